"""What a run of the paper's form needs of its scene: the unknowns by name, constants, grid and scales.

In the paper: eq. (21) the thirteen equations; eq. (22) the thirteen unknowns.
"""

from dataclasses import dataclass

import numpy as np

from .. import parameters
from ..physics.tension import LAWS
from ..record import lengths_of
from ..scene.models import Scene

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
    tables = []
    record = parameters.record_of(scene, tables)[0]
    tables = np.concatenate(tables)
    h = lengths_of(record, tables)
    per = np.array([record[name] if name else 1.0 for name in SCALES])
    active = PLANE if scene.motion.dimensions == 2 else SPACE
    return Line(record, tables, h, scene.tether.torsion_stiffness_Nm2, accelerations, per, active)
