"""Euler parameters and the local frame: eqs. (1)-(6), and the axes in which appendix A is written.

Appendix A projects the weight on the first column of C: its vertical is axis 1. The engine's z, x, y are therefore the
paper's axes 1, 2, 3 here (a right-handed set), and the appendix is used as it stands. A motion in the plane of x and z
then has beta_1 = beta_2 = Omega_1 = Omega_2 = S_b = w = 0.

Arrays carry their components first, (3, ...) and (4, ...), and may be complex: nothing here takes an absolute value.

In the paper: eq. (1) local frame from the fixed one; eq. (2) components of a vector; eq. (3) rate of a vector in the
local frame; eq. (4) derivative along the line in the local frame; eq. (5) Euler parameters; eq. (6) rotation matrix.
"""

import numpy as np

from ..spatial.vectors import frame_of

TO_ENGINE = [1, 2, 0]  # (x, y, z) from the paper's axes
TO_PAPER = [2, 0, 1]  # the paper's axes from (x, y, z)


def rotation(beta: np.ndarray) -> np.ndarray:
    """C of eq. (6), rows t, n, b, (3, 3, ...); C31 has the factor 2 that the print leaves out.

    beta (4, ...). Scaled by |beta|^2 where |beta| is not 1: the box rule does not keep it.
    """
    return np.array(frame_of(beta))


def normal_rates(beta: np.ndarray, rate: np.ndarray) -> tuple[list, list]:
    """d/dt of the rows n and b of C, (2, 3, ...), for d(beta)/dt = rate."""
    b0, b1, b2, b3 = beta
    d0, d1, d2, d3 = rate
    n = [
        2 * (d1 * b2 + b1 * d2 - d0 * b3 - b0 * d3),
        2 * (b0 * d0 - b1 * d1 + b2 * d2 - b3 * d3),
        2 * (d2 * b3 + b2 * d3 + d0 * b1 + b0 * d1),
    ]
    b = [
        2 * (d1 * b3 + b1 * d3 + d0 * b2 + b0 * d2),
        2 * (d2 * b3 + b2 * d3 - d0 * b1 - b0 * d1),
        2 * (b0 * d0 - b1 * d1 - b2 * d2 + b3 * d3),
    ]
    return n, b


def turning(beta: np.ndarray, rate: np.ndarray) -> tuple:
    """omega of eq. (3) in the local frame, 2 beta* o d(beta)/dt without its scalar part, (3, ...)."""
    b0, b1, b2, b3 = beta
    d0, d1, d2, d3 = rate
    return (
        2 * (b0 * d1 - b1 * d0 + b3 * d2 - b2 * d3),
        2 * (b0 * d2 - b2 * d0 + b1 * d3 - b3 * d1),
        2 * (b0 * d3 - b3 * d0 + b2 * d1 - b1 * d2),
    )


def to_fixed(beta: np.ndarray, local: np.ndarray) -> np.ndarray:
    """Fixed components C' g of a vector given by its local components g (3, ...), eq. (2) the other way round."""
    C = rotation(beta)
    return np.array([C[0, i] * local[0] + C[1, i] * local[1] + C[2, i] * local[2] for i in range(3)])


def to_local(beta: np.ndarray, fixed: np.ndarray) -> np.ndarray:
    """Local components C G of a vector given in the paper's axes, eq. (2)."""
    C = rotation(beta)
    return np.array([C[i, 0] * fixed[0] + C[i, 1] * fixed[1] + C[i, 2] * fixed[2] for i in range(3)])


def roll(beta: np.ndarray) -> np.ndarray:
    """Direction of d(beta) for a roll of the frame about t: beta o (0, 1, 0, 0)."""
    return np.array([-beta[1], beta[0], beta[3], -beta[2]])


def turns(beta: np.ndarray, Omega: np.ndarray, h: np.ndarray) -> np.ndarray:
    """Turn within each element (rad): the larger of the angle between the frames at its ends and h times mean |Omega|.

    beta (4, n), Omega (3, n), h (n - 1,). The frames alone do not see whole turns. The mean of |Omega|, not |mean|: a
    slack line in this form carries curvatures of alternate signs from node to node, with frames that hardly turn.
    """
    unit = beta / np.linalg.norm(beta, axis=0)
    cosine = np.abs(np.sum(unit[:, 1:] * unit[:, :-1], axis=0))
    between = 2 * np.arccos(np.minimum(cosine, 1.0))
    bend = np.linalg.norm(Omega, axis=0)
    return np.maximum(between, 0.5 * h * (bend[1:] + bend[:-1]))
