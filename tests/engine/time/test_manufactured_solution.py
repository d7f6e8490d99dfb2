"""A bending line in a current that was computed from its motion: the engine returns that motion, at order 2 in space.

See `manufactured`. The steps (0.01 s, order 4) and the table of the current (401 x 401, linear between its points)
err by 3e-5 m; the coarsest grids by 0.02 m and 0.07 m.
"""

import numpy as np
import pytest

from engine import simulate
from tests.engine.manufactured import current_table, exact, scene_of

END_S = 2.0
NODES = (11, 21, 41)


@pytest.fixture(scope="module")
def current():
    return current_table(END_S, times=401, heights=401)


@pytest.mark.parametrize("stretching, cap_m", [(0.0, 0.03), (2.0, 0.1)])
def test_second_order_towards_the_chosen_motion(current, stretching, cap_m):
    errors = []  # per grid: position (m) and strain, at rest and in motion
    for nodes in NODES:
        run = simulate(scene_of(current, nodes, END_S, 0.01, stretching), duration_s=END_S)
        assert run.status == "ok", run.message
        found = []
        for t, sample in ((0.0, 0), (END_S, -1)):
            x, z, strain = exact(t, run.profiles.s_m)
            found.append(np.hypot(run.profiles.x_m[sample] - x, run.profiles.z_m[sample] - z).max())
            found.append(np.abs(run.profiles.strain[sample] - strain).max())
        errors.append(found)
    errors = np.array(errors)
    assert errors[0, [0, 2]].max() < cap_m
    assert np.all(np.abs(np.log2(errors[:-1] / errors[1:]) - 2) < 0.1), errors


def test_the_chosen_motion_is_a_motion():
    """At the end the line has moved by far more than the errors that are measured."""
    s = np.linspace(0, 20, 5)
    (x0, z0, e0), (x1, z1, e1) = exact(0.0, s), exact(END_S, s)
    assert np.hypot(x1 - x0, z1 - z0).max() > 0.3 and np.abs(e1 - e0).max() > 0.01
