"""What a sweep of wave steepness found: regimes, jumps, chaos, what is undecided, the largest tension and its use.

A jump: between two neighbouring values the largest tension changes by more than a quarter, and by more than three times
the median change between neighbours. A largest tension is doubted where the model says more than it knows (`reasons`).
"""

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise
from statistics import median

from campaigns.answers import OPEN_WORDS, Row, between, greatest, kilonewton, known, of_kicks, regimes, spans
from campaigns.explore.motions import from_rest
from campaigns.machinery.session import MOST_LINES
from campaigns.statements import listed
from engine.views import in_regular_waves

PEAK, ERROR = "tension_top_max_N", "tension_top_max_error_N"
HEIGHT = "max_buoy_height_above_water_m"
LEAST_JUMP, TYPICAL = math.log(1.25), 3.0
MOST_ENDS = 4  # that are told
TOLD = 3  # jumps beside the largest that are told
SMALLER = "Smaller jumps of the largest tension between"
FLIES = "the sphere flies above still water with all its buoyancy (buoy.submergence)"
LOOPS = "loops were released (motion.dimensions)"
COARSE = 0.05  # of the largest tension: an error above it is told in words
OTHER = "becomes another motion"  # said in a row's message (`errors.error_N`)
CAPPED = "wetted cap"  # role of companions


def sentences(
    rows: Sequence[Row], key: str, symbol: str, scene, companions: Sequence[Row] = (), ends: Sequence[Row] = ()
) -> list[str]:
    """At most eight, of the rows over a column `key` of the table, in words `symbol`; scene: of one of the runs.

    companions, ends: rows of its folders of these names.
    """
    good = [row for row in rows if row["status"] == "ok" and math.isfinite(known(row, PEAK))]
    if not good:
        return ["No run lasts beyond the transient, so nothing can be said of the motion."]
    good.sort(key=lambda row: known(row, key))
    first = [row for row in good if from_rest(row)]
    regular, rest = regimes(first, symbol, [known(row, key) for row in first], scene)
    many = [*coexisting(good, key, symbol, ends)]
    said = [f"From rest: {line[:1].lower()}{line[1:]}" for line in regular] if many else regular
    found = [*said, *jumps(first, key, symbol), *rest, *many, *use(good, key, symbol, scene, companions)]
    return [line for line in found if len(found) <= MOST_LINES or not line.startswith(SMALLER)]


def jumps(rows: Sequence[Row], key: str, symbol: str) -> Iterator[str]:
    """The largest jump in numbers, and where the next ones are. rows: sorted."""
    pairs = [(abs(math.log(known(b, PEAK) / known(a, PEAK))), a, b) for a, b in pairwise(rows) if _pull(a) and _pull(b)]
    least = max(LEAST_JUMP, TYPICAL * median(size for size, *_ in pairs)) if pairs else math.inf
    found = sorted((pair for pair in pairs if pair[0] > least), key=lambda pair: -pair[0])
    for _, a, b in found[:1]:
        before, after = (known(row, "radius_max_m") - known(row, "radius_min_m") for row in (a, b))
        slack = (100.0 * known(row, "slack_fraction") for row in (a, b))
        yield (
            f"Between {symbol} = {known(a, key):.4g} and {known(b, key):.4g} the motion jumps to one "
            f"{after / before if before else math.inf:.2g} times as large: peak tension {_change(a, b)}, "
            f"swing of r {before:.2f} -> {after:.2f} m, "
            "time with less than 5 % of the static tension {:.0f} -> {:.0f} %.".format(*slack)
        )
    if more := sorted((known(a, key), known(b, key), _change(a, b)) for _, a, b in found[1 : 1 + TOLD]):
        yield f"{SMALLER} {symbol} = {listed(f'{a:.4g} and {b:.4g} ({change})' for a, b, change in more)}."


def coexisting(rows: Sequence[Row], key: str, symbol: str, ends: Sequence[Row]) -> Iterator[str]:
    """Where one value has several motions, the one that pulls hardest there, and where motions end."""
    values = list(dict.fromkeys(known(row, key) for row in rows))
    at = {value: [row for row in rows if known(row, key) == value] for value in values}
    several = [value for value in values if len(at[value]) > 1]
    if not several:
        return
    worst, usual = max(
        (
            (greatest(at[value], PEAK), min(at[value], key=lambda row: (not from_rest(row), known(row, PEAK))))
            for value in several
        ),
        key=lambda pair: known(pair[0], PEAK) / max(known(pair[1], PEAK), 1e-9),
    )
    said = f"One wave has several motions at {symbol} = {spans([value in several for value in values], values)}"
    if worst is not usual:
        rest = "the one from rest" if from_rest(usual) else f"motion {usual['motion']}"
        counted = of_kicks(worst)
        share = f", and {counted} kicks end in it (95 % interval of the share: {between(worst)})" if counted else ""
        said += (
            f"; at {symbol} = {known(worst, key):.4g} motion {worst['motion']} pulls {kilonewton(known(worst, PEAK))}, "
            f"{rest} {kilonewton(known(usual, PEAK))}{share}"
        )
    yield f"{said}."
    words = []
    for end in ends:
        exact, inside, outside = (known(end, f"{key}_{side}") for side in ("end", "with", "without"))
        told = f"{exact:.4g} ({end['kind']})" if math.isfinite(exact) else f"{0.5 * (inside + outside):.3g}"
        becomes = f", into {end['leads_to']}" if end.get("leads_to") else ""
        words.append(f"{end['motion']} {'above' if end['end'] == 'upper' else 'below'} {told}{becomes}")
    if words:
        more = len(words) - MOST_ENDS
        told = f"{listed(words[:MOST_ENDS])}{f'; {more} more in ends/table.csv' if more > 0 else ''}"
        yield f"Motions end: {told}."


def _pull(row: Row) -> bool:
    return known(row, PEAK) > 0.0


def _change(before: Row, after: Row) -> str:
    """ "4.4 -> 9.4 kN"."""
    return f"{known(before, PEAK) / 1e3:.2g} -> {known(after, PEAK) / 1e3:.2g} kN"


def use(rows: Sequence[Row], key: str, symbol: str, scene, companions: Sequence[Row]) -> Iterator[str]:
    """The largest tension, what it becomes otherwise, whether it may be used, and the largest that may."""
    peak, static_N = greatest(rows, PEAK), static_tension(scene)
    times = f" ({known(peak, PEAK) / static_N:.1f} times static)" if static_N else ""
    motion = "" if from_rest(peak) else f", motion {peak['motion']}"
    said = f"Largest tension {largest(peak)} at {symbol} = {known(peak, key):.4g}{motion}{times}"
    sound = [row for row in companions if row["status"] == "ok" and row["role"] == CAPPED]
    for row in sound:
        if _of(row, key) == _of(peak, key):
            said += f"; with the {CAPPED} {kilonewton(known(row, PEAK))}"
    yield f"{said}."
    searched = any(math.isfinite(known(row, "share")) for row in rows)
    if scene is None:
        return
    yield use_of(peak, scene, searched)
    free = greatest([row for row in [*rows, *sound] if not [*reasons(row, scene)]], PEAK)
    if free is None or free is peak:
        return
    which = f"With the {CAPPED} the largest tension is" if free in sound else "Largest tension without that:"
    yield f"{which} {largest(free)} at {symbol} = {known(free, key):.4g}. {use_of(free, scene, searched)}"


def use_of(row: Row, scene, searched: bool) -> str:
    """What speaks against using the tension of a row; else what was checked of it, and what was not.

    searched: whether other motions were looked for.
    """
    doubts = [*reasons(row, scene)]
    return f"It is no load to design for, because {listed(doubts)}." if doubts else f"{_checks(row, scene, searched)}."


def _checks(row: Row, scene, searched: bool) -> str:
    """What was checked of the tension of a row, and what was not, by what the row knows and the scene has."""
    error, waves = known(row, ERROR) / known(row, PEAK), scene.waves
    room = 3 in (known(row, "dimensions"), scene.motion.dimensions)
    grid = f"grid and steps (± {100.0 * error:.2g} %)" if math.isfinite(error) else "grid and steps"
    checks = {grid: math.isfinite(error), "loops": math.isfinite(known(row, "loop_releases"))}
    if scene.buoy is not None and waves is not None:
        wetted = row.get("role") == CAPPED or scene.buoy.submergence != "full"
        checks["wetted buoy"] = wetted or math.isfinite(known(row, HEIGHT))
    if in_regular_waves(scene):
        checks["that the motion has settled"] = row.get("regime") not in (None, "", *OPEN_WORDS)
        checks |= {"other motions": searched, "an irregular sea": False}
    elif waves is not None:
        checks[f"a sea longer than its {known(row, 'end_time_s') / 60.0:.2g} min or of another seed"] = False
    if scene.water is not None:
        checks["the sea bed"] = scene.floor is not None
    checks["motion out of the plane"] = room
    lists = (listed(name for name, made in checks.items() if made is wanted) for wanted in (True, False))
    return "Checked: {}; not checked: {}".format(*lists)


def largest(row: Row) -> str:
    """ "9.45 kN (± 0.12 kN)", without the error where that is not known."""
    error = known(row, ERROR)
    return f"{kilonewton(known(row, PEAK))}{f' (± {error / 1e3:.2g} kN)' if math.isfinite(error) else ''}"


def _of(row: Row, key: str) -> tuple:
    return known(row, key), str(row.get("motion") or "")


def reasons(row: Row, scene) -> Iterator[str]:
    """What speaks against the tensions of a run: water on a sphere in the air, loops in a plane, grid and steps."""
    if scene is not None and scene.buoy is not None and scene.buoy.submergence == "full":
        if row.get("role") != CAPPED and known(row, HEIGHT) > scene.buoy.diameter_m:
            yield FLIES
    if known(row, "loop_releases") > 0 and known(row, "dimensions") != 3:
        yield LOOPS
    if known(row, ERROR) > COARSE * known(row, PEAK):
        yield f"it holds to {100.0 * known(row, ERROR) / known(row, PEAK):.0f} % only"
    if OTHER in str(row.get("message")):
        yield f"with smaller elements and steps it {OTHER}"


def static_tension(scene) -> float | None:
    """The tension of the buoy at rest (N), None where there is no closed form."""
    from engine.natural_frequencies import natural_frequencies

    modes = None if scene is None else natural_frequencies(scene)
    return None if modes is None else modes.static_tension_N
