"""What a run of the paper's form needs of its scene: constants of appendix A, grid, scales, and what moves.

In the paper: eq. (21) the thirteen equations; eq. (22) the thirteen unknowns.
"""

from dataclasses import dataclass

import numpy as np

from .. import parameters
from ..scene.models import Scene

EPS, S_N, S_B, U, V, W, B0, B1, B2, B3, O1, O2, O3 = range(13)
SPEEDS, EULER, OMEGA = slice(U, W + 1), slice(B0, B3 + 1), slice(O1, O3 + 1)
PLANE = [EPS, S_N, U, V, B0, B3, O3]  # the others stay exactly zero in the plane of axes 1 and 2 (x and z)
SPACE = list(range(13))
BELOW_PLANE, ABOVE_PLANE = [0, 1, 3, 6], [0, 1, 5]  # rows of `ends.lower` and `ends.upper` that a plane has


@dataclass(frozen=True)
class Line:
    """Constants of one scene in the letters of appendix A (SI units), the engine's record, and the grid.

    R_turn, m_turn: factors of the terms of rows 2 and 3 in which beta turns. As the paper has it (component rates of v
    and v_c) they are R = rho_w pi d^2/4 + m_a and m; with the normal components of the accelerations they would be 0
    and m + m_a, which does not depend on the roll of the frame (THEORY.md, section 4).
    per: inverse scales of the thirteen unknowns. active: the unknowns of a plane or of space.
    """

    record: np.void
    tables: np.ndarray
    h: np.ndarray
    m: float
    m_a: float
    R: float
    m_turn: float
    R_turn: float
    w0: float
    EI: float
    GIp: float
    c_t: float
    c_n: float
    per: np.ndarray
    active: list[int]

    @property
    def spatial(self):
        """Does the line move in space?"""
        return len(self.active) == 13

    @property
    def s(self):
        """Unstretched arc length of the nodes (n,), m."""
        return np.concatenate([[0.0], np.cumsum(self.h)])


def line_of(scene: Scene, accelerations: bool = False) -> Line:
    """The `Line` of a scene. accelerations: true normal accelerations in place of the paper's component rates."""
    tables = []
    record = parameters.record_of(scene, tables)[0]
    n = int(record["nodes"])
    tables = np.concatenate(tables)
    m, m_a, R = (float(record[name]) for name in ("m", "ma", "Rw"))
    force, speed = float(record["per_force"]), float(record["per_speed"])
    curvature = float(record["per_curvature"])
    return Line(
        record=record,
        tables=tables,
        h=tables[record["grid_at"] : record["grid_at"] + n - 1],
        m=m,
        m_a=m_a,
        R=R,
        m_turn=m + m_a if accelerations else m,
        R_turn=0.0 if accelerations else R,
        w0=float(record["w0"]),
        EI=float(record["EI"]),
        GIp=scene.tether.torsion_stiffness_Nm2,
        c_t=float(record["ct"]),
        c_n=float(record["cn"]),
        per=np.array([float(record["per_strain"])] + 2 * [force] + 3 * [speed] + 4 * [1.0] + 3 * [curvature]),
        active=PLANE if scene.motion.dimensions == 2 else SPACE,
    )
