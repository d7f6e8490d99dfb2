"""Law: a straight line at rest under a force F at its end carries N(s) = F - w (L - s) z, T = N.e along its direction
e, and ends at e int (1 + T/EA) ds. Upright under the buoy in still water F = B - W, so that

    r = L + [(B - W) L - w L^2/2]/EA,   B - W = (rho_w pi D^3/6 - M) g,   w = (rho - rho_w) A g

r = 20.8 m with (B - W)/EA = 0.0400 at rho_w = 1027 (4.2 of the paper: T_s = 2000 N, eps_s = 0.04), and 20.785719 m at
1025 (independent codes). Tolerance: T is linear in s and the trapezoid exact for it: rounding and the
tolerance of statics, 1e-8 m.
"""

import numpy as np
import pytest

from tests.engine.lines import DRY, STILL, equilibrium, forces, free, held, line, linear, positions, ran

LENGTH, EA, AREA, G = 20.0, 5e4, 7.85e-5, 9.81
UP, DOWN, ASLANT = np.array([[0.0, 1.0], [0.0, -1.0], [0.6, -0.8]])


def lift(rho_w):
    return (rho_w * np.pi * 1.5**3 / 6 - 1611.0) * G


def upright(rho_w):
    weight = (1140.0 - rho_w) * AREA * G
    return LENGTH + (lift(rho_w) * LENGTH - weight * LENGTH**2 / 2) / EA


def under_the_buoy(rho_w, **tether):
    return (
        STILL | {"water.density_kgpm3": rho_w, "water.depth_m": 25.0},
        tether,
        EA,
        (1140.0 - rho_w) * AREA * G,
        lift(rho_w),
        UP,
    )


def bar(parts, end, density, stiffness, force, direction, rho_w=0.0, g=G):
    """The case of a line of 1e-4 m2 of any material with another end; force: along its direction, None: as is held."""
    w = (density - rho_w) * 1e-4 * g
    tether = {"area_m2": 1e-4, "density_kgpm3": density, "tension": linear(stiffness)}
    return parts | end, tether, stiffness, w, 0.025 * stiffness + w * LENGTH / 2 if force is None else force, direction


GRIDS = [(3, 0.0, 0.4), (41, 0.0, 0.4), (41, 2.0, 0.0), (161, 0.0, 40.0)]
CASES = [
    under_the_buoy(rho_w, nodes=nodes, grid_stretching=stretching, bending_stiffness_Nm2=EI)
    for rho_w in (1025.0, 1027.0, 1200.0)
    for nodes, stretching, EI in GRIDS
] + [
    *(bar(DRY, free(0, -load), rho, 5e3, load, DOWN) for load in (0.0, 30.0) for rho in (1140.0, 7800.0)),
    bar(DRY | {"gravity_mps2": 0.0}, free(30.0, -40.0), 1140.0, 5e3, 50.0, ASLANT, g=0.0),
    bar(DRY, held(0, 20.5), 5000.0, 1e4, None, UP),
    *(bar(STILL, held(0, 20.5), rho, 1e4, None, UP, 1027.0) for rho in (500.0, 5000.0)),
]


@pytest.mark.parametrize("parts, tether, stiffness, weight, force, direction", CASES)
def test_distance_and_tension(parts, tether, stiffness, weight, force, direction):
    motion = equilibrium(line(parts, **tether))
    T = force - weight * direction[1] * (LENGTH - motion.s)
    assert forces(motion.Y, stiffness)[:, [0, 2]] == pytest.approx(T[:, None] * direction, abs=1e-6)
    reached = np.trapezoid(1 + T / stiffness, motion.s)
    assert positions(motion.Y, motion.h)[-1] == pytest.approx(reached * direction, abs=1e-8)


def test_the_published_numbers():
    assert upright(1025.0) == pytest.approx(20.785719, abs=1e-6)
    assert upright(1027.0) == pytest.approx(20.8, abs=5e-4)
    assert lift(1027.0) == pytest.approx(2000, abs=1)


def test_the_buoy_stays_at_rest():
    """Nothing moves that has no reason to: 1e-9 m over a minute, from a static tolerance of 1e-9."""
    run = ran(line(STILL), duration_s=60.0)
    assert np.max(np.abs(run.columns["radius_m"] - upright(1027.0))) < 1e-9
    assert np.max(np.abs(run.columns["angle_rad"])) < 1e-12
    assert run.columns["tension_top_N"] == pytest.approx(lift(1027.0), abs=1e-6)
