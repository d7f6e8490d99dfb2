"""Data of figure 19: Poincare sections of the exact model (a) and of eq. (33) (b), both in the units of eq. (33).

Lengths over the buoy's diameter D, time in units of the radial natural frequency: g = (r - l_0)/D, so that the tether
is slack below 0 in both, and g' = r'/(D w_nr).
"""

import numpy as np

from campaigns.figure_data import Array, Source, source
from campaigns.machinery.folder import trajectory_path
from campaigns.paper.figures.buoy import buoy_run
from campaigns.paper.figures.plans import LeftOut, Parts, Plan
from campaigns.paper.measures import LARGE, strobed
from engine.natural_frequencies import natural_frequencies

LEAST_POINTS = 20


def sections(parts: Parts) -> Plan:
    """Figure 19."""
    part, trajectory, found = buoy_run(parts, LARGE)
    points = strobed(trajectory, int(part.provenance["transient"]))
    if len(points) < LEAST_POINTS:
        raise LeftOut(f"the section at kA = {LARGE:g} has {len(points)} points, {LEAST_POINTS} are needed")
    states, numbers, other = _oscillator(parts)
    title = "Poincaré sections of the exact model and of eq. (33)"
    return Plan(title, (found, other), lambda: _sections(trajectory, points, states, numbers))


def _oscillator(parts: Parts) -> tuple[np.ndarray, dict[str, float], Source]:
    """Strobed states (m, 2) of eq. (33), its numbers, and where they are from."""
    from scipy.io import netcdf_file

    part = parts.part("oscillator")
    row = next((row for row in part.rows if row["part"] == "section"), None)
    if row is None:
        raise LeftOut("the part `oscillator` has no section: it has no row in table.csv")
    path = trajectory_path(part.folder, row["run_key"])
    try:
        with netcdf_file(path, "r", mmap=False) as file:
            states = np.array(file.variables["section"][:])
    except (OSError, ValueError, TypeError, KeyError) as error:
        reason = row["message"] or f"its arrays cannot be read ({type(error).__name__})"
        raise LeftOut(f"the part `oscillator` has no section: {reason}") from None
    settings = (part.folder / "scene.toml").read_text(encoding="utf-8")
    numbers = {key: float(entry) for key, entry in part.provenance["oscillator"].items()}
    return states, numbers, source("eq. (33)", parts.root, path, row["run_key"], settings, row["wall_s"])


def _sections(trajectory, points, states, numbers) -> dict[str, Array]:
    scene = trajectory.scene
    modes = natural_frequencies(scene)
    length, diameter = scene.tether.length_m, scene.buoy.diameter_m
    radius, rate = points.T
    exact, reduced = ("exact_point",), ("reduced_point",)
    return {
        "exact_radius_m": (exact, radius, "m", "strobed distance of the buoy from the anchor"),
        "exact_rate_mps": (exact, rate, "m s-1", "strobed rate of that distance"),
        "exact_displacement": (exact, (radius - length) / diameter, "1", "(r - l_0)/D"),
        "exact_velocity": (exact, rate / (diameter * modes.radial_radps), "1", "r'/(D w_nr)"),
        "unstretched_m": ((), length, "m", "unstretched length l_0"),
        "diameter_m": ((), diameter, "m", "diameter D of the buoy"),
        "natural_radial_radps": ((), modes.radial_radps, "rad s-1", "radial natural frequency"),
        "reduced_displacement": (reduced, states[:, 0], "1", "gamma of eq. (33)"),
        "reduced_velocity": (reduced, states[:, 1], "1", "its rate"),
        **{key: ((), entry, "1", f"{key} of eq. (33)") for key, entry in numbers.items()},
    }
