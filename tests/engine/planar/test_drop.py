"""Law: a line that hangs from its anchor unstretched and is let go under its own weight (dry, linear law) is a bar:

    m u_tt = EA u_ss + m g,   u = 0 above, no tension below.   With tau = c t/L, c^2 = EA/m, u_0 = g L^2/(2 c^2):
    u(L, t) = u_0 tau^2 for tau < 1,   2 u_0 - u_0 (2 - tau)^2 for 1 < tau < 3,   u_0 (4 - tau)^2 to tau = 4, and again

(d'Alembert): the end falls freely until the front from the anchor meets it, comes to rest at twice the static stretch
u_0 and returns.

Tolerance: the strain has corners, which second-order differences smear over some elements: the error of the stretch
falls with the element, 0.5 h/L of the static stretch in the first two periods.
"""

import numpy as np
import pytest

from tests.engine.lines import DRY, Motion, equilibrium, free, line, linear

LENGTH, MASS, EA, G = 10.0, 0.5, 2e3, 9.81
C = np.sqrt(EA / MASS)
STATIC = G * LENGTH**2 / (2 * C**2)


def drop(nodes):
    """A line that hangs straight down, without strain, at rest."""
    scene = line(
        DRY, free(), {"solver.rtol": 1e-4, "solver.newton_tolerance": 1e-8, "output.step_s": LENGTH / C / 10},
        length_m=LENGTH, area_m2=5e-4, density_kgpm3=1000.0, nodes=nodes, bending_stiffness_Nm2=0.1, tension=linear(EA),
    )  # fmt: skip
    Y = np.zeros_like(equilibrium(scene).Y)
    Y[:, 4] = -np.pi / 2
    return Motion(scene, 8 * LENGTH / C, Y)


def stretch(t):
    tau = np.mod(C * t / LENGTH, 4)
    return STATIC * np.where(tau < 1, tau**2, np.where(tau < 3, 2 - (2 - tau) ** 2, (4 - tau) ** 2))


@pytest.mark.parametrize("nodes", [41, 161])
def test_the_end_falls_to_twice_the_static_stretch(nodes):
    table = drop(nodes).run().table()
    t, z = table.time_s.to_numpy(), table.z_m.to_numpy()
    assert np.max(np.abs(-z - LENGTH - stretch(t))) < 0.5 * STATIC / (nodes - 1)
    assert (-z - LENGTH).max() == pytest.approx(2 * STATIC, rel=0.01)
    assert np.max(np.abs(table.x_m)) < 1e-9
