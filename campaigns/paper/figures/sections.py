"""Data of figure 19: Poincare sections of the exact model (a) and of eq. (33) (b), both in the units of eq. (33).

Lengths over the buoy's diameter D, time in units of the radial natural frequency: g = (r - l_0)/D, so that the tether
is slack below 0 in both, and g' = r'/(D w_nr).
"""

from campaigns.paper.figures.buoy import LARGE, buoy_run
from campaigns.paper.figures.plans import LeftOut, Parts, Plan
from reports.buoy_sweep.physics import natural_frequencies
from reports.buoy_sweep.runs import strobed
from reports.oscillator.folder import read_study
from reports.parts.figure_data import Array, Source, source
from reports.parts.folder import FolderError

LEAST_POINTS = 20


def sections(parts: Parts) -> Plan:
    """Figure 19."""
    folder, trajectory, found = buoy_run(parts, LARGE)
    points = strobed(trajectory, int(folder.provenance["transient"]))
    if len(points) < LEAST_POINTS:
        raise LeftOut(f"the section at kA = {LARGE:g} has {len(points)} points, {LEAST_POINTS} are needed")
    study, other = _oscillator(parts)
    title = "Poincaré sections of the exact model and of eq. (33)"
    return Plan(title, (found, other), lambda: _sections(trajectory, points, study))


def _oscillator(parts: Parts) -> tuple[object, Source]:
    place = parts.root / "oscillator"
    try:
        study = read_study(place)
    except FolderError as error:
        raise LeftOut(f"the part `oscillator` is not there: {'; '.join(error.faults)}") from None
    if "section" in study.faults:
        raise LeftOut(f"the part `oscillator` has no section: {study.faults['section']}")
    row = study.rows["section"]
    path = place / "trajectories" / f"{row['run_key']}.nc"
    settings = (place / "scene.toml").read_text(encoding="utf-8")
    return study, source("eq. (33)", parts.root, path, row["run_key"], settings, float(row["wall_s"]))


def _sections(trajectory, points, study) -> dict[str, Array]:
    scene = trajectory.scene
    modes = natural_frequencies(scene)
    length, diameter = scene.tether.length_m, scene.buoy.diameter_m
    radius, rate = points.T
    states = study.arrays["section"]["section"]
    exact, reduced = ("exact_point",), ("reduced_point",)
    numbers = {key: ((), entry, "1", f"{key} of eq. (33)") for key, entry in study.oscillator.items()}
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
        **numbers,
    }
