"""Data of figure 14: the largest Lyapunov exponent of both waves over the length of the record, bits per wave period.

Wolf's method on r(t) (eq. (32)), one setting of the plateau of `analysis.wolf_lyapunov`, and beside it the exponent of
the tangent dynamics, which needs no neighbours: the mean growth of an infinitesimal perturbation up to that time.
"""

import numpy as np

from campaigns.figure_data import Array
from campaigns.judge import carried
from campaigns.paper.figures.buoy import buoy_run
from campaigns.paper.figures.plans import LeftOut, Parts, Plan
from campaigns.paper.measures import LARGE, SMALL

LINEAR_PERIODS = 200  # kept whole, for a linear axis as in the paper; a longer record is drawn on a logarithmic one
LATER_POINTS = 600
WAVES = {"large": LARGE, "small": SMALL}  # in the order of the paper's key


def running_exponents(parts: Parts) -> Plan:
    """Figure 14."""
    runs, found = {}, []
    for name, steepness in WAVES.items():
        part, runs[name], source = buoy_run(parts, steepness)
        found.append(source)
        if not carried(runs[name]):
            raise LeftOut(f"the run at kA = {steepness:g} carried no perturbation (`output.tangent_vectors`)")
    transient = int(part.provenance["transient"])
    return Plan("Running maximum Lyapunov exponents", tuple(found), lambda: _exponents(runs, transient))


def _exponents(runs: dict, transient: int) -> dict[str, Array]:
    from analysis import tangent_lyapunov, wolf_lyapunov

    arrays: dict[str, Array] = {
        "transient_periods": ((), transient, "1", "wave periods left out at the start"),
        "linear_periods": ((), LINEAR_PERIODS, "1", "length of the record up to which every value is kept"),
    }
    for name, trajectory in runs.items():
        scene, kA = trajectory.scene, f"kA = {WAVES[name]:g}"
        period_s, step_s = scene.waves.period_s, scene.sample_step_s()
        after = round(transient * period_s / step_s)
        wolf = wolf_lyapunov(trajectory.columns["radius_m"][after:], step_s).in_bits_per_period(period_s)
        if not wolf.found:
            raise LeftOut(f"Wolf's method gives no exponent at {kA}: {wolf.reason}")
        one = wolf.details["run"]
        growth = trajectory.tangent.growth_nats[transient:, 0]
        count = np.arange(len(growth)) + 1.0
        curves = {
            "wolf": (one.time_s / period_s, one.convergence * period_s, "Wolf's method"),
            "tangent": (count, np.cumsum(growth) / count, "the tangent dynamics"),
        }
        for method, (periods, nats, words) in curves.items():
            shown = _thinned(periods)
            axis = (f"{name}_{method}_periods",)
            about = f"exponent per wave period by {words}, {kA}"
            arrays[axis[0]] = (axis, periods[shown], "1", "length of the record used, wave periods")
            arrays[f"{name}_{method}_bits"] = (axis, nats[shown] / np.log(2.0), "bit", about)
        (tangent,) = tangent_lyapunov(trajectory.tangent.growth_nats[:, :1], transient)
        for method, exponent in (("wolf", wolf), ("tangent", tangent)):
            arrays[f"{name}_{method}_value"] = ((), exponent.value, "bit", f"exponent per wave period, {method}, {kA}")
            arrays[f"{name}_{method}_error"] = ((), exponent.error, "bit", f"its standard error, {method}, {kA}")
    return arrays


def _thinned(periods: np.ndarray) -> np.ndarray:
    """Indices of all points of the first LINEAR_PERIODS, then of points at even distances in the logarithm."""
    first = int(np.searchsorted(periods, LINEAR_PERIODS, side="right"))
    later = np.geomspace(first + 1, max(len(periods), first + 1), LATER_POINTS)
    return np.unique(np.concatenate([np.arange(first), np.round(later).astype(int) - 1])).clip(max=len(periods) - 1)
