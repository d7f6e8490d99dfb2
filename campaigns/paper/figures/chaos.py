"""Data of figures 14 and 19: largest Lyapunov exponents over the length of the record, and Poincare sections.

Figure 14, bits per wave period: Wolf's method on r(t) (eq. (32)), one setting of the plateau of
`analysis.wolf_lyapunov`, and beside it the exponent of the tangent dynamics, which needs no neighbours: the mean growth
of an infinitesimal perturbation up to that time.

Figure 19, sections of the exact model (a) and of eq. (33) (b), both in the units of eq. (33): lengths over the buoy's
diameter D, time in units of the radial natural frequency: g = (r - l_0)/D, so that the tether is slack below 0 in both,
and g' = r'/(D w_nr).
"""

import numpy as np

from campaigns.figure_data import Array, Source, source
from campaigns.machinery import trajectory_path
from campaigns.paper.measured import LeftOut, Parts, Plan
from engine.natural_frequencies import natural_frequencies
from engine.views import carried, strobed_radius
from tables import LARGE, SMALL

LINEAR_PERIODS = 200  # kept whole, for a linear axis as in the paper; a longer record is drawn on a logarithmic one
LATER_POINTS = 600
WAVES = {"large": LARGE, "small": SMALL}  # in the order of the paper's key
LEAST_POINTS = 20


def running_exponents(parts: Parts) -> Plan:
    """Figure 14."""
    runs = {name: parts.of_buoy(steepness) for name, steepness in WAVES.items()}
    for name, (trajectory, _) in runs.items():
        if not carried(trajectory):
            raise LeftOut(f"the run at kA = {WAVES[name]:g} carried no perturbation (`output.tangent_vectors`)")
    transient, sources = int(parts.part("buoy").provenance["transient"]), tuple(origin for _, origin in runs.values())
    return Plan("Running maximum Lyapunov exponents", sources, lambda: _exponents(runs, transient))


def _exponents(runs: dict, transient: int) -> dict[str, Array]:
    from analysis import tangent_lyapunov, wolf_lyapunov

    arrays = {
        "transient_periods": ((), transient, "1", "wave periods left out at the start"),
        "linear_periods": ((), LINEAR_PERIODS, "1", "length of the record up to which every value is kept"),
    }
    for name, (trajectory, _) in runs.items():
        scene, kA = trajectory.scene, f"kA = {WAVES[name]:g}"
        period_s, step_s = scene.waves.period_s, scene.sample_step_s()
        first = round(transient * period_s / step_s)
        wolf = wolf_lyapunov(trajectory.columns["radius_m"][first:], step_s).in_bits_per_period(period_s)
        if not wolf.found:
            raise LeftOut(f"Wolf's method gives no exponent at {kA}: {wolf.reason}")
        course = wolf.details["run"]
        growth = trajectory.tangent.growth_nats[transient:, 0]
        count = np.arange(len(growth)) + 1.0
        (tangent,) = tangent_lyapunov(trajectory.tangent.growth_nats[:, :1], transient)
        curves = {
            "wolf": (wolf, course.time_s / period_s, course.convergence * period_s, "Wolf's method"),
            "tangent": (tangent, count, np.cumsum(growth) / count, "the tangent dynamics"),
        }
        for method, (exponent, periods, nats, words) in curves.items():
            shown, axis = _thinned(periods), (f"{name}_{method}_periods",)
            about = f"exponent per wave period by {words}, {kA}"
            arrays[axis[0]] = (axis, periods[shown], "1", "length of the record used, wave periods")
            arrays[f"{name}_{method}_bits"] = (axis, nats[shown] / np.log(2.0), "bit", about)
            arrays[f"{name}_{method}_value"] = ((), exponent.value, "bit", f"exponent per wave period, {method}, {kA}")
            arrays[f"{name}_{method}_error"] = ((), exponent.error, "bit", f"its standard error, {method}, {kA}")
    return arrays


def _thinned(periods: np.ndarray) -> np.ndarray:
    """Indices of all points of the first LINEAR_PERIODS, then of points at even distances in the logarithm."""
    first = int(np.searchsorted(periods, LINEAR_PERIODS, side="right"))
    later = np.geomspace(first + 1, max(len(periods), first + 1), LATER_POINTS)
    return np.unique(np.concatenate([np.arange(first), np.round(later).astype(int) - 1])).clip(max=len(periods) - 1)


def sections(parts: Parts) -> Plan:
    """Figure 19."""
    trajectory, origin = parts.of_buoy(LARGE)
    points = strobed_radius(trajectory, int(parts.part("buoy").provenance["transient"]))
    if len(points) < LEAST_POINTS:
        raise LeftOut(f"the section at kA = {LARGE:g} has {len(points)} points, {LEAST_POINTS} are needed")
    states, numbers, reduced = _oscillator(parts)
    title = "Poincaré sections of the exact model and of eq. (33)"
    return Plan(title, (origin, reduced), lambda: _sections(trajectory, points, states, numbers))


def _oscillator(parts: Parts) -> tuple[np.ndarray, dict, Source]:
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
    scene, (radius, rate) = trajectory.scene, points.T
    modes, length, diameter = natural_frequencies(scene), scene.tether.length_m, scene.buoy.diameter_m
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
