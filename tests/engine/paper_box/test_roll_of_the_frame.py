"""Law: with true accelerations the roll of the local frame, which is free, changes no force of the paper's form.

That M and P are those of appendix A is what `test_newton_jacobian` needs to pass.
"""

import numpy as np

from engine.paper_box.frame import roll, rotation, to_local
from engine.paper_box.line import line_of
from engine.paper_box.nodal import times_M
from tests.engine.paper_box.states import scene_of, states


def test_true_accelerations_do_not_depend_on_the_roll_of_the_frame():
    """Rows 2, 3 of M dY/dt as a vector in fixed axes: with true accelerations a rolling frame changes nothing.

    With the component rates of the print it does, by (m_a V - R U_c) omega_1.
    """
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
