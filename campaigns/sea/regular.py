"""The motions of regular waves beside a sea: their loads, and the folds between a small and a large one.

The folder `regular` holds a sweep of waves.amplitude_m, as `campaigns.sweep` makes it, up to 1.86 times the significant
height. Where a wave has two motions, the measure that tells them apart best says to which of them a piece of a record
in a sea belongs.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from analysis import slow_forecast
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
RAMP = 2000  # amplitudes of a slowly rising or falling wave
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
class Motion:
    """A motion of regular waves.

    letter, begins, ends: of its range of amplitudes (m). before, after: letters of the motions that follow where it
    ends at falling and at rising waves; "" where that is not known. amplitude_m, swing (k,): its measure.
    """

    letter: str
    begins: float
    ends: float
    before: str
    after: str
    amplitude_m: np.ndarray
    swing: np.ndarray


@dataclass(frozen=True)
class Folds:
    """The motions of regular waves over their amplitude, and a border between a small and a large motion.

    measure: what tells them apart best (`swings`). amplitude_m, small, large (k,): its values at the waves that have
    both. enters, leaves: amplitudes (m) at which a slowly rising wave brings the large motion, and a slowly falling one
    ends it; NaN: none does.
    """

    motions: tuple[Motion, ...]
    measure: str
    amplitude_m: np.ndarray
    small: np.ndarray
    large: np.ndarray

    def border(self, amplitude_m: np.ndarray) -> np.ndarray:
        """The measure between both motions at an amplitude; beyond the waves that have both as at the nearest."""
        return np.interp(amplitude_m, self.amplitude_m, np.sqrt(self.small * self.large))

    def forecast(self, amplitude_m: np.ndarray, inside: bool) -> np.ndarray:
        """Whether a motion that follows a slow envelope is large, at each amplitude; inside: at the first."""
        letters = [motion.letter for motion in self.motions]
        ranges = [(motion.begins, motion.ends) for motion in self.motions]
        successors = [
            [letters.index(letter) if letter in letters else -1 for letter in (m.before, m.after)] for m in self.motions
        ]
        border = self.border(amplitude_m)
        large = np.stack([np.interp(amplitude_m, m.amplitude_m, m.swing) for m in self.motions]) > border
        start = 0
        for number, (begins, ends) in enumerate(ranges):
            if begins <= amplitude_m[0] <= ends and large[number, 0] == inside:
                start = number
                break
        followed = slow_forecast(amplitude_m, ranges, start, successors)
        return large[followed, np.arange(len(amplitude_m))]

    @cached_property
    def enters(self) -> float:
        rising = self._ramp()
        large = self.forecast(rising, False)
        return float(rising[np.argmax(large)]) if large.any() else math.nan

    @cached_property
    def leaves(self) -> float:
        falling = self._ramp()[::-1]
        small = ~self.forecast(falling, True)
        return float(falling[np.argmax(small)]) if small.any() else math.nan

    def _ramp(self) -> np.ndarray:
        ends = [motion.amplitude_m for motion in self.motions]
        return np.linspace(min(map(np.min, ends)), max(map(np.max, ends)), RAMP)


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
    motions = tuple(_motion(letter, at, ends, measure) for letter in _letters(at))
    small, large = (np.array([pairs[amplitude][which][0] for amplitude in run]) for which in (0, 1))
    return Folds(motions, measure, np.array(run), small, large)


def _letters(at: Mapping[float, Sequence[Row]]) -> list[str]:
    return sorted({str(row["motion"]) for rows in at.values() for row in rows})


def _motion(letter: str, at: Mapping[float, Sequence[Row]], ends: Sequence[Row], measure: str) -> Motion:
    """The motion of a letter, with its range and what follows it."""
    swing = {}
    for amplitude, rows in sorted(at.items()):
        for row in rows:
            if row["motion"] == letter:
                swing[amplitude] = _swing(row, measure)
    own = {row["end"]: row for row in ends if row["motion"] == letter}
    amplitudes = sorted(at)
    begins = _end(own.get("lower"), amplitudes, min(swing), -1)
    last = _end(own.get("upper"), amplitudes, max(swing), 1)
    before, after = (str(own[end].get("leads_to") or "") if end in own else "" for end in ("lower", "upper"))
    return Motion(letter, begins, last, before, after, np.array([*swing]), np.array([*swing.values()]))


def _longest_run(amplitudes: Sequence[float], pairs: Mapping[float, object]) -> list[float]:
    """The longest row of neighbouring amplitudes that all have a pair."""
    longest: list[float] = []
    current: list[float] = []
    for amplitude in amplitudes:
        current = [*current, amplitude] if amplitude in pairs else []
        if len(current) > len(longest):
            longest = current
    return longest


def _end(row: Row | None, amplitudes: Sequence[float], last: float, step: int) -> float:
    """Where a motion ends: as orbit or bisection say, else half-way to the next wave; beyond the sweep never."""
    place = list(amplitudes).index(last) + step
    if not 0 <= place < len(amplitudes):
        return step * math.inf
    if row is None:
        return 0.5 * (last + amplitudes[place])
    exact = number_of(row, f"{KEY}_end")
    if math.isfinite(exact):
        return exact
    return 0.5 * (number_of(row, f"{KEY}_with") + number_of(row, f"{KEY}_without"))


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
