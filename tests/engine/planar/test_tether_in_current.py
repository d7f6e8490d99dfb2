"""Law: at rest in a current (u_t, u_p: its parts along and across t) the force in the line obeys

    N_s = w z - sqrt(1+eps) [rho_w d C_dp/2 |u_p| u_p + rho_w pi d C_dt/2 |u_t| u_t t],   X_s = (1 + eps) t,   N = T t

(3) and (24) without bending, from (30) at the buoy: N = (B - W) z + rho_w C_d A_p/2 |U| U; fluid acceleration is none.
In space the current turns with height, so that no plane holds the line.

The same equations are integrated here by scipy (DOP853, 1e-12) from the force that the engine finds at the anchor. The
box is of order 2: asked for within 0.1 between three grids, the finest of 321 nodes. Its error is that of trapezoidal
sums, h^2/12 times the variation of the first derivative, in the sum of the load (then, over T, an angle) and in the sum
of q: twice their sum bounds the error of position.
"""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tests.engine.box_equations import buoy_of, water_on_line, wet_weight
from tests.engine.lines import STILL, equilibrium, forces, held, line, positions

LENGTH, EA = 20.0, 5e4
PROFILES = {  # heights (m), velocities (m/s), dimensions
    "uniform": ([0.0, 30.0], [[1.2, 0.0, -0.1], [1.2, 0.0, -0.1]], 2),
    "sheared": ([0.0, 8.0, 14.0, 30.0], [[0.2, 0, 0], [0.4, 0, 0], [0.9, 0, 0], [2.5, 0, 0]], 2),
    "veering": ([0.0, 24.0], [[0.3, -0.5, 0.0], [1.2, 0.6, -0.15]], 3),
}


def water(scene, height):
    """Velocity (3,) of a current by heights."""
    heights, velocities = scene.current.height_m, np.transpose(scene.current.velocity_mps)
    return np.array([np.interp(height, heights, part) for part in velocities])


def slope(s, y, scene):
    """d/ds of (N, X) of a line at rest without bending."""
    T = np.linalg.norm(y[:3])
    t, stretch = y[:3] / T, 1 + T / scene.tether.tension.stiffness_N
    still = np.zeros((1, 3))
    drag, _ = water_on_line(scene, np.array([[stretch]]), t[None], -water(scene, y[5])[None], still, still)
    return [*(wet_weight(scene) - drag[0]), *(stretch * t)]


def from_the_anchor(N, scene):
    """(N, X) as a function of s; short steps where the shear has corners, at z = 8 and 14 m: some 1e-8."""
    longest = 0.25 if len(scene.current.height_m) > 2 else np.inf
    start, tight = [*N, 0.0, 0.0, 0.0], {"rtol": 1e-12, "atol": 1e-12, "max_step": longest, "dense_output": True}
    return solve_ivp(slope, (0.0, LENGTH), start, args=(scene,), method="DOP853", **tight).sol


def bound(exact, scene, nodes):
    """Error of position (m) as in the head of this file."""
    s = np.linspace(0, LENGTH, 2001)
    y = exact(s)
    rates = np.array([slope(0.0, column, scene) for column in y.T]).T
    load, turn = (
        np.sum(np.linalg.norm(np.diff(np.gradient(part, s, axis=1), axis=1), axis=0)) for part in (rates[:3], rates[3:])
    )
    return 2 * (LENGTH / (nodes - 1)) ** 2 / 12 * (turn + LENGTH * load / np.linalg.norm(y[:3], axis=0).min())


@pytest.mark.parametrize("end", ["buoy", "held"])
@pytest.mark.parametrize("name", PROFILES)
def test_a_line_in_a_current(name, end):
    heights, velocities, dimensions = PROFILES[name]
    place = [8.0, -5.0, 16.0] if dimensions == 3 else [8.0, 0.0, 17.0]
    current = {"current": {"law": "profile", "height_m": heights, "velocity_mps": velocities}}
    parts = [STILL, current, {"motion.dimensions": dimensions}] + [held(*place)] * (end == "held")
    errors = []
    for nodes in (81, 161, 321):
        scene = line(*parts, nodes=nodes, bending_stiffness_Nm2=0.0)
        motion = equilibrium(scene)
        X, N = positions(motion.Y, motion.h).T, forces(motion.Y, EA)
        exact = from_the_anchor(N[0], scene)
        expected = exact(motion.s)
        off = X - (expected[3:] if dimensions == 3 else expected[[3, 5]]), N.T - expected[:3]
        errors.append([np.abs(part).max() for part in off])
        if end == "buoy":
            _, lift, drag, _ = buoy_of(scene)
            assert N[-1] == pytest.approx(lift + drag(-water(scene, X[-1, -1])), abs=1e-5)
        else:
            assert X[[0, -1], -1] == pytest.approx([place[0], place[-1]], abs=1e-6)
    errors = np.array(errors)
    assert errors[1, 0] < bound(exact, scene, 161)
    assert np.log2(errors[:-1] / errors[1:]) == pytest.approx(2, abs=0.1)
    assert abs(expected[3, -1]) > 1.0  # the current moves the buoy well to the side
    if dimensions == 3:
        out_of_every_plane = np.linalg.svd(X.T - X.mean(1))[1][2]
        assert out_of_every_plane > {"buoy": 0.02, "held": 0.2}[end]  # m
