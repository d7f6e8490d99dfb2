"""Law: a straight line vibrates across itself alike in every direction, at the frequencies of the plane, each twice,
and along itself at its axial frequencies, each once. Closed forms: hanging chain (J0), tensioned pinned beam, buoy on
its tether; the derivations and what the box makes of a wave number are in the planar tests of the same names.
"""

import numpy as np
import pytest
from scipy.special import jn_zeros

from engine import simulate
from tests.engine.lines import DRY, STILL, equilibrium, free, linear
from tests.engine.modes import box
from tests.engine.spatial.lines import held_at, in_space
from tests.engine.spatial.modes import frequencies
from tests.engine.planar.test_buoy_modes import axial, pendulum
from tests.engine.planar.test_hanging_chain_modes import loaded

WEIGHTLESS = {"gravity_mps2": 0.0}


def distances(found, expected):
    """Relative distance from each expected frequency to the two nearest ones found, (m, 2)."""
    return np.sort(np.abs(found[:, None] / expected - 1), axis=0)[:2].T


@pytest.mark.slow
def test_a_bare_chain_swings_in_both_directions_at_the_zeros_of_j0():
    scene = in_space(DRY, free(), length_m=10.0, nodes=81, area_m2=5e-4, density_kgpm3=1000.0,
                     bending_stiffness_Nm2=1e-6, tension=linear(1e9))  # fmt: skip
    found = frequencies(equilibrium(scene), 3.0)
    exact = jn_zeros(0, 4) / 2 * np.sqrt(9.81 / 10.0)
    assert found[:8] == pytest.approx(np.repeat(exact, 2), rel=1e-3)
    assert found[0:8:2] == pytest.approx(found[1:8:2], rel=1e-7)


def test_a_chain_with_a_tip_load_swings_at_its_bessel_frequencies():
    scene = in_space(DRY, free(0, -5.0), length_m=10.0, nodes=41, area_m2=5e-4, density_kgpm3=1000.0,
                     bending_stiffness_Nm2=0.0, tension=linear(1e9))  # fmt: skip
    found = frequencies(equilibrium(scene), 3.0)
    assert found[:8] == pytest.approx(np.repeat(loaded(5.0, 4), 2), rel=2e-3 * (160 / 40) ** 2)


@pytest.mark.parametrize("direction", [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.4, -0.7, 0.3], [0.0, 0.0, -1.0]])
@pytest.mark.parametrize("EI", [0.0, 2.0])
@pytest.mark.parametrize("water", ["dry", "wet"])
def test_a_taut_line_is_a_pinned_beam_in_two_directions(direction, EI, water):
    length, nodes, m, EA, strain = 10.0, 31, 0.5, 1e4, 0.02
    place = length * (1 + strain) * np.array(direction) / np.linalg.norm(direction)
    scene = in_space(
        {"dry": DRY, "wet": STILL}[water], held_at(*place), WEIGHTLESS, length_m=length, nodes=nodes, area_m2=5e-4,
        density_kgpm3=1000.0, bending_stiffness_Nm2=EI, tension=linear(EA),
    )  # fmt: skip
    h, heavy = length / (nodes - 1), m + (1027.0 * 5e-4 if water == "wet" else 0.0)
    k, lam = box(np.arange(1, 6) * np.pi / length, h), 1 + strain
    found = frequencies(equilibrium(scene), 10.0)
    across = np.sqrt((EA * strain * k**2 / lam + EI * k**4 / lam**4) / heavy)
    assert distances(found, across).max() < 2e-7
    assert distances(found, np.sqrt(EA / m) * k)[:, 0].max() < 2e-7


def test_a_buoy_swings_alike_in_both_directions_and_bobs_in_one():
    found = frequencies(equilibrium(in_space(STILL)), 1.0)
    assert found[:2] == pytest.approx(pendulum(), rel=2e-6)
    assert found[2] == pytest.approx(axial(1, lambda k: box(k, 0.5))[0], rel=2e-6)


def test_a_buoy_that_is_struck_across_swings_across():
    """Without drag, from 0.02 m/s: sin at the frequency of the pendulum, amplitude v/omega, for two periods. What
    changes: the share of the line's own modes in the blow (m L/M = 7e-4), and the amplitude squared (0.1 m of 20 m)."""
    omega = pendulum()
    scene = in_space(
        STILL,
        {"start.buoy_velocity_mps": [0.0, 0.02, 0.0], "buoy.drag": 0.0, "solver.rtol": 1e-4, "output.step_s": 0.5},
        drag_normal=0.0, drag_tangential=0.0,
    )  # fmt: skip
    run = simulate(scene, duration_s=4 * np.pi / omega)
    t, y = run.columns["time_s"], run.columns["y_m"]
    assert run.status == "ok" and np.abs(run.columns["x_m"]).max() < 1e-12
    assert np.abs(y - 0.02 / omega * np.sin(omega * t)).max() < 2e-3 * 0.02 / omega
