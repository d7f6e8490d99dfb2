"""A run that has not settled, and the periodic orbit that it comes nearer to (`analysis.approaches`)."""

from analysis import Evidence, approach_evidence, approached_period, detect_period, poincare_section
from campaigns.explore.multipliers import OrbitUnder, orbit_under
from campaigns.machinery.long_runs import EARLY
from campaigns.machinery.store import Store
from engine.trajectory import Trajectory
from engine.views import LONGEST_PERIOD, STROBE_TOLERANCE, carries_tangents, state_of

ITERATIONS = 6  # of Newton's method: from a run that comes nearer to an orbit three are enough


def orbit_ahead(trajectory: Trajectory, orbits: Store) -> tuple[OrbitUnder, Evidence] | None:
    """The orbit near a run, and whether the run comes nearer to it; None where no orbit is looked for or found.

    It is looked for where the run repeats, or where its steps shrink. That the orbit attracts, and that the run lies on
    it or comes nearer, proves a period after fewer periods than the run itself could.
    """
    scene = trajectory.scene
    step_s, period_s = scene.sample_step_s(), scene.waves.period_s
    periods = round((len(trajectory.columns["time_s"]) - 1) * step_s / period_s)
    if periods < EARLY or not carries_tangents(scene) or trajectory.final_state is None:
        return None
    coordinates, scale = state_of(trajectory.columns, step_s, period_s, periods // 2)
    strobed = poincare_section(coordinates, step_s, period_s).points
    period = detect_period(strobed[periods // 2 :], LONGEST_PERIOD, STROBE_TOLERANCE, scale).period
    if period is None:
        period = approached_period(strobed, scale, LONGEST_PERIOD)
    if period is None:
        return None
    try:
        orbit = orbit_under(trajectory, period, orbits, ITERATIONS)
    except (ArithmeticError, ValueError):
        return None
    coordinates, scale = state_of(orbit.run.columns, step_s, period_s, 0)
    points = poincare_section(coordinates, step_s, period_s).points[: orbit.period]
    return orbit, approach_evidence(strobed, points, orbit.multipliers, orbit.errors, scale)
