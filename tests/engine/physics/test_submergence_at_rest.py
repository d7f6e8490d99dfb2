"""Law: a sphere rests where it displaces what it carries (Archimedes): pi h^2 (3R - h) rho/3 = M + T/g.

On a taut line T belongs to the line's own length; on a slack one of no weight it is zero, whatever shape the line has.
"""

import numpy as np
import pytest

from engine import simulate
from engine.scales import tension_at
from tests.engine.lines import STILL, equilibrium, line, positions
from tests.engine.physics.caps import CAP, floating_depth, volume

DIMENSIONS = [2, 3]


def rest(changes):
    """Place (x, z) of the buoy, tension at the top, and the scene; fails where no rest is found."""
    scene = line(CAP, STILL, changes)
    motion = equilibrium(scene)
    place = positions(motion.Y, motion.h)[-1]
    return place[0], place[-1], tension_at(motion.Y[-1, 0], scene.tether.tension), scene


@pytest.mark.parametrize("dimensions", DIMENSIONS)
@pytest.mark.parametrize("depth_m", [21.5, 20.5])
def test_taut(dimensions, depth_m):
    x, z, T, scene = rest({"water.depth_m": depth_m, "motion.dimensions": dimensions})
    D, g = scene.buoy.diameter_m, scene.gravity_mps2
    h = depth_m - z + D / 2
    assert 0 < h < D and abs(x) < 1e-9
    assert T == pytest.approx((scene.water.density_kgpm3 * volume(h, D) - scene.buoy.mass_kg) * g, rel=1e-9)
    tether = scene.tether
    weight = (tether.density_kgpm3 - scene.water.density_kgpm3) * tether.area_m2 * g * tether.length_m
    stretch = (T - weight / 2) / tether.tension.stiffness_N
    assert z == pytest.approx(tether.length_m * (1 + stretch), rel=1e-11)


@pytest.mark.parametrize("dimensions", DIMENSIONS)
@pytest.mark.parametrize("depth_m", [20.4, 20.33, 20.1, 20.0, 12.0])
def test_slack(dimensions, depth_m):
    """A line as heavy as the water weighs nothing; its bending holds it in a bow, with hundredths of a newton."""
    neutral = {"tether.density_kgpm3": 1027.0}
    _, z, T, scene = rest(neutral | {"water.depth_m": depth_m, "motion.dimensions": dimensions})
    h = depth_m - z + scene.buoy.diameter_m / 2
    assert h == pytest.approx(floating_depth(scene), abs=1e-5)
    assert abs(T) < 0.1


@pytest.mark.parametrize("depth_m", [20.33, 18.0])
def test_a_heavy_slack_line_hangs_on_the_buoy(depth_m):
    """The buoy carries less than the weight of the line, and more than half of what of it hangs from there."""
    _, z, T, scene = rest({"water.depth_m": depth_m})
    h = depth_m - z + scene.buoy.diameter_m / 2
    assert h == pytest.approx(floating_depth(scene, T), abs=1e-7)
    assert 0.8 < T < 1.8


@pytest.mark.parametrize("dimensions", DIMENSIONS)
@pytest.mark.parametrize("EI", [0.1, 1.0, 10.0])
def test_a_stiff_slack_line_does_not_stand_up_under_the_buoy(dimensions, EI):
    """Upright it could bear the sphere's weight without buckling, but would tip over about its pinned end."""
    small = {"buoy.diameter_m": 0.2, "buoy.mass_kg": 1.6, "buoy.added_mass_kg": 2.0, "water.depth_m": 1.0}
    short = {"tether.length_m": 1.1, "tether.bending_stiffness_Nm2": EI, "motion.dimensions": dimensions}
    x, z, T, scene = rest(small | short)
    weight = (1140.0 - 1027.0) * scene.tether.area_m2 * 9.81 * 1.1
    assert x**2 + z**2 == pytest.approx(1.1**2, rel=1e-2)  # nearly straight
    assert 0.4 * weight < T < 1.1 * weight
    assert 1.0 - z + 0.1 == pytest.approx(floating_depth(scene, weight / 2), rel=1e-2)


def test_what_is_too_heavy_sinks_as_before():
    """With less buoyancy than weight there is no floating; the whole sphere hangs or stands below the water."""
    heavy = {"buoy.mass_kg": 2500.0, "water.depth_m": 60.0}
    _, z, T, scene = rest(heavy)
    assert z < scene.water.depth_m - scene.buoy.diameter_m
    lift = scene.water.density_kgpm3 * volume(1.5, 1.5) - 2500.0
    assert abs(T) == pytest.approx(abs(lift) * scene.gravity_mps2, rel=1e-9)


@pytest.mark.parametrize("dimensions", DIMENSIONS)
def test_a_buoy_that_stays_under_water_moves_as_the_whole_sphere(dimensions):
    """Bit for bit, in small waves over 25 m of water: its top stays below the troughs."""
    deep = {"water.depth_m": 25.0, "waves.steepness": 0.08, "tether.nodes": 21, "motion.dimensions": dimensions}
    run, other = simulate(line(deep, CAP), periods=6), simulate(line(deep), periods=6)
    assert run.status == other.status == "ok" and np.ptp(run.columns["x_m"]) > 1.0
    assert run.columns["z_m"].max() + 0.75 < 25.0 - 0.08 / 0.16
    for key, values in other.columns.items():
        assert np.array_equal(run.columns[key], values), key
    assert run.statistics["newton_iterations"] == other.statistics["newton_iterations"]
