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

from ..physics.sea import direction_of
from ..record import SAMPLE_WIDTH, STATE
from ..scene.models import Scene
from ..time import status as codes
from ..time.statics import why_no_rest
from ..trajectory import Profiles, Trajectory
from ..trajectory.columns import columns_of, heading_of, sample_count, statistics_of
from ..trajectory.excursions import with_excursions
from .ends import force_and_velocity
from .line import EPS, EULER, OMEGA, TO_ENGINE, Line, line_of, turns
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
    most_gap: float = MOST_GAP,
) -> Trajectory:
    """Simulate one scene in the paper's own discrete form.

    scene           bending stiffness above zero; fixed steps of solver.step_s (T/400, or 0.0125 s without waves)
    duration_s      s;  progress  callable(fraction), optional
    accelerations   true normal accelerations in Morison's force instead of the paper's component rates (`line.Line`)
    most_gap        m per m of line at which the run stops (head of the constant above)
    Returns a Trajectory: status "ok", or why it ended early. Further statistics: closure_m, the largest distance of the
    upper end by the shape of the line from that by its own velocity, zero for the exact equations: what compatibility
    in the local frame has lost; euler_norm_error, the largest | |beta|^2 - 1 |.
    """
    line = line_of(scene, accelerations)
    record = Record(scene, line, duration_s, most_gap)
    state = record.state
    dt, max_iterations = float(line.record["fixed_step"]), int(line.record["max_newton"])
    tolerance = scene.solver.newton_tolerance or TOLERANCE
    started = time.perf_counter()
    status, Y = at_rest(scene, line)
    if status == codes.OK:
        level = level_of(line, 0.0, Y)
        flat = FLAT * float(line.tension(Y[EPS])[1].max())
        status = record.keep(level)
    while status == codes.OK and (len(record.rows), len(record.profiles)) != (record.goal, record.profile_goal):
        status, used, level = solve(line, (state["steps"] + 1) * dt, level, max_iterations, tolerance, flat)
        state["newton"] += used
        if status != codes.OK:
            state["failures"] = 1
            break
        state["steps"] += 1
        status = record.keep(level)
        if progress is not None and state["steps"] % STEPS_PER_CALL == 0:
            progress(min(1.0, level.t / duration_s))
    state["t"] = state["steps"] * dt
    drifts = {"closure_m": record.closure, "euler_norm_error": record.norm_error}
    statistics = statistics_of(state, time.perf_counter() - started) | drifts
    message = ""
    if status in (codes.STATICS_FAILED, codes.IN_THE_AIR):
        message = f"paper-box: {codes.ADVICE[status]}"
        message += why_no_rest(line.record, scene) if status == codes.STATICS_FAILED else ""
    elif status != codes.OK:
        turn, end = state["max_turn"], (state["steps"] + state["failures"]) * dt
        reason = SAID[status].format(turn=turn, gap=record.closure)
        seen = f"turn per element up to {turn:.3g} rad, strain down to {state['min_strain']:.3g} before"
        cure = 'add nodes, shorten solver.step_s, or take solver.scheme = "conservation"'
        message = f"paper-box: {reason} in the step of {dt:.3g} s to t = {end:.6g} s ({seen}): {cure}"
    columns = columns_of(np.array(record.rows).reshape(-1, SAMPLE_WIDTH), scene)
    message, excursions = with_excursions(message, scene, columns, codes.WORDS[status])
    profiles = record.lines()
    return Trajectory(scene, codes.WORDS[status], message, columns, statistics, profiles, excursions=excursions)


class Record:
    """Samples and guards of one run. `keep` takes every time level in turn, the first one at t = 0."""

    def __init__(self, scene: Scene, line: Line, duration_s: float, most_gap: float) -> None:
        self.line, self.most_gap = line, most_gap * line.s[-1]
        self.step, self.profile_step = float(line.record["output_step"]), float(line.record["profile_step"])
        self.goal, self.profile_goal = (sample_count(duration_s, step) for step in (self.step, self.profile_step))
        cosine, sine = direction_of(heading_of(scene))
        self.across = np.array([-sine, cosine, 0.0])
        self.rows, self.profiles, self.state = [], [], np.zeros(1, STATE)[0]
        self.state["low"], self.state["high"], self.state["min_strain"] = np.inf, -np.inf, np.inf
        self.state["foot"] = -np.inf
        self.state["ringing"] = -1.0
        self.closure, self.norm_error = 0.0, 0.0
        self.before = self.travelled = None

    def keep(self, level: Level) -> int:
        """Take in the state at the end of a step; a status code."""
        line, Y, state = self.line, level.Y, self.state
        X, V = positions(line, Y)[TO_ENGINE], force_and_velocity(line, Y)[1][TO_ENGINE]
        T = line.tension(Y[EPS])[0]
        now = level.t, np.array([*X, *V, Y[EPS], T])
        state["max_turn"] = max(state["max_turn"], turns(Y[EULER], Y[OMEGA], line.h).max())
        state["min_strain"] = min(state["min_strain"], Y[EPS].min())
        self.norm_error = max(self.norm_error, float(np.abs(np.sum(Y[EULER] ** 2, axis=0) - 1).max()))
        if self.before is None:
            self.before, self.travelled = now, X[:, -1].copy()
        self.travelled += 0.5 * (now[0] - self.before[0]) * (self.before[1][3:6, -1] + V[:, -1])
        self.closure = max(self.closure, float(np.linalg.norm(self.travelled - X[:, -1])))
        for t, at in self._due(self.rows, self.step, self.goal, now):
            top, tension = at[:, -1], at[7]
            low, high = min(state["low"], top[7]), max(state["high"], top[7])
            offplane = np.abs(self.across @ at[:3]).max()
            line_most = tension[0], tension.max(), line.s[tension.argmax()], max(state["foot"], tension[0])
            self.rows.append(
                [t, *top[:6], top[7], tension.min(), low, high, offplane, 0.0, at[2].min(), 0.0, *line_most]
            )  # as `engine.record` has them
            state["low"] = state["high"] = top[7]
            state["foot"] = tension[0]
        for _, at in self._due(self.profiles, self.profile_step, self.profile_goal, now):
            self.profiles.append(at)
        state["low"], state["high"] = min(state["low"], T[-1]), max(state["high"], T[-1])
        state["foot"] = max(state["foot"], T[0])
        self.before = now
        if state["max_turn"] > MOST_TURN:
            return codes.TURN_UNRESOLVED
        return codes.SHAPE_LOST if self.closure > self.most_gap else codes.OK

    def _due(self, rows: list, step: float, goal: int, now: tuple) -> Iterator[tuple[float, np.ndarray]]:
        """Times of samples within the step that ends now, and the values (8, n) then: x, y, z, velocity, strain, T."""
        (t0, start), (t1, end) = self.before, now
        while len(rows) < goal and (t := len(rows) * step) <= t1 + ROUNDING * (t1 - t0):
            part = min((t - t0) / (t1 - t0), 1.0) if t1 > t0 else 1.0
            yield t, (1 - part) * start + part * end

    def lines(self) -> Profiles | None:
        """Profiles, or None where the scene does not ask for them."""
        if not self.profile_goal:
            return None
        values = np.array(self.profiles).reshape(-1, 8, len(self.line.s))
        x, y, z, vx, vy, vz, strain, tension = np.ascontiguousarray(np.moveaxis(values, 1, 0))
        speed = np.sqrt(vx * vx + vy * vy + vz * vz)
        return Profiles(np.arange(len(values)) * self.profile_step, self.line.s, x, y, z, strain, tension, speed)
