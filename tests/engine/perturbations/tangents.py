"""Runs whose accepted steps are kept, and copies of them that repeat the same steps from a displaced state.

A copy takes each step as the run took it: same time, same length, same kind, with Newton's method driven to rounding in
both. Copies on a common step sequence differ by the dynamics alone, not by their step control.
"""

import numpy as np

from engine.time.status import OK
from tests.engine.kernels import Stage, Steps, new_state

ROUNDING = 1e-20  # Newton's tolerance: it stops once an update is below 7e-11, one more step of it from rounding


class Run(Steps):
    """A simulation of one scene, advanced chunk by chunk, its stages solved to rounding."""

    def __init__(self, scene, duration_s):
        super().__init__(scene, duration_s, newton_tolerance=ROUNDING, max_newton=40)
        self.weight = float(self.record["per_speed"]) ** 2
        self.stage = Stage(scene)

    def norm(self, dC):
        """Length of a displacement of C (n, 4), as the engine measures it."""
        return np.sqrt(np.sum(dC[:, :2] ** 2) + self.weight * np.sum(dC[:, 2:] ** 2))

    def direction(self, seed):
        """A random displacement of C of length one that leaves the anchor at rest."""
        dC = np.random.default_rng(seed).normal(size=(int(self.record["nodes"]), 4))
        dC[0, 2:] = 0.0
        return dC / self.norm(dC)

    def copies(self, apart, vectors):
        """Two copies, displaced by +-apart vectors (n, 4) from where the run is."""
        return [Copy(self, sign * apart * vectors) for sign in (1, -1)]


class Carried:
    """The engine's perturbations along a run, from vectors (k, n, 4) with rates that do not matter; `growth` (nats)
    per vector since the start."""

    def __init__(self, run, vectors):
        self.run, self.vectors = run, vectors.copy()
        self.rates, self.waters, self.growth = np.zeros_like(vectors), np.zeros_like(vectors), np.zeros(len(vectors))

    def follow(self, step):
        """Along one kept step."""
        self.growth += self.run.carry(step, 1, self.vectors, self.rates, self.waters)


class Copy:
    """A second state on the steps of a run, displaced by dC from where the run is."""

    def __init__(self, run, dC):
        Y = run.inner.motion.Y
        self.run, self.state, self.dt_before = run, new_state(), 0.0
        self.C, self.K, self.Y = run.stage.conserved(Y) + dC, run.inner.motion.K.copy(), Y.copy()
        turn = np.arctan2(self.C[:, 1], self.C[:, 0]) - Y[:, 4]
        self.Y[:, 4] += (turn + np.pi) % (2 * np.pi) - np.pi
        self.Y[:, 0] = np.hypot(self.C[:, 0], self.C[:, 1]) - 1
        self.Y[:, 2:4] = self.C[:, 2:]
        self.Y_before = self.Y.copy()
        self.new = np.zeros(run.Ys.shape[1:]), np.zeros(run.Ks.shape[1:]), np.zeros_like(self.C)

    def step(self, t, dt, one_stage):
        """Returns whether a loop was released after the step."""
        state = self.Y, self.Y_before, self.C, self.K
        code = self.run.repeat(t, dt, self.dt_before, one_stage, state, self.new)
        if code != OK and self.dt_before > 0.0:  # as after a step that the run had to repeat: another first guess
            code = self.run.repeat(t, dt, 0.0, one_stage, state, self.new)
        assert code == OK, f"the copy fails at {t} s"
        Ys, Ks, C_new = self.new
        self.Y_before[:], self.Y[:], self.C[:], self.K[:] = self.Y, Ys[-1], C_new, Ks[-1]
        code, released = self.run.guard(self.state, self.Y)
        assert code == OK
        self.dt_before = 0.0 if released else dt
        return released
