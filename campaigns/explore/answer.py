"""What a sweep over any key found, in the order in which it is used: a line each, with its word in front.

LOAD     the largest tension, and whether one may design for it (`campaigns.explore.load`)
SNAPS    how often the line snaps, and how hard
JUMP     where one motion becomes another, as the key rises, as it falls, and from rest
MOTIONS  the range of each motion, and its regimes
STARTS   where the start decides, and kicks that ended in no motion
CHAOS    the largest exponent
OPEN     what is not decided, why, and what would decide it

A line is left out where the rows know nothing of it. A jump: between two neighbouring values the largest tension
changes by more than a quarter, and by more than three times the median change between neighbours. No change of two can
be three times their median, so four values are needed.
"""

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from functools import partial
from itertools import groupby, pairwise
from operator import itemgetter
from statistics import median

from analysis.looks import BLURRED, OF_STEPS
from campaigns.answers import NOTHING_LASTS, greatest, in_newtons, known_rows, lasting, lines, numbers_of
from campaigns.explore.load import load, place_of
from campaigns.explore.motions import from_rest
from campaigns.explore.multipliers import UNSTABLE
from engine.views import carries_tangents, in_regular_waves
from tables import (
    CHAOTIC,
    EMPTY,
    OTHER_GROWTH,
    OTHER_MOTION,
    PEAK,
    PERIODIC,
    TANGENT_ERROR,
    TANGENT_EXPONENT,
    TRANSIENT,
    UNDECIDED,
    WOLF_ERROR,
    WOLF_EXPONENT,
    Row,
    Rows,
    count,
    listed,
    number,
    number_of,
    of_kicks,
    ranges,
    typed,
)

LEAST_JUMP, TYPICAL = math.log(1.25), 3.0
LEAST_PAIRS = 3  # of neighbours, for a change that is more than TYPICAL times their median
NAMED = 3  # jumps that are named
MOST_STRETCHES = 6  # of a motion that are named; of more each regime says at how many values it is
LONGER = "a longer run (--budget) decides"
OPEN_REASONS = {
    UNDECIDED: f"the tests of the regime disagree ({LONGER})",
    TRANSIENT: f"the motion still changes when the run ends ({LONGER})",
}
OF_TOLERANCE = {  # words of the reason of a regime -> what is said of its row
    BLURRED: f"the start is forgotten, but no period is met: {BLURRED} (a tenth of solver.rtol or more nodes decide)",
    UNSTABLE: "the orbit of the period that is met is unstable (a tenth of solver.rtol decides)",
    OF_STEPS: "chaos is gone at a tenth of the tolerance (a tenth of solver.rtol decides, or a longer run (--budget))",
}
BESIDE_A_PERIOD = f"chaos stands beside a period and may be a long transient ({LONGER})"
ON_A_FINER_GRID = {  # words of a message -> what is said of its row
    OTHER_MOTION: "smaller elements and steps give another motion (more tether.nodes decide)",
    OTHER_GROWTH: "smaller elements and steps may give another regime (column message; more tether.nodes decide)",
}


def sentences(rows: Rows, key: str, symbol: str, scene, companions: Rows = (), ends: Rows = ()) -> list[str]:
    """The lines, of the rows over a column `key` of the table, in words `symbol`; scene: of the largest tension.

    companions, ends: rows of its folders of these names.
    """
    good = sorted(lasting(rows), key=partial(number_of, name=key))
    if not good:
        return lines(NOTHING_LASTS)
    texts = {
        "LOAD": load(good, {key: symbol}, scene, companions),
        "SNAPS": snaps(good, key, symbol),
        "JUMP": jump(good, key, symbol, ends),
        "MOTIONS": motions(good, key, symbol),
        "STARTS": " ".join(filter(None, (starts(good, key, symbol, scene), lost_kicks(rows, key, symbol)))),
        "CHAOS": chaos(good, key, symbol),
        "OPEN": undecided(rows, key, symbol, scene),
    }
    return lines(texts)


def by_motion(rows: Rows) -> dict[str, list]:
    """The rows of each motion by its letter, in the order of letters; "" where motions have none."""
    motions = {}
    for row in sorted(rows, key=_letter):
        motions.setdefault(_letter(row), []).append(row)
    return motions


def by_value(rows: Rows, key: str) -> dict[float, list]:
    """The rows at each value."""
    values = {}
    for row in rows:
        values.setdefault(row[key], []).append(row)
    return values


def _letter(row: Row) -> str:
    return str(row.get("motion") or "")


def snaps(rows: Rows, key: str, symbol: str) -> str:
    """Snaps a wave of each motion, the peaks where they are largest, the speed and the slack; "" where not counted."""
    counted = known_rows(rows, "snaps_per_wave")
    if not counted:
        return ""
    motions, calm = [], []
    for letter, members in by_motion(counted).items():
        snapping = [row for row in members if number_of(row, "snaps_per_wave") > 0.0]
        if not snapping:
            calm.append(letter)
            continue
        words = f"{span(numbers_of(snapping, 'snaps_per_wave'))} a wave"
        if len(snapping) < len(members):
            words += f" at {symbol} = {_at(snapping, members, key)}"
        largest = greatest(snapping, "snap_peak_max_N")
        if largest is not None:
            words += f", up to {in_newtons(largest['snap_peak_max_N'])}"
        motions.append(f"{letter}: {words}" if letter else words)
    if not motions:
        return "none: the tension never comes back from slack."
    parts = [f"{'; '.join(motions)}."]
    if any(calm):
        parts.append(f"None in {listed(calm)}.")
    parts.append(snap_peaks(counted, {key: symbol}))
    return " ".join(parts)


def snap_peaks(rows: Rows, keys: Mapping[str, str]) -> str:
    """The peaks where they are largest, the speed and the slack; keys: what is varied, by column, with its symbol."""
    parts, hardest = [], greatest(rows, "snap_peak_max_N")
    if hardest is not None:
        middle, high, most = (in_newtons(number_of(hardest, f"snap_peak_{name}_N")) for name in ("median", "95", "max"))
        words = f"At {place_of(hardest, keys)} median {middle}, 95 % below {high}, largest {most}"
        rise_s = number_of(hardest, "snap_rise_s")
        if math.isfinite(rise_s):
            words += f", within {number(rise_s, 2)} s of becoming taut"
        parts.append(f"{words}.")
        fastest = greatest(rows, "snap_speed_max_mps") or {}
        speed_mps = number_of(fastest, "snap_speed_max_mps")
        if speed_mps > 0.0:  # else the ends come together while the line becomes taut
            parts.append(f"Snap speed up to {number(speed_mps, 2)} m/s, at {place_of(fastest, keys)}.")
    slack = [share for share in numbers_of(rows, "slack_fraction") if math.isfinite(share)]
    if slack:
        parts.append(f"Slack {span([100.0 * share for share in slack], places=0)} % of the time.")
    return " ".join(parts)


def span(values: Sequence[float], places: int = 2) -> str:
    """ "0.6 to 0.8"; one number where both ends are the same in print."""
    low, high = (number(round(end(values), places), 3) for end in (min, max))
    return low if low == high else f"{low} to {high}"


def jump(rows: Rows, key: str, symbol: str, ends: Rows) -> str:
    """The motion that follows where one ends, as the key rises and as it falls; then from rest. "" for one value."""
    if len(by_value(rows, key)) < 2:
        return ""
    parts = []
    for side, direction, relation in (("upper", "Rising", "above"), ("lower", "Falling", "below")):
        words = []
        for end in ends:
            if end["end"] == side and end.get("leads_to"):
                words.append(_end(end, rows, key, relation))
        if words:
            parts.append(f"{direction} {symbol}: {', '.join(words)}.")
    parts.append(_from_rest(rows, key, symbol, bool(parts)))
    return " ".join(filter(None, parts))


def _end(end: Row, rows: Rows, key: str, relation: str) -> str:
    """ "A becomes C above 0.118 (4.4 -> 9.4 kN)"."""
    exact, inside, outside = (number_of(end, f"{key}_{name}") for name in ("end", "with", "without"))
    place, change = f"{0.5 * (inside + outside):.3g}", "by bisection"
    if math.isfinite(exact):
        place, change = f"{exact:.3g}", str(end["kind"])
    motions = by_motion(rows)
    before, after = (motions.get(str(end[name])) for name in ("motion", "leads_to"))
    if before and after:
        nearest = partial(min, key=lambda row: abs(row[key] - outside))
        change = ", ".join(filter(None, (_change(nearest(before), nearest(after)), change)))
    return f"{end['motion']} becomes {end['leads_to']} {relation} {place} ({change})"


def _from_rest(rows: Rows, key: str, symbol: str, ended: bool) -> str:
    """The jumps of runs from rest; ended: whether the ends of motions are known, so that only earlier ones are told."""
    letters = {value: set(map(_letter, members)) for value, members in by_value(rows, key).items()}
    pairs = []
    for below, above in pairwise(filter(from_rest, rows)):
        if below[PEAK] > 0.0 and above[PEAK] > 0.0:
            pairs.append((abs(math.log(above[PEAK] / below[PEAK])), below, above))
    if not pairs:
        return ""
    least = max(LEAST_JUMP, TYPICAL * median(map(itemgetter(0), pairs)))
    large = sorted((pair for pair in pairs if pair[0] > least), key=itemgetter(0), reverse=True)
    words = []
    for _, below, above in sorted(large[:NAMED], key=lambda pair: pair[1][key]):
        place = f"between {typed(below[key])} and {typed(above[key])} ({_change(below, above)})"
        early = _letter(below) != _letter(above) and _letter(below) in letters[above[key]]
        if not ended:
            words.append(place)
        elif early and above[PEAK] > below[PEAK]:
            words.append(f"{_letter(below)} becomes {_letter(above)} {place}")
    if words and ended:
        return f"From rest already: {', '.join(words)}, because the start-up crosses the border between these motions."
    if not words:
        if ended:
            return ""
        change = max(map(itemgetter(0), pairs))
        verdict = "none"
        if change > LEAST_JUMP:
            verdict = "none stands out"
            if len(pairs) < LEAST_PAIRS:
                verdict = f"not told by fewer than {LEAST_PAIRS + 1} values"
        return f"{verdict}: the largest tension changes by a factor of {math.exp(change):.2g} between values at most."
    _, below, above = large[0]
    place = "There" if len(words) == 1 else "At the largest"
    return f"From rest, {symbol}: {', '.join(words)}. {place} {_swings(below, above)}."


def _swings(below: Row, above: Row) -> str:
    """What else a jump changes."""
    swings = [number_of(row, "radius_max_m") - number_of(row, "radius_min_m") for row in (below, above)]
    slack = [100.0 * number_of(row, "slack_fraction") for row in (below, above)]
    return (
        f"the swing of r goes from {swings[0]:.2f} to {swings[1]:.2f} m, and the time in which the line is slack from "
        f"{slack[0]:.0f} to {slack[1]:.0f} %"
    )


def _change(before: Row, after: Row) -> str:
    """ "4.4 -> 9.4 kN"."""
    return in_newtons(before[PEAK], after[PEAK], digits=2)


def motions(rows: Rows, key: str, symbol: str) -> str:
    """Each motion with its range and its regimes; "" where no run has one."""
    if not any(row.get("regime") for row in rows):
        return _repeating(rows, key, symbol)
    sentences = []
    for letter, members in by_motion(rows).items():
        values, words = numbers_of(members, key), [_regime(row) for row in members]
        head = f"{letter} at {symbol} = {_ends(values)}".lstrip()
        sentences.append(f"{head[:1].upper()}{head[1:]}: {_stretches(values, words)}.")
    doubtful = _in_doubt(rows)
    if doubtful:
        sentences.append(f"In doubt at {_at(doubtful, rows, key)} (OPEN).")
    return " ".join(sentences)


def _in_doubt(rows: Rows) -> list[Row]:
    """Rows whose regime smaller elements and steps do not confirm."""
    return [row for row in rows if OTHER_GROWTH in str(row.get("message"))]


def _regime(row: Row) -> str:
    """ "period 2"."""
    return str(row.get("regime") or "not judged").replace(PERIODIC, "period ")


def _ends(values: Sequence[float]) -> str:
    if values[0] == values[-1]:
        return typed(values[0])
    return f"{typed(values[0])} to {typed(values[-1])}"


def _stretches(values: Sequence[float], words: Sequence[str]) -> str:
    """ "period 1 to 0.04, chaotic at 0.043": the regimes in the order of the values."""
    stretches = []
    for word, group in groupby(zip(values, words, strict=True), key=itemgetter(1)):
        stretches.append((word, [value for value, _ in group]))
    if len(stretches) == 1:
        return words[0]
    if len(stretches) > MOST_STRETCHES:
        return ", ".join(f"{word} at {count(times, 'value')}" for word, times in Counter(words).most_common())
    parts = []
    for place, (word, members) in enumerate(stretches):
        span = f"at {_ends(members)}"
        if place == 0 and len(members) > 1:
            span = f"to {typed(members[-1])}"
        parts.append(f"{word} {span}")
    return ", ".join(parts)


def _repeating(rows: Rows, key: str, symbol: str) -> str:
    """Where motions repeat of runs that have no verdict."""
    periods = numbers_of(rows, "strobed_period")
    known = list(map(math.isfinite, periods))
    if not any(known):
        return ""
    longest = max(filter(math.isfinite, periods))
    return f"repeat after 1 to {longest:g} wave periods at {symbol} = {ranges(numbers_of(rows, key), known, 2)}."


def starts(rows: Rows, key: str, symbol: str, scene) -> str:
    """Where one value has several motions, and how many kicks end in the one that pulls most beyond the usual one."""
    if not known_rows(rows, "share"):
        if scene is None or not in_regular_waves(scene):
            return ""
        return "each value has one run, so other motions may exist: --starts N kicks the buoy N times at each value."
    values = by_value(rows, key)
    pairs = []
    for members in values.values():
        if len(members) > 1:
            usual = min(members, key=lambda row: (not from_rest(row), row[PEAK]))
            pairs.append((greatest(members, PEAK), usual))
    if not pairs:
        kicks = greatest(rows, "kicks")
        number_of_kicks = f"{kicks['kicks']:.0f} kicks" if kicks else "the kicks"
        return f"{number_of_kicks} at each value led to no motion but the one from rest."
    place = ranges([*values], [len(members) > 1 for members in values.values()], 2)
    sentence = f"at {symbol} = {place} the start decides"
    worst, usual = max(pairs, key=lambda pair: pair[0][PEAK] / max(pair[1][PEAK], 1e-9))
    kicks = of_kicks(worst)
    if worst is usual or kicks == EMPTY:
        return f"{sentence}."
    low, high = (100.0 * number_of(worst, f"share_{end}") for end in ("low", "high"))
    interval = f" (95 % interval {low:.0f} to {high:.0f} %)" if math.isfinite(low) else ""
    other = "the motion from rest" if from_rest(usual) else f"motion {usual['motion']}"
    return (
        f"{sentence}. At {symbol} = {typed(worst[key])}, {kicks} kicks{interval} end in motion {worst['motion']}, "
        f"which pulls {in_newtons(worst[PEAK])}; {other} pulls {in_newtons(usual[PEAK])}."
    )


def lost_kicks(rows: Rows, key: str, symbol: str) -> str:
    """How many kicks ended in no motion, and where; "" where each has one. rows: all, failed ones too."""
    most = greatest(rows, "kicks")
    if most is None:
        return ""
    values, lost = by_value(sorted(rows, key=partial(number_of, name=key)), key), []
    for members in values.values():
        joined = sum(number_of(row, "share") for row in known_rows(members, "share"))
        lost.append(round(most["kicks"] * (1.0 - joined)))
    if not any(lost):
        return ""
    place = ranges([*values], [how_many > 0 for how_many in lost], 2)
    kicks = count(round(most["kicks"] * len(values)), "kick")
    return (
        f"{sum(lost)} of {kicks}, at {symbol} = {place}, ended in no motion: they had not settled, or they failed "
        "(starts/table.csv)."
    )


def chaos(rows: Rows, key: str, symbol: str) -> str:
    """The exponents of chaotic motions, from tangent dynamics where they carry some, else by Wolf's method."""
    judged = [row for row in rows if row.get("regime")]
    if not judged:
        return ""
    chaotic = [row for row in judged if row["regime"] == CHAOTIC]
    sentences = []
    for name, error, method in (
        (TANGENT_EXPONENT, TANGENT_ERROR, ""),
        (WOLF_EXPONENT, WOLF_ERROR, " by Wolf's method"),
    ):
        known = known_rows(chaotic, name)
        if not known:
            continue
        exponents = numbers_of(known, name)
        doubling = [float(f"{1.0 / exponent:.2g}") for exponent in exponents if exponent > 0.0]
        sentence = f"largest exponent{method} {span(exponents)} bits a wave (± {max(numbers_of(known, error)):.2g})"
        if doubling:
            waves = "waves"
            if set(doubling) == {1.0}:
                waves = "wave"
            sentence += f": an error doubles in {span(doubling)} {waves}"
        sentence += f". Chaotic at {symbol} = {_at(chaotic, judged, key)}"
        doubtful = _in_doubt(chaotic)
        if doubtful:
            sentence += ", but "
            if len(doubtful) < len(chaotic):
                sentence += f"at {_at(doubtful, judged, key)} "
            sentence += "smaller elements and steps do not confirm it"
        sentences.append(f"{sentence}.")
        break
    growing = []
    for row in judged:
        if number_of(row, TANGENT_EXPONENT) > 2.0 * number_of(row, TANGENT_ERROR):
            if number_of(row, "strobed_period") > 0 and row not in chaotic:
                growing.append(row)
    if growing:
        sentences.append(f"Perturbations grow though the buoy repeats at {symbol} = {_at(growing, judged, key)}.")
    return " ".join(sentences) or f"none: no run of {len(judged)} is chaotic."


def _at(chosen: Rows, rows: Rows, key: str) -> str:
    """The values of some of the rows."""
    values = sorted(by_value(rows, key))
    wanted = set(numbers_of(chosen, key))
    return ranges(values, [value in wanted for value in values], 2)


def undecided(rows: Rows, key: str, symbol: str, scene) -> str:
    """What has no verdict or no result, and what is less sure than its word; each with what would decide it."""
    rows = sorted(rows, key=partial(number_of, name=key))
    good, failed = [], []
    for row in rows:
        (good if row["status"] == "ok" else failed).append(row)
    parts = []
    for status, group in groupby(sorted(failed, key=itemgetter("status")), key=itemgetter("status")):
        place = _at([*group], rows, key)
        parts.append(f"no result at {symbol} = {place} ({status}; the column message says what would help)")
    if not any(row.get("regime") for row in good):
        parts.append(_unjudged(good, scene))
    doubts = {}
    for word, reason in OPEN_REASONS.items():
        doubts[reason] = [row for row in good if row.get("regime") == word and not _tolerance_decides(row)]
    for words, reason in OF_TOLERANCE.items():
        doubts[reason] = [row for row in good if words in str(row.get("regime_reason"))]
    doubts[BESIDE_A_PERIOD] = _chaos_beside_period(good)
    for words, reason in ON_A_FINER_GRID.items():
        doubts[reason] = [row for row in good if words in str(row.get("message"))]
    for reason, group in doubts.items():
        if group:
            parts.append(f"at {symbol} = {_at(group, good, key)} {reason}")
    return f"{'; '.join(filter(None, parts)) or 'nothing: every run has a verdict'}."


def _tolerance_decides(row: Row) -> bool:
    """Whether the reason of an open regime says that a tighter tolerance would decide it."""
    return any(words in str(row.get("regime_reason")) for words in OF_TOLERANCE)


def _chaos_beside_period(rows: Rows) -> list[Row]:
    """Chaotic rows beside a periodic one of the same motion: the period may come late there too."""
    doubtful = []
    for members in by_motion(rows).values():
        for pair in pairwise(members):
            words = [str(row.get("regime") or "") for row in pair]
            if CHAOTIC in words and any(word.startswith(PERIODIC) for word in words):
                doubtful.append(pair[words.index(CHAOTIC)])
    return doubtful


def _unjudged(rows: Rows, scene) -> str:
    """Why no run has a verdict, and what a verdict needs; "" where none exists for the scene."""
    if scene is None or scene.waves is None:
        return ""
    if not in_regular_waves(scene):
        return "no run is judged, because verdicts exist only for a buoy in regular waves"
    if scene.motion.dimensions == 2 and not carries_tangents(scene):
        return "no run is judged, because verdicts in a plane need bending stiffness and an implicit integrator"
    return "no run is judged, because --periods ended them; without --periods each goes on until its regime is known"
