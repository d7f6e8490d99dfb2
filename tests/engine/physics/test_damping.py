"""Law: T = f(eps) + c e_t lets a mass on a vertical line ring as the roots of its equation say, and takes c e_t^2.

Small axial motions of a linear line with a mass M at its end, u ~ sinh(kappa s) exp(lambda t):

    m lambda^2 = (EA + c lambda) kappa^2,    M lambda^2 + (EA + c lambda) kappa coth(kappa L) = 0

Gravity shifts the rest only. Order 2 of the box in the element length is left of the difference.
"""

import cmath

import numpy as np
import pytest

from engine import simulate
from engine.time.damping import left_after
from tests.engine.kernels import of_kind, parameters_of
from tests.engine.lines import DRY, kick, line, ran

EA, C, L, M = 5e4, 4e3, 20.0, 1611.0
LINE_M = 1140.0 * 7.85e-5
RINGING = {**DRY, **kick(w=0.01), "solver.rtol": 1e-5, "solver.newton_tolerance": 1e-12}
RINGING |= {"output.step_s": 0.05, "solver.max_step_s": 0.02}


def root(c):
    """lambda (1/s) of the slowest ringing."""
    z = 1j * (EA / L / (M + LINE_M * L / 3)) ** 0.5
    for _ in range(60):
        kappa = z * cmath.sqrt(LINE_M / (EA + c * z))
        z += 0.5 * (1j * cmath.sqrt((EA + c * z) * kappa / cmath.tanh(kappa * L) / M) - z)
    return z


def ringing(nodes, *changes):
    run = ran(line(RINGING, *changes, nodes=nodes, damping_Ns=C), duration_s=20.0)
    t, z = run.columns["time_s"], run.columns["z_m"] - run.columns["z_m"][0]
    late = t > 5.0  # faster motions are gone
    computed = root(C)
    shapes = np.exp(computed.real * t) * np.stack([np.cos(computed.imag * t), np.sin(computed.imag * t)])
    return np.linalg.lstsq(shapes[:, late].T, z[late])[1][0] / np.sum(z[late] ** 2)


def test_a_mass_on_the_line_rings_as_it_should(dimensions):
    assert root(0.0).real == pytest.approx(0.0, abs=1e-9)
    assert root(C).real < -0.02
    p, tables = parameters_of(line(RINGING, damping_Ns=C))
    left = np.exp(0.1 * root(C).real)
    assert of_kind(left_after, p, tables, 0.0, 0.1 * root(C).imag, 0.1) == pytest.approx(left, abs=1e-2 * (1.0 - left))
    assert ringing(9, {"motion.dimensions": dimensions}) < 1e-7


@pytest.mark.slow
def test_the_budget_has_what_the_damping_takes(dimensions):
    budgets = []
    for step_s in (0.02, 0.01):
        more = {"solver.integrator": "midpoint", "solver.step_s": step_s, "output.energy": True}
        more |= {**kick(0.3, 0.0, 1.0), "motion.dimensions": dimensions}
        scene = line(DRY, more, nodes=9, damping_Ns=C)
        budgets.append(simulate(scene, duration_s=10.0).energy)
    assert budgets[1].viscous_J[-1] > 100.0
    assert np.all(np.diff(budgets[1].viscous_J) >= 0.0)
    # the budget closes to Newton's tolerance, the buoy's own energy is the work at the end
    for budget in budgets:
        assert np.abs(budget.remainder_J()).max() < 1e-3 * budget.viscous_J[-1]
    assert budgets[0].viscous_J[-1] == pytest.approx(budgets[1].viscous_J[-1], rel=1e-3)


@pytest.mark.parametrize("integrator", ["esdirk43", "midpoint"])
def test_what_is_told_as_tension_has_the_damping(dimensions, integrator):
    more = {"motion.dimensions": dimensions, "solver.integrator": integrator, "solver.step_s": 0.005}
    more |= {**kick(w=0.3), "output.profiles": True}
    run = simulate(line(RINGING, more, nodes=9, damping_Ns=5 * C), duration_s=2.0)
    strain, tension_N = run.profiles.strain[:, -1], run.columns["tension_top_N"]
    viscous = 5 * C * np.gradient(strain, 0.05, edge_order=2)
    assert np.abs(viscous[1:-1]).max() > 290.0
    assert np.abs(tension_N - EA * strain - viscous)[1:-1].max() < 1.0
    np.testing.assert_array_equal(run.profiles.tension_N[:, -1], tension_N)
    assert np.all(run.columns["tension_top_high_N"] >= tension_N)


def test_a_share_of_critical_is_that_of_an_element():
    """c = zeta l sqrt(EA m), MoorDyn's -BA: an element of mass m l rings at 2 sqrt(EA/m)/l at most."""
    damped = parameters_of(line({"tether.damping_critical": 0.4}, nodes=41))[0]["damping"]
    assert damped == pytest.approx(0.4 * 0.5 * np.sqrt(EA * LINE_M))
