"""Law: every method keeps its order with each law of `engine.physics.extras`, steps halved, slope within 0.2.

A soft line, so that steps resolve its fastest waves, pushed at its upper end. It lies on a bed as soft as its weight
asks for, or stands within a surface as thick as the line is long, so that no node passes a kink of a law; friction and
drag keep their directions.
"""

import numpy as np
import pytest

from tests.engine.lines import DRY, QUIET, harmonic, held, line, orders, ran

SOFT = {
    "tether.tension.stiffness_N": 2e3,
    "tether.nodes": 6,
    "tether.bending_stiffness_Nm2": 0.0,
    "tether.density_kgpm3": 5e4,
}
MOVED = harmonic([0.4, 0.0, 0.05], 4.0, phase_rad=0.0, ramp_s=4.0)
BED = {"stiffness_Npm3": 1e3, "damping_Nspm3": 100.0, "friction": 0.3, "friction_speed_mps": 0.5}
DRIFT = {"law": "uniform", "velocity_mps": [2.0, 0.0, 2.0]}
WITHIN = {"tether.submergence": "free-surface", "tether.diameter_m": 60.0, "tether.drag_normal": 1e-5}
WITHIN |= {"tether.drag_tangential": 0.0, "tether.added_mass": 1e-7, "tether.area_m2": 1e-4}
LAWS = {
    "damping": DRY | {"tether.damping_Ns": 100.0},
    "surface": {"waves": None, "current": DRIFT, **WITHIN},
    "push": {"waves.steepness": 0.01, "waves.ramp_s": 3.0, "current": DRIFT, "tether.froude_krylov": "whole",
             "tether.diameter_m": 0.1, "anchor.position_m": [0.0, 0.0, 8.0]},
    "bed": DRY | {"floor": BED},
}  # fmt: skip


@pytest.mark.parametrize("method, order", [("trbdf2", 2), ("esdirk43", 4), ("generalized-alpha", 2)])
@pytest.mark.parametrize("law", LAWS)
def test_in_time(law, dimensions, method, order):
    ends = []
    for step_s in 0.1 / 2.0 ** np.arange(4 if order == 2 else 3):
        solver = {"solver.integrator": method, "solver.step_s": float(step_s), **QUIET}
        changes = {"output.step_s": 0.1, "output.profiles": True, "motion.dimensions": dimensions}
        end = held(20.4, -3.0 if law == "bed" else 1.0, motion=MOVED)
        profiles = ran(line(SOFT, LAWS[law], end, solver, changes), duration_s=1.5).profiles
        ends.append(np.concatenate([profiles.x_m[-1], profiles.z_m[-1]]))
    slopes = orders(np.linalg.norm(np.diff(ends, axis=0), axis=1))
    assert slopes[-1] > order - 0.2, slopes
