"""The breaking line of section 4.1 in one dimension: theory, characteristics with a fitted shock, finite volumes.

    from analysis.line_waves import PAPER_LAW, break_theory, fitted_break
    print(break_theory(PAPER_LAW, 2.239, 60.0, 450e3).end_speed_mps)
    motion = fitted_break(PAPER_LAW, 2.239, 60.0, 450e3, 5e-3, until_s=0.055)
    strain, velocity, tension = motion.at([25.0, 40.0], 0.04)

No gravity, no bending, no water: m u_t = T(eps)_s, eps_t = u_s. `law` holds the closed forms of the tanh law,
`simple_wave` the theory, `characteristics`, `fitting` and `fitted` the exact motion, `volumes` and `captured` the
finite volumes for what comes after, `energy` the budget, `reference` both motions behind one function. The law is the
five numbers p1 ... p5 of eq. (20) and the mass per unit unstretched length; p1 = 0 is a linear line. Names are imported
on first use.
"""

from analysis.on_first_use import on_first_use

_HOME = {
    "PAPER_LAW": "law",
    "ShockStart": "simple_wave",
    "shock_start": "simple_wave",
    "BreakTheory": "simple_wave",
    "break_theory": "simple_wave",
    "simple_wave_work": "simple_wave",
    "ShockPath": "fitted",
    "FittedBreak": "fitted",
    "fitted_break": "fitting",
    "CapturedBreak": "captured",
    "captured_break": "captured",
    "EnergyBudget": "energy",
    "fitted_energy": "energy",
    "captured_energy": "energy",
    "BreakReference": "reference",
    "reference_break": "reference",
}

__all__ = [*_HOME]
__getattr__, __dir__ = on_first_use(__name__, _HOME)
