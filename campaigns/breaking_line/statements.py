"""What the paper says of the breaking line (section 4.1, the abstract, section 3), as claims.

The campaign of the whole paper judges the same records. A claim is a place in the paper, the words, what is measured,
the measure (`judging`), the rule, and what else supports the number.
"""

from dataclasses import replace

from campaigns.breaking_line.judging import (
    all_cases,
    by_case,
    by_pair,
    case_to_case,
    changed,
    column,
    crossing,
    dominant,
    doubled,
    later,
    least_gap,
    off_one_ratio,
    ratio,
    same_motion,
    shock_incomplete,
    smaller,
    vertical,
)  # fmt: skip
from campaigns.breaking_line.lines import FAST, FRONT, SLOW
from campaigns.statements import Claim, Measured, Rule, above, below, met, within

SOUND_MPS = 343.0  # in dry air at 20 degrees C
PRINTED_STRAIN = {"1": 0.099, "2": 0.178, "3": 0.228, "4": 0.292}
PRINTED_SHARE = {"1": 0.10, "2": 0.40, "3": 0.70}  # of the strength, which case 4 has
PRINTED_FRONT_MPS = 500.0


def dissipates(results) -> Measured:
    both = KINETIC_SPREAD.measure(results), RESTING.measure(results)
    names = "judged by the spread of the energy", "judged by the part at rest"
    checks = [(name, min(x for _, x in one.checks)) for name, one in zip(names, both, strict=True) if one.checks]
    return Measured(checks, f"{both[0].told}; at rest {both[1].told}" if checks else "")


EXACT, DOUBLED = "closed form: exact simple wave", "refinement: doubled grids"
LAW = "closed form: slope of the printed tension law"
REPORT = "report on the breaking line"
FRONT_SPEED = "√(T′/m) at the static tension, m/s"
HALF = "When half the strain energy is left, share of the line"
STEEP = "an element steeper than 0.2 rad"
front, end_speed, tilt = column("front_speed_theory_mps"), column("end_speed_mps"), column("steepest_tilt_rad")

DOUBLING = Claim(
    "3", "Doubling the points changes the results by less than 1 %: the breaking line.",
    "Largest change of end speed, recoil or kinetic energy",
    doubled, below(0.01, "below 1 %"), "part `breaking_line`: every case on doubled grids",
)  # fmt: skip
SAME_SPEED = Claim(
    "4.1.3, fig. 7", "The maximum speed does not depend on the fracture time.", "End speed, m/s",
    by_pair(end_speed, ".2f", changed), within(0.003, "equal to 0.3 %"), EXACT,
)  # fmt: skip
UNIFORM_TENSION = Claim(
    "4.1.3, fig. 6", "In slow breaks the tension is more uniform along the line.",
    "Standard deviation of T over its mean when half the strain energy is left",
    by_pair(column("tension_spread"), ".2f", smaller), above(0.0, "smaller in the slow break"),
    "exact simple wave for the fronts",
)  # fmt: skip
RESTING = Claim(
    "4.1.3, fig. 7", "In fast breaks a part of the line is practically at rest; in slow breaks more of it moves.",
    f"{HALF} slower than 0.1 of the settled end speed",
    by_pair(column("resting_share"), ".2f", smaller), above(0.0, "smaller in the slow break"), DOUBLED,
)  # fmt: skip
KINETIC_SPREAD = Claim(
    "4.1.3, fig. 7", "In slow breaks the kinetic energy is more uniformly distributed.",
    f"{HALF} that would hold the kinetic energy at one speed",
    by_pair(column("kinetic_spread"), ".2f", later), above(0.0, "larger in the slow break"),
    f"{DOUBLED}; three measures disagree (docs/breaking_line.md)",
)  # fmt: skip
DISSIPATES = Claim(
    "5", "A line that breaks slowly takes up the kinetic energy along a larger part of its length.",
    KINETIC_SPREAD.quantity, dissipates, above(0.0, "larger spread, smaller part at rest"),
    "as under 4.1.3; docs/breaking_line.md",
)  # fmt: skip
CLAIMS = (
    Claim(
        "abstract", "The speed of the snap back is proportional to the initial strain.", "Speed over strain, m/s",
        all_cases(ratio("end_speed_mps", "static_strain"), ".0f", off_one_ratio), below(0.1, "one ratio to 10 %"),
        f"{EXACT} ({REPORT}, fronts and shocks; docs/breaking_line.md)",
    ),
    Claim(
        "4.1.2", "Static tensions of 45, 180, 315 and 450 kN stretch the line by 9.9, 17.8, 22.8 and 29.2 %.",
        "Strain by the tension law",
        by_case(column("static_strain"), ".2%", FAST, judge=lambda x: x["static_strain"] - PRINTED_STRAIN[x["case"]]),
        within(0.002, "within 0.2 % of strain"), "closed form: the tension law inverted",
    ),
    Claim(
        "4.1.2",
        "The tensions of cases 1, 2 and 3 are 10, 40 and 70 % of the breaking strength, which is that of case 4.",
        "Tension over that of case 4",
        by_case(column("force_over_4"), ".1%", FAST[:3], judge=lambda x: x["force_over_4"] - PRINTED_SHARE[x["case"]]),
        within(0.005, "within 0.5 %"), "arithmetic",
    ),
    Claim(
        "4.1.2, fig. 2", "The wave takes 0.55 to 0.91 s to run along the whole line.",
        "First arrival at the fixed end, s", crossing,
        below(0.02, "shortest and longest within 2 %"), EXACT,
    ),
    Claim(
        "4.1.2, fig. 2", "The times that the figures cover suit the wave: it runs along the whole line within them.",
        "Time covered over that of the first arrival at the fixed end",
        by_case(ratio("end_time_s", "arrival_theory_s"), ".2f"),
        above(1.0, "more than once the time of arrival (by the printed times it would not arrive)"), EXACT,
    ),
    Claim(
        "4.1.2, fig. 2", "Lines that break at higher tension snap back farther.",
        "Way of the end in the first 120 ms, m", case_to_case(column("recoil_120ms_m"), ".1f", FAST, SLOW),
        above(0.0, "rises from case to case"), f"{DOUBLED} (less than 1 mm, docs/breaking_line.md)",
    ),
    Claim(
        "4.1.2, fig. 2", "The vertical motion decreases as the static tension increases.",
        "Largest rise or fall in m", vertical, above(0.0, "falls from case to case"),
        f"{DOUBLED}; details of folds are not settled by any grid",
    ),
    Claim(
        "4.1.2, fig. 2", "The line buckles at the fixed end.", "Steepest element by the end of the figure, rad",
        by_case(tilt, ".2f", FAST), above(0.2, STEEP), f"{DOUBLED}; bending stiffness varied ({REPORT})",
    ),
    Claim(
        "4.1.2, fig. 2", "In the high-tension case parts of the line overshoot and move to the left of the fixed end.",
        "Leftmost point, m", by_case(column("x_min_m"), ".3f", only=("4",)), below(-0.1, "0.1 m to the left in case 4"),
        f"bending stiffness varied: docs/breaking_line.md; {REPORT}",
    ),
    Claim(
        "4.1.2, fig. 3", "The front of falling tension runs at the speed of elastic waves, √(T′/m).",
        "Measured in the run over √(T′/m), less one",
        by_case(lambda x: x["front_speed_mps"] / x["front_speed_theory_mps"] - 1.0, ".2%"),
        within(0.01, "within 1 %"), f"{EXACT}; even grids without gravity ({REPORT})",
    ),
    Claim(
        "4.1.2, fig. 3", "The speed of the front depends on the static tension: it is another in every case.",
        FRONT_SPEED, all_cases(front, ".0f", least_gap), above(0.01, "more than 1 % apart"), LAW,
    ),
    Claim(
        "4.1.2", "At high tension the front runs at about 500 m/s.", FRONT_SPEED,
        by_case(front, ".0f", FAST, ("4",), lambda x: x["front_speed_theory_mps"] / PRINTED_FRONT_MPS - 1.0),
        within(0.1, "within 10 % of 500 m/s in case 4"), LAW,
    ),
    Claim(
        "4.1.2", "At high tension the front is supersonic relative to the air.", "Front over 343 m/s",
        by_case(column("front_speed_theory_mps", 1.0 / SOUND_MPS), ".2f", FAST, ("3", "4")),
        above(1.0, "faster than 343 m/s in cases 3 and 4"), LAW,
    ),
    Claim(
        "4.1.2, fig. 3", "In cases 2 and 3 the front is faster than in case 4.", FRONT_SPEED,
        by_case(front, ".0f", FAST, ("2", "3"), column("front_over_4")), above(1.0, "faster than in case 4"), LAW,
    ),
    Claim(
        "4.1.2, fig. 3", "In cases 2 and 3 a shock begins to form: the front steepens.",
        "By how much the wave at 0.99 of the static strain is faster than at it",
        by_case(column("steepening"), ".2%", FAST, ("2", "3")),
        above(0.0, "faster: the tension law is concave there"), "closed form: curvature of the printed tension law",
    ),
    Claim(
        "4.1.2, fig. 3",
        "In cases 2 and 3 the shock does not form completely, because the wave reaches the fixed end first.",
        "A shock exists, by exact characteristics, from these distances in m from the broken end on",
        shock_incomplete, met("no crossing of characteristics before the fixed end"),
        "closed form: characteristics; second method: finite volumes (tests)",
    ),
    Claim(
        "4.1.2, figs. 3, 4", "The front of the velocity runs with that of the tension.",
        "Distance of the two, half way, over the length of the line", by_case(column("fronts_apart"), ".2%", FAST),
        below(0.02, f"within 2 % of the line, each where {FRONT:.0%} is lost or gained"),
        f"{EXACT}: T and speed are functions of each other",
    ),
    Claim(
        "4.1.2, fig. 4",
        "The front at the highest velocity runs at the same speed in all cases, the wave speed at zero tension.",
        "Measured over √(T′(0)/m), less one",
        by_case(lambda x: x["slack_front_speed_mps"] / x["slack_front_speed_theory_mps"] - 1.0, ".2%"),
        within(0.01, "within 1 % of √(T′(0)/m)"), EXACT,
    ),
    Claim(
        "4.1.2, fig. 4",
        "Behind the front of highest velocity the line is without tension and is pulled towards the fixed end.",
        "Median |T| there over the static tension, half way through the front's run",
        by_case(column("tension_behind"), ".2%", FAST), below(0.02, "below 2 % of the static tension"), DOUBLED,
    ),
    Claim(
        "4.1.2, fig. 4", "The velocity of the end point is the maximum along the line.",
        "Largest speed of any node at any time over the largest of the settled end, less one",
        by_case(lambda x: x["speed_largest_mps"] / x["end_speed_most_mps"] - 1.0, ".2%"),
        below(0.01, "exceeded by less than 1 %"), DOUBLED,
    ),
    Claim(
        "4.1.2, fig. 4", "It is higher when the static tension is higher.", "End speed, m/s",
        case_to_case(end_speed, ".1f", FAST, SLOW), above(0.0, "rises from case to case"), EXACT,
    ),
    Claim(
        "4.1.2, fig. 4", "More energy is stored in a line that is more highly tensioned.", "Stored energy, kJ",
        case_to_case(column("stored_J", 1e-3), ".0f", FAST), above(0.0, "rises from case to case"),
        "closed form: integral of the tension law",
    ),
    Claim(
        "4.1.2, fig. 4",
        "At the highest tension the speed of the broken end is comparable with the speed of sound in air.",
        "End speed over 343 m/s", by_case(column("end_speed_mps", 1.0 / SOUND_MPS), ".2f", FAST, ("4",)),
        above(0.5, "within a factor 2 in case 4"), EXACT,
    ),
    Claim(
        "4.1.3, fig. 5", "The motion of the line as a whole is not much changed by the slower break.",
        "Way of the end in the first 120 ms, m (+ what half the difference of the fracture times delays it)",
        same_motion, below(0.1, "within 10 %"), DOUBLED,
    ),
    Claim(
        "4.1.3, fig. 5", "In slow breaks too the line buckles near the fixed end, at every tension.",
        "Steepest element by the end of the figure, rad", by_case(tilt, ".2f", SLOW), above(0.2, STEEP),
        f"{DOUBLED}; bending stiffness varied ({REPORT})",
    ),
    UNIFORM_TENSION,
    Claim(
        "4.1.3, fig. 6",
        "In slow breaks the wave has time to reach the fixed end before the tension at the broken end is zero.",
        "Fracture time over that of the first arrival",
        by_case(ratio("breaking_time_s", "arrival_theory_s"), ".2f", SLOW),
        Rule(lambda share: share >= 1.0, "the arrival comes first"), EXACT,
    ),
    SAME_SPEED,
    Claim(
        "4.1.3, fig. 7", "The initial static tension, not the fracture time, decides the maximum velocity.",
        "Change of the end speed, m/s", dominant, below(0.1, "a tenth at most"), EXACT,
    ),
    Claim(
        "4.1.3, fig. 7", "In slow breaks the end takes longer to reach the maximum velocity.",
        "Time at which it has 99 % of the settled speed, ms", by_pair(column("reached_s", 1e3), ".1f", later),
        above(0.0, "later in the slow break"), EXACT,
    ),
    Claim(
        "4.1.3, fig. 7", "In slow breaks a smaller part of the line moves at the maximum speed.",
        f"{HALF} faster than 0.9 of the settled end speed", by_pair(column("fast_share"), ".2f", smaller),
        above(0.0, "smaller in the slow break"), DOUBLED,
    ),
    RESTING,
    KINETIC_SPREAD,
    Claim(
        "4.1.3", "The total kinetic energy depends only on the static tension, not on the fracture time.",
        "Largest kinetic energy over the stored energy",
        by_pair(ratio("kinetic_largest_J", "stored_J"), ".1%", changed),
        within(0.01, "equal to 1 %"), f"energy budget closed ({REPORT}, energy); exact work of the end force",
    ),
)  # fmt: skip
ALL = (DOUBLING, *CLAIMS, DISSIPATES)


def again(claim: Claim, place: str, evidence: str) -> Claim:
    """The same claim at another place of the paper."""
    return replace(claim, place=place, evidence=evidence)
