"""A run that has not settled, and the periodic orbit that it comes nearer to (`analysis.approaches`)."""

from dataclasses import replace

from analysis import Evidence, Verdict, approach_evidence, approached_period, next_look, poincare_section
from campaigns.explore.multipliers import OrbitUnder, orbit_under
from engine.trajectory import Trajectory
from engine.views import LONGEST_PERIOD, carries_tangents, state_of

ITERATIONS = 6  # of Newton's method: from a run that comes nearer to an orbit three are enough


def orbit_ahead(trajectory: Trajectory) -> tuple[OrbitUnder, Evidence] | None:
    """The orbit near a run, and whether the run comes nearer to it; None where no orbit is looked for or found.

    It is looked for from the second look on, where steps of the run shrink.
    """
    scene = trajectory.scene
    step_s, period_s = scene.sample_step_s(), scene.waves.period_s
    periods = round((len(trajectory.columns["time_s"]) - 1) * step_s / period_s)
    if periods < next_look(next_look()) or not carries_tangents(scene) or trajectory.final_state is None:
        return None
    coordinates, scale = state_of(trajectory.columns, step_s, period_s, periods // 2)
    strobed = poincare_section(coordinates, step_s, period_s).points
    if (period := approached_period(strobed, scale, LONGEST_PERIOD)) is None:
        return None
    try:
        under = orbit_under(trajectory, period, ITERATIONS)
    except (ArithmeticError, ValueError):
        return None
    coordinates, scale = state_of(under.run.columns, step_s, period_s, 0)
    points = poincare_section(coordinates, step_s, period_s).points[: under.orbit.period]
    return under, approach_evidence(strobed, points, under.orbit.multipliers, under.errors, scale)


def judged_by_orbit(trajectory: Trajectory, verdict: Verdict) -> tuple[Verdict, OrbitUnder | None]:
    """The Verdict on a run that has not settled, with what the orbit near it says; the orbit where the run comes to it.

    Its transient ends where the last third of the judged periods begins.
    """
    found = orbit_ahead(trajectory)
    if found is None:
        return verdict, None
    under, approach = found
    evidence = *verdict.evidence, approach
    if not approach.passed:
        return replace(verdict, reason=f"{verdict.reason}; {approach.sentence}", evidence=evidence), None
    period, points = under.orbit.period, verdict.points // 3
    reason = f"repeats after {period} wave period(s) in the limit: {approach.sentence}; extremes are the orbit's"
    transient = verdict.transient + verdict.points - points
    return Verdict(f"period-{period}", reason, evidence, period, points, verdict.seed, transient), under
