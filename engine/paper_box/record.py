"""What a run keeps of its steps: even samples, profiles, and what shows that the paper's form has lost the solution.

Between two steps positions, velocities and tensions are interpolated linearly (never Euler parameters).
"""

from dataclasses import fields

import numpy as np

from ..record import SAMPLE_WIDTH
from ..run import columns_of
from ..trajectory import Profiles
from .ends import force_and_velocity
from .frame import TO_ENGINE, turns
from .law import tension_law
from .line import EULER, OMEGA
from .water import positions

ROUNDING = 1e-9  # of a step: a sample this little after a step is taken in it


class Record:
    """Samples and guards of one run. `keep` takes every time level in turn, the first one at t = 0."""

    def __init__(self, scene, line, duration_s):
        record = line.record
        self.line = line
        self.step, self.profile_step = float(record["output_step"]), float(record["profile_step"])
        self.goal = int(duration_s / self.step * (1 + 1e-12) + 1e-9) + 1
        self.profile_goal = int(duration_s / self.profile_step * (1 + 1e-12) + 1e-9) + 1 if self.profile_step else 0
        self.heading = scene.waves.direction_rad if line.spatial and scene.waves is not None else 0.0
        self.across = np.array([-round(np.sin(self.heading), 15), round(np.cos(self.heading), 15), 0.0])
        self.rows, self.profiles = [], []
        self.low, self.high = np.inf, -np.inf
        self.max_turn, self.min_strain = 0.0, np.inf
        self.closure, self.norm_error = 0.0, 0.0
        self.before = None
        self.travelled = None

    def keep(self, level):
        """Take in the state at the end of a step."""
        line = self.line
        Y = level.Y
        X = positions(line, Y)[TO_ENGINE]
        V = force_and_velocity(line, Y)[1][TO_ENGINE]
        T = tension_law(line.record, line.tables, Y[0])[0]
        now = (level.t, np.concatenate([X, V, Y[:1], T[None]]))
        self.max_turn = max(self.max_turn, float(turns(Y[EULER], Y[OMEGA], line.h).max()))
        self.min_strain = min(self.min_strain, float(Y[0].min()))
        self.norm_error = max(self.norm_error, float(np.abs(np.sum(Y[EULER] ** 2, axis=0) - 1).max()))
        if self.before is None:
            self.before, self.travelled = now, X[:, -1].copy()
        self.travelled += 0.5 * (now[0] - self.before[0]) * (self.before[1][3:6, -1] + V[:, -1])
        self.closure = max(self.closure, float(np.linalg.norm(self.travelled - X[:, -1])))
        self._sample(now)
        self.low, self.high = min(self.low, T[-1]), max(self.high, T[-1])
        self.before = now

    def _between(self, now, t):
        (t0, start), (t1, end) = self.before, now
        if t1 == t0:
            return end
        part = min((t - t0) / (t1 - t0), 1.0)
        return (1 - part) * start + part * end

    def _sample(self, now):
        reached = now[0] + ROUNDING * (now[0] - self.before[0])
        while len(self.rows) < self.goal and len(self.rows) * self.step <= reached:
            t = len(self.rows) * self.step
            at = self._between(now, t)
            top, tension = at[:, -1], at[7]
            offplane = np.abs(self.across @ at[:3]).max()
            low, high = min(self.low, top[7]), max(self.high, top[7])
            self.rows.append([t, *top[:6], top[7], tension.min(), low, high, offplane])  # as `engine.record` has them
            self.low = self.high = top[7]
        while len(self.profiles) < self.profile_goal and len(self.profiles) * self.profile_step <= reached:
            self.profiles.append(self._between(now, len(self.profiles) * self.profile_step))

    def done(self):
        """Is every sample there?"""
        return len(self.rows) == self.goal and len(self.profiles) == self.profile_goal

    def columns(self):
        """Columns of a trajectory (`engine.trajectory.COLUMNS`)."""
        return columns_of(np.array(self.rows).reshape(-1, SAMPLE_WIDTH), self.heading)

    def lines(self):
        """Profiles, or None where the scene does not ask for them."""
        if not self.profile_goal:
            return None
        values = np.array(self.profiles).reshape(len(self.profiles), 8, len(self.line.s))
        x, y, z, vx, vy, vz, strain, tension = np.moveaxis(values, 1, 0)
        known = {
            "time_s": np.arange(len(values)) * self.profile_step,
            "s_m": self.line.s,
            "x_m": x,
            "y_m": y,
            "z_m": z,
            "strain": strain,
            "tension_N": tension,
            "speed_mps": np.sqrt(vx * vx + vy * vy + vz * vz),
        }
        return Profiles(**{field.name: np.ascontiguousarray(known[field.name]) for field in fields(Profiles)})
