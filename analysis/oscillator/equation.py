"""Eq. (33), the snap oscillator: a buoy on a massless tether that pulls but cannot push, in the radial direction only.

    g'' + mu g' + a g = F sin(omega t + phase) + (B - W),   a = 1 where g >= 0 (taut), 0 where g < 0 (slack)   (33)

g is the radial displacement from the length at which the tether becomes taut, everything made dimensionless by the
mass, the buoy's diameter and the natural frequency of the radial motion, so that time is in 1/omega_r. The sign of
B - W is right as printed. The force a g is continuous at g = 0: the velocity field has a kink there and no jump.

In the paper: eq. (33) snap oscillator.
"""

import math
from dataclasses import dataclass

from analysis.sampling import checked_not_negative, checked_positive


@dataclass(frozen=True)
class SnapOscillator:
    """Eq. (33) with its five numbers, by default those of the paper's figure 19(b); dimensionless.

    damping     mu, 0 <= mu < 2 (underdamped when taut)
    frequency   omega > 0 of the forcing, in units of the natural frequency
    force       F >= 0, amplitude of the forcing
    lift        B - W, buoyancy less weight
    phase       of the forcing at time 0 [rad]; the strobe looks at times 0, T, 2T, ..., so it picks the section

    ValueError for numbers outside these ranges, and for a linear response above 1e6 F (resonance without damping).
    Source: Tjavaras, Zhu, Liu, Triantafyllou & Yue 1998, eq. (33) and figure 19(b).
    """

    damping: float = 0.025
    frequency: float = 1.14
    force: float = 1.4
    lift: float = 0.68
    phase: float = 0.0

    def __post_init__(self) -> None:
        checked_not_negative(self.damping, "damping")
        checked_positive(self.frequency, "frequency")
        checked_not_negative(self.force, "force")
        for name in ("lift", "phase"):
            if not math.isfinite(getattr(self, name)):
                raise ValueError(f"{name}: a finite number is needed, given {getattr(self, name)!r}")
        if self.damping >= 2.0:
            raise ValueError(f"damping: a number below 2 (underdamped) is needed, given {self.damping!r}")
        if self.impedance < 1e-6:
            raise ValueError("damping, frequency: no linear response exists at resonance without damping")

    @property
    def period(self) -> float:
        """Forcing period T = 2 pi/omega, in units of time."""
        return 2.0 * math.pi / self.frequency

    @property
    def impedance(self) -> float:
        """sqrt((1 - omega^2)^2 + (mu omega)^2): F over this is the amplitude of the always taut motion."""
        return math.hypot(1.0 - self.frequency**2, self.damping * self.frequency)
