"""A twisted, bent line in a current that was computed from its motion: the engine returns that motion, at order 2.

See `manufactured`. Every unknown is compared: q (strain, tangent), n (the rest of the Euler parameters), shear,
velocity, torsion and curvature, and the positions. In space: steps of 1/64 s with order 4. In space and time: methods
of order 2 on steps so long that they double the error of the velocity. The table of the current, linear between its
points, errs by 1e-5 in q; all other sizes are those of the coarsest grid, in the caps.
"""

from functools import cache

import numpy as np
import pytest

from tests.engine.lines import Motion, axes_of, positions
from tests.engine.spatial.manufactured import current_table, motion, normals, scene_of

END_S = 1.5
NODES = (16, 31, 61)
CAPS = {"q": 2e-3, "n": 2e-3, "S": 2.0, "V": 0.03, "O1": 5e-6, "K": 3e-3, "X": 0.01}  # 1, 1, N, m/s, 1/m, 1/m, m


@cache
def current():
    return current_table(END_S, times=241, heights=801)


def errors(run, t, stage_s=None):
    """Largest error along the line, by the names of CAPS; shear is compared with that at stage_s where it is given."""
    Y, (exact, _) = run.Y, motion(t, run.s / run.s[-1])
    if stage_s is not None:
        exact["S"] = motion(stage_s, run.s / run.s[-1])[0]["S"]
    t_, n, b = axes_of(Y)
    found = {
        "q": (1 + Y[:, :1]) * t_,
        "n": n,
        "S": Y[:, 1:2] * n + Y[:, 2:3] * b,
        "V": Y[:, 3:6],
        "O1": Y[:, 10],
        "K": Y[:, 11:12] * n + Y[:, 12:] * b,
        "X": positions(Y, run.h),
    }
    exact["n"] = normals(t, run.s, n[0])
    return np.array([np.abs(found[key] - exact[key]).max() for key in CAPS])


def assert_second_order(found, keys=tuple(CAPS)):
    """Within 0.1; within 0.3 for O1, whose error, 1e-7 ... 1e-6 /m, is a small difference of larger ones."""
    slopes = np.log2(np.divide(found[:-1], found[1:]))
    assert np.all(np.abs(slopes - 2) < [0.3 if key == "O1" else 0.1 for key in keys]), slopes


@pytest.mark.slow
@pytest.mark.parametrize("stretching", [0.0, 1.0])
def test_second_order_in_space(stretching):
    at_rest, moved = [], []
    for nodes in NODES:
        run = Motion(scene_of(current(), nodes, END_S, 0.015625, stretching), END_S)
        at_rest.append(errors(run, 0.0))
        assert run.run().status == "ok"
        moved.append(errors(run, run.time_s))
    assert np.all(moved[0] < list(CAPS.values())), dict(zip(CAPS, moved[0], strict=True))
    moving = list(CAPS).index("V")
    at_rest = np.array(at_rest)
    assert not at_rest[:, moving].any()
    assert_second_order(np.delete(at_rest, moving, axis=1), [key for key in CAPS if key != "V"])
    assert_second_order(moved)


@pytest.mark.slow
@pytest.mark.parametrize("integrator", ["midpoint", "generalized-alpha", "trbdf2"])
def test_second_order_in_space_and_time(integrator):
    """Elements and steps halved together. One-stage methods leave the shear force at the time of their stage."""
    found = []
    for nodes, step_s in zip(NODES, (0.125, 0.0625, 0.03125), strict=True):
        run = Motion(scene_of(current(), nodes, END_S, step_s, integrator=integrator), END_S)
        assert run.run().status == "ok"
        behind = (1.0 - float(run.record["alpha_f"])) * step_s if integrator != "trbdf2" else 0.0
        found.append(errors(run, run.time_s, run.time_s - behind))
    assert_second_order(found)


def test_the_chosen_motion_is_a_motion():
    """At the end the line has moved and bent by more than five times the errors that are measured, out of a plane."""
    x = np.linspace(0, 1, 41)
    (before, _), (after, _) = motion(0.0, x), motion(END_S, x)
    for key in ("q", "S", "K", "X"):
        assert np.abs(after[key] - before[key]).max() > 5 * CAPS[key], key
    assert np.linalg.svd(after["X"] - after["X"].mean(0))[1][2] > 0.1
    assert after["O1"] > 0.1
