"""What a sweep of wave steepness found: regimes, jumps, chaos, what is undecided, the largest tension and its use.

A jump: between two neighbouring values the largest tension changes by more than a quarter, and by more than three times
the median change between neighbours. A largest tension is doubted where the model says more than it knows (`reasons`).
"""

import math
from collections.abc import Iterator, Sequence
from functools import partial
from itertools import pairwise
from operator import itemgetter
from statistics import median

from campaigns.answers import OPEN_WORDS, greatest, kilonewton, numbers_of, regimes
from campaigns.explore.motions import from_rest
from campaigns.machinery.session import MOST_LINES
from engine.natural_frequencies import natural_frequencies
from engine.views import in_regular_waves
from tables import (
    BUOY_HEIGHT,
    CAPPED,
    COARSE,
    EMPTY,
    OTHER_MOTION,
    PEAK,
    PEAK_ERROR,
    Row,
    listed,
    number_of,
    of_kicks,
    ranges,
)

LEAST_JUMP, TYPICAL = math.log(1.25), 3.0
MOST_ENDS = 4  # that are named
NAMED = 3  # jumps beside the largest that are named
SMALLER = "Smaller jumps of the largest tension between"
FLIES = "the sphere flies above still water with all its buoyancy (buoy.submergence)"
LOOPS = "loops were released (motion.dimensions)"


def sentences(
    rows: Sequence[Row], key: str, symbol: str, scene, companions: Sequence[Row] = (), ends: Sequence[Row] = ()
) -> list[str]:
    """At most eight, of the rows over a column `key` of the table, in words `symbol`; scene: of one of the runs.

    companions, ends: rows of its folders of these names.
    """
    good = [row for row in rows if row["status"] == "ok" and math.isfinite(number_of(row, PEAK))]
    if not good:
        return ["No run lasts beyond the transient, so nothing can be said of the motion."]
    good.sort(key=partial(number_of, name=key))
    first = list(filter(from_rest, good))
    regular, rest = regimes(first, symbol, numbers_of(first, key), scene)
    several = [*coexisting(good, key, symbol), *_ends(good, key, ends)]
    if several and regular:
        (line,) = regular
        regular = [f"From rest: {line[:1].lower()}{line[1:]}"]
    lines = [*regular, *jumps(first, key, symbol), *rest, *several, *use(good, key, symbol, scene, companions)]
    if len(lines) > MOST_LINES:
        lines = [line for line in lines if not line.startswith(SMALLER)]
    return lines


def jumps(rows: Sequence[Row], key: str, symbol: str) -> Iterator[str]:
    """The largest jump in numbers, and where the next ones are. rows: sorted."""
    pairs = []
    for below, above in pairwise(rows):
        if below[PEAK] > 0.0 and above[PEAK] > 0.0:
            pairs.append((abs(math.log(above[PEAK] / below[PEAK])), below, above))
    if not pairs:
        return
    least = max(LEAST_JUMP, TYPICAL * median(map(itemgetter(0), pairs)))
    large = [pair for pair in pairs if pair[0] > least]
    large.sort(key=itemgetter(0), reverse=True)
    for _, below, above in large[:1]:
        swing_below, swing_above, growth = _swing(below), _swing(above), math.inf
        if swing_below:
            growth = swing_above / swing_below
        slack_below, slack_above = number_of(below, "slack_fraction"), number_of(above, "slack_fraction")
        yield (
            f"Between {symbol} = {below[key]:.4g} and {above[key]:.4g} the motion jumps to one "
            f"{growth:.2g} times as large: peak tension {_change(below, above)}, "
            f"swing of r {swing_below:.2f} -> {swing_above:.2f} m, time with less than 5 % of the static tension "
            f"{100.0 * slack_below:.0f} -> {100.0 * slack_above:.0f} %."
        )
    smaller = sorted(large[1 : 1 + NAMED], key=lambda pair: pair[1][key])
    if smaller:
        places = []
        for _, below, above in smaller:
            places.append(f"{below[key]:.4g} and {above[key]:.4g} ({_change(below, above)})")
        yield f"{SMALLER} {symbol} = {listed(places)}."


def _swing(row: Row) -> float:
    return number_of(row, "radius_max_m") - number_of(row, "radius_min_m")


def coexisting(rows: Sequence[Row], key: str, symbol: str) -> Iterator[str]:
    """Where one value has several motions, and that of them which pulls most beyond the usual one."""
    by_value: dict[float, list[Row]] = {}
    for row in rows:
        by_value.setdefault(row[key], []).append(row)
    pairs = []
    for motions in by_value.values():
        if len(motions) > 1:
            base = min(motions, key=lambda row: (not from_rest(row), row[PEAK]))
            pairs.append((greatest(motions, PEAK), base))
    if not pairs:
        return
    worst, usual = max(pairs, key=lambda pair: pair[0][PEAK] / max(pair[1][PEAK], 1e-9))
    several = ranges([*by_value], [len(motions) > 1 for motions in by_value.values()], 2)
    sentence = f"One wave has several motions at {symbol} = {several}"
    if worst is not usual:
        rest = f"motion {usual['motion']}"
        if from_rest(usual):
            rest = "the one from rest"
        sentence += (
            f"; at {symbol} = {worst[key]:.4g} motion {worst['motion']} pulls "
            f"{kilonewton(worst[PEAK])}, {rest} {kilonewton(usual[PEAK])}"
        )
        kicks = of_kicks(worst)
        if kicks != EMPTY:
            interval = f"{number_of(worst, 'share_low'):.2f} to {number_of(worst, 'share_high'):.2f}"
            sentence += f", and {kicks} kicks end in it (95 % interval of the share: {interval})"
    yield f"{sentence}."


def _ends(rows: Sequence[Row], key: str, ends: Sequence[Row]) -> Iterator[str]:
    """Where motions end, if a value has several. ends: rows of ends/table.csv."""
    if not ends or len(set(numbers_of(rows, key))) == len(rows):
        return
    sides = {"upper": "above", "lower": "below"}
    words = []
    for end in ends:
        exact, inside, outside = (number_of(end, f"{key}_{side}") for side in ("end", "with", "without"))
        value = f"{0.5 * (inside + outside):.3g}"
        if math.isfinite(exact):
            value = f"{exact:.4g} ({end['kind']})"
        sentence = f"{end['motion']} {sides[end['end']]} {value}"
        if end.get("leads_to"):
            sentence += f", into {end['leads_to']}"
        words.append(sentence)
    sentence = f"Motions end: {listed(words[:MOST_ENDS])}"
    if len(words) > MOST_ENDS:
        sentence += f"; {len(words) - MOST_ENDS} more in ends/table.csv"
    yield f"{sentence}."


def _change(before: Row, after: Row) -> str:
    """ "4.4 -> 9.4 kN"."""
    return f"{before[PEAK] / 1e3:.2g} -> {after[PEAK] / 1e3:.2g} kN"


def use(rows: Sequence[Row], key: str, symbol: str, scene, companions: Sequence[Row]) -> Iterator[str]:
    """The largest tension, what it becomes otherwise, whether it may be used, and the largest that may."""
    peak, modes = greatest(rows, PEAK), scene and natural_frequencies(scene)
    sentence = f"Largest tension {largest(peak)} at {symbol} = {peak[key]:.4g}"
    if not from_rest(peak):
        sentence += f", motion {peak['motion']}"
    if modes and modes.static_tension_N:  # else there is no closed form
        sentence += f" ({peak[PEAK] / modes.static_tension_N:.1f} times static)"
    sound = [row for row in companions if row["status"] == "ok" and row["role"] == CAPPED]
    for row in sound:
        if number_of(row, key) == peak[key] and (row.get("motion") or "") == (peak.get("motion") or ""):
            sentence += f"; with the {CAPPED} {kilonewton(number_of(row, PEAK))}"
    yield f"{sentence}."
    if scene is None:
        return
    searched = any(map(math.isfinite, numbers_of(rows, "share")))
    yield use_of(peak, scene, searched)
    usable = greatest([row for row in [*rows, *sound] if not [*reasons(row, scene)]], PEAK)
    if usable is None or usable is peak:
        return
    head = "Largest tension without that:"
    if usable in sound:
        head = f"With the {CAPPED} the largest tension is"
    yield f"{head} {largest(usable)} at {symbol} = {usable[key]:.4g}. {use_of(usable, scene, searched)}"


def use_of(row: Row, scene, searched: bool) -> str:
    """The reasons against using the tension of a row; without any, the checks that were made of it, and those not made.

    searched: whether other motions were looked for.
    """
    doubts = [*reasons(row, scene)]
    if doubts:
        return f"It is no load to design for, because {listed(doubts)}."
    error, waves = number_of(row, PEAK_ERROR) / number_of(row, PEAK), scene.waves
    grid = "grid and steps"
    if math.isfinite(error):
        grid = f"{grid} (± {100.0 * error:.2g} %)"
    checks = {grid: math.isfinite(error), "loops": math.isfinite(number_of(row, "loop_releases"))}
    if scene.buoy is not None and waves is not None:
        wetted = row.get("role") == CAPPED or scene.buoy.submergence != "full"
        checks["wetted buoy"] = wetted or math.isfinite(number_of(row, BUOY_HEIGHT))
    if in_regular_waves(scene):
        checks["that the motion has settled"] = row.get("regime") not in (None, "", *OPEN_WORDS)
        checks |= {"other motions": searched, "an irregular sea": False}
    elif waves is not None:
        checks[f"a sea longer than its {number_of(row, 'end_time_s') / 60.0:.2g} min or of another seed"] = False
    if scene.water is not None:
        checks["the sea bed"] = scene.floor is not None
    checks["motion out of the plane"] = 3 in (number_of(row, "dimensions"), scene.motion.dimensions)
    passed, missing = [], []
    for name, checked in checks.items():
        (passed if checked else missing).append(name)
    return f"Checked: {listed(passed)}; not checked: {listed(missing)}."


def largest(row: Row) -> str:
    """ "9.45 kN (± 0.12 kN)", without the error where that is not known."""
    text, error = kilonewton(number_of(row, PEAK)), number_of(row, PEAK_ERROR)
    if math.isfinite(error):
        text += f" (± {error / 1e3:.2g} kN)"
    return text


def reasons(row: Row, scene) -> Iterator[str]:
    """What speaks against the tensions of a run: water on a sphere in the air, loops in a plane, grid and steps."""
    if scene is not None and scene.buoy is not None and scene.buoy.submergence == "full":
        if row.get("role") != CAPPED and number_of(row, BUOY_HEIGHT) > scene.buoy.diameter_m:
            yield FLIES
    if number_of(row, "loop_releases") > 0 and number_of(row, "dimensions") != 3:
        yield LOOPS
    if number_of(row, PEAK_ERROR) > COARSE * number_of(row, PEAK):
        yield f"it holds to {100.0 * number_of(row, PEAK_ERROR) / number_of(row, PEAK):.0f} % only"
    if OTHER_MOTION in str(row.get("message")):
        yield f"with smaller elements and steps it {OTHER_MOTION}"
