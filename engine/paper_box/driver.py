"""One scene by the paper's scheme: eq. (28) at fixed steps from rest, until the end of the run or of what it can do.

The paper says nothing of steps that fail. Here the first one ends the run, and so do

    a turn per element that the nodes do not resolve,
    a shape whose upper end has left the path of its own velocity: compatibility (19) holds rates only, in axes that
        turn with the line; what a bend loses of the length of the line is lost for good, and r with it,
    a tension law without slope (row 1 is divided by it), a strain of -1, a value that is not finite.

Between two steps positions, velocities and tensions are interpolated linearly (never Euler parameters).
"""

import math
import time
from collections.abc import Callable, Iterator

import numpy as np

from ..record import SAMPLE_WIDTH
from ..run import columns_of
from ..scene.models import Scene
from ..time import status as codes
from ..time.statics import why_no_rest
from ..trajectory import Profiles, Trajectory
from .ends import force_and_velocity
from .frame import TO_ENGINE, turns
from .line import EPS, EULER, OMEGA, Line, line_of
from .newton import TOLERANCE, solve
from .nodal import Level, level_of, positions
from .start import at_rest

MOST_TURN = math.pi / 2  # rad in one element; half of what two frames can tell
MOST_GAP = 0.0025  # m per m of line between shape and path; the paper bounds its whole error by 0.01 (section 3)
FLAT = 1e-6  # of the largest slope f' at rest: below it row 1 is noise
STEPS_PER_CALL = 100
ROUNDING = 1e-9  # of a step: a sample this little after a step is taken in it

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
        said = SAID[status].format(turn=record.max_turn, gap=record.closure)
        seen = f"turn per element up to {record.max_turn:.3g} rad, strain down to {record.min_strain:.3g} before"
        cure = 'add nodes, shorten solver.step_s, or take solver.scheme = "conservation"'
        message = f"paper-box: {said} in the step of {dt:.3g} s to t = {(steps + failures) * dt:.6g} s ({seen}): {cure}"
    return Trajectory(scene, codes.WORDS[status], message, record.columns(), statistics, record.lines())


class Record:
    """Samples and guards of one run. `keep` takes every time level in turn, the first one at t = 0."""

    def __init__(self, scene: Scene, line: Line, duration_s: float, most_turn: float, most_gap: float) -> None:
        self.line, self.most_turn, self.most_gap = line, most_turn, most_gap * line.s[-1]
        self.step, self.profile_step = float(line.record["output_step"]), float(line.record["profile_step"])
        self.goal, self.profile_goal = (
            int(duration_s / step * (1 + 1e-12) + 1e-9) + 1 if step else 0 for step in (self.step, self.profile_step)
        )
        self.heading = scene.waves.direction_rad if line.spatial and scene.waves is not None else 0.0
        self.across = np.array([-round(np.sin(self.heading), 15), round(np.cos(self.heading), 15), 0.0])
        self.rows, self.profiles = [], []
        self.low, self.high = np.inf, -np.inf
        self.max_turn, self.min_strain = 0.0, np.inf
        self.closure, self.norm_error = 0.0, 0.0
        self.before = self.travelled = None

    def keep(self, level: Level) -> int:
        """Take in the state at the end of a step; a status code."""
        line, Y = self.line, level.Y
        X, V = positions(line, Y)[TO_ENGINE], force_and_velocity(line, Y)[1][TO_ENGINE]
        T = line.tension(Y[EPS])[0]
        now = level.t, np.array([*X, *V, Y[EPS], T])
        self.max_turn = max(self.max_turn, float(turns(Y[EULER], Y[OMEGA], line.h).max()))
        self.min_strain = min(self.min_strain, float(Y[EPS].min()))
        self.norm_error = max(self.norm_error, float(np.abs(np.sum(Y[EULER] ** 2, axis=0) - 1).max()))
        if self.before is None:
            self.before, self.travelled = now, X[:, -1].copy()
        self.travelled += 0.5 * (now[0] - self.before[0]) * (self.before[1][3:6, -1] + V[:, -1])
        self.closure = max(self.closure, float(np.linalg.norm(self.travelled - X[:, -1])))
        self._sample(now)
        self.low, self.high = min(self.low, T[-1]), max(self.high, T[-1])
        self.before = now
        if self.max_turn > self.most_turn:
            return codes.TURN_UNRESOLVED
        return codes.SHAPE_LOST if self.closure > self.most_gap else codes.OK

    def _due(self, kept: list, step: float, goal: int, now: tuple) -> Iterator[tuple[float, np.ndarray]]:
        """Times of samples within the step that ends now, and the values (8, n) then: x, y, z, velocity, strain, T."""
        (t0, start), (t1, end) = self.before, now
        while len(kept) < goal and len(kept) * step <= t1 + ROUNDING * (t1 - t0):
            t = len(kept) * step
            part = min((t - t0) / (t1 - t0), 1.0) if t1 > t0 else 1.0
            yield t, (1 - part) * start + part * end

    def _sample(self, now):
        for t, at in self._due(self.rows, self.step, self.goal, now):
            top, tension = at[:, -1], at[7]
            offplane = np.abs(self.across @ at[:3]).max()
            low, high = min(self.low, top[7]), max(self.high, top[7])
            self.rows.append([t, *top[:6], top[7], tension.min(), low, high, offplane])  # as `engine.record` has them
            self.low = self.high = top[7]
        for _, at in self._due(self.profiles, self.profile_step, self.profile_goal, now):
            self.profiles.append(at)

    def done(self) -> bool:
        """Is every sample there?"""
        return len(self.rows) == self.goal and len(self.profiles) == self.profile_goal

    def columns(self) -> dict[str, np.ndarray]:
        """Columns of a trajectory (`engine.trajectory.COLUMNS`)."""
        return columns_of(np.array(self.rows).reshape(-1, SAMPLE_WIDTH), self.heading)

    def lines(self) -> Profiles | None:
        """Profiles, or None where the scene does not ask for them."""
        if not self.profile_goal:
            return None
        values = np.array(self.profiles).reshape(-1, 8, len(self.line.s))
        x, y, z, vx, vy, vz, strain, tension = np.ascontiguousarray(np.moveaxis(values, 1, 0))
        speed = np.sqrt(vx * vx + vy * vy + vz * vz)
        return Profiles(np.arange(len(values)) * self.profile_step, self.line.s, x, y, z, strain, tension, speed)
