"""Law: T = f(eps) (20) in its three forms, with f' (Newton's slope) its derivative.

linear T = p1 eps; tanh T = p1 tanh(p2 eps + p3) + p4 + p5 eps; tabulated: the monotone cubic of Fritsch & Carlson
(SIAM J. Numer. Anal. 17, 1980), here against scipy's, and straight along its end tangents outside the table.
Tolerance: rounding of a sum of terms of size max|T|, 1e-14; central differences of step 1e-5: 1e-8.
"""

import numpy as np
import pytest
from scipy.interpolate import PchipInterpolator

from engine.physics.tension.kernels import stored, tension
from engine.scales import strain_at, tension_at
from tests.engine.kernels import parameters_of
from tests.engine.lines import line

STRAIN = [-0.2, -0.05, 0.0, 0.01, 0.04, 0.041, 0.1, 0.3, 0.5]
TENSION = [-30.0, -1.0, 0.0, 5.0, 200.0, 900.0, 900.0, 2500.0, 1e4]
P = (2.703e5, 10.2, -2.128, 2.627e5, 135.5)
TABLE = PchipInterpolator(STRAIN, TENSION)
LAWS = {
    "linear": ({"law": "linear", "stiffness_N": 5e4}, lambda e: 5e4 * e),
    "tanh": ({"law": "tanh", "p": list(P)}, lambda e: P[0] * np.tanh(P[1] * e + P[2]) + P[3] + P[4] * e),
    "tabulated": ({"law": "tabulated", "strain": STRAIN, "tension_N": TENSION}, TABLE),
    "two points": ({"law": "tabulated", "strain": [0.0, 0.5], "tension_N": [0.0, 1e3]}, lambda e: 2e3 * e),
}


def evaluate(law, strains, tables_before=(), of=tension, **tether):
    record, tables = parameters_of(line(tension=law, **tether), tables_before)
    return np.array([of(e, record, tables) for e in strains]).T


@pytest.mark.parametrize("name", LAWS)
def test_value_and_slope(name):
    law, exact = LAWS[name]
    strains = np.concatenate([np.random.default_rng(4).uniform(-0.2, 0.5, 3000), [-0.05, 0.0, 0.01, 0.3]])
    inside = strains if name != "two points" else strains[strains > 0]
    T, slope = evaluate(law, inside)
    scale = np.max(np.abs(T))
    assert np.max(np.abs(T - exact(inside))) <= 1e-14 * scale
    step = 1e-5
    differences = (exact(inside + step) - exact(inside - step)) / (2 * step)
    knots = STRAIN if name == "tabulated" else []  # f'' jumps there
    apart = np.all(np.abs(np.subtract.outer(inside, knots)) > 2 * step, axis=1)
    third = {"tanh": 2 * P[0] * P[1] ** 3, "tabulated": np.max(np.abs(TABLE.derivative(3)(inside)))}.get(name, 0.0)
    rounding = 1e-15 * scale / step
    assert np.max(np.abs(slope - differences)[apart]) <= third * step**2 / 6 + 10 * rounding


def test_the_table_has_scipys_slopes_and_its_knots():
    law, _ = LAWS["tabulated"]
    strains = np.random.default_rng(5).uniform(-0.2, 0.5, 3000)
    slope = evaluate(law, strains)[1]
    exact = TABLE.derivative()(strains)
    assert np.max(np.abs(slope - exact)) <= 1e-13 * np.max(exact)
    assert evaluate(law, STRAIN)[0] == pytest.approx(TENSION, rel=1e-14, abs=1e-12)


def test_outside_the_table_the_law_goes_on_along_its_end_tangents():
    law, _ = LAWS["tabulated"]
    for end, edge in ((0, -0.2), (-1, 0.5)):
        tangent = float(TABLE.derivative()(edge))
        beyond = edge + np.array([0.01, 0.3, 2.0]) * (-1 if end == 0 else 1)
        T, slope = evaluate(law, beyond)
        assert T == pytest.approx(TENSION[end] + tangent * (beyond - edge), rel=1e-13)
        assert slope == pytest.approx(np.full(3, tangent), rel=1e-13)
        both = evaluate(law, np.nextafter(edge, [-1.0, 1.0]))
        assert both[0, 0] == pytest.approx(both[0, 1], rel=1e-12)
        assert both[1, 0] == pytest.approx(both[1, 1], rel=1e-9)


def test_a_tabulated_law_rises_between_rising_points_also_behind_other_tables():
    law, strains = LAWS["tabulated"][0], np.linspace(-0.5, 1.0, 20001)
    T, slope = evaluate(law, strains)
    assert np.all(np.diff(T) >= -1e-10) and np.all(slope >= -1e-7)
    assert np.array_equal(evaluate(law, strains, [np.full(17, 1e9)]), [T, slope])


@pytest.mark.parametrize("name", LAWS)
def test_the_law_outside_the_kernels_is_the_same(name):
    law = line(tension=LAWS[name][0]).tether.tension
    strains = np.linspace(0.001, 0.6, 200)
    T = evaluate(LAWS[name][0], strains)[0]
    assert T == pytest.approx([tension_at(e, law) for e in strains], rel=1e-12)
    for load in (0.5 * T[20] + 0.5 * T[21], T[150]):
        assert tension_at(strain_at(load, law), law) == pytest.approx(load, rel=1e-9)


@pytest.mark.parametrize("name", LAWS)
def test_the_barrier_keeps_a_line_from_collapsing(name):
    """T - P_b (0.5/lambda - 1)^2 below lambda = 1/2; the slope is T', the stored energy its integral."""
    law, guard = LAWS[name][0], {"compression_barrier_N": 2e4}
    strains = np.concatenate([np.linspace(-0.99, -0.51, 40), np.linspace(-0.49, 0.4, 40)])
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
