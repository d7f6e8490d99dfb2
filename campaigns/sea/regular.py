"""The motions of regular waves beside a sea: their loads, and the folds between a small and a large one.

The folder `regular` holds a sweep of waves.amplitude_m, as `campaigns.sweep` makes it, up to 1.86 times the significant
height. Where a wave has two motions, the largest tension says to which of them a piece of a record in a sea belongs.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from operator import itemgetter

import numpy as np

import engine
from analysis import slow_forecast
from campaigns import sweep
from campaigns.answers import lasting
from campaigns.explore.grid import Grid, varied
from campaigns.explore.sweep import REST
from campaigns.machinery import CampaignStopped, Plan, Summary, spare_groups
from campaigns.machinery.session import condensed
from campaigns.study import Order
from engine.views import carries_tangents
from tables import PEAK, Rows, number_of

FOLDER, KEY = "regular", "waves.amplitude_m"
DESIGN, SAME_ENERGY = 1.86, 1.0 / math.sqrt(2.0)  # heights of regular waves over the significant height
HEIGHTS, LOWEST = 9, 0.15  # waves of the sweep; the lowest over the highest
BUDGET, KICKS = 300, 3  # wave periods of a run, and kicks at each height
# of the amplitude of a wave: the highest of the sweep; nearness at which a wave counts as it
BELOW_BREAKING, NEAR = 0.98, 0.06
RAMP = 2000  # amplitudes of a slowly rising or falling wave
APART = 1.2  # two motions of a wave are a small and a large one if their tensions differ by this factor
SEA_KEYS = (
    "waves.jonswap", "waves.component", "waves.significant_steepness", "waves.relative_width", "waves.seed",
    "waves.record",
)  # fmt: skip


def significant_height_m(scene) -> float:
    """Four standard deviations of the surface, from the waves of a sea."""
    from engine.physics.sea import components_of

    _, amplitudes_m, *_ = components_of(scene)
    return float(4.0 * math.sqrt(np.sum(amplitudes_m**2) / 2.0))


def _breaking_m(scene) -> float:
    """Amplitude of the highest regular wave of the peak period."""
    from engine.physics.waves import breaking_steepness, wave_number

    depth_m = scene.water.depth_m
    k = wave_number(scene.waves.period_s, depth_m, scene.gravity_mps2)
    return breaking_steepness(k, depth_m) / k


def one_set(order: Order) -> bool:
    """Whether all states of the order have their regular waves in common: only the sea is varied, not its direction."""
    headings = {scene.waves.heading_rad for scene in order.scenes}
    return len(headings) == 1 and all(key.key.startswith(SEA_KEYS) for key in order.options.grid.keys)


def regular_order(order: Order) -> Order | None:
    """The order of a sweep over regular waves; None where the states of a map have none in common.

    Raises CampaignStopped where a wave cannot be run.
    """
    if not one_set(order):
        return None
    heights_m = sorted({float(f"{significant_height_m(scene):.5g}") for scene in order.scenes})
    scene = order.scenes[0]
    top_m = min(0.5 * DESIGN * heights_m[-1], BELOW_BREAKING * _breaking_m(scene))
    amplitudes = {float(f"{top_m * share:.6g}") for share in np.linspace(LOWEST, 1.0, HEIGHTS)}
    if len(heights_m) == 1:
        amplitudes |= {float(f"{0.5 * heights_m[0] * share:.6g}") for share in (1.0, SAME_ENERGY)}
    changes = {name: value for name, value in order.changes.items() if not name.startswith(SEA_KEYS)}
    changes |= {
        "waves.direction_rad": scene.waves.heading_rad,
        "waves.above_still_water": scene.waves.above_still_water,
        "buoy.submergence": scene.buoy.submergence,  # whose default is another one in a sea
    }
    key = varied([KEY], [], numbers=sorted(amplitudes))
    how = replace(order.how, out=order.how.out / FOLDER, report=False)
    waves = sweep.STUDY.order(
        how,
        order.name,
        changes,
        grid=Grid((key,)),
        starts=KICKS if carries_tangents(scene) else REST,
        budget=BUDGET,
        kick_speed=order.options.kick_speed,
        seed=order.options.seed,
        no_accuracy=True,
    )
    if waves.faults:
        raise CampaignStopped("; ".join(condensed(waves.faults)) + "; leave regular waves out with --no-regular")
    waves.simulate = None if order.simulate is engine.simulate else order.simulate
    return waves


def regular_ahead(order: Order, plan: Plan) -> None:
    """Let workers that would wait for the last runs in a sea do those of regular waves from rest.

    Raises CampaignStopped where a wave cannot be run: before the runs in the sea.
    """
    waves = regular_order(order)
    if waves is not None:
        plan.spare.extend(spare_groups(sweep.STUDY.plan(waves), waves.how.out, waves.cases))


def regular_waves(order: Order, plan: Plan, summary: Summary) -> float:
    """Do the sweep of regular waves; nothing where the states of a map have none in common. Returns seconds."""
    waves = regular_order(order)
    if waves is None:
        return 0.0
    plan.spare.clear()  # what is left of `regular_ahead` is done here
    (waves.how.out / "trajectories").mkdir(parents=True, exist_ok=True)
    return sweep.STUDY.work(waves).times["analysis_s"]


@dataclass(frozen=True)
class Folds:
    """The motions of regular waves over their amplitude, and the border between a small and a large motion.

    ranges (k, 2): amplitudes (m) between which each motion exists. amplitudes_m, tensions_N: of the waves of the sweep
    that have a motion, (k,) of (n,). border_m, border_N (b,): waves that have a small and a large motion, and the
    geometric mean of the largest tensions of both.
    """

    ranges: np.ndarray
    amplitudes_m: list[list[float]]
    tensions_N: list[list[float]]
    border_m: np.ndarray
    border_N: np.ndarray

    def is_large(self, amplitude_m: np.ndarray, tension_N: np.ndarray) -> np.ndarray:
        """Whether a largest tension is that of a large motion; beyond the waves that have both as at the nearest."""
        return tension_N > np.interp(amplitude_m, self.border_m, self.border_N)

    def forecast(self, amplitude_m: np.ndarray, inside: bool) -> np.ndarray:
        """Whether a motion that follows a slow envelope is large, at each amplitude; inside: at the first."""
        large = []
        for known_m, known_N in zip(self.amplitudes_m, self.tensions_N, strict=True):
            large.append(self.is_large(amplitude_m, np.interp(amplitude_m, known_m, known_N)))
        exists = (self.ranges[:, 0] <= amplitude_m[0]) & (amplitude_m[0] <= self.ranges[:, 1])
        likely = exists & (np.array(large)[:, 0] == inside)
        motions = slow_forecast(amplitude_m, self.ranges, int(np.argmax(likely)))
        return np.array(large)[motions, np.arange(len(amplitude_m))]

    def jump(self, rising: bool) -> float:
        """Amplitude (m) at which a slowly rising wave brings the large motion, or a falling one ends it; NaN: none."""
        ramp_m = np.linspace(min(map(min, self.amplitudes_m)), max(map(max, self.amplitudes_m)), RAMP)
        if not rising:
            ramp_m = ramp_m[::-1]
        jumped = self.forecast(ramp_m, not rising) == rising
        return float(ramp_m[np.argmax(jumped)]) if jumped.any() else math.nan


def folds_of(rows: Rows, ends: Rows) -> Folds | None:
    """The folds of a sweep of regular waves, from the rows of its tables; None where no wave has two unlike motions."""
    waves, motions = {}, {}  # largest tensions by amplitude; by letter and amplitude
    for row in lasting(rows):
        amplitude_m, tension_N = row[KEY], row[PEAK]
        if row.get("motion"):
            waves.setdefault(amplitude_m, []).append(tension_N)
            motions.setdefault(str(row["motion"]), {})[amplitude_m] = tension_N
    border = {}
    for amplitude_m, tensions_N in sorted(waves.items()):
        least, largest = min(tensions_N), max(tensions_N)
        if largest > APART * least > 0.0:
            border[amplitude_m] = math.sqrt(least * largest)
    if not border:
        return None
    ranges = []
    for letter, known in motions.items():
        ranges.append([_end(letter, which, known, ends, sorted(waves)) for which in ("lower", "upper")])
    known_m, known_N = [sorted(known) for known in motions.values()], []
    for amplitudes_m, known in zip(known_m, motions.values(), strict=True):
        known_N.append([known[amplitude_m] for amplitude_m in amplitudes_m])
    return Folds(np.array(ranges), known_m, known_N, np.array([*border]), np.array([*border.values()]))


def _end(letter: str, which: str, known: Mapping[float, float], ends: Rows, waves: Sequence[float]) -> float:
    """Where a motion ends: as orbit or bisection say, else half-way to the next wave; beyond the sweep never."""
    last, step = (min(known), -1) if which == "lower" else (max(known), 1)
    place = waves.index(last) + step
    if not 0 <= place < len(waves):
        return step * math.inf
    for row in ends:
        if (row["motion"], row["end"]) == (letter, which):
            exact = number_of(row, f"{KEY}_end")
            bisected = 0.5 * (number_of(row, f"{KEY}_with") + number_of(row, f"{KEY}_without"))
            return exact if math.isfinite(exact) else bisected
    return 0.5 * (last + waves[place])


def design_loads(rows: Rows, amplitude_m: float) -> list[tuple]:
    """Letter and largest tension (N) of each motion of the regular wave of an amplitude, the smallest first.

    A wave of the sweep within NEAR counts as this one. Else the tension of a motion lies between those of the next
    smaller and the next larger wave; a motion that only one of them has counts where that one is the nearer. Outside
    the sweep the list is empty.
    """
    waves = {}  # largest tensions by amplitude and letter
    for row in lasting(rows):
        waves.setdefault(row[KEY], {})[str(row["motion"])] = row[PEAK]
    nearest = min(waves, key=lambda value: abs(value - amplitude_m), default=math.inf)
    if abs(nearest - amplitude_m) <= NEAR * amplitude_m:
        loads = waves[nearest]
    elif min(waves, default=math.inf) < amplitude_m < max(waves):
        loads = dict(waves[nearest])
        smaller, larger = max(a for a in waves if a < amplitude_m), min(a for a in waves if a > amplitude_m)
        share = (amplitude_m - smaller) / (larger - smaller)
        for letter in waves[smaller].keys() & waves[larger].keys():
            loads[letter] = (1.0 - share) * waves[smaller][letter] + share * waves[larger][letter]
    else:
        loads = {}
    return sorted(loads.items(), key=itemgetter(1))
