"""The breaking line of section 4.1 in one dimension: theory, and characteristics with a fitted shock.

    from campaigns.breaking_line.theory import PAPER_LAW, fitted_break
    motion = fitted_break(PAPER_LAW, 2.239, 60.0, 450e3, 5e-3, until_s=0.055)
    strain, velocity, tension = motion.at([25.0, 40.0], 0.04)

No gravity, no bending, no water: m u_t = T(eps)_s, eps_t = u_s. `law` holds the closed forms of the tanh law,
`simple_wave` the theory, `characteristics`, `fitting` and `fitted` the exact motion; `theory_of` a scene is all that
its run is held against. The law is the five numbers p1 ... p5 of eq. (20) and the mass per unit unstretched length;
p1 = 0 is a linear line.
"""

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from campaigns.breaking_line.theory.fitted import FittedBreak
from campaigns.breaking_line.theory.fitting import fitted_break
from campaigns.breaking_line.theory.law import PAPER_LAW, strain_of_tension, wave_speed
from campaigns.breaking_line.theory.simple_wave import BreakTheory, ShockStart, break_theory, simple_wave_work

__all__ = ["PAPER_LAW", "Theory", "fitted_break", "theory_of"]


@dataclass(frozen=True, eq=False)
class Theory:
    """Theory of one scene."""

    length_m: float
    force_N: float
    speeds: BreakTheory
    start: ShockStart
    motion: FittedBreak
    end_work_J: float  # of the end force, while no echo reaches the end before it is zero
    arrival_s: float  # of the front, or of the shock that has overtaken it, at the fixed end; at most the motion's end
    lost_J: float  # in the shock by then

    @property
    def shocked(self) -> bool:
        """Whether unloading steepens into a shock on the line, before the front is at the fixed end."""
        return self.start.distance_m < self.length_m and self.start.time_s < self.speeds.front_arrival_s

    def strain_at(self, share: float) -> float:
        """The strain where the tension is `share` of the static one."""
        return float(strain_of_tension(self.motion.case.law, share * self.force_N, 0.2))

    def wave_speed(self, strain):
        """sqrt(T'/m), m/s, at one strain or several."""
        return wave_speed(self.motion.case.law, strain)

    def swallowed(self, share: float) -> bool:
        """Whether the shock eats the contour of this share of the static tension before the front is at the wall."""
        if not self.shocked or not len(self.motion.shock.time_s):
            return False
        earlier = self.motion.shock.time_s <= self.arrival_s
        return self.strain_at(share) > self.motion.shock.behind[earlier].min()

    def falling(self, share: float) -> tuple[np.ndarray, np.ndarray]:
        """Times (m,) and places (m,) of the C- that leaves the broken end when its force is `share` of the static one.

        Straight from the end to the first crossing that is known, through the crossings, to the shock or the wall; a
        line that the shock meets is ended there.
        """
        net, shock = self.motion.net, self.motion.shock
        emitted = 2.0 * self.motion.case.decay / math.pi * math.acos(math.sqrt(share))
        if emitted >= net.tau[0] and len(net.T):
            # up to where echoes come back to the broken end: the times of the C- then repeat no order
            back = np.append(np.diff(net.tau) <= 0.0, True)
            line = int(np.argmin(np.abs(net.tau[: int(np.argmax(back)) + 1] - emitted)))
            crossed = np.isfinite(net.T[line])
            if crossed.any():
                order = np.argsort(net.T[line, crossed])
                times, places = net.T[line, crossed][order], net.S[line, crossed][order]
                return np.append(net.tau[line], times), np.append(self.length_m, places)
        met = shock.emission_s >= emitted
        if (met & (shock.emission_s > 0.0)).any():
            row = int(np.flatnonzero(met)[-1])
            return np.array([emitted, shock.time_s[row]]), np.array([self.length_m, shock.place_m[row]])
        arrival = emitted + self.length_m / float(self.wave_speed(self.strain_at(share)))
        return np.array([emitted, arrival]), np.array([self.length_m, 0.0])


def theory_of(scene, until_s: float) -> Theory | None:
    """The theory of a breaking line up to a time, or None: another law than tanh, or no breaking end."""
    law = scene.tether.tension
    if law.law != "tanh" or not scene.end.force_decay_s:
        return None
    mass = scene.tether.density_kgpm3 * scene.tether.area_m2
    force_N = math.hypot(*scene.end.force_N)
    try:
        return _theory(tuple(law.p), mass, scene.tether.length_m, force_N, scene.end.force_decay_s, until_s)
    except ValueError:  # a law that does not rise everywhere
        return None


@lru_cache(maxsize=16)
def _theory(law, mass, length, force, decay, until) -> Theory:
    motion = fitted_break(law, mass, length, force, decay, until)
    speeds, shock = break_theory(motion.case), motion.shock
    through = len(shock.time_s) > 0 and shock.place_m[-1] <= 1e-6 * length
    shock_arrival_s = shock.time_s[-1] if through else math.inf
    arrival = float(min(motion.valid_until_s, speeds.front_arrival_s, shock_arrival_s))
    work = simple_wave_work(motion.case)
    return Theory(length, force, speeds, motion.start, motion, work, arrival, motion.lost_J(arrival))
