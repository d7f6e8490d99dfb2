"""Runs whose accepted steps are kept, and copies of them that repeat the same steps from a displaced state.

A copy takes each step as the run took it: same time, same length, same kind, with Newton's method driven to rounding in
both. Copies on a common step sequence differ by the dynamics alone, not by their step control.
"""

import numpy as np

from engine.time.status import OK
from tests.engine.kernels import Steps, conserved, new_state

ROUNDING = 1e-20  # Newton's tolerance: it stops once an update is below 7e-11, one more step of it from rounding


class Run(Steps):
    """A simulation of one scene, advanced chunk by chunk (`chunks`); its steps stay in `T, Ys, Ks`."""

    def __init__(self, scene, duration_s):
        super().__init__(scene, duration_s, newton_tolerance=ROUNDING, max_newton=40)
        self.weight = float(self.record["per_speed"]) ** 2
        self.period_s = scene.waves.period_s if scene.waves is not None else 1.0

    def norm(self, dC):
        """Length of a displacement of C (n, 4), as the engine measures it."""
        return np.sqrt(np.sum(dC[:, :2] ** 2) + self.weight * np.sum(dC[:, 2:] ** 2))

    def direction(self, seed):
        """A random displacement of C of length one that leaves the anchor at rest."""
        dC = np.random.default_rng(seed).normal(size=(int(self.record["nodes"]), 4))
        dC[0, 2:] = 0.0
        return dC / self.norm(dC)

    def carried(self, vectors):
        """Perturbations as `carry` takes them, starting from vectors (k, n, 4) with rates that do not matter."""
        return Carried(self, vectors)


class Carried:
    """The engine's perturbations along a run; `growth` (nats) per vector since the start."""

    def __init__(self, run, vectors):
        self.run = run
        self.vectors, self.rates, self.waters = vectors.copy(), np.zeros_like(vectors), np.zeros_like(vectors)
        self.growth = np.zeros(len(vectors))

    def follow(self, first, count):
        self.growth += self.run.carry(first, count, self.vectors, self.rates, self.waters)


class Copy:
    """A second state on the steps of a run, displaced from a state Y (n, 6) with rates K by dC and dK."""

    def __init__(self, run, Y, K, dC, dK):
        n, s = len(Y), run.Ys.shape[1]
        self.run, self.state = run, new_state()
        self.C, self.K, self.Y, self.Y_before = np.zeros((n, 4)), np.zeros((n, 4)), np.zeros((n, 6)), np.zeros((n, 6))
        self.C_new, self.Ys, self.Ks = np.zeros((n, 4)), np.zeros((s, n, 6)), np.zeros((s, n, 4))
        self.displace(Y, K, dC, dK)

    def displace(self, Y, K, dC, dK):
        conserved(self.run.record, Y, self.C)
        self.C += dC
        self.K[:] = K + dK
        self.Y[:] = Y
        turn = np.arctan2(self.C[:, 1], self.C[:, 0]) - Y[:, 4]
        self.Y[:, 4] += (turn + np.pi) % (2 * np.pi) - np.pi
        self.Y[:, 0] = np.hypot(self.C[:, 0], self.C[:, 1]) - 1
        self.Y[:, 2:4] = self.C[:, 2:]
        self.dt_before = 0.0

    def step(self, t, dt, one_stage):
        """Returns whether a loop was released after the step."""
        code = self._try(t, dt, one_stage)
        if code != OK and self.dt_before > 0.0:  # as after a step that the run had to repeat: another first guess
            self.dt_before = 0.0
            code = self._try(t, dt, one_stage)
        assert code == OK, f"the copy fails at {t} s"
        self.Y_before[:], self.Y[:], self.C[:], self.K[:] = self.Y, self.Ys[-1], self.C_new, self.Ks[-1]
        code, released = self.run.guard(self.state, self.Y)
        assert code == OK
        self.dt_before = 0.0 if released else dt
        return released

    def _try(self, t, dt, one_stage):
        state, new = (self.Y, self.Y_before, self.C, self.K), (self.Ys, self.Ks, self.C_new)
        return self.run.repeat(t, dt, self.dt_before, one_stage, state, new)


def start_of(run):
    """The state (Y, K) of a run that has not moved yet."""
    return run.inner.motion.Y.copy(), run.inner.motion.K.copy()
