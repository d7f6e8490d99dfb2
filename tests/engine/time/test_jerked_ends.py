"""Law: an end pulled away at V from a taut straight line sends out a wave of the force V sqrt(m EA) (d'Alembert).

Until the wave comes back from the anchor, T = T_0 + V(t) sqrt(m EA) at the end, also where the motion begins with a
jerk (no ramp): a force that is far above what the line carries at rest. Tolerance: 1 % of the jump, until the short
waves that run ahead of the front on a grid have come back.
"""

import numpy as np
import pytest

from engine import simulate
from tests.engine.lines import DRY, STILL, held, line, linear

LENGTH, MASS, EA = 20.0, 0.5, 5e4
C = np.sqrt(EA / MASS)


@pytest.mark.parametrize("dimensions", [2, 3])
def test_the_force_of_a_jerk(dimensions):
    stretch, amplitude, period = 1e-3, 0.1, 1.0
    motion = {"law": "harmonic", "amplitude_m": [amplitude, 0.0, 0.0], "period_s": period}
    scene = line(
        DRY, held(LENGTH * (1 + stretch), 0.0, motion=motion), {"motion.dimensions": dimensions, "gravity_mps2": 0.0},
        {"solver.rtol": 1e-2, "output.step_s": LENGTH / C / 20},
        length_m=LENGTH, area_m2=5e-4, density_kgpm3=1000.0, nodes=161, tension=linear(EA),
    )  # fmt: skip
    run = simulate(scene, duration_s=1.6 * LENGTH / C)
    assert run.status == "ok", run.message
    t = run.columns["time_s"]
    jump = amplitude * 2 * np.pi / period * np.sqrt(MASS * EA)
    expected = EA * stretch + jump * np.cos(2 * np.pi * t / period)
    assert jump > EA * stretch
    assert np.abs(run.columns["tension_top_N"] - expected)[1:].max() < 0.01 * jump


@pytest.mark.parametrize("dimensions", [2, 3])
@pytest.mark.parametrize("EI, period_s", [(0.4, 2.0), (50.0, 0.5)])
@pytest.mark.parametrize("position", [[15.0, 0.0, 8.0], [5.0, 0.0, 18.0]])
def test_a_slack_line_stands_a_jerk(dimensions, EI, position, period_s):
    """It weighs 2 N in water, and the jerk at its end is of 40 N and more."""
    motion = {"law": "harmonic", "amplitude_m": [0.3, 0.0, 0.3], "period_s": period_s}
    end = held(*position, motion=motion)
    scene = line(STILL, end, {"motion.dimensions": dimensions}, bending_stiffness_Nm2=EI)
    run = simulate(scene, duration_s=2.0)
    assert run.status == "ok", run.message
    assert run.statistics["steps"] < 300


@pytest.mark.parametrize("nodes", [21, 41])
@pytest.mark.parametrize("position", [[15.0, 0.0, 4.0], [2.0, 8.0, 1.0]])
def test_a_stiff_light_line_in_a_clamp_finds_its_rest(nodes, position):
    """Its shear forces, some 20 N, are far above its weight."""
    clamped = {"anchor.rotation": "clamped", "motion.dimensions": 3}
    run = simulate(line(STILL, held(*position), clamped, nodes=nodes, bending_stiffness_Nm2=50.0), duration_s=1.0)
    assert run.status == "ok", run.message
    assert np.ptp(run.columns["tension_top_N"]) < 1e-3
