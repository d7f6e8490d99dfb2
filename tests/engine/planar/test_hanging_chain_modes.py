"""Law: an inextensible chain of weight w per length, hanging with a load f at its tip, swings as

    w_tip(x) = A J0(z) + B Y0(z),   z = 2 omega sqrt((x + f/w)/g),   x from the tip,

at rest above (x = L) and with T dw/dx = 0 at the tip; without a load omega_j = (z_j/2) sqrt(g/L), J0(z_j) = 0
(D. Bernoulli 1733; Lamb, Higher Mechanics). The anchor is the upper end here, the free end hangs below it.

Tolerance: strains are 6e-8 and less (EA = 1e9 N), which moves frequencies by no more. With a load the wave number is
bounded: order 2 in h, asked for within 0.1. Without it the box meets a singular end: 1e-4 at 161 nodes, of which the
little bending that keeps the tip determined (EI = 1e-6 N m2) may take 2e-5 of the fourth mode,
int EI w_xx^2 / int m omega^2 w^2.
"""

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.special import j0, j1, jn_zeros, y0, y1

from tests.engine.lines import DRY, equilibrium, free, line, linear
from tests.engine.modes import frequencies

LENGTH, GRAVITY, EA = 10.0, 9.81, 1e9
WEIGHT = 0.5 * GRAVITY


def hanging(nodes, EI, load):
    scene = line(
        DRY, free(0, -load), length_m=LENGTH, nodes=nodes, area_m2=5e-4, density_kgpm3=1000.0,
        bending_stiffness_Nm2=EI, tension=linear(EA),
    )  # fmt: skip
    motion = equilibrium(scene)
    assert np.cos(motion.Y[:, 4] + np.pi / 2) == pytest.approx(1.0, abs=1e-12)
    return frequencies(motion, 3.0)


def loaded(load, count):
    offset = load / WEIGHT

    def condition(omega):
        top, tip = (2 * omega * np.sqrt((x + offset) / GRAVITY) for x in (LENGTH, 0.0))
        return j0(top) * y1(tip) - y0(top) * j1(tip)

    grid = np.linspace(0.3, 60, 20001)
    values = np.array([condition(omega) for omega in grid])
    changes = np.flatnonzero(values[1:] * values[:-1] < 0)[:count]
    return np.array([brentq(condition, grid[i], grid[i + 1], xtol=1e-13) for i in changes])


@pytest.mark.slow
def test_a_chain_with_a_tip_load_swings_at_its_bessel_frequencies():
    exact = loaded(5.0, 4)
    coarse, middle, fine = (hanging(nodes, 0.0, 5.0)[:4] / exact - 1 for nodes in (41, 81, 161))
    assert np.all(np.abs(fine) < 2e-3)
    assert np.log2(coarse / middle) == pytest.approx(2, abs=0.1)
    assert np.log2(middle / fine) == pytest.approx(2, abs=0.1)


@pytest.mark.slow
def test_a_bare_chain_swings_at_the_zeros_of_j0():
    exact = jn_zeros(0, 4) / 2 * np.sqrt(GRAVITY / LENGTH)
    assert hanging(161, 1e-6, 0.0)[:4] == pytest.approx(exact, rel=1e-4)
