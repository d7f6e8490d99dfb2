"""What a run of the paper's form needs of its scene: unknowns by name, constants, grid, scales; and its local frame.

Appendix A projects the weight on the first column of C: its vertical is axis 1. The engine's z, x, y are therefore the
paper's axes 1, 2, 3 here (a right-handed set), and the appendix is used as it stands. A motion in the plane of x and z
then has beta_1 = beta_2 = Omega_1 = Omega_2 = S_b = w = 0.

Arrays carry their components first, (3, ...) and (4, ...), and may be complex: nothing here takes an absolute value.

In the paper: eq. (1) local frame from the fixed one; eq. (2) components of a vector; eq. (3) rate of a vector in the
local frame; eq. (4) derivative along the line in the local frame; eq. (5) Euler parameters; eq. (6) rotation matrix;
eq. (21) the thirteen equations; eq. (22) the thirteen unknowns.
"""

from dataclasses import dataclass

import numpy as np

from .. import parameters
from ..physics.tension import LAWS
from ..record import lengths_of
from ..scene.models import Scene
from ..spatial.vectors import dot_of, frame_of

TO_ENGINE = [1, 2, 0]  # (x, y, z) from the paper's axes
TO_PAPER = [2, 0, 1]  # the paper's axes from (x, y, z)
EPS, S_N, S_B, U, V, W, B0, B1, B2, B3, O1, O2, O3 = range(13)
SPEEDS, EULER, OMEGA = slice(U, W + 1), slice(B0, B3 + 1), slice(O1, O3 + 1)
SPACE = list(range(13))
PLANE = [EPS, S_N, U, V, B0, B3, O3]  # the others stay exactly zero in the plane of axes 1 and 2 (x and z)
# the unknown in whose scale each row of `ends` is: a plane has the rows of its own unknowns
BELOW, ABOVE = [U, V, W, B0, B1, O2, O3], [EPS, S_N, S_B, O1, O2, O3]
SCALES = ["per_strain", *2 * ["per_force"], *3 * ["per_speed"], *4 * [None], *3 * ["per_curvature"]]


@dataclass(frozen=True)
class Line:
    """Constants of one scene: the engine's parameter record and tables, element lengths h (n - 1,), m, GIp (N m2).

    accelerations: true normal accelerations in Morison's force in place of the paper's component rates.
    per: inverse scales of the thirteen unknowns. active: the unknowns of a plane or of space.
    """

    record: np.void
    tables: np.ndarray
    h: np.ndarray
    GIp: float
    accelerations: bool
    per: np.ndarray
    active: list[int]

    @property
    def spatial(self) -> bool:
        """Does the line move in space?"""
        return self.active is SPACE

    @property
    def s(self) -> np.ndarray:
        """Unstretched arc length of the nodes (n,), m."""
        return np.concatenate([[0.0], np.cumsum(self.h)])

    def tension(self, eps: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """T = f(eps) and f'(eps), N, eqs. (20) and (29), at real or complex strains of any shape."""
        return LAWS[int(self.record["law"])].of_array(eps, self.record, self.tables)


def line_of(scene: Scene, accelerations: bool = False) -> Line:
    """The `Line` of a scene."""
    record, tables = parameters.numbers_of(scene)
    h = lengths_of(record, tables)
    per = np.array([record[name] if name else 1.0 for name in SCALES])
    active = PLANE if scene.motion.dimensions == 2 else SPACE
    return Line(record, tables, h, scene.tether.torsion_stiffness_Nm2, accelerations, per, active)


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
    return np.array([dot_of(C[:, i], local) for i in range(3)])


def to_local(beta: np.ndarray, fixed: np.ndarray) -> np.ndarray:
    """Local components C G of a vector given in the paper's axes, eq. (2)."""
    C = rotation(beta)
    return np.array([dot_of(row, fixed) for row in C])


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
