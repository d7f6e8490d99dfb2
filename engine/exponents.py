"""The book-keeping of tangent dynamics for one run: the trail of accepted steps, the perturbations, their growth."""

import numpy as np

from .tangent import carry
from .trajectory import TangentGrowth

STEPS = 200  # of the trail before it is followed: 8 MB at 41 nodes
SEED = 20  # of the first perturbations: any will do, they turn to the fastest growth by themselves


class Trail:
    """Steps as `march` stores them, and the perturbations that follow; empty where the scene asks for none."""

    def __init__(self, scene, record, duration_s):
        n, s = int(record["nodes"]), max(int(record["stages"]), 2)
        count = scene.output.tangent_vectors
        room = STEPS if count else 0
        unknowns, conserved = (6, 4) if scene.motion.dimensions == 2 else (13, 6)
        self.steps = (np.zeros((room, 3)), np.zeros((room, s, n, unknowns)), np.zeros((room, s, n, conserved)))
        self.period_s = scene.waves.period_s if scene.waves is not None else 1.0
        self.count = count
        if not count:
            return
        periods = int(duration_s / self.period_s * (1 + 1e-12) + 1e-9)
        self.nats = np.zeros((periods + 1, count))
        self.released = np.zeros(periods + 1)
        vectors = np.random.default_rng(SEED).normal(size=(n, 4, count))
        vectors[0, 2:] = 0.0  # the anchor does not move
        basis = np.linalg.qr(vectors.reshape(4 * n, count))[0]
        self.vectors = np.ascontiguousarray(basis.T).reshape(count, n, 4)
        self.rates, self.waters = np.zeros((count, n, 4)), np.zeros((count, n, 4))

    def follow(self, record, tables, state):
        """Carry the perturbations through the steps stored since the last call, and empty the trail."""
        count = int(state["trail"])
        state["trail"] = 0
        if count == 0:
            return
        T = self.steps[0][:count]
        ends = np.minimum(((T[:, 0] + T[:, 1]) / self.period_s - 1e-9).astype(int), len(self.released) - 1)
        self.released[ends[(T[:, 2] > 1) & (T[:, 0] > 0.01 * self.period_s)]] = 1.0
        carry(record, tables, self.period_s, count, *self.steps, self.vectors, self.rates, self.waters, self.nats)

    def growth(self, state):
        """Growth of the complete periods, or None."""
        if not self.count:
            return None
        complete = min(int(state["t"] / self.period_s + 1e-9), len(self.nats) - 1)
        return TangentGrowth(self.period_s, self.nats[:complete].copy(), self.released[:complete].copy())
