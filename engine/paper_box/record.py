"""What a run keeps of its steps: even samples, profiles, and what shows that the paper's form has lost the solution.

Between two steps positions, velocities and tensions are interpolated linearly (never Euler parameters).
"""

from collections.abc import Iterator

import numpy as np

from ..record import SAMPLE_WIDTH
from ..run import columns_of
from ..scene.models import Scene
from ..time.status import OK, SHAPE_LOST, TURN_UNRESOLVED
from ..trajectory import Profiles
from .ends import force_and_velocity
from .frame import TO_ENGINE, turns
from .line import EPS, EULER, OMEGA, Line
from .nodal import Level, positions

ROUNDING = 1e-9  # of a step: a sample this little after a step is taken in it


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
            return TURN_UNRESOLVED
        return SHAPE_LOST if self.closure > self.most_gap else OK

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
