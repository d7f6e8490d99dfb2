"""The paper's tension law in one dimension: wave speed, Riemann function and stored energy in closed form.

    T(eps) = p1 tanh(y) + p4 + p5 eps,   y = p2 eps + p3          (20)
    c(eps) = sqrt(T'/m),  T' = a sech^2 y + p5,  a = p1 p2
    phi(eps) = integral_0^eps c d eps,   W(eps) = integral T d eps

With w = tanh y / sqrt(a sech^2 y + p5) the integral of c is elementary:

    p2 sqrt(m) phi = sqrt(a) asin(tanh(y) sqrt(a/(a + p5))) + sqrt(p5) atanh(sqrt(p5) w)

In a slack line sqrt(p5) w tends to -1, and atanh of it would lose all digits. The code therefore takes its logarithm
from 1 - p5 w^2 = (a + p5) sech^2 y/(a sech^2 y + p5), where nothing cancels. With p1 = 0 the law is linear,
T = p4 + p5 eps, and phi = c eps.

`law` is the array (p1, p2, p3, p4, p5, m) everywhere: T in N, m the mass per unit unstretched length in kg/m. Kernels
take a strain or an array of strains. T' > 0 everywhere. T' rises up to the inflection of T at y = 0 (eps = 0.2086 with
the paper's numbers) and falls above it.
"""

import numpy as np

from analysis.compiled import kernel
from analysis.sampling import checked_positive, checked_series

PAPER_LAW = (2.703e5, 10.2, -2.128, 2.627e5, 135.5)  # section 4.1.1
NEWTON_MOST = 200  # iterations, at most


def checked_law(parameters, mass):
    """(p1, p2, p3, p4, p5, m) as one array. Raises ValueError unless T rises with the strain everywhere."""
    law = checked_series((*parameters, checked_positive(mass, "mass")), "law")
    if law.shape != (6,) or law[0] < 0.0 or law[1] <= 0.0 or law[4] <= 0.0:
        raise ValueError(f"law: five numbers p1 >= 0, p2 > 0, p3, p4, p5 > 0 are needed, given {tuple(parameters)!r}")
    return law


@kernel
def tension(law, eps):
    """T [N]."""
    return law[0] * np.tanh(law[1] * eps + law[2]) + law[3] + law[4] * eps


@kernel
def slope(law, eps):
    """T' = dT/d eps [N]."""
    th = np.tanh(law[1] * eps + law[2])
    return law[0] * law[1] * (1.0 - th) * (1.0 + th) + law[4]


@kernel
def wave_speed(law, eps):
    """c = sqrt(T'/m) [m/s]."""
    return np.sqrt(slope(law, eps) / law[5])


@kernel
def wave_speed_slope(law, eps):
    """dc/d eps [m/s]; negative where a wave of unloading steepens into a shock."""
    th = np.tanh(law[1] * eps + law[2])
    bend = -2.0 * law[0] * law[1] ** 2 * th * (1.0 - th) * (1.0 + th)  # T''
    return bend / (2.0 * law[5] * wave_speed(law, eps))


@kernel
def _log_cosh(y):
    """ln cosh y, without overflow."""
    return np.abs(y) + np.log1p(np.exp(-2.0 * np.abs(y))) - np.log(2.0)


@kernel
def _speed_integral(law, y):
    """phi up to a constant, as a function of y: the closed form at the head of this file."""
    a, b = law[0] * law[1], law[4]
    th = np.tanh(y)
    stiff = a * (1.0 - th) * (1.0 + th) + b
    z = np.abs(th) * np.sqrt(b / stiff)
    slack = np.log1p(z) + 0.5 * np.log(stiff / (a + b)) + _log_cosh(y)
    steep = np.sqrt(a) * np.arcsin(th * np.sqrt(a / (a + b)))
    return (steep + np.sign(y) * np.sqrt(b) * slack) / (law[1] * np.sqrt(law[5]))


@kernel
def riemann(law, eps):
    """phi [m/s]: the speed that a line has after a simple wave has unloaded it from eps to 0."""
    return _speed_integral(law, law[1] * eps + law[2]) - _speed_integral(law, law[2])


@kernel
def energy(law, eps):
    """W [J/m], counted from eps = 0."""
    y = law[1] * eps + law[2]
    curved = law[0] / law[1] * (_log_cosh(y) - _log_cosh(law[2]))
    return curved + law[3] * eps + 0.5 * law[4] * eps * eps


@kernel
def strain_of_riemann(law, phi, guess):
    """eps at which phi(eps) = phi, by Newton's method from any guess.

    phi is convex below the inflection and concave above it. Iterates are kept on that side of the inflection on which
    the root is; they then approach the root monotonically, at the latest after one step.
    """
    bend = -law[2] / law[1]
    above = phi > riemann(law, bend)
    eps = guess
    for _ in range(NEWTON_MOST):
        eps = max(eps, bend) if above else min(eps, bend)
        step = (phi - riemann(law, eps)) / wave_speed(law, eps)
        eps += step
        if abs(step) <= 1e-14 + 4e-16 * abs(eps):
            return eps
    return eps


@kernel
def strain_of_tension(law, force, guess):
    """eps at which T = force, by Newton's method as in `strain_of_riemann`, because T has the same inflection."""
    bend = -law[2] / law[1]
    above = force > tension(law, bend)
    eps = guess
    for _ in range(NEWTON_MOST):
        eps = max(eps, bend) if above else min(eps, bend)
        step = (force - tension(law, eps)) / slope(law, eps)
        eps += step
        if abs(step) <= 1e-14 + 4e-16 * abs(eps):
            return eps
    return eps
