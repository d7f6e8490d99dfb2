"""Clamped rods for the tests of torsion, and an equilibrium of them that is not the engine's: the localised buckle.

A rod here is a dry, weightless line of `length` m under a linear law, clamped at both ends and twisted.
"""

from dataclasses import dataclass

import numpy as np

from tests.engine.lines import DRY, SPACE, equilibrium, held, line, linear

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


def at_rest(rod, nodes):
    """State of rest (n, 13) of the engine, and element lengths."""
    motion = equilibrium(rod.scene(nodes))
    return motion.Y.copy(), motion.h


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

    @property
    def deflection(self):
        """Largest distance from the axis, m: half the shortening."""
        return 0.5 * self.shortening

    def angles(self, s):
        """theta and psi at s from the middle."""
        k, a, m = np.sqrt(self.T / self.EI), np.sqrt(1 - self.m**2), self.m
        return 2 * np.arcsin(a / np.cosh(k * a * s)), m * k * s + np.arctan(a / m * np.tanh(k * a * s))
