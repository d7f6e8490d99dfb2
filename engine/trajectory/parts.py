"""What a trajectory holds where the scene asks for it: profiles along the line, energies, growth of perturbations."""

from dataclasses import dataclass
from typing import Annotated

import numpy as np


@dataclass(frozen=True)
class Profiles:
    """Quantities along the line. time_s (nt,); s_m (nn,); the others (nt, nn), SI units."""

    time_s: Annotated[np.ndarray, ("s", "time of the profiles")]
    s_m: Annotated[np.ndarray, ("m", "unstretched arc length from the anchor")]
    x_m: Annotated[np.ndarray, ("m", "position along x, from the anchor")]
    y_m: Annotated[np.ndarray, ("m", "position along y, from the anchor")]
    z_m: Annotated[np.ndarray, ("m", "height above the anchor")]
    strain: Annotated[np.ndarray, ("1", "strain")]
    tension_N: Annotated[np.ndarray, ("N", "tension")]
    speed_mps: Annotated[np.ndarray, ("m s-1", "speed")]


@dataclass(frozen=True)
class EnergyBudget:
    """Where the energy of a dry line is and went since t = 0; each (m,) (`engine.time.energy`).

    time_s: the first end of a step past each output time. See `remainder_J`.
    """

    time_s: Annotated[np.ndarray, ("s", "time of the energies, ends of steps")]
    kinetic_J: Annotated[np.ndarray, ("J", "kinetic energy")]
    strain_J: Annotated[np.ndarray, ("J", "strain energy")]
    gravity_J: Annotated[np.ndarray, ("J", "energy of the weight, from the height of the lower end")]
    bed_J: Annotated[np.ndarray, ("J", "energy of the bed's spring")]
    end_work_J: Annotated[np.ndarray, ("J", "work of the force at the upper end since the start")]
    bending_J: Annotated[np.ndarray, ("J", "work against the shear forces since the start: bending")]
    viscous_J: Annotated[np.ndarray, ("J", "dissipated by the viscosity of shocks and of the material since the start")]
    bed_damping_J: Annotated[np.ndarray, ("J", "dissipated by the damper of the bed since the start")]
    friction_J: Annotated[np.ndarray, ("J", "dissipated by friction on the bed since the start")]
    scheme_space_J: Annotated[np.ndarray, ("J", "dissipated by the discretisation in space since the start")]
    scheme_time_J: Annotated[np.ndarray, ("J", "dissipated by the discretisation in time since the start")]

    @property
    def stored_J(self) -> float:
        """Strain energy at the start."""
        return float(self.strain_J[0])

    def remainder_J(self) -> np.ndarray:
        """What the entries leave unexplained: energy at the start + work - everything found later."""
        held = self.kinetic_J + self.strain_J + self.gravity_J + self.bed_J
        gone = self.bending_J + self.viscous_J + self.bed_damping_J + self.friction_J
        gone = gone + self.scheme_space_J + self.scheme_time_J
        return held[0] + self.end_work_J - held - gone


@dataclass(frozen=True)
class TangentGrowth:
    """Growth of infinitesimal perturbations, period by period (`engine.perturbations.tangent`).

    period_s: the wave period, or 1 s without waves. growth_nats (m, k): logarithm of the growth of the k orthonormal
    perturbations in the plane in each of the m complete periods; k may be 0. released (m,): 1 where a loop was released
    in that period. lateral_nats (m,): growth across the plane (`perturbations.lateral`), None where not asked for.
    """

    period_s: float
    growth_nats: np.ndarray
    released: np.ndarray
    lateral_nats: np.ndarray | None = None
