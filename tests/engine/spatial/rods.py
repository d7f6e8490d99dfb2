"""Clamped rods for the tests of torsion, and an equilibrium of them that is not the engine's: the localised buckle.

A rod here is a dry, weightless line of `length` m under a linear law, clamped at both ends and twisted.
"""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from engine.parameters import grid
from engine.time.statics import settle
from tests.engine.kernels import parameters_of
from tests.engine.lines import DRY, SPACE, equilibrium, held, line, linear
from tests.engine.rotations import carried, parameters_of_frames

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


@dataclass(frozen=True)
class Localised:
    """The buckle of an infinitely long rod under tension T and torque M (Coyne 1990; van der Heijden & Thompson 2000).

    With m = M/(2 sqrt(EI T)), k = sqrt(T/EI), a = sqrt(1 - m^2), theta and psi the polar angles of t about the axis,
    1 - cos theta = 2 a^2 sech^2(k a s),  psi = m k s + arctan((a/m) tanh(k a s)).
    """

    EI: float
    GI: float
    T: float
    m: float

    @property
    def torque(self):
        return 2 * self.m * np.sqrt(self.EI * self.T)

    @property
    def shortening(self):
        """D: what the ends come closer, m, extension left out."""
        return 4 * np.sqrt(self.EI / self.T) * np.sqrt(1 - self.m**2)

    def rotation(self, length):
        """R: what the ends are turned against each other, rad."""
        return self.torque * length / self.GI + 4 * np.arccos(self.m)

    @property
    def deflection(self):
        """Largest distance from the axis, m: half the shortening."""
        return 0.5 * self.shortening

    def angles(self, s):
        """theta and psi at s from the middle."""
        k, a, m = np.sqrt(self.T / self.EI), np.sqrt(1 - self.m**2), self.m
        return 2 * np.arcsin(a / np.cosh(k * a * s)), m * k * s + np.arctan(a / m * np.tanh(k * a * s))

    def rod(self, length, EA):
        """The clamped rod of this length along x whose ends are placed as this solution has them."""
        reach = (length - self.shortening) * (1 + self.T / EA)
        return Rod(self.EI, self.GI, EA, length, (reach, 0.0, 0.0), self.rotation(length))

    def state(self, rod, s):
        """State (n, 13) along a rod: the moment M t + EI t x t_s, and n without roll, from node to node."""
        theta, psi = self.angles(s - 0.5 * rod.length)
        t = np.stack([np.cos(theta), np.sin(theta) * np.cos(psi), np.sin(theta) * np.sin(psi)], 1)
        n = [np.cross([0.0, 0.0, 1.0], t[0]) / np.hypot(*t[0, :2])]
        for below, above in pairwise(t):
            n.append(carried(below, above, n[-1]))
        M = self.torque * t + self.EI * np.cross(t, np.gradient(t, s, axis=0))
        return state_of(rod, s, t, np.array(n), M, np.array([self.T, 0.0, 0.0]))
