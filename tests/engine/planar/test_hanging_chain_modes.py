"""Law: an inextensible chain of weight w per length, hanging with a load f at its tip, swings as

    w_tip(x) = A J0(z) + B Y0(z),   z = 2 omega sqrt((x + f/w)/g),   x from the tip,

at rest above (x = L) and with T dw/dx = 0 at the tip; without a load omega_j = (z_j/2) sqrt(g/L), J0(z_j) = 0
(D. Bernoulli 1733; Lamb, Higher Mechanics). The anchor is the upper end here, the free end hangs below it.

Tolerance: strains are 6e-8 and less (EA = 1e9 N), which moves frequencies by no more. With a load the wave number is
bounded: order 2 in h, asked for within 0.1. Without it the box meets a singular end: 1e-4 at 161 nodes, of which the
little bending that keeps the tip determined (EI = 1e-6 N m2) may take 2e-5 of the fourth mode,
int EI w_xx^2 / int m omega^2 w^2. In space every frequency comes twice.
"""

from itertools import pairwise

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.special import j0, j1, jn_zeros, y0, y1

from tests.engine.lines import DRY, equilibrium, free, line, linear, positions
from tests.engine.modes import frequencies

LENGTH, GRAVITY, EA = 10.0, 9.81, 1e9
WEIGHT = 0.5 * GRAVITY


def hanging(nodes, EI, load, dimensions=2):
    """The four slowest frequencies (4, dimensions - 1), rad/s."""
    scene = line(
        DRY, free(0, -load), {"motion.dimensions": dimensions}, length_m=LENGTH, nodes=nodes, area_m2=5e-4,
        density_kgpm3=1000.0, bending_stiffness_Nm2=EI, tension=linear(EA),
    )  # fmt: skip
    motion = equilibrium(scene)
    assert np.diff(positions(motion.Y, motion.h)[:, -1]) == pytest.approx(-motion.h, rel=1e-6)
    return frequencies(motion, 3.0)[: 4 * (dimensions - 1)].reshape(4, -1)


def loaded(load, count):
    offset = load / WEIGHT

    def condition(omega):
        top, tip = (2 * omega * np.sqrt((x + offset) / GRAVITY) for x in (LENGTH, 0.0))
        return j0(top) * y1(tip) - y0(top) * j1(tip)

    grid = np.linspace(0.3, 60, 20001)
    values = np.array([condition(omega) for omega in grid])
    changes = np.flatnonzero(values[1:] * values[:-1] < 0)[:count]
    return np.array([brentq(condition, grid[i], grid[i + 1], xtol=1e-13) for i in changes])


@pytest.mark.parametrize("dimensions, grids", [(2, (21, 41, 81)), (3, (41, 81))])
def test_a_chain_with_a_tip_load_swings_at_its_bessel_frequencies(dimensions, grids):
    errors = [hanging(nodes, 0.0, 5.0, dimensions) / loaded(5.0, 4)[:, None] - 1 for nodes in grids]
    for coarse, fine in pairwise(errors):
        assert np.log2(coarse / fine) == pytest.approx(2, abs=0.1)
    assert np.all(np.abs(errors[-1]) < 2e-3 * (160 / (grids[-1] - 1)) ** 2)
    assert np.ptp(errors[-1], axis=1) == pytest.approx(0, abs=1e-6)


@pytest.mark.parametrize("dimensions, nodes, error", [(2, 161, 1e-4), (3, 81, 1e-3)])
def test_a_bare_chain_swings_at_the_zeros_of_j0(dimensions, nodes, error):
    exact = jn_zeros(0, 4)[:, None] / 2 * np.sqrt(GRAVITY / LENGTH)
    found = hanging(nodes, 1e-6, 0.0, dimensions)
    assert found / exact == pytest.approx(1, rel=error)
    assert np.ptp(found / exact, axis=1) == pytest.approx(0, abs=1e-7)
