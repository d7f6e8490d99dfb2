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

from tests.engine.lines import STILL, equilibrium, forces, held, line, positions

LENGTH, EA, AREA, RHO_W, G = 20.0, 5e4, 7.85e-5, 1027.0, 9.81
D = np.sqrt(4 * AREA / np.pi)
W = np.array([0.0, 0.0, (1140.0 - RHO_W) * AREA * G])
LIFT = np.array([0.0, 0.0, (RHO_W * np.pi * 1.5**3 / 6 - 1611.0) * G])
C_BUOY = 0.5 * RHO_W * 0.2 * np.pi * 1.5**2 / 4
PROFILES = {  # heights (m), velocities (m/s), dimensions
    "uniform": ([0.0, 30.0], [[1.2, 0.0, -0.1], [1.2, 0.0, -0.1]], 2),
    "sheared": ([0.0, 8.0, 14.0, 30.0], [[0.2, 0, 0], [0.4, 0, 0], [0.9, 0, 0], [2.5, 0, 0]], 2),
    "veering": ([0.0, 24.0], [[0.3, -0.5, 0.0], [1.2, 0.6, -0.15]], 3),
}


def water(name, height):
    heights, velocities, _ = PROFILES[name]
    return np.array([np.interp(height, heights, part) for part in np.transpose(velocities)])


def slope(s, y, name):
    """d/ds of (N, X)."""
    N = y[:3]
    T = np.linalg.norm(N)
    t, stretch = N / T, 1 + T / EA
    u = water(name, y[5])
    ut = (u @ t) * t
    up = u - ut
    drag = np.pi * 0.1 * np.linalg.norm(ut) * ut + np.linalg.norm(up) * up
    return [*(W - 0.5 * RHO_W * D * np.sqrt(stretch) * drag), *(stretch * t)]


def from_the_anchor(N, name):
    """(N, X) as a function of s; short steps at z = 8 and 14 m, where the shear has corners: some 1e-9."""
    longest = 0.1 if name == "sheared" else np.inf
    start, tight = [*N, 0.0, 0.0, 0.0], {"rtol": 1e-12, "atol": 1e-12, "max_step": longest, "dense_output": True}
    return solve_ivp(slope, (0.0, LENGTH), start, args=(name,), method="DOP853", **tight).sol


def bound(exact, name, nodes):
    """Error of position (m) as in the head of this file."""
    s = np.linspace(0, LENGTH, 2001)
    y = exact(s)
    rates = np.array([slope(0.0, column, name) for column in y.T]).T
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
        motion = equilibrium(line(*parts, nodes=nodes, bending_stiffness_Nm2=0.0))
        X, N = positions(motion.Y, motion.h).T, forces(motion.Y, EA)
        exact = from_the_anchor(N[0], name)
        expected = exact(motion.s)
        off = X - (expected[3:] if dimensions == 3 else expected[[3, 5]]), N.T - expected[:3]
        errors.append([np.abs(part).max() for part in off])
        if end == "buoy":
            u = water(name, X[-1, -1])
            assert N[-1] == pytest.approx(LIFT + C_BUOY * np.linalg.norm(u) * u, abs=1e-5)
        else:
            assert X[[0, -1], -1] == pytest.approx([place[0], place[-1]], abs=1e-6)
    errors = np.array(errors)
    assert errors[1, 0] < bound(exact, name, 161)
    assert np.log2(errors[:-1] / errors[1:]) == pytest.approx(2, abs=0.1)
    assert abs(expected[3, -1]) > 1.0  # the current moves the buoy well to the side
    if dimensions == 3:
        out_of_every_plane = np.linalg.svd(X.T - X.mean(1))[1][2]
        assert out_of_every_plane > {"buoy": 0.02, "held": 0.2}[end]  # m
