"""A run that has not settled, and the periodic orbit that it comes nearer to (`analysis.approaches`)."""

from analysis import Evidence, approach_evidence, approached_period, next_look
from campaigns.explore.multipliers import OrbitUnder, orbit_under
from campaigns.judge import periods_of
from campaigns.machinery.store import Store
from engine.trajectory import Trajectory
from engine.views import LONGEST_PERIOD, carries_tangents, strobed_states

ITERATIONS = 6  # of Newton's method: from a run that comes nearer to an orbit three are enough


def orbit_ahead(trajectory: Trajectory, orbits: Store) -> tuple[OrbitUnder, Evidence] | None:
    """The orbit near a run, and whether the run comes nearer to it; None where no orbit is looked for or found.

    It is looked for from the second look on, where steps of the run shrink.
    """
    scene = trajectory.scene
    periods = round(periods_of(scene, trajectory.columns))
    if periods < next_look(next_look()) or not carries_tangents(scene) or trajectory.final_state is None:
        return None
    strobed, scale = strobed_states(trajectory, periods // 2)
    period = approached_period(strobed, scale, LONGEST_PERIOD)
    if period is None:
        return None
    try:
        orbit = orbit_under(trajectory, period, orbits, ITERATIONS)
    except (ArithmeticError, ValueError):
        return None
    points, scale = strobed_states(orbit.run, 0)
    return orbit, approach_evidence(strobed, points[: orbit.period], orbit.multipliers, orbit.errors, scale)
