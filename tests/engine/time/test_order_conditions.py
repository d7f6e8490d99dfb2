"""The coefficients of the integrators: order conditions, stiff accuracy, L-stability, A-stability.

A Runge-Kutta method has order p when sum b_i Phi_i(tree) = 1/gamma(tree) for every rooted tree of up to p nodes
(Butcher 1963; Hairer, Norsett & Wanner I, II.2). R(z) = 1 + z b (1 - z A)^-1 e.
"""

import numpy as np
import pytest

from engine.time.integrators import backward_euler, esdirk43, generalized_alpha, midpoint, trbdf2

PAIRS = {"esdirk43": esdirk43, "trbdf2": trbdf2}
ROUNDING = 1e-14  # the printed coefficients are exact fractions of order one


def defects(A, b):
    """Largest |sum b_i Phi_i(tree) - 1/gamma(tree)| over the rooted trees of 1, 2, 3, 4 nodes, and for the tall and the
    bushy tree of 5."""
    c = A.sum(axis=1)
    Ac, Ac2 = A @ c, A @ c**2
    return [
        abs(b.sum() - 1),
        abs(b @ c - 1 / 2),
        max(abs(b @ c**2 - 1 / 3), abs(b @ Ac - 1 / 6)),
        max(abs(b @ c**3 - 1 / 4), abs(b @ (c * Ac) - 1 / 8), abs(b @ Ac2 - 1 / 12), abs(b @ A @ Ac - 1 / 24)),
        max(abs(b @ c**4 - 1 / 5), abs(b @ A @ A @ Ac - 1 / 120)),
    ]


def order(A, b):
    """Highest p whose conditions all hold, of at most 4."""
    return next(p for p, defect in enumerate(defects(A, b)) if defect > ROUNDING)


def stability(A, b, z):
    return 1 + z * (b @ np.linalg.solve(np.eye(len(A)) - z * A, np.ones(len(A))))


@pytest.mark.parametrize("name, main, embedded", [("esdirk43", 4, 3), ("trbdf2", 2, 3)])
def test_runge_kutta_pairs_have_their_stated_orders(name, main, embedded):
    method = PAIRS[name]
    assert order(method.A, method.A[-1]) == main == method.ORDER
    assert order(method.A, method.B_EMBEDDED) == embedded == method.EMBEDDED_ORDER


@pytest.mark.parametrize("name", PAIRS)
def test_stages_are_diagonally_implicit_of_stage_order_two_stiffly_accurate_and_l_stable(name):
    A = PAIRS[name].A
    b, c = A[-1], A.sum(axis=1)
    assert not np.triu(A, 1).any() and A[0, 0] == 0 and len({float(a) for a in np.diag(A)[1:]}) == 1
    assert abs(c[-1] - 1) <= ROUNDING  # the last stage, whose weights are the last row, is the new state
    # stage order 2; in the Kennedy-Carpenter table it holds to the printed digits
    assert np.allclose(A[1:] @ c, c[1:] ** 2 / 2, atol=1e-14)
    # y_i = y + z sum a_ij y_j becomes 0 = sum a_ij y_j for the implicit stages as z -> infinity; y_1 = y, R = y_s/y
    assert abs(np.linalg.solve(A[1:, 1:], A[1:, 0])[-1]) <= ROUNDING
    decay = [abs(stability(A, b, z)) * abs(z) for z in (-1e3, -1e4, -1e5, -1e6)]  # R falls as 1/z
    assert max(decay) < 1.1 * min(decay)
    y = np.concatenate([np.linspace(0, 50, 20001), np.logspace(1.7, 8, 2000)])
    assert max(abs(stability(A, b, 1j * w)) for w in y) <= 1 + 1e-12


FAMILY = [(generalized_alpha, rho, rho, 2) for rho in (0.0, 0.3, 0.5, 0.8, 1.0)]


@pytest.mark.parametrize("method, given, rho, order", [*FAMILY, (midpoint, 0.5, 1.0, 2), (backward_euler, 0.5, 0.0, 1)])
def test_one_stage_methods_are_a_stable_and_have_order_and_spectral_radius(method, given, rho, order):
    radius_at_infinity, worst, slope = amplification_of(method.alphas(given))
    assert abs(radius_at_infinity - rho) < 1e-7  # a double eigenvalue: the square root of rounding
    assert worst <= 1 + 1e-9
    assert abs(slope - 1 - order) < 0.05 and method.ORDER == order  # local error of order dt^(order + 1)


def amplification(z, alpha_m, alpha_f, gamma):
    """Matrix of one step (y, dt y') -> (y, dt y') of y' = lambda y, z = lambda dt (Jansen et al. 2000).

    alpha_m K' + (1 - alpha_m) K = z (alpha_f y' + (1 - alpha_f) y),  y' = y + (1 - gamma) K + gamma K'
    """
    large = abs(z) > 1  # the second row divided by z, so that z may be infinite
    zeta, m = (1, 1 / z) if large else (z, 1)
    left = np.array([[1, -gamma], [-zeta * alpha_f, m * alpha_m]])
    right = np.array([[1, 1 - gamma], [zeta * (1 - alpha_f), m * (alpha_m - 1)]])
    return np.linalg.solve(left, right)


def amplification_of(alphas):
    """Spectral radius at infinite frequency, largest on the imaginary axis, slope of the local error."""

    def eigenvalues(z):
        return np.linalg.eigvals(amplification(z, *alphas))

    worst = max(np.abs(eigenvalues(1j * w)).max() for w in np.logspace(-3, 6, 3000))
    steps = np.array([1e-2, 5e-3])
    errors = [np.abs(eigenvalues(1j * w) - np.exp(1j * w)).min() for w in steps]
    return np.abs(eigenvalues(np.inf)).max(), worst, np.log2(errors[0] / errors[1])
