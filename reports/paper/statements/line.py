"""Section 4.1: the breaking line. Most statements are those of the breaking line's own report."""

from __future__ import annotations

import math

import numpy as np

from ...breaking_line import statements as own
from ...breaking_line.runs import FAST, SLOW, find, of_kind, pairs
from ...parts.statements import Statement
from ...parts.wording import decimals, number, percent
from ..results import Results
from . import line_fronts

SOUND_MPS = 343.0  # in dry air at 20 degrees C
PRINTED_STRAIN = {"1": 0.099, "2": 0.178, "3": 0.228, "4": 0.292}
SAME_STRAIN = 0.002  # the strain is printed to 0.001
PRINTED_CROSSING_S = (0.55, 0.91)
SAME_CROSSING = 0.02  # the time is printed to two digits
COMPARABLE = 2.0  # factor within which two speeds are comparable
SAME_WAY = 0.1
SLACK_TENSION = 0.02  # of the static one, up to which the line counts as without tension
MOST_OF = 0.99  # of the settled speed at which it counts as reached
PROPORTIONAL = 0.1


def static_strain(results: Results) -> Statement:
    found = [(name, strain) for name, strain in results.static if name in PRINTED_STRAIN]
    return Statement(
        "Static tensions of 45, 180, 315 and 450 kN stretch the line by 9.9, 17.8, 22.8 and 29.2 %.",
        f"From the tension law, %: {own.told([(name, 100 * strain) for name, strain in found], 2)}.",
        tuple((f"case {name}", abs(strain - PRINTED_STRAIN[name]) < SAME_STRAIN) for name, strain in found),
        f"within {number(100 * SAME_STRAIN)} % of strain",
    )


def crossing(results: Results) -> Statement:
    times = own.in_turn(results.lines, FAST, "arrival_theory_s")
    claim = "The wave takes 0.55 to 0.91 s to run along the whole line."
    if not times:
        return Statement(claim, "No run shows it.", ())
    seen = min(seconds for _, seconds in times), max(seconds for _, seconds in times)

    def agrees(scale: float) -> bool:
        both = zip(seen, PRINTED_CROSSING_S, strict=True)
        return all(abs(scale * a / b - 1.0) < SAME_CROSSING for a, b in both)

    found = f"First arrival at the fixed end, s: {own.told(times, 4)}."
    checks = (("as printed", agrees(1.0)), ("a tenth of it is meant (0.055 to 0.091 s)", agrees(10.0)))
    return Statement(claim, found, checks, f"shortest and longest within {percent(SAME_CROSSING)}")


def front_theory(results: Results) -> Statement:
    lines = [line for line in of_kind(results.lines, "case") if math.isfinite(line.value("front_speed_mps"))]
    off = [(line.name, line.value("front_speed_mps") / line.value("front_speed_theory_mps") - 1.0) for line in lines]
    return Statement(
        "The front of falling tension runs at the speed of elastic waves, √(T′/m).",
        f"Measured in the run over √(T′/m), less one, %: {own.told([(n, 100 * x) for n, x in off], 2)}.",
        own.each(off, lambda value: abs(value) < own.SAME_FRONT),
        f"within {percent(own.SAME_FRONT)}",
    )


def supersonic(results: Results) -> Statement:
    numbers = own.in_turn(results.lines, FAST, "front_speed_theory_mps")
    return Statement(
        "At high tension the front is supersonic relative to the air.",
        f"Front over {number(SOUND_MPS)} m/s: {own.told([(n, v / SOUND_MPS) for n, v in numbers], 2)}.",
        own.each([one for one in numbers if one[0] in ("3", "4")], lambda value: value > SOUND_MPS),
        f"faster than {number(SOUND_MPS)} m/s in cases 3 and 4",
    )


def steepens(results: Results) -> Statement:
    found = [one for one in results.steepening if one[0] in ("2", "3")]
    return Statement(
        "In cases 2 and 3 a shock begins to form: the front steepens.",
        "By how much the wave at 0.99 of the static strain is faster than at it, %: "
        f"{own.told([(name, 100 * share) for name, share in results.steepening], 2)}.",
        own.each(found, lambda share: share > 0.0),
        "faster: the tension law is concave there",
    )


def shock_incomplete(results: Results) -> Statement:
    lines = [find(results.lines, case) for case in ("2", "3")]
    born = [line for line in lines if line is not None and math.isfinite(line.value("shock_birth_theory_m"))]
    judged = [line for line in lines if line is not None and math.isfinite(line.value("front_speed_theory_mps"))]
    words = ", ".join(f"case {line.name} {decimals(line.value('shock_birth_theory_m'), 1)} m" for line in born)
    return Statement(
        "In cases 2 and 3 the shock does not form completely, because the wave reaches the fixed end first.",
        f"A shock exists, by exact characteristics, from these distances from the broken end on: {words or 'none'}.",
        tuple((f"case {line.name}", line not in born) for line in judged),
        "no crossing of characteristics before the fixed end",
    )


def without_tension(results: Results) -> Statement:
    numbers = []
    for case in FAST:
        line = find(results.lines, case)
        if line is not None and line.trajectory is not None and line.trajectory.profiles is not None:
            worst = _tension_behind(line)
            numbers += [(line.name, worst)] if math.isfinite(worst) else []
    return Statement(
        "Behind the front of highest velocity the line is without tension and is pulled towards the fixed end.",
        f"Median |T| there over the static tension, half way through the front's run, %: "
        f"{own.told([(n, 100 * v) for n, v in numbers], 2)}.",
        own.each(numbers, lambda value: value < SLACK_TENSION),
        f"below {percent(SLACK_TENSION)} of the static tension",
    )


def _tension_behind(line) -> float:
    """Median |T| over the static one between the slack front and the broken end, when the wave is half way."""
    profiles = line.trajectory.profiles
    row = int(np.argmin(np.abs(profiles.time_s - 0.5 * line.value("arrival_theory_s"))))
    since = profiles.time_s[row] - line.value("breaking_time_s")
    front = profiles.s_m[-1] - line.value("slack_front_speed_theory_mps") * since
    behind = profiles.s_m > front
    if not behind.any():
        return math.nan
    return float(np.median(np.abs(profiles.tension_N[row, behind])) / line.value("force_N"))


def stored(results: Results) -> Statement:
    numbers = [(name, value / 1e3) for name, value in own.in_turn(results.lines, FAST, "stored_J")]
    claim = "More energy is stored in a line that is more highly tensioned."
    return Statement(claim, f"kJ: {own.told(numbers, 0)}.", own.rises(numbers), "rises from case to case")


def sound(results: Results) -> Statement:
    numbers = own.in_turn(results.lines, FAST, "end_speed_mps")
    return Statement(
        "At the highest tension the speed of the broken end is comparable with the speed of sound in air.",
        f"End speed over {number(SOUND_MPS)} m/s: {own.told([(n, v / SOUND_MPS) for n, v in numbers], 2)}.",
        own.each([one for one in numbers if one[0] == "4"], lambda value: value > SOUND_MPS / COMPARABLE),
        f"within a factor {number(COMPARABLE)} in case 4",
    )


def same_motion(results: Results) -> Statement:
    """The way of the end, as seen and with the delay of the slow break taken off: v (t_slow - t_fast)/2."""
    found = own.with_column(results.lines, "recoil_120ms_m")
    seen, shifted, words = [], [], []
    for fast, slow in found:
        way = fast.value("recoil_120ms_m"), slow.value("recoil_120ms_m")
        late = 0.5 * (slow.value("breaking_time_s") - fast.value("breaking_time_s")) * fast.value("end_speed_mps")
        seen.append(abs(way[1] / way[0] - 1.0) < SAME_WAY)
        shifted.append(seen[-1] or abs((way[1] + late) / way[0] - 1.0) < SAME_WAY)
        words.append(f"{fast.name} {decimals(way[0], 2)}, {slow.name} {decimals(way[1], 2)} + {decimals(late, 2)}")
    return Statement(
        "The motion of the line as a whole is not much changed by the slower break.",
        f"Way of the end in the first 120 ms, m (+ what half the difference of the fracture times delays it): "
        f"{'; '.join(words) or 'no pair of runs'}.",
        (("the delay of the break is taken off", all(shifted)), ("as seen", all(seen))) if found else (),
        f"within {percent(SAME_WAY)}",
    )


def dominant(results: Results) -> Statement:
    speeds = own.in_turn(results.lines, FAST, "end_speed_mps")
    both = pairs(results.lines)
    claim = "The initial static tension, not the fracture time, decides the maximum velocity."
    if len(speeds) < 2 or not both:
        return Statement(claim, "No run shows it.", ())
    by_tension = max(v for _, v in speeds) - min(v for _, v in speeds)
    by_time = max(abs(slow.value("end_speed_mps") - fast.value("end_speed_mps")) for fast, slow in both)
    found = f"Over the tensions it changes by {decimals(by_tension, 1)} m/s, over the fracture times by at most "
    return Statement(
        claim,
        f"{found}{decimals(by_time, 2)} m/s.",
        (("all pairs", by_time < 0.1 * by_tension),),
        "a tenth at most",
    )


def later(results: Results) -> Statement:
    found = []
    for fast, slow in pairs(results.lines):
        times = [reached_s(line) for line in (fast, slow)]
        found += [(fast, slow, *times)] if all(math.isfinite(time) for time in times) else []
    words = ", ".join(
        f"{fast.name} {decimals(1e3 * a, 1)} and {slow.name} {decimals(1e3 * b, 1)}" for fast, slow, a, b in found
    )
    return Statement(
        "In slow breaks the end takes longer to reach the maximum velocity.",
        f"Time at which it has {percent(MOST_OF)} of the settled speed, ms: {words or 'no pair of runs'}.",
        tuple((f"{fast.name} and {slow.name}", b > a) for fast, slow, a, b in found),
        "later in the slow break",
    )


def reached_s(line) -> float:
    """When the broken end first has MOST_OF of its settled speed; nan where the profiles do not show it."""
    trajectory = line.trajectory
    if trajectory is None or trajectory.profiles is None:
        return math.nan
    fast = trajectory.profiles.speed_mps[:, -1] >= MOST_OF * line.value("end_speed_mps")
    return float(trajectory.profiles.time_s[int(np.argmax(fast))]) if fast.any() else math.nan


def proportional(results: Results) -> Statement:
    strains, speeds = dict(results.static), own.in_turn(results.lines, FAST, "end_speed_mps")
    ratios = [(name, speed / strains[name]) for name, speed in speeds if name in strains]
    claim = "The speed of the snap back is proportional to the initial strain."
    if len(ratios) < 2:
        return Statement(claim, "No run shows it.", ())
    middle = float(np.mean([ratio for _, ratio in ratios]))
    found = f"Speed over strain, m/s: {own.told(ratios, 0)}: the speed rises faster than the strain."
    if not all(holds for _, holds in own.rises(ratios)):
        found = f"Speed over strain, m/s: {own.told(ratios, 0)}."
    checks = (("all cases", all(abs(ratio / middle - 1.0) < PROPORTIONAL for _, ratio in ratios)),)
    return Statement(claim, found, checks, f"one ratio to {percent(PROPORTIONAL)}")


def buckling(claim: str, cases: tuple[str, ...]):
    """The statement that the line buckles, of these cases."""

    def state(results: Results) -> Statement:
        numbers = own.in_turn(results.lines, cases, "steepest_tilt_rad")
        return Statement(
            claim,
            f"Steepest element by the end of the figure, rad: {own.told(numbers, 2)}.",
            own.each(numbers, lambda value: value > own.BUCKLED_RAD),
            f"an element steeper than {number(own.BUCKLED_RAD)} rad",
        )

    return state


def shared(state):
    """A statement of the breaking line's own report."""
    return lambda results: state(results.lines)


fast_buckling = buckling("The line buckles at the fixed end.", FAST)
slow_buckling = buckling("In slow breaks too the line buckles near the fixed end, at every tension.", SLOW)
EXACT, DOUBLED = "closed form: exact simple wave", "refinement: doubled grids"
REPORT = "report on the breaking line"
STATEMENTS = (
    ("abstract", proportional, f"{EXACT} ({REPORT}, fronts and shocks; docs/breaking_line.md)"),
    ("4.1.2", static_strain, "closed form: the tension law inverted"),
    ("4.1.2", line_fronts.shares_of_strength, "arithmetic"),
    ("4.1.2, fig. 2", crossing, EXACT),
    ("4.1.2, fig. 2", line_fronts.covered, EXACT),
    ("4.1.2, fig. 2", shared(own.recoil), f"{DOUBLED} (less than 1 mm, docs/breaking_line.md)"),
    ("4.1.2, fig. 2", shared(own.vertical), f"{DOUBLED}; details of folds are not settled by any grid"),
    ("4.1.2, fig. 2", fast_buckling, f"{DOUBLED}; bending stiffness varied ({REPORT})"),
    ("4.1.2, fig. 2", shared(own.overshoot), f"bending stiffness varied: docs/breaking_line.md; {REPORT}"),
    ("4.1.2, fig. 3", front_theory, f"{EXACT}; even grids without gravity ({REPORT})"),
    ("4.1.2, fig. 3", line_fronts.differs, "closed form: slope of the printed tension law"),
    ("4.1.2", shared(own.front_speed), "closed form: slope of the printed tension law"),
    ("4.1.2", supersonic, "closed form: slope of the printed tension law"),
    ("4.1.2, fig. 3", shared(own.faster_fronts), "closed form: slope of the printed tension law"),
    ("4.1.2, fig. 3", steepens, "closed form: curvature of the printed tension law"),
    ("4.1.2, fig. 3", shock_incomplete, "closed form: characteristics; second method: finite volumes (tests)"),
    ("4.1.2, figs. 3, 4", line_fronts.together, f"{EXACT}: T and speed are functions of each other"),
    ("4.1.2, fig. 4", shared(own.slack_front), EXACT),
    ("4.1.2, fig. 4", without_tension, DOUBLED),
    ("4.1.2, fig. 4", shared(own.at_the_end), DOUBLED),
    ("4.1.2, fig. 4", shared(own.energy_speed), EXACT),
    ("4.1.2, fig. 4", stored, "closed form: integral of the tension law"),
    ("4.1.2, fig. 4", sound, EXACT),
    ("4.1.3, fig. 5", same_motion, DOUBLED),
    ("4.1.3, fig. 5", slow_buckling, f"{DOUBLED}; bending stiffness varied ({REPORT})"),
    ("4.1.3, fig. 6", shared(own.tension), "exact simple wave for the fronts"),
    ("4.1.3, fig. 6", line_fronts.in_time, EXACT),
    ("4.1.3, fig. 7", shared(own.speed), EXACT),
    ("4.1.3, fig. 7", dominant, EXACT),
    ("4.1.3, fig. 7", later, EXACT),
    ("4.1.3, fig. 7", shared(own.fast_part), DOUBLED),
    ("4.1.3, fig. 7", shared(own.resting_part), DOUBLED),
    ("4.1.3, fig. 7", shared(own.kinetic_spread), f"{DOUBLED}; three measures disagree (docs/breaking_line.md)"),
    ("4.1.3", shared(own.kinetic), f"energy budget closed ({REPORT}, energy); exact work of the end force"),
)
