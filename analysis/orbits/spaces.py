"""The derivative of an orbit on the few directions that a period does not forget: linear systems and multipliers.

    d_{i+1} = J_i d_i + b_i delta + r_i,    r_i = P(z_i) - z_{i+1},   J_i = dP/dz,   b_i = dP/dlambda     (a)

Newton's update must close: d_N = d_0. Because (a) is affine in d_0 and delta, only they are left as unknowns. Along a
branch the correction is orthogonal to its tangent t (Keller 1977); at a given parameter the last row and delta go:

    [ I - M   -B  ] [ d_0   ]   [ R ]        M = J_{N-1} ... J_0,    R, B: d_N from the r_i, from the b_i, alone
    [ t_z^T   t_l ] [ delta ] = [ a ]                                                                     (b)

M has the multipliers of the orbit as eigenvalues; all but a few are near 0 in a damped system. So d_0 is sought in a
small space Q, with least squares of what is left of (b), and what is left is its next direction (Saad & Schultz 1986).
Multipliers are those of Q^T M Q (Rayleigh & Ritz), and what M y - mu y leaves of Q gives its next directions. Q begins
with the directions that mattered at the orbit before. A map that carries several directions at the cost of one is given
as many each time: what images of Q leave of it comes next to what is needed.
"""

from collections.abc import Sequence

import numpy as np
from scipy.linalg import eig

from analysis.orbits.maps import Linearised, finite

LINEAR = 1e-3  # what is left of the right-hand side of (b)
RITZ = 1e-9  # what |M y - mu y| leaves, |y| = 1
MOST_DIRECTIONS, MOST_PASSES = 60, 12
NEW_DIRECTION = 1e-8  # what a unit vector must add to Q
FORGOTTEN, MOST_KEPT = 1e-2, 12
FRESH, SEED = 2, 16  # vectors of no preference, so that nothing is missed


class Space:
    """M on Q: `ways` are N + 1 arrays (n, k), Q and its images at each point of the orbit."""

    def __init__(self, linearised: Sequence[Linearised], directions: np.ndarray, abreast: int = 1):
        self.linearised, self.abreast = linearised, abreast
        self.ways = [np.empty((len(directions), 0))] * (len(linearised) + 1)
        self.grow(directions)

    def grow(self, vectors: np.ndarray) -> bool:
        """Whether vectors (n, k) have added to Q. They are made orthogonal again after they have been chosen, because
        a small remainder is orthogonal to Q only to its rounding."""
        basis, lengths = self.ways[0], np.linalg.norm(vectors, axis=0)
        new = vectors[:, lengths > 0.0] / lengths[lengths > 0.0]
        new = new - basis @ (basis.T @ new)
        axes, sizes, _ = np.linalg.svd(new, full_matrices=False)
        new = axes[:, sizes > NEW_DIRECTION][:, : len(basis) - basis.shape[1]]
        if not new.shape[1]:
            return False
        new = np.hstack([new, self._images_beside(new)])
        new = np.hstack([new, self._random(self._room_beside(new))])
        for _ in range(2):
            new = np.linalg.qr(new - basis @ (basis.T @ new))[0]
        for i, linear in enumerate([*self.linearised, None]):
            self.ways[i] = np.hstack([self.ways[i], finite(new)])
            new = linear(new) if linear else new
        return True

    def _images_beside(self, new: np.ndarray) -> np.ndarray:
        """Directions (n, k) of the images of Q beside Q and `new`, the longest: as many as are carried at no cost."""
        known = np.hstack([self.ways[0], new])
        beside = self.ways[-1] - known @ (known.T @ self.ways[-1])
        axes, sizes, _ = np.linalg.svd(beside, full_matrices=False)
        return axes[:, sizes > NEW_DIRECTION][:, : self._room_beside(new)]

    def _random(self, count: int) -> np.ndarray:
        """Directions (n, count) of no preference, about of length 1; others where Q has grown."""
        n, known = self.ways[0].shape
        return np.random.default_rng([SEED, known]).normal(size=(n, count)) / np.sqrt(n)

    def _room_beside(self, new: np.ndarray) -> int:
        """How many directions are carried at no cost beside new ones."""
        return min(-new.shape[1] % self.abreast, len(new) - new.shape[1] - self.ways[0].shape[1])

    def solve(
        self,
        known: np.ndarray,
        slopes: np.ndarray | None = None,
        tangent: np.ndarray | None = None,
        along: float | np.ndarray = 0.0,
    ) -> tuple[np.ndarray, float | np.ndarray]:
        """(b) for known parts r (N, n) and a = along: d (N, n) and delta; slopes b (N, n) and tangent (n + 1,).

        Of m parameters: slopes (N, n, m), m tangents (m, n + m), a and delta (m,).
        """
        n = known.shape[1]
        rows = np.empty((0, n)) if tangent is None else np.atleast_2d(tangent)
        free = len(rows)
        parts = [np.zeros((n, 1 + free))]
        for i, linear in enumerate(self.linearised):
            part = np.column_stack([known[i], slopes[i]]) if free else known[i][:, None]
            parts.append(part + linear(parts[-1]) if parts[-1].any() else part)
        right = np.append(parts[-1][:, 0], np.broadcast_to(along, free))
        while True:
            basis, image = self.ways[0], self.ways[-1]
            matrix = basis - image
            if free:
                matrix = np.block([[matrix, -parts[-1][:, 1:]], [rows[:, :n] @ basis, rows[:, n:]]])
            solution = np.linalg.lstsq(matrix, right, rcond=None)[0]
            rest = right - matrix @ solution
            settled = np.linalg.norm(rest) <= LINEAR * np.linalg.norm(right)
            if settled or basis.shape[1] >= MOST_DIRECTIONS or not self.grow(rest[:n, None]):
                break
        basis_shares, deltas = np.split(solution, [len(solution) - free])
        shares, update = np.append(1.0, deltas), []
        for way, part in zip(self.ways[:-1], parts, strict=False):
            update.append(way @ basis_shares + part @ shares)
        if np.ndim(tangent) == 2:
            return np.array(update), deltas
        return np.array(update), float(deltas[0]) if free else 0.0

    def strongest(self) -> np.ndarray:
        """Directions (n, k) that are left after a period."""
        axes, sizes, _ = np.linalg.svd(self.ways[-1], full_matrices=False)
        return axes[:, sizes > FORGOTTEN][:, :MOST_KEPT]

    def multipliers(self, count: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """The largest: values (k,), their errors (k,) and eigenvectors (n, k) of length 1.

        k is one larger than count where a conjugate pair would be cut, and n at most. Errors: what is left of
        M y - mu y, with rounding, times the condition of mu; no more than |mu|, for those that may as well be 0.
        """
        n = len(self.ways[0])
        self.grow(self._random(FRESH + max(0, count - self.ways[0].shape[1])))
        for _ in range(MOST_PASSES):
            basis, image = self.ways[0], self.ways[-1]
            small = basis.T @ image
            values, duals, vectors = eig(small, left=True)
            order = np.argsort(-np.abs(values), kind="stable")
            # of a pair, LAPACK gives the one with the positive imaginary part first
            order = order[: count + (len(order) > count and values[order[count - 1]].imag > 0.0)]
            values, duals, vectors = values[order], duals[:, order], vectors[:, order]
            rest = image @ vectors - (basis @ vectors) * values
            sizes = np.linalg.norm(rest, axis=0)
            rough = rest[:, sizes > RITZ * np.maximum(1.0, np.abs(values))]
            if not rough.shape[1] or basis.shape[1] == n or not self.grow(np.hstack([rough.real, rough.imag])):
                break
        sizes = np.maximum(sizes, np.finfo(float).eps * np.linalg.norm(small, 2))
        errors = sizes / np.maximum(np.abs((duals.conj() * vectors).sum(axis=0)), 1e-300)
        errors = np.minimum(errors, np.maximum(np.abs(values), np.sqrt(sizes)))
        return values, errors, basis @ vectors
