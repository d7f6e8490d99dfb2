"""Law: a scheme that shares only the tension law and F(t) with the characteristics converges to the same motion.

First-order finite volumes with Roe's flux, which is exact for this system: with Z = m sigma and
sigma^2 = (T_r - T_l)/(m (eps_r - eps_l)), T* = (T_l + T_r)/2 + Z (u_r - u_l)/2 and
u* = (u_l + u_r)/2 + (T_r - T_l)/(2 Z).
Source: Toro, Riemann Solvers (2009), chapters 6 and 11; Roe, J. Comput. Phys. 43, 357 (1981).
"""

import numpy as np
import pytest

from campaigns.breaking_line.theory import PAPER_LAW, fitted_break
from campaigns.breaking_line.theory.law import tension, wave_speed
from campaigns.breaking_line.theory.simple_wave import end_force
from tests.campaigns.breaking_line.test_theory import CASES, LAW, LENGTH, MASS, broken

FASTEST_MPS = 1110.0  # at the inflection of the law


def captured(case, until_s, cells):
    """Strain and velocity (cells,) of a break at a time, displacement of the end and impulse of both ends."""
    line, h = broken(*CASES[case]), LENGTH / cells
    strain = np.full(cells, line.strain0)
    u, displacement, impulse = np.zeros(cells), 0.0, 0.0
    steps = int(np.ceil(until_s / (0.9 * h / FASTEST_MPS)))
    dt = until_s / steps
    for step in range(steps):
        T, c = tension(LAW, strain), wave_speed(LAW, strain)
        jump = np.diff(strain)
        flat = np.abs(jump) < 1e-7
        sigma = np.where(flat, c[1:], np.sqrt(np.abs(np.diff(T) / np.where(flat, 1.0, jump)) / MASS))
        pull = end_force(line, (step + 0.5) * dt)
        wall, out = T[0] + MASS * c[0] * u[0], u[-1] + (pull - T[-1]) / (MASS * c[-1])
        T_star = np.concatenate([[wall], 0.5 * (T[1:] + T[:-1]) + 0.5 * MASS * sigma * np.diff(u), [pull]])
        u_star = np.concatenate([[0.0], 0.5 * (u[1:] + u[:-1]) + 0.5 * np.diff(T) / (MASS * sigma), [out]])
        strain, u = strain + dt / h * np.diff(u_star), u + dt / (h * MASS) * np.diff(T_star)
        displacement, impulse = displacement + dt * out, impulse + dt * (pull - wall)
    return strain, u, displacement, impulse


@pytest.mark.parametrize(
    ("case", "until_s", "least"),
    [("2p", 0.05, 0.95), ("1p", 0.15, 0.9), ("4", 0.04, 0.8)],
    ids=["smooth", "through the echo of the fixed end", "behind a shock"],
)
def test_finite_volumes_converge_to_the_characteristics(case, until_s, least):
    exact = fitted_break(PAPER_LAW, MASS, LENGTH, *CASES[case], until_s)
    cells, errors = (200, 400, 800), []
    for count in cells:
        middles = (np.arange(count) + 0.5) * LENGTH / count
        strain = captured(case, until_s, count)[0]
        errors.append(np.mean(np.abs(strain - exact.at(middles, until_s)[0])))
    assert -np.polyfit(np.log(cells), np.log(errors), 1)[0] > least and errors[-1] < 2e-3


def test_the_scheme_keeps_length_and_momentum_to_rounding():
    strain, u, displacement, impulse = captured("4", 0.05, 200)
    stretch = LENGTH * broken(*CASES["4"]).strain0
    assert LENGTH * strain.mean() == pytest.approx(stretch + displacement, abs=1e-10)
    assert MASS * LENGTH * u.mean() == pytest.approx(impulse, rel=1e-10)
