"""Law: T = f(eps) (20) in its three forms, with f' (Newton's slope) its derivative.

linear T = p1 eps; tanh T = p1 tanh(p2 eps + p3) + p4 + p5 eps; tabulated: the monotone cubic of Fritsch & Carlson
(SIAM J. Numer. Anal. 17, 1980), in `box_equations` scipy's, and straight along its end tangents outside the table.
Tolerance: rounding of a sum of terms of size max|T|.
"""

import numpy as np
import pytest

from engine.physics.strains import strain_at, tension_at
from engine.physics.tension.kernels import stored, tension
from tests.engine import box_equations
from tests.engine.kernels import parameters_of
from tests.engine.lines import line, linear

STRAIN = [-0.2, -0.05, 0.0, 0.01, 0.04, 0.041, 0.1, 0.3, 0.5]
TENSION = [-30.0, -1.0, 0.0, 5.0, 200.0, 900.0, 900.0, 2500.0, 1e4]
DEEP = {"water.depth_m": 60.0}  # soft lines hold the buoy under water there
LAWS = {
    "linear": linear(5e4),
    "tanh": {"law": "tanh", "p": [2.703e5, 10.2, -2.128, 2.627e5, 135.5]},
    "tabulated": {"law": "tabulated", "strain": STRAIN, "tension_N": TENSION},
    "two points": {"law": "tabulated", "strain": [0.0, 0.5], "tension_N": [0.0, 1e3]},
}


def evaluate(law, strains, tables_before=(), of=tension, **tether):
    record, tables = parameters_of(line(DEEP, tension=law, **tether), tables_before)
    return np.array([of(e, record, tables) for e in strains]).T


@pytest.mark.parametrize("name", LAWS)
def test_value_and_slope(name):
    """The slope by a complex step; below, between, at and beyond the points of a table, also behind other tables."""
    strains = np.concatenate([np.random.default_rng(4).uniform(-0.7, 2.5, 3000), STRAIN, np.nextafter(STRAIN, 1.0)])
    T, slope = evaluate(LAWS[name], strains)
    exact = box_equations.tension(line(DEEP, tension=LAWS[name]).tether.tension, strains + 1j * box_equations.STEP)
    assert T == pytest.approx(exact.real, rel=1e-13, abs=1e-14 * np.abs(T).max())
    assert slope == pytest.approx(exact.imag / box_equations.STEP, rel=1e-12, abs=1e-14 * slope.max())
    assert np.array_equal(evaluate(LAWS[name], strains, [np.full(17, 1e9)]), [T, slope])


@pytest.mark.parametrize("name", LAWS)
def test_the_law_outside_the_kernels_is_the_same(name):
    law = line(DEEP, tension=LAWS[name]).tether.tension
    strains = np.linspace(0.001, 0.6, 200)
    T = evaluate(LAWS[name], strains)[0]
    assert T == pytest.approx([tension_at(e, law) for e in strains], rel=1e-12)
    for load in (0.5 * T[20] + 0.5 * T[21], T[150]):
        assert tension_at(strain_at(load, law), law) == pytest.approx(load, rel=1e-9)


@pytest.mark.parametrize("name", LAWS)
def test_the_barrier_keeps_a_line_from_collapsing(name):
    """T - P_b (0.5/lambda - 1)^2 below lambda = 1/2; the slope is T', the stored energy its integral."""
    law, guard = LAWS[name], {"compression_barrier_N": 2e4}
    strains = np.concatenate([np.linspace(-0.99, -0.51, 40), np.linspace(-0.49, 0.8, 40)])
    T, slope = evaluate(law, strains, **guard)
    excess = np.where(strains < -0.5, 0.5 / (1.0 + strains) - 1.0, 0.0)
    assert T == pytest.approx(evaluate(law, strains)[0] - 2e4 * excess**2, rel=1e-13, abs=1e-9)
    step = 1e-6
    high, low = (evaluate(law, strains + d, **guard)[0] for d in (step, -step))
    assert slope == pytest.approx((high - low) / (2 * step), rel=1e-4, abs=1.0)
    high, low = (evaluate(law, strains + d, of=stored, **guard) for d in (step, -step))
    assert T == pytest.approx((high - low) / (2 * step), rel=1e-5, abs=0.05)
    assert evaluate(law, [0.0], of=stored, **guard) == pytest.approx(0.0, abs=1e-12)
    assert evaluate(law, [-0.999], **guard)[0] < -1e9
