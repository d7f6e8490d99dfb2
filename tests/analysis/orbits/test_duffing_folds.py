"""The fold of Duffing's oscillator over frequency and force: a stroboscopic map by DOP853 with variational equations.

No published curve has eight digits; the reference is scipy's root of the shooting equations with det(I - M) = 0.
"""

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import root

from analysis.orbits import OrbitMap, follow_curve

DAMPING = 0.2


def shot(z, frequency, force):
    """Image (2,) and derivative (2, 2) of x'' + 0.2 x' + x + x^3 = F cos(w t) over a period."""

    def rates(phase, y):
        x, v, a, b, c, d = y
        stiffness = 1.0 + 3.0 * x * x
        pull = force * np.cos(phase) - DAMPING * v - x - x**3
        ways = c, d, -stiffness * a - DAMPING * c, -stiffness * b - DAMPING * d
        return np.array([v, pull, *ways]) / frequency

    start = [*z, 1.0, 0.0, 0.0, 1.0]
    end = solve_ivp(rates, (0.0, 2.0 * np.pi), start, method="DOP853", rtol=1e-13, atol=1e-14).y[:, -1]
    return end[:2], end[2:].reshape(2, 2)


def duffing(z, p):
    image, derivative = shot(z, *p)
    return image, lambda V: derivative @ V


def fold_at(force, guess):
    """x, v and the frequency of the fold."""

    def equations(unknown):
        *z, frequency = unknown
        image, derivative = shot(z, frequency, force)
        return [*(image - z), np.linalg.det(np.eye(2) - derivative)]

    solved = root(equations, guess, tol=1e-13)
    assert np.abs(equations(solved.x)).max() < 1e-10
    return solved.x


def test_the_fold_of_duffings_oscillator_lies_where_the_shooting_equations_have_it():
    *z, frequency = fold_at(0.5, [0.0, 2.4, 1.62])
    system = OrbitMap(duffing, parameter_size=np.ones(2))
    start = np.array([z]), np.array([frequency, 0.5])
    curve = follow_curve(system, "fold", *start, (1.0, 0.45), (2.5, 0.55), step=0.2, longest=0.2)
    assert len(curve.points) >= 3 and all("end of the range of key 2" in end for end in curve.ends)
    for point in curve.points:
        frequency, force = point.parameters
        assert abs(fold_at(force, [*point.orbit.points[0], frequency])[2] - frequency) < 1e-8
