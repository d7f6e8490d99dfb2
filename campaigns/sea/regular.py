"""The motions of regular waves beside a sea: their loads, and the folds between a small and a large one.

The folder `regular` holds a sweep of waves.amplitude_m, as `campaigns.sweep` makes it, up to 1.86 times the significant
height. Where a wave has two motions, the measure that tells them apart best says to which of them a piece of a record
in a sea belongs.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from campaigns.explore.grid import Grid, varied
from campaigns.explore.sweep import tables_of
from campaigns.machinery.folder import CampaignStopped
from campaigns.machinery.plan import Plan, Summary
from campaigns.study import Order
from tables import PEAK, Row, number_of

FOLDER, KEY = "regular", "waves.amplitude_m"
DESIGN, SAME_ENERGY = 1.86, 1.0 / math.sqrt(2.0)  # heights of regular waves over the significant height
HEIGHTS, LOWEST = 13, 0.15  # waves of the sweep; the lowest over the highest
BUDGET, KICKS = 300, 4  # wave periods of a run, and kicks at each height
APART = 1.2  # two motions of a wave are a small and a large one if a measure of them differs by this factor
SEA_KEYS = ("waves.jonswap", "waves.components", "waves.significant_steepness", "waves.relative_width")


def significant_height_m(scene) -> float:
    """Four standard deviations of the surface, from the waves of a sea."""
    from engine.physics.sea import components_of

    _, amplitudes_m, *_ = components_of(scene)
    return float(4.0 * math.sqrt(np.sum(amplitudes_m**2) / 2.0))


def one_set(order: Order) -> bool:
    """Whether all states of the order have their regular waves in common: only the sea itself is varied."""
    return all(key.key.startswith(SEA_KEYS) for key in order.options.grid.keys)


def regular_waves(order: Order, plan: Plan, summary: Summary) -> float:
    """Do the sweep of regular waves; nothing where the states of a map have none in common. Returns seconds."""
    from campaigns import sweep

    if not one_set(order):
        return 0.0
    heights_m = sorted({round(significant_height_m(scene), 4) for scene in order.scenes})
    top_m = 0.5 * DESIGN * heights_m[-1]
    amplitudes = {float(f"{top_m * share:.6g}") for share in np.linspace(LOWEST, 1.0, HEIGHTS)}
    if len(heights_m) == 1:
        amplitudes |= {float(f"{0.5 * heights_m[0] * share:.6g}") for share in (1.0, SAME_ENERGY)}
    changes = {name: value for name, value in order.changes.items() if not name.startswith(SEA_KEYS)}
    changes["waves.above_still_water"] = order.scenes[0].waves.above_still_water
    key = replace(varied([KEY, "0", "1", "2"], []), values=tuple(sorted(amplitudes)))
    options = {"grid": Grid((key,)), "starts": KICKS, "budget": BUDGET}
    options |= {"kick_speed": order.options.kick_speed, "seed": order.options.seed}
    how = replace(order.how, out=order.how.out / FOLDER, report=False)
    waves = sweep.STUDY.order(how, order.name, changes, **options)
    if waves.faults:
        raise CampaignStopped("; ".join(waves.faults) + "; leave regular waves out with --no-regular")
    (how.out / "trajectories").mkdir(parents=True, exist_ok=True)
    waves.simulate = None if plan.simulate_each is not None else order.simulate
    timing, _ = sweep.STUDY.work(waves)
    return timing["analysis_s"]


@dataclass(frozen=True)
class Folds:
    """A small and a large motion of regular waves over their amplitude.

    enters, leaves: amplitudes (m) at which the small motion ends, and the large one. measure: what tells them apart, a
    column of `swings`. amplitude_m, small, large: its values (k,) at the waves that have both.
    """

    enters: float
    leaves: float
    measure: str
    amplitude_m: np.ndarray
    small: np.ndarray
    large: np.ndarray

    def border(self, amplitude_m: np.ndarray) -> np.ndarray:
        """The measure that lies between both motions, at an amplitude; beyond the folds as at the nearest wave."""
        return np.interp(amplitude_m, self.amplitude_m, np.sqrt(self.small * self.large))


_SWINGS = {  # measure -> its least and greatest value in a row of the sweep; "" for a value without a least
    "tension": ("", PEAK),
    "radius": ("radius_min_m", "radius_max_m"),
    "angle": ("angle_min_rad", "angle_max_rad"),
}


def swings(columns: Mapping[str, np.ndarray], begins: Sequence[int], ends: Sequence[int]) -> dict[str, np.ndarray]:
    """The measures of pieces of a record: largest tension, and ranges of radius and angle."""
    values = {"tension": [], "radius": [], "angle": []}
    for begin, end in zip(begins, ends, strict=True):
        values["tension"].append(columns["tension_top_high_N"][begin:end].max())
        values["radius"].append(np.ptp(columns["radius_m"][begin:end]))
        values["angle"].append(np.ptp(columns["angle_rad"][begin:end]))
    return {name: np.array(series) for name, series in values.items()}


def _swing(row: Row, measure: str) -> float:
    least, greatest = _SWINGS[measure]
    return number_of(row, greatest) - (number_of(row, least) if least else 0.0)


def folds_of(rows: Sequence[Row], ends: Sequence[Row]) -> Folds | None:
    """The folds of a sweep of regular waves, from the rows of its tables; None where no wave has two unlike motions."""
    at: dict[float, list[Row]] = {}
    for row in rows:
        if row.get("motion") and row["status"] == "ok" and math.isfinite(number_of(row, PEAK)):
            at.setdefault(number_of(row, KEY), []).append(row)
    best, best_ratio = None, 0.0
    for measure in _SWINGS:
        pairs = {}
        for amplitude, motions in sorted(at.items()):
            sizes = sorted((_swing(row, measure), str(row["motion"])) for row in motions)
            if sizes[0][0] > 0.0 and sizes[-1][0] > APART * sizes[0][0]:
                pairs[amplitude] = sizes[0], sizes[-1]
        run = _longest_run(sorted(at), pairs)
        if not run:
            continue
        ratio = math.exp(np.mean([math.log(pairs[amplitude][1][0] / pairs[amplitude][0][0]) for amplitude in run]))
        if ratio > best_ratio:
            best, best_ratio = (measure, run, pairs), ratio
    if best is None:
        return None
    measure, run, pairs = best
    amplitudes = sorted(at)
    leaves = _end(ends, pairs[run[0]][1][1], "lower", amplitudes, run[0], -1)
    enters = _end(ends, pairs[run[-1]][0][1], "upper", amplitudes, run[-1], 1)
    small, large = (np.array([pairs[amplitude][which][0] for amplitude in run]) for which in (0, 1))
    return Folds(enters, leaves, measure, np.array(run), small, large)


def _longest_run(amplitudes: Sequence[float], pairs: Mapping[float, object]) -> list[float]:
    """The longest row of neighbouring amplitudes that all have a pair."""
    longest: list[float] = []
    current: list[float] = []
    for amplitude in amplitudes:
        current = [*current, amplitude] if amplitude in pairs else []
        if len(current) > len(longest):
            longest = current
    return longest


def _end(ends: Sequence[Row], letter: str, which: str, amplitudes: Sequence[float], last: float, step: int) -> float:
    """Where a motion ends: as its orbit or its bisection says, else half-way to the next wave of the sweep."""
    place = list(amplitudes).index(last) + step
    if not 0 <= place < len(amplitudes):
        return last
    beyond = amplitudes[place]
    for row in ends:
        exact, bracket = number_of(row, f"{KEY}_end"), (number_of(row, f"{KEY}_with"), number_of(row, f"{KEY}_without"))
        known = exact if math.isfinite(exact) else 0.5 * sum(bracket)
        if row["motion"] == letter and row["end"] == which and min(last, beyond) <= known <= max(last, beyond):
            return known
    return 0.5 * (last + beyond)


def design_loads(rows: Sequence[Row], amplitude_m: float) -> list[tuple[str, float]]:
    """Letter and largest tension (N) of each motion of the regular wave nearest to an amplitude, the smallest first."""
    known = [row for row in rows if row["status"] == "ok" and math.isfinite(number_of(row, PEAK))]
    if not known:
        return []
    nearest = min((number_of(row, KEY) for row in known), key=lambda value: abs(value - amplitude_m))
    loads = [(str(row["motion"]), number_of(row, PEAK)) for row in known if number_of(row, KEY) == nearest]
    return sorted(loads, key=lambda load: load[1])


def regular_tables(order: Order) -> tuple[tuple[Row, ...], tuple[Row, ...]]:
    """The rows of the motions of regular waves, and of their ends; none where there are none."""
    folder = order.how.out / FOLDER
    return tables_of(folder, ".")["."], tables_of(folder, "ends")["ends"]
