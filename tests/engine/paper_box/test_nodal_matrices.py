"""The engine's M and P are those of appendix A (corrected), entry by entry, at random states and for any |beta|."""

import numpy as np
import pytest

from engine.paper_box.law import tension_law
from engine.paper_box.line import line_of
from engine.paper_box.nodal import P, times_M
from engine.physics.tension.kernels import tension
from tests.engine.paper_box.states import LAWS, M_and_P, scene_of, states

ROUNDING = 1e-12  # of the largest entry of the row


@pytest.mark.parametrize("unit", [True, False], ids=["|beta| = 1", "any |beta|"])
@pytest.mark.parametrize("law", LAWS)
def test_every_entry(law, unit):
    scene = scene_of(law)
    line = line_of(scene)
    Y, water = states(11, 20, unit)
    for k in range(20):
        M, rows = M_and_P(scene, Y[:, k], water[:, k])
        # column j of M is its product with the unit vector j
        found = times_M(line, Y[:, k, None], np.eye(13), water[:, k, None])
        assert np.all(np.abs(found - M) <= ROUNDING * np.abs(M).max(1, keepdims=True))
        found = P(line, Y[:, k, None], water[:, k, None])[:, 0]
        assert np.all(np.abs(found - rows) <= ROUNDING * np.maximum(np.abs(rows), np.abs(rows[:3]).max()))


@pytest.mark.parametrize("law", LAWS)
def test_the_tension_law_is_the_engines(law):
    line = line_of(scene_of(law))
    strains = np.concatenate([np.linspace(-0.3, 0.5, 81), [-0.2, 0.0, 0.1, 0.3]])
    found = np.array(tension_law(line.record, line.tables, strains)).T
    expected = np.array([tension(eps, line.record, line.tables) for eps in strains])
    assert np.allclose(found, expected, rtol=1e-13, atol=1e-9)


def test_true_accelerations_do_not_depend_on_the_roll_of_the_frame():
    """Rows 2, 3 of M dY/dt as a vector in fixed axes: with true accelerations a rolling frame changes nothing.

    With the component rates of the print it does, by (m_a V - R U_c) omega_1.
    """
    from engine.paper_box.frame import roll, rotation, to_local

    scene = scene_of()
    Y, water = states(3, 30)
    rng = np.random.default_rng(5)
    V, V_t = rng.normal(0, 2, (2, 3, 30))

    def force(line, rolling):
        """M dY/dt, normal part in fixed axes, for a frame whose t stands still, rolling at 2 rad/s or not."""
        state, rate = Y.copy(), np.zeros((13, 30))
        rate[6:10] = rolling * roll(Y[6:10])
        state[3:6] = to_local(Y[6:10], V)
        turned = (to_local(Y[6:10] + 1e-20j * rate[6:10], V)).imag / 1e-20  # dC/dt V
        rate[3:6] = to_local(Y[6:10], V_t) + turned
        rows = times_M(line, state, rate, water)
        C = rotation(Y[6:10])
        return rows[1] * C[1] + rows[2] * C[2]

    for accelerations, depends in ((True, False), (False, True)):
        line = line_of(scene, accelerations)
        change = np.abs(force(line, 1.0) - force(line, 0.0)).max()
        assert (change > 1.0) if depends else (change < 1e-11)
