"""The book-keeping of perturbations for one run: the trail of accepted steps, what follows it, how it grows.

In the paper: eq. (32) Lyapunov exponent.
"""

import numpy as np

from ..arrays import Trail
from ..record import RESTART
from ..trajectory import TangentGrowth
from .lateral import carry_lateral, energy_weights
from .tangent import carry

STEPS = 200  # of the trail before it is followed: 8 MB at 41 nodes
SEED = 20  # of the first perturbations: any will do, they turn to the fastest growth by themselves


class Followed:
    """Steps as `march` stores them, and the perturbations that follow; empty where the scene asks for none."""

    def __init__(self, scene, record, tables, duration_s):
        n, s = int(record["nodes"]), max(int(record["stages"]), 2)
        self.count, self.sideways = scene.output.tangent_vectors, scene.output.lateral_growth
        self.followed = self.count > 0 or self.sideways
        room = STEPS if self.followed else 0
        unknowns, conserved = (6, 4) if scene.motion.dimensions == 2 else (13, 6)
        self.steps = Trail(np.zeros((room, 3)), np.zeros((room, s, n, unknowns)), np.zeros((room, s, n, conserved)))
        self.period_s = scene.waves.period_s if scene.waves is not None else 1.0
        if not self.followed:
            return
        periods = int(duration_s / self.period_s * (1 + 1e-12) + 1e-9)
        self.nats, self.lateral_nats = np.zeros((periods + 1, self.count)), np.zeros(periods + 1)
        self.released = np.zeros(periods + 1)
        if self.count:
            vectors = np.random.default_rng(SEED).normal(size=(n, 4, self.count))
            vectors[0, 2:] = 0.0  # the anchor does not move
            basis = np.linalg.qr(vectors.reshape(4 * n, self.count))[0]
            self.vectors = np.ascontiguousarray(basis.T).reshape(self.count, n, 4)
            self.rates, self.waters = np.zeros((self.count, n, 4)), np.zeros((self.count, n, 4))
        if self.sideways:
            self.weights = energy_weights(record, tables)
            vector = np.random.default_rng(SEED).normal(size=(n, 2)) / np.sqrt(self.weights)
            vector[0, 1] = 0.0
            self.lateral = vector / np.sqrt(np.sum(self.weights * vector**2))
            self.lateral_rates = np.zeros((n, 2))

    def follow(self, record, tables, state):
        """Carry the perturbations through the steps stored since the last call, and empty the trail.

        A call without steps compiles the kernels and does nothing else.
        """
        if not self.followed:
            return
        count = int(state["trail"])
        state["trail"] = 0
        self.mark(self.steps.T[:count])
        if self.count:
            carry(record, tables, self.period_s, count, self.steps, self.vectors, self.rates, self.waters, self.nats)
        if self.sideways:
            vector = self.weights, self.lateral, self.lateral_rates
            carry_lateral(record, tables, self.period_s, count, self.steps, *vector, self.lateral_nats)

    def mark(self, T):
        """Mark the periods in which a loop was released, from the steps (m, 3) of a trail."""
        t, dt, kind = T.T
        ends = np.minimum(((t + dt) / self.period_s - 1e-9).astype(int), len(self.released) - 1)
        self.released[ends[(kind == RESTART) & (t > 0.01 * self.period_s)]] = 1.0

    def growth(self, state):
        """Growth of the complete periods, or None."""
        if not self.followed:
            return None
        complete = min(int(state["t"] / self.period_s + 1e-9), len(self.nats) - 1)
        sideways = self.lateral_nats[:complete].copy() if self.sideways else None
        return TangentGrowth(self.period_s, self.nats[:complete].copy(), self.released[:complete].copy(), sideways)
