"""The breaking line of section 4.1 in one dimension: theory, and characteristics with a fitted shock.

    from campaigns.breaking_line.theory import PAPER_LAW, fitted_break
    motion = fitted_break(PAPER_LAW, 2.239, 60.0, 450e3, 5e-3, until_s=0.055)
    strain, velocity, tension = motion.at([25.0, 40.0], 0.04)

No gravity, no bending, no water: m u_t = T(eps)_s, eps_t = u_s. `law` holds the closed forms of the tanh law,
`simple_wave` the theory, `characteristics`, `fitting` and `fitted` the exact motion, `of_scene` all that a run is held
against. The law is the five numbers p1 ... p5 of eq. (20) and the mass per unit unstretched length; p1 = 0 is a linear
line.
"""

from campaigns.breaking_line.theory.fitting import fitted_break
from campaigns.breaking_line.theory.law import PAPER_LAW
from campaigns.breaking_line.theory.of_scene import Theory, theory_of

__all__ = ["PAPER_LAW", "Theory", "fitted_break", "theory_of"]
