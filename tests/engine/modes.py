"""Eigenvalues of the space-discretised line about an equilibrium, from the kernels that a time step uses.

The stage equation of every integrator is C = C~ + f(C)/c for the conserved variables C = (q, V) and a rate c; its
derivative with respect to C~ is R = c (c - A)^-1 with A = df/dC. The columns of R are Newton updates of the engine for
small changes of C~, so the eigenvalues of A follow from those of R as lambda = c (1 - 1/mu); mu = 0 belongs to what the
box equations do not see. R is taken by central differences, with an error of the square of `CHANGE`.
"""

import numpy as np

from tests.engine.box_equations import change_of
from tests.engine.kernels import Stage

CHANGE = 1e-5


def eigenvalues_of(R, rate):
    """lambda (1/s) of R, those with |lambda| < 1e3 rate, by size."""
    mu = np.linalg.eigvals(R)
    found = rate * (1 - 1 / mu[np.abs(mu) > 1e-3])
    return found[np.argsort(np.abs(found))]


def rates(motion, rate):
    """Eigenvalues lambda (1/s) of small motions about `motion.Y`, in a plane or in space, by size.

    rate : c (1/s), of the order of the eigenvalues wanted
    """
    Y, stage = motion.Y, Stage(motion.scene)
    F, rest = stage.water(0.0, Y), stage.conserved(Y)
    R = np.empty((rest.size, rest.size))
    for j in range(rest.size):
        change = np.zeros(rest.size)
        change[j] = CHANGE
        ahead, behind = (
            change_of(Y, stage.update(rate, rate, 1.0, Y, rest + sign * change.reshape(rest.shape), F))
            for sign in (1, -1)
        )
        R[:, j] = (ahead - behind).ravel() / (2 * CHANGE)
    return eigenvalues_of(R, rate)


def frequencies(motion, rate):
    """Angular frequencies (rad/s) of the undamped modes, rising: imaginary parts of the eigenvalues above the axis.

    In space those of a line at rest across each of two planes come twice.
    """
    found = rates(motion, rate)
    return np.sort(found.imag[found.imag > 1e-6 * rate])


def box(k, h):
    """What the box makes of a wave number k: differences over means of exp(iks) give i (2/h) tan(kh/2)."""
    return 2 / h * np.tan(0.5 * k * h)


def distance(found, expected, times=1):
    """Largest relative distance from each expected frequency to the `times` nearest ones found."""
    return np.sort(np.abs(found[:, None] / expected - 1), axis=0)[:times].max()
