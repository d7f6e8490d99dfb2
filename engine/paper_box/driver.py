"""One scene by the paper's scheme: eq. (28) at fixed steps from rest, until the end of the run or of what it can do.

The paper says nothing of steps that fail. Here the first one ends the run, and so do

    a turn per element that the nodes do not resolve,
    a shape whose upper end has left the path of its own velocity: compatibility (19) holds rates only, in axes that
        turn with the line; what a bend loses of the length of the line is lost for good, and r with it,
    a tension law without slope (row 1 is divided by it), a strain of -1, a value that is not finite.
"""

import math
import time
from collections.abc import Callable

from ..scene.models import Scene
from ..time import status as codes
from ..time.statics_advice import why_no_rest
from ..trajectory import Trajectory
from .line import EPS, line_of
from .newton import TOLERANCE, solve
from .nodal import level_of
from .record import Record
from .start import at_rest

MOST_TURN = math.pi / 2  # rad in one element; half of what two frames can tell
MOST_GAP = 0.0025  # m per m of line between shape and path; the paper bounds its whole error by 0.01 (section 3)
FLAT = 1e-6  # of the largest slope f' at rest: below it row 1 is noise
STEPS_PER_CALL = 100

SAID = {
    codes.NEWTON_FAILED: "Newton's method did not converge",
    codes.NOT_FINITE: "a value that is not a finite number appeared",
    codes.STRAIN_BELOW_MINUS_ONE: "an element is compressed to nothing (strain <= -1)",
    codes.TENSION_FLAT: "the tension law has lost its slope, and the paper's form divides by it",
    codes.TURN_UNRESOLVED: "the tether turns by {turn:.3g} rad within one element, more than it resolves",
    codes.SHAPE_LOST: "the upper end by the shape of the line is {gap:.3g} m away from where its velocity took it",
}


def run(
    scene: Scene,
    duration_s: float,
    progress: Callable[[float], None] | None = None,
    accelerations: bool = False,
    most_turn: float = MOST_TURN,
    most_gap: float = MOST_GAP,
) -> Trajectory:
    """Simulate one scene in the paper's own discrete form.

    Parameters
    ----------
    scene : Scene, bending stiffness above zero; fixed steps of solver.step_s (T/400, or 0.0125 s without waves)
    duration_s : float, s
    progress : callable(fraction), optional
    accelerations : true normal accelerations in Morison's force instead of the paper's component rates (`line.Line`)
    most_turn, most_gap : rad in one element, m per m of line at which the run stops (heads of the constants above)

    Returns
    -------
    Trajectory
        status "ok", or why it ended early. Further statistics: closure_m, the largest distance between the upper end by
        the shape of the line and by its own velocity, zero for the exact equations: what compatibility in the local
        frame has lost; euler_norm_error, the largest | |beta|^2 - 1 |.
    """
    line = line_of(scene, accelerations)
    record = Record(scene, line, duration_s, most_turn, most_gap)
    dt, most = float(line.record["fixed_step"]), int(line.record["max_newton"])
    tolerance = scene.solver.newton_tolerance or TOLERANCE
    began = time.perf_counter()
    status, Y = at_rest(scene, line)
    steps = iterations = failures = 0
    if status == codes.OK:
        level = level_of(line, 0.0, Y)
        flat = FLAT * float(line.tension(Y[EPS])[1].max())
        status = record.keep(level)
    while status == codes.OK and not record.done():
        status, used, level = solve(line, (steps + 1) * dt, level, most, tolerance, flat)
        iterations += used
        if status != codes.OK:
            failures = 1
            break
        steps += 1
        status = record.keep(level)
        if progress is not None and steps % STEPS_PER_CALL == 0:
            progress(min(1.0, level.t / duration_s))
    statistics = {
        "steps": steps,
        "rejected_steps": 0,
        "newton_iterations": iterations,
        "newton_failures": failures,
        "loop_releases": 0,
        "max_turn_rad": record.max_turn,
        "min_strain": record.min_strain,
        "end_time_s": steps * dt,
        "wall_s": time.perf_counter() - began,
        "closure_m": record.closure,
        "euler_norm_error": record.norm_error,
    }
    message = ""
    if status == codes.STATICS_FAILED:
        message = "paper-box: " + codes.ADVICE[codes.STATICS_FAILED] + why_no_rest(line.record, scene)
    elif status != codes.OK:
        message = _message(status, (steps + failures) * dt, dt, record)
    return Trajectory(scene, codes.WORDS[status], message, record.columns(), statistics, record.lines())


def _message(status, t, dt, record):
    said = SAID[status].format(turn=record.max_turn, gap=record.closure)
    seen = f"turn per element up to {record.max_turn:.3g} rad, strain down to {record.min_strain:.3g} before"
    cure = 'add nodes, shorten solver.step_s, or take solver.scheme = "conservation"'
    return f"paper-box: {said} in the step of {dt:.3g} s to t = {t:.6g} s ({seen}): {cure}"
