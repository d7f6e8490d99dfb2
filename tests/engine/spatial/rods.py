"""Clamped rods for the tests of torsion: scenes, rest from a given state, what a state (n, 13) looks like in space.

A rod here is a dry, weightless line of `length` m under a linear law, clamped at both ends and twisted.
"""

from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from engine.parameters import grid, record_of
from engine.spatial.lift import product, stretch_vectors
from engine.time.statics import settle
from tests.engine.lines import DRY, equilibrium, line, linear

DENSITY, AREA = 1140.0, 7.85e-5


@dataclass(frozen=True)
class Rod:
    """Stiffnesses (N m2, N), length (m), the place of the upper end (m), clamps' directions and twist (rad)."""

    EI: float
    GI: float
    EA: float
    length: float
    place: tuple
    twist: float
    below: tuple = (1.0, 0.0, 0.0)
    above: tuple = (1.0, 0.0, 0.0)

    def scene(self, nodes, **changes):
        return line(
            DRY,
            {
                "gravity_mps2": 0.0, "motion.dimensions": 3, "buoy": None,
                "anchor": {"rotation": "clamped", "direction": list(self.below)},
                "end": {"kind": "held", "position_m": list(self.place), "rotation": "clamped",
                        "direction": list(self.above), "twist_rad": self.twist},
            },
            changes, length_m=self.length, nodes=nodes, area_m2=AREA, density_kgpm3=DENSITY,
            bending_stiffness_Nm2=self.EI, torsion_stiffness_Nm2=self.GI, tension=linear(self.EA),
        )  # fmt: skip


def frames(Y):
    """t, n, b (n, 3) each of a state: turned unit vectors q e q*."""
    beta = Y[:, 6:10]
    back = beta * [1.0, -1.0, -1.0, -1.0]
    return [product(product(beta, unit), back)[:, 1:] for unit in np.eye(4)[1:]]


def positions(Y, h):
    """Nodes (n, 3), m."""
    q = stretch_vectors(Y)
    return np.vstack([np.zeros(3), np.cumsum(0.5 * h[:, None] * (q[1:] + q[:-1]), axis=0)])


def force(rod, Y):
    """N (n, 3)."""
    t, n, b = frames(Y)
    return rod.EA * Y[:, :1] * t + Y[:, 1:2] * n + Y[:, 2:3] * b


def at_rest(rod, nodes, guess=None):
    """State of rest (n, 13) of the engine, and element lengths; from the engine's own guess, or a function of s."""
    scene = rod.scene(nodes)
    if guess is None:
        motion = equilibrium(scene)
        return motion.Y.copy(), motion.h
    tables = []
    record = record_of(scene, tables)[0]
    h = grid(rod.length, nodes, 0.0)
    Y = guess(np.concatenate([[0.0], np.cumsum(h)]))
    assert settle(record, np.concatenate(tables), Y, np.array(rod.place)) == 0, "no rest"
    return Y, h


def state_of(rod, s, t, n, M, N):
    """State (n, 13) of tangents, normals, moments (n, 3) and a force (3,): a guess, exact where they are."""
    b = np.cross(t, n)
    Y = np.zeros((len(s), 13))
    axial, Y[:, 1], Y[:, 2] = t @ N, n @ N, b @ N
    Y[:, 0] = axial / rod.EA
    Y[:, 6:10] = _euler_parameters(np.stack([t, n, b], axis=2))
    Y[:, 10] = np.sum(M * t, 1) / rod.GI
    Y[:, 11], Y[:, 12] = np.sum(M * n, 1) / rod.EI, np.sum(M * b, 1) / rod.EI
    return Y


def _euler_parameters(R):
    """Euler parameters (n, 4) of rotation matrices (n, 3, 3) of columns t, n, b, with no jump of sign."""
    beta = Rotation.from_matrix(R).as_quat()[:, [3, 0, 1, 2]]
    keeps = np.sign(np.sum(beta[1:] * beta[:-1], axis=1))
    beta[1:] *= np.cumprod(keeps)[:, None]
    return beta
