"""Law: a line at rest in space - a catenary in whatever vertical plane its ends lie, bent out of it by a current.

Without a current the elastic catenary of the plane, turned. With one, (3) and (24) without bending, in three
components:

    N_s = w z - sqrt(1+eps) [rho_w d C_dp/2 |u_p| u_p + rho_w pi d C_dt/2 |u_t| u_t t],   X_s = (1 + eps) t,   N = T t

u_t, u_p the parts of the current along and across t; integrated by scipy (DOP853, 1e-12), with the unknown force at a
held line's anchor or the unknown height of the buoy by root search. Order 2, within 0.1, over 41, 81 and 161 nodes.
The current turns with height: no plane holds the line.
"""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, root

from tests.engine.lines import DRY, STILL, equilibrium, held, line, linear
from tests.engine.lines import positions as planar_positions
from tests.engine.spatial.lines import forces, frames, held_at, in_space, positions
from tests.engine.planar.test_tether_in_current import AREA, C_BUOY, EA, LENGTH, LIFT, RHO_W, D, W

HEIGHT = [0.0, 24.0]
BOTTOM, SLOPE = np.array([0.3, -0.5, 0.0]), np.array([0.9, 1.1, -0.15])  # linear in height: no corners
VELOCITY = [(BOTTOM + SLOPE * z / HEIGHT[1]).tolist() for z in HEIGHT]
VEERING = {"current": {"law": "profile", "height_m": HEIGHT, "velocity_mps": VELOCITY}}


def water(z):
    return BOTTOM + SLOPE * z / HEIGHT[1]


def slope(s, y):
    """d/ds of (N, X)."""
    N = y[:3]
    T = np.linalg.norm(N)
    t, stretch = N / T, 1 + T / EA
    u = water(y[5])
    ut = (u @ t) * t
    up = u - ut
    drag = 0.5 * RHO_W * D * np.sqrt(stretch) * (
        math.pi * 0.1 * np.linalg.norm(ut) * ut + np.linalg.norm(up) * up
    )  # fmt: skip
    return [*(np.array([0, 0, W]) - drag), *(stretch * t)]


def integrate(start, span):
    return solve_ivp(slope, span, start, method="DOP853", rtol=1e-12, atol=1e-12, dense_output=True)


def buoyed():
    """(N, X) of the line under the buoy as a function of s."""

    def downwards(top):
        u = water(top)
        return integrate([*(np.array([0, 0, LIFT]) + C_BUOY * np.linalg.norm(u) * u), 0, 0, top], (LENGTH, 0.0))

    top = brentq(lambda z: downwards(z).y[5, -1], 5.0, 21.0, xtol=1e-12)
    solution = downwards(top)
    return lambda s: solution.sol(s) - np.concatenate([[0, 0, 0], solution.y[3:5, -1], [0]])[:, None]


def between(end):
    found = root(lambda N: integrate([*N, 0, 0, 0], (0.0, LENGTH)).y[3:, -1] - end, [60.0, -20.0, 90.0], tol=1e-12)
    assert np.abs(found.fun).max() < 1e-8
    return integrate([*found.x, 0, 0, 0], (0.0, LENGTH)).sol


@pytest.mark.parametrize("end", ["buoy", "held"])
def test_a_line_in_a_current_that_turns_with_height(end):
    place = [8.0, -5.0, 16.0]
    exact = buoyed() if end == "buoy" else between(place)
    errors = []
    for nodes in (41, 81, 161):
        parts = (STILL, VEERING) if end == "buoy" else (STILL, VEERING, held_at(*place))
        motion = equilibrium(in_space(*parts, nodes=nodes, bending_stiffness_Nm2=0.0))
        expected = exact(motion.s).T
        N = forces(motion.Y, lambda eps: EA * eps)
        off = positions(motion.Y, motion.h) - expected[:, 3:]
        errors.append([np.abs(off).max(), np.abs(N - expected[:, :3]).max()])
    X = expected[:, 3:]
    assert np.linalg.svd(X - X.mean(0))[1][2] > {"buoy": 0.02, "held": 0.2}[end]  # m, out of every plane
    assert errors[0][0] < 0.01
    assert np.log2(np.divide(errors[:-1], errors[1:])) == pytest.approx(2, abs=0.1)


@pytest.mark.parametrize("EI", [0.0, 4.0])
@pytest.mark.parametrize("azimuth", [0.0, 0.8, math.pi / 2, math.pi, -2.0])
def test_a_catenary_in_any_vertical_plane_is_that_of_the_plane(azimuth, EI):
    tether = dict(length_m=20.0, area_m2=AREA, density_kgpm3=5000.0, bending_stiffness_Nm2=EI, tension=linear(1e4))
    plane = equilibrium(line(DRY, held(14.0, 6.0), **tether))
    space = equilibrium(in_space(DRY, held_at(14 * math.cos(azimuth), 14 * math.sin(azimuth), 6.0), **tether))
    X, Z = planar_positions(plane.Y, plane.h).T
    expected = np.stack([X * math.cos(azimuth), X * math.sin(azimuth), Z], 1)
    assert np.abs(positions(space.Y, space.h) - expected).max() < 1e-7
    assert np.abs(space.Y[:, 0] - plane.Y[:, 0]).max() < 1e-9
    b = frames(space.Y[:, 6:10])[:, 2]
    curvature = np.hypot(space.Y[:, 11], space.Y[:, 12])
    assert np.abs(curvature - np.abs(plane.Y[:, 5])).max() < 1e-7
    assert np.abs(np.linalg.norm(b, axis=1) - 1).max() < 1e-14


def test_a_slack_line_under_a_cross_current_hangs_aside():
    """Level ends along x, a uniform current along y: the loop of the line leans over to y, and mirrors with it."""
    lean = []
    for speed in (0.4, -0.4):
        current = {"current": {"law": "uniform", "velocity_mps": [0.0, speed, 0.0]}}
        motion = equilibrium(in_space(STILL, current, held_at(12.0, 0.0, 0.0), density_kgpm3=5000.0))
        lean.append(positions(motion.Y, motion.h))
    middle = lean[0][20]
    assert middle[1] > 1.0 and middle[2] < -1.0
    assert np.abs(lean[0] - lean[1] * [1, -1, 1]).max() < 1e-9
