"""The book-keeping of perturbations for one run: the trail of accepted steps, what follows it, how it grows.

In the paper: eq. (32) Lyapunov exponent.
"""

import numpy as np

from ..arrays import Trail
from ..compiled import kernel
from ..dimensions import shape
from ..physics.sea_series import forget
from ..physics.water import water as flow
from ..record import BEGIN, KIND, RESTART, STEP, WIDTHS
from ..simd.elementary import copy_into
from ..time.steps import known_part, plan_stage, stage_rate
from ..trajectory.parts import TangentGrowth
from .lateral import COEFFICIENTS, WIDTH, energy_weights, lateral_stage, normalise
from .tangent import Base, linearise, orthonormalise, period_of, tangent_arrays, tangent_stage, water_moves

STEPS = 200  # of the trail before it is followed: 4 MB at 41 nodes, 21 MB of eight runs in lanes
SEED = 20  # of the first perturbations: any will do, they turn to the fastest growth by themselves


@kernel
def carry(p, tables, period, count, trail, tangent, across):
    """Carry perturbations through the first `count` steps of a Trail.

    tangent: vectors, rates (k, n, 4), dC and dK, orthonormal in C on entry and exit, and growth (periods, k), nats;
    across: weights, vector, rates (n, 2), C = (q_y, V_y) of length one by these weights on entry and exit, and growth
    (periods,), nats; None where there are none. What each step adds to a growth goes to the period (s) in which it ends
    (the last, beyond the end).
    """
    s, n = trail.Y.shape[1], trail.Y.shape[2]
    work, water = tangent_arrays(p, n)
    a, w = np.empty(s), np.empty(3)
    moving_water = water_moves(p)
    if tangent is not None:
        vectors, rates, growth = tangent
        number = vectors.shape[0]
        dKs, dC_tilde, dC = np.zeros((number, s, n, 4)), np.zeros((n, 4)), np.zeros((n, 4))
        lengths, known_of_box = np.empty(number), np.zeros((n, 3))
    if across is not None:
        weights, vector, vector_rates, vector_growth = across
        H, E = np.zeros((n, COEFFICIENTS)), np.zeros((n, WIDTH))
        dC_y, known, dK = np.zeros((n, 2)), np.zeros((n, 2)), np.zeros((s, n, 2))
    for step in range(count):
        t, dt, euler = trail.T[step, BEGIN], trail.T[step, STEP], trail.T[step, KIND] > 0.0
        if tangent is not None:
            for v in range(number):
                copy_into(dKs[v, 0], rates[v])
        if across is not None:
            copy_into(dK[0], vector_rates)
        forget(work.sea)
        for i in range(s - 1 if euler else 1, s):
            rate, delay = plan_stage(p, tables, i, euler, dt, 0.0, a, w)  # 0.0 and w: of a first guess, not used
            so_far = 0 if euler else i
            base = Base(t + delay, rate, moving_water, trail.Y[step, i], trail.K[step, i])
            if tangent is not None:
                linearise(p, tables, base, work, water)
                for v in range(number):
                    known_part(a, so_far, vectors[v], dKs[v], dC_tilde)
                    tangent_stage(p, tables, base, dC_tilde, dC, dKs[v, i], work, water, known_of_box)
                    if i == s - 1:
                        copy_into(vectors[v], dC)
                        copy_into(rates[v], dKs[v, i])
            else:
                shape(p, tables, base.Y, work.Q, work.X)
                flow(p, tables, base.t, 1.0, work.X, work.F, work.sea)
            if across is not None:
                known_part(a, so_far, vector, dK, known)
                lateral_stage(p, tables, base, work, known, H, E, dC_y)
                stage_rate(rate, dC_y, known, dK[i])
        if tangent is not None:
            orthonormalise(p.per_speed * p.per_speed, True, vectors, rates, lengths)
            for v in range(number):
                growth[period_of(t + dt, period, growth.shape[0]), v] += np.log(lengths[v])
        if across is not None:
            copy_into(vector, dC_y)
            copy_into(vector_rates, dK[s - 1])
            length = normalise(weights, True, vector, vector_rates)
            vector_growth[period_of(t + dt, period, vector_growth.shape[0])] += np.log(length)


class Followed:
    """Steps as `march` stores them, and the perturbations that follow; empty where the scene asks for none."""

    def __init__(self, scene, record, tables, duration_s, start=None):
        n, s = int(record["nodes"]), max(int(record["stages"]), 2)
        self.count, self.sideways = scene.output.tangent_vectors, scene.output.lateral_growth
        self.followed = self.count > 0 or self.sideways
        room = STEPS if self.followed else 0
        unknowns, conserved = WIDTHS[scene.motion.dimensions]
        self.steps = Trail(np.zeros((room, 3)), np.zeros((room, s, n, unknowns)), np.zeros((room, s, n, conserved)))
        self.period_s = scene.waves.period_s if scene.waves is not None else 1.0
        if not self.followed:
            return
        begin_s = 0.0 if start is None else start.time_s
        self.first = int(begin_s / self.period_s + 1e-9)  # the period in which it begins
        periods = int((begin_s + duration_s) / self.period_s * (1 + 1e-12) + 1e-9)
        self.along = self.across = None  # the arguments of `carry`
        self.nats, self.lateral_nats = np.zeros((periods + 1, self.count)), np.zeros(periods + 1)
        self.released = np.zeros(periods + 1)
        if self.count:
            vectors = np.random.default_rng(SEED).normal(size=(n, 4, self.count))
            vectors[0, 2:] = 0.0  # the anchor does not move
            basis = np.linalg.qr(vectors.reshape(4 * n, self.count))[0]
            vectors = np.ascontiguousarray(basis.T).reshape(self.count, n, 4)
            self.along = vectors, np.zeros_like(vectors), self.nats
        if self.sideways:
            weights = energy_weights(record, tables)
            vector = np.random.default_rng(SEED).normal(size=(n, 2)) / np.sqrt(weights)
            vector[0, 1] = 0.0
            vector /= np.sqrt(np.sum(weights * vector**2))
            self.across = weights, vector, np.zeros((n, 2)), self.lateral_nats
        if start is not None:
            self._go_on(start)

    def _go_on(self, start):
        """Take over the perturbations of a run that carried as many."""
        has_vectors, sideways = start.vectors.size > 0, start.lateral.size > 0
        if has_vectors and len(start.vectors[0]) == self.count:
            for part, stored in zip(self.along[:2], start.vectors, strict=True):
                part[:] = stored
            self.nats[self.first : self.first + 1] = start.growth[:, : self.count]
        if sideways and self.sideways:
            for part, stored in zip(self.across[1:3], start.lateral, strict=True):
                part[:] = stored
            self.lateral_nats[self.first] = start.growth[0, -2]
        if has_vectors or sideways:
            self.released[self.first] = start.growth[0, -1]

    def state(self, state):
        """vectors, lateral and growth of a FinalState."""
        if not self.followed:
            return np.empty(0), np.empty(0), np.empty(0)
        at = self.complete(state)
        growth = np.array([[*self.nats[at], self.lateral_nats[at], self.released[at]]])
        tangent = np.array(self.along[:2]) if self.count else np.empty(0)
        return tangent, np.array(self.across[1:3]) if self.sideways else np.empty(0), growth

    def follow(self, record, tables, state):
        """Carry the perturbations through the steps stored since the last call, and empty the trail.

        A call without steps compiles the kernels and does nothing else.
        """
        if not self.followed:
            return
        count = int(state["trail"])
        state["trail"] = 0
        self.mark(self.steps.T[:count])
        carry(record, tables, self.period_s, count, self.steps, self.along, self.across)

    def mark(self, T):
        """Mark the periods in which a loop was released, from the steps (m, 3) of a trail."""
        t, dt, kind = T.T
        ends = np.minimum(((t + dt) / self.period_s - 1e-9).astype(int), len(self.released) - 1)
        self.released[ends[(kind == RESTART) & (t > 0.01 * self.period_s)]] = 1.0

    def growth(self, state):
        """Growth of the complete periods, or None."""
        if not self.followed:
            return None
        periods = slice(self.first, self.complete(state))
        sideways = self.lateral_nats[periods].copy() if self.sideways else None
        return TangentGrowth(self.period_s, self.nats[periods].copy(), self.released[periods].copy(), sideways)

    def complete(self, state):
        """How many periods have ended since t = 0."""
        return min(int(state["t"] / self.period_s + 1e-9), len(self.nats) - 1)
