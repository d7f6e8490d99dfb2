"""The largest tension of a table: how well it is known, whether one may design for it, and the largest that one may.

A tension is doubted where the model says more than it knows (`reasons`).
"""

import math
from collections.abc import Iterable, Iterator, Mapping

from campaigns.answers import greatest, in_newtons, known_rows
from campaigns.explore.motions import from_rest
from engine.natural_frequencies import natural_frequencies
from engine.trajectory.excursions import EMERGES
from engine.views import in_regular_waves
from tables import (
    BUOY_HEIGHT,
    CAPPED,
    COARSE,
    EMERGED,
    OPEN,
    OTHER_MOTION,
    PEAK,
    PEAK_ERROR,
    Row,
    Rows,
    count,
    listed,
    number_of,
    typed,
)

VIOLENT = 1.25  # times the peak: a larger tension of the start-up is told
BELOW_BED = "below the bed"  # in the message of a run (`engine.trajectory.excursions`)
OVERBUOYANT = "the buoy comes out of the water and keeps its whole buoyancy (--set buoy.submergence=spherical-cap)"


def load(rows: Rows, keys: Mapping[str, str], scene, companions: Rows = ()) -> str:
    """The largest tension, its use, that of the largest motion that stays in the water, and what was checked of it.

    keys: columns of what is varied, with their symbols.
    """
    peak, modes = greatest(rows, PEAK), scene and natural_frequencies(scene)
    words = [f"peak top tension {largest(peak)}"]
    if modes and modes.static_tension_N:  # else there is no closed form
        words[0] += f", {peak[PEAK] / modes.static_tension_N:.1f} times static"
    share = number_of(peak, "utilisation")
    if math.isfinite(share):
        words[0] += f", {typed(100.0 * share, 2)} % of the breaking load"
        if _is_below_the_top(peak, peak):
            words[0] += f" ({_in_the_line(peak)})"
    words += [of_motion(peak), place_of(peak, keys), str(peak.get("regime") or "")]
    elsewhere = _below_the_top(rows, peak, keys) + _start_up(rows, peak, keys, scene)
    sentences = [f"{', '.join(filter(None, words))}.{elsewhere}"]
    if scene is None:
        return sentences[0]
    if not any(reasons(peak, scene)):
        return f"{sentences[0]} {use_of(peak, scene, is_searched(peak, rows, keys))}"
    sentences.append(use_of(peak, scene, is_searched(peak, rows, keys)))
    capped = greatest([row for row in companions if row["status"] == "ok" and row["role"] == CAPPED], PEAK)
    if capped is not None:
        sentences.append(f"With the {CAPPED} at most {in_newtons(capped[PEAK])}.")
    usable = greatest([row for row in rows if not any(reasons(row, scene))], PEAK)
    if usable is not None:
        place = ", ".join(filter(None, (largest(usable), of_motion(usable), place_of(usable, keys))))
        kind = "Largest without these faults"
        if [*reasons(peak, scene)] == [OVERBUOYANT]:
            kind = "Largest of the runs that stay in the water"
        sentences += [f"{kind}: {place}.", use_of(usable, scene, is_searched(usable, rows, keys))]
    return " ".join(sentences)


def _is_below_the_top(row: Row, peak: Row) -> bool:
    """Whether the line bears clearly more in a row than its top in that of the peak."""
    return number_of(row, "tension_line_max_N") > (1.0 + COARSE) * peak[PEAK]


def _in_the_line(row: Row) -> str:
    """ "0.152 kN, 0 m from the anchor": the largest tension along the line and its place."""
    place_m = typed(number_of(row, "tension_line_max_s_m"))
    return f"{in_newtons(number_of(row, 'tension_line_max_N'))}, {place_m} m from the anchor"


def _below_the_top(rows: Rows, peak: Row, keys: Mapping[str, str]) -> str:
    """The largest tension of the lines, with a space in front, where it is above the peak: a floating rope has it."""
    most = greatest(rows, "tension_line_max_N")
    if most is None or not _is_below_the_top(most, peak):
        return ""
    if most is peak and math.isfinite(number_of(peak, "utilisation")):  # told beside that
        return ""
    return f" Below its top the line bears up to {_in_the_line(most)}, {place_of(most, keys)}."


def _start_up(rows: Rows, peak: Row, keys: Mapping[str, str], scene) -> str:
    """The largest tension of runs from rest before they have settled, with a space in front, where it is far above the
    peak or breaks a line that the peak does not break."""
    most = greatest([row for row in rows if from_rest(row)], "tension_top_start_N")
    if most is None:
        return ""
    start_N, least_N = most["tension_top_start_N"], VIOLENT * peak[PEAK]
    pull, strength_N = in_newtons(start_N), None
    if scene is not None:
        strength_N = scene.tether.breaking_load_N
    if strength_N is not None:
        pull += f", {typed(100.0 * start_N / strength_N, 2)} % of the breaking load"
        if strength_N > peak[PEAK]:
            least_N = min(least_N, strength_N)
    if not start_N > least_N:
        return ""
    return f" Before it has settled a run from rest pulls up to {pull}, {place_of(most, keys)}."


def is_searched(row: Row, rows: Rows, keys: Iterable[str]) -> bool:
    """Whether a kick at the place of a row ended in a motion: kicks that have not settled find no other one."""
    for other in known_rows(rows, "share"):
        if other["share"] > 0.0 and all(other[key] == row[key] for key in keys):
            return True
    return False


def place_of(row: Row, keys: Mapping[str, str]) -> str:
    """ "kA = 0.1, H = 22": the values of the varied columns, which keys gives with their symbols."""
    return ", ".join(f"{symbol} = {typed(row[key])}" for key, symbol in keys.items())


def of_motion(row: Row) -> str:
    """ "motion C"; "" where motions have no letters."""
    letter = row.get("motion")
    return f"motion {letter}" if letter else ""


def largest(row: Row) -> str:
    """ "9.45 kN (± 0.12 kN by grid and steps)", without the error where that is not known."""
    text, error = in_newtons(row[PEAK]), number_of(row, PEAK_ERROR)
    if math.isfinite(error):
        text += f" (± {in_newtons(error, digits=2)} by grid and steps)"
    return text


def use_of(row: Row, scene, searched: bool) -> str:
    """The reasons against using the tension of a row; without any, the checks that were made of it, and those not made.

    searched: whether other motions were looked for.
    """
    doubts = [*reasons(row, scene)]
    if doubts:
        return f"Not for design: {'; '.join(doubts)}."
    error, waves = number_of(row, PEAK_ERROR) / row[PEAK], scene.waves
    grid = "grid and steps"
    if math.isfinite(error):
        grid = f"{grid} (± {100.0 * error:.2g} %)"
    checks = {grid: math.isfinite(error), "loops": math.isfinite(number_of(row, "loop_releases"))}
    if scene.buoy is not None and waves is not None:
        wetted = row.get("role") == CAPPED or scene.buoy.submergence != "full"
        checks["wetted buoy"] = wetted or number_of(row, EMERGED) <= EMERGES
    if in_regular_waves(scene):
        checks["a settled motion"] = row.get("regime") not in (None, "", *OPEN)
        checks |= {"other motions": searched, "an irregular sea": False}
    elif waves is not None:
        checks[f"a sea longer than its {typed(number_of(row, 'end_time_s') / 60.0, 2)} min or of another seed"] = False
    if scene.water is not None:
        bed = "the sea bed"
        if BELOW_BED in str(row.get("message")):
            bed = f"{bed} (the line lay below it: --set floor.stiffness_Npm3=1e5)"
        checks[bed] = scene.floor is not None
    checks["motion out of the plane"] = 3 in (number_of(row, "dimensions"), scene.motion.dimensions)
    checks["what the scene is given (stiffness, drag, masses)"] = False
    passed, missing = [], []
    for name, checked in checks.items():
        (passed if checked else missing).append(name)
    return f"Checked: {listed(passed)}; not checked: {listed(missing)}."


def is_overbuoyant(row: Row, scene) -> bool:
    """Whether a sphere that keeps its whole buoyancy comes out of the water."""
    if scene.buoy is None or scene.buoy.submergence != "full":
        return False
    # the height is all that a folder of an earlier version has
    return number_of(row, EMERGED) > EMERGES or number_of(row, BUOY_HEIGHT) > scene.buoy.diameter_m


def reasons(row: Row, scene) -> Iterator[str]:
    """What speaks against the tensions of a run: a sphere in the air, loops, a line that breaks, grid and steps."""
    if scene is not None and row.get("role") != CAPPED and is_overbuoyant(row, scene):
        yield OVERBUOYANT
    loops = number_of(row, "loop_releases")
    if loops > 0 and number_of(row, "dimensions") != 3:
        yield f"{count(int(loops), 'loop')} released in a plane (motion.dimensions)"
    if number_of(row, PEAK_ERROR) > COARSE * number_of(row, PEAK):
        yield f"its numerical error is {100.0 * number_of(row, PEAK_ERROR) / number_of(row, PEAK):.0f} %"
    if number_of(row, "utilisation") > 1.0:
        yield "the line breaks (tether.breaking_load_N)"
    if OTHER_MOTION in str(row.get("message")):
        yield f"with smaller elements and steps it {OTHER_MOTION}"
