"""Clamped rods for the tests of torsion: scenes, rest from a given state, what a state (n, 13) looks like in space.

A rod here is a dry, weightless line of `length` m under a linear law, clamped at both ends and twisted.
"""

from dataclasses import dataclass

import numpy as np

from engine.parameters import grid
from engine.time.statics import settle
from tests.engine.kernels import parameters_of
from tests.engine.lines import DRY, SPACE, equilibrium, held, line, linear
from tests.engine.rotations import parameters_of_frames

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
        clamps = {"anchor": {"rotation": "clamped", "direction": list(self.below)}}
        end = held(*self.place, rotation="clamped", direction=list(self.above), twist_rad=self.twist)
        return line(
            DRY, SPACE, {"gravity_mps2": 0.0}, clamps, end, changes,
            length_m=self.length, nodes=nodes, area_m2=AREA, density_kgpm3=DENSITY,
            bending_stiffness_Nm2=self.EI, torsion_stiffness_Nm2=self.GI, tension=linear(self.EA),
        )  # fmt: skip


def at_rest(rod, nodes, guess=None):
    """State of rest (n, 13) of the engine, and element lengths; from the engine's own guess, or a function of s."""
    scene = rod.scene(nodes)
    if guess is None:
        motion = equilibrium(scene)
        return motion.Y.copy(), motion.h
    h = grid(rod.length, nodes, 0.0)
    Y = guess(np.concatenate([[0.0], np.cumsum(h)]))
    assert settle(*parameters_of(scene), Y, np.array(rod.place)) == 0, "no rest"
    return Y, h


def state_of(rod, s, t, n, M, N):
    """State (n, 13) of tangents, normals, moments (n, 3) and a force (3,): a guess, exact where they are."""
    b = np.cross(t, n)
    Y = np.zeros((len(s), 13))
    Y[:, 0], Y[:, 1], Y[:, 2] = t @ N / rod.EA, n @ N, b @ N
    Y[:, 6:10] = parameters_of_frames(t, n)
    for column, (axis, stiffness) in enumerate(((t, rod.GI), (n, rod.EI), (b, rod.EI))):
        Y[:, 10 + column] = np.sum(M * axis, 1) / stiffness
    return Y
