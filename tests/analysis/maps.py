"""Orbits of maps whose regime is known by theory, for the tests of the 0-1 test, the dimension and the verdict."""

import numpy as np


def logistic(rate, points, start=0.3, skip=2000):
    """x -> rate x (1 - x)."""
    orbit, x = np.empty(points), start
    for k in range(-skip, points):
        x = rate * x * (1.0 - x)
        if k >= 0:
            orbit[k] = x
    return orbit


def henon(points, a=1.4, b=0.3, skip=200, start=(0.1, 0.1)):
    """x -> 1 - a x^2 + y, y -> b x."""
    orbit, (x, y) = np.empty((points, 2)), start
    for k in range(-skip, points):
        x, y = 1.0 - a * x * x + y, b * x
        if k >= 0:
            orbit[k] = x, y
    return orbit


def circle_map(coupling, rotation, points, skip=500, start=0.1):
    """angle -> angle + rotation - coupling/(2 pi) sin(2 pi angle), as (cos, sin); a homeomorphism for coupling < 1."""
    angle, theta = np.empty(points), start
    for k in range(-skip, points):
        theta = theta + rotation - coupling / (2.0 * np.pi) * np.sin(2.0 * np.pi * theta)
        if k >= 0:
            angle[k] = theta
    return circle(angle)


def circle(turns):
    """(cos, sin) of angles in turns."""
    return np.column_stack([np.cos(2.0 * np.pi * turns), np.sin(2.0 * np.pi * turns)])
