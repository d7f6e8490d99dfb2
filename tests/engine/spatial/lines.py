"""Scenes, states and starts for the tests in space; states Y (n, 13) as in `engine.spatial.node`.

What is of the plane as well - lines with other ends, a run stepped from outside - comes from `tests.engine.lines`.
"""

import numpy as np

from engine.spatial.lift import product
from tests.engine.lines import line

SPACE = {"motion.dimensions": 3}
QUIET = {"solver.newton_tolerance": 1e-14, "solver.max_newton_iterations": 50}  # stages solved to rounding


def in_space(*parts, **tether):
    """`line` in three dimensions."""
    return line(*parts, SPACE, **tether)


def held_at(x, y, z):
    """Overrides for an upper end held at a place, m from the anchor."""
    return {"end": {"kind": "held", "position_m": [float(x), float(y), float(z)]}, "buoy": None}


def frames(beta):
    """t, n, b as rows (m, 3, 3) of Euler parameters (m, 4): eq. (6), turned vectors q e q*."""
    beta = np.asarray(beta, float)
    conjugate = beta * [1.0, -1.0, -1.0, -1.0]
    units = np.eye(4)[1:]
    return np.stack([product(product(beta, units[i]), conjugate)[:, 1:] for i in range(3)], 1)


def positions(Y, h):
    """Nodes (n, 3), m: the anchor, then sums of h times the mean of q."""
    q = (1 + Y[:, :1]) * frames(Y[:, 6:10])[:, 0]
    return np.concatenate([np.zeros((1, 3)), np.cumsum(0.5 * h[:, None] * (q[1:] + q[:-1]), axis=0)])


def forces(Y, tension_N):
    """Internal force N (n, 3) of a state under a tension law given as a function of strain."""
    F = frames(Y[:, 6:10])
    return tension_N(Y[:, :1]) * F[:, 0] + Y[:, 1:2] * F[:, 1] + Y[:, 2:3] * F[:, 2]
