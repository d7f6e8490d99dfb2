"""Law: at rest in a current (u_n, u_t: its parts along n and t) the force in the line obeys

    N_s = w z - sqrt(1+eps) [rho_w d C_dp/2 |u_n| u_n n + rho_w pi d C_dt/2 |u_t| u_t t],   X_s = (1 + eps) t,   N = T t

(3) and (24) without bending, from (30) at the buoy: N = (B - W) z + rho_w C_d A_p/2 |U| U; fluid acceleration is none.

The same equations are integrated here by scipy (DOP853, 1e-12), with the unknown height of the buoy, or the unknown
force at a held line's anchor, found by root search. The box is of order 2: asked for within 0.1 between 81, 161 and 321
nodes. Its error is that of trapezoidal sums, h^2/12 times the variation of the first derivative, in the sum of the load
(then, over T, an angle) and in the sum of q: twice their sum bounds the error of position at 161 nodes.
"""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, root

from tests.engine.lines import STILL, equilibrium, held, line, positions

LENGTH, EA, AREA, RHO_W, G = 20.0, 5e4, 7.85e-5, 1027.0, 9.81
D = np.sqrt(4 * AREA / np.pi)
W = (1140.0 - RHO_W) * AREA * G
LIFT = (RHO_W * np.pi * 1.5**3 / 6 - 1611.0) * G
C_BUOY = 0.5 * RHO_W * 0.2 * np.pi * 1.5**2 / 4
HEIGHT, SPEED = [0.0, 8.0, 14.0, 30.0], [0.2, 0.4, 0.9, 2.5]


def uniform(height):
    return np.array([1.2, -0.1])


def sheared(height):
    return np.array([np.interp(height, HEIGHT, SPEED), 0.0])


CURRENTS = {
    uniform: {"law": "uniform", "velocity_mps": [1.2, 0.0, -0.1]},
    sheared: {"law": "profile", "height_m": HEIGHT, "velocity_mps": [[u, 0.0, 0.0] for u in SPEED]},
}


def slope(s, y, current):
    """d/ds of (N_x, N_z, x, z)."""
    N, z = y[:2], y[3]
    T = np.hypot(*N)
    t, stretch = N / T, 1 + T / EA
    n = np.array([-t[1], t[0]])
    U = current(z)
    along, across = U @ t, U @ n
    drag = 0.5 * RHO_W * D * np.sqrt(stretch) * (np.pi * 0.1 * abs(along) * along * t + abs(across) * across * n)
    return [*(np.array([0.0, W]) - drag), *(stretch * t)]


def integrate(start, span, current):
    """From one end to the other; z = 8 and 14 m, where the profile has corners, cost accuracy of some 1e-9 only."""
    return solve_ivp(
        slope, span, start, args=(current,), method="DOP853", rtol=1e-12, atol=1e-12, max_step=0.1, dense_output=True
    )


def buoyed(current):
    """Line under the buoy as a function of s: (N_x, N_z, x, z)."""

    def downwards(top):
        U = current(top)
        force = np.array([0.0, LIFT]) + C_BUOY * np.hypot(*U) * U
        return integrate([*force, 0.0, top], (LENGTH, 0.0), current)

    top = brentq(lambda z: downwards(z).y[3, -1], 5.0, 21.0, xtol=1e-12)
    solution = downwards(top)
    return lambda s: solution.sol(s) - np.array([0, 0, solution.y[2, -1], 0])[:, None]


def between(end, current, guess):
    def reach(force):
        return integrate([*force, 0.0, 0.0], (0.0, LENGTH), current)

    found = root(lambda force: reach(force).y[2:, -1] - end, guess, tol=1e-12)
    assert np.max(np.abs(found.fun)) < 1e-8
    return reach(found.x).sol


def errors(exact, *parts):
    """Largest error of position (m) and force (N), for three grids."""
    found = []
    for nodes in (81, 161, 321):
        motion = equilibrium(line(STILL, *parts, nodes=nodes, bending_stiffness_Nm2=0.0))
        Y, expected = motion.Y, exact(motion.s)
        N = EA * Y[:, 0] * np.array([np.cos(Y[:, 4]), np.sin(Y[:, 4])])
        found.append([np.max(np.abs(positions(Y, motion.h).T - expected[2:])), np.max(np.abs(N - expected[:2]))])
    return np.array(found)


def bound(exact, current):
    """Error of position (m) at 161 nodes as in the head of this file."""
    s = np.linspace(0, LENGTH, 2001)
    y = exact(s)
    rates = np.array([slope(0.0, column, current) for column in y.T]).T
    load, turn = (np.sum(np.hypot(*np.diff(np.gradient(part, s, axis=1), axis=1))) for part in (rates[:2], rates[2:]))
    return 2 * (LENGTH / 160) ** 2 / 12 * (turn + LENGTH * load / np.hypot(*y[:2]).min())


@pytest.mark.parametrize("current", CURRENTS)
def test_buoy_on_its_tether(current):
    exact = buoyed(current)
    found = errors(exact, {"current": CURRENTS[current]})
    assert abs(exact(np.array([LENGTH]))[2, 0]) > 1.0  # the current moves the buoy well to the side
    assert found[1, 0] < bound(exact, current)
    assert np.log2(found[:-1] / found[1:]) == pytest.approx(2, abs=0.1)


@pytest.mark.parametrize("current", CURRENTS)
def test_held_line(current):
    end = np.array([8.0, 17.0])
    exact = between(end, current, [40.0, 60.0])
    found = errors(exact, held(*end), {"current": CURRENTS[current]})
    assert found[1, 0] < bound(exact, current)
    assert np.log2(found[:-1] / found[1:]) == pytest.approx(2, abs=0.1)
