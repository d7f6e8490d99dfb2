"""Law: in still water the buoy stands upright at r = L + int T/EA ds, T = (B - W) - w (L - s): in closed form

    r = L + [(B - W) L - w L^2/2]/EA,   B - W = (rho_w pi D^3/6 - M) g,   w = (rho - rho_w) A g

r = 20.8 m with (B - W)/EA = 0.0400 at rho_w = 1027 (4.2 of the paper: T_s = 2000 N, eps_s = 0.04), and 20.785719 m at
1025 (independent codes). Tolerance: T is linear in s and the trapezoid exact for it: rounding and the
tolerance of statics, 1e-8 m.
"""

import numpy as np
import pytest

from engine import simulate
from tests.engine.lines import DRY, STILL, equilibrium, free, held, line, linear, positions

LENGTH, EA, AREA, G = 20.0, 5e4, 7.85e-5, 9.81


def lift(rho_w):
    return (rho_w * np.pi * 1.5**3 / 6 - 1611.0) * G


def upright(rho_w):
    weight = (1140.0 - rho_w) * AREA * G
    return LENGTH + (lift(rho_w) * LENGTH - weight * LENGTH**2 / 2) / EA


@pytest.mark.parametrize("rho_w", [1025.0, 1027.0, 1200.0])
@pytest.mark.parametrize("nodes, stretching, EI", [(3, 0.0, 0.4), (41, 0.0, 0.4), (41, 2.0, 0.0), (161, 0.0, 40.0)])
def test_distance_and_tension(rho_w, nodes, stretching, EI):
    scene = line(
        STILL, {"water.density_kgpm3": rho_w}, nodes=nodes, grid_stretching=stretching, bending_stiffness_Nm2=EI
    )
    motion = equilibrium(scene)
    assert positions(motion.Y, motion.h)[-1] == pytest.approx([0, upright(rho_w)], abs=1e-8)
    T = lift(rho_w) - (1140.0 - rho_w) * AREA * G * (LENGTH - motion.s)
    assert EA * motion.Y[:, 0] == pytest.approx(T, abs=1e-6)


def test_the_published_numbers():
    assert upright(1025.0) == pytest.approx(20.785719, abs=1e-6)
    assert upright(1027.0) == pytest.approx(20.8, abs=5e-4)
    assert lift(1027.0) == pytest.approx(2000, abs=1)


def test_the_buoy_stays_at_rest():
    """Nothing moves that has no reason to: 1e-9 m over a minute, from a static tolerance of 1e-9."""
    run = simulate(line(STILL), duration_s=60.0)
    assert run.status == "ok"
    assert np.max(np.abs(run.columns["radius_m"] - upright(1027.0))) < 1e-9
    assert np.max(np.abs(run.columns["angle_rad"])) < 1e-12
    assert run.columns["tension_top_N"] == pytest.approx(lift(1027.0), abs=1e-6)


@pytest.mark.parametrize("load", [0.0, 30.0])
@pytest.mark.parametrize("density", [1140.0, 7800.0])
def test_a_line_hanging_from_its_anchor_stretches_under_its_own_weight(density, load):
    """Free end below the anchor, dry: L + (w L^2/2 + load L)/EA down; exact for the box as above."""
    motion = equilibrium(line(DRY, free(0, -load), tension=linear(5e3), density_kgpm3=density, area_m2=1e-4))
    w = density * 1e-4 * G
    expected = LENGTH + (w * LENGTH**2 / 2 + load * LENGTH) / 5e3
    assert positions(motion.Y, motion.h)[-1] == pytest.approx([0, -expected], abs=1e-8)
    assert 5e3 * motion.Y[:, 0] == pytest.approx(load + w * (LENGTH - motion.s), abs=1e-6)


@pytest.mark.parametrize("water, density", [(DRY, 5000.0), (STILL, 5000.0), (STILL, 500.0)])
def test_an_upright_held_line_is_a_bar_under_its_own_weight(water, density):
    """eps = eps_mean + w (s - L/2)/EA: the box is exact for it. Rounding."""
    w = (density - (1027.0 if water is STILL else 0.0)) * 1e-4 * G
    motion = equilibrium(line(water, held(0, 20.5), area_m2=1e-4, density_kgpm3=density, tension=linear(1e4)))
    assert motion.Y[:, 0] == pytest.approx(20.5 / LENGTH - 1 + w * (motion.s - LENGTH / 2) / 1e4, abs=1e-9)
    assert np.cos(motion.Y[:, 4] - np.pi / 2) == pytest.approx(1.0, abs=1e-14)


def test_a_weightless_line_points_along_the_force_on_its_free_end():
    """N(s) = F + w (s - L) with w = 0: straight, strained by |F|/EA."""
    motion = equilibrium(line(DRY, {"gravity_mps2": 0.0}, free(30.0, -40.0), tension=linear(5e3)))
    assert positions(motion.Y, motion.h)[-1] == pytest.approx(LENGTH * 1.01 * np.array([0.6, -0.8]), abs=1e-8)
