"""Law: the water of a sea is the plain sum of its linear waves, in a plane and in space, also far above waves that are
short beside an element; its slopes are those of the sum. In a plane it is a series about the last sum, whose error over
random phases is the stated one. Two halves of one wave move a line as the whole wave does, and a sea in a plane is the
same in space.
"""

import numpy as np
import pytest

from engine import load_scene, simulate
from engine.physics.sea import AMPLITUDE, COSINE, OMEGA, PHASE, SINE, K, elevation_m, enough_waves, envelope_m, rows_of
from engine.physics.sea_series import LEFT_OUT, ORDER
from tests.engine.kernels import SeaLine, current_at, waves_at
from tests.engine.lines import line
from tests.engine.physics.caps import CAP, linear_waves

RNG = np.random.default_rng(7)
DEPTH = 22.5


def sea(seed, dimensions=2, **changes):
    jonswap = {"significant_height_m": 1.6, "seed": seed, "components": int(RNG.choice([2, 8, 37, 64]))}
    keys = {"water.depth_m": DEPTH, "motion.dimensions": dimensions, "waves.jonswap": jonswap, "tether.nodes": 11}
    return line(keys, changes)


def plain_sum(scene, t, X):
    """Velocity and its rate at X (n, 2) or (n, 3) in long doubles."""
    return linear_waves(rows_of(scene)[:, [K, OMEGA, AMPLITUDE, PHASE, COSINE, SINE]], DEPTH, t, X)


def random_sea(number):
    """One of fifty: JONSWAP or Gaussian, peaks of 1 to 8 s, in a plane or in space."""
    rng = np.random.default_rng(number)
    space = number % 2
    keys = {"waves.period_s": rng.uniform(1.0, 8.0), "waves.above_still_water": "extrapolate"}
    if space:
        keys["waves.direction_rad"] = rng.uniform(-3.0, 3.0)
    if number % 4 < 2:
        jonswap = {"significant_height_m": rng.uniform(0.02, 0.1) * keys["waves.period_s"]}
        keys["waves.jonswap"] = jonswap | {"peak_enhancement": rng.uniform(1.0, 7.0), "seed": number}
    else:
        keys |= {"waves.jonswap": None, "waves.significant_steepness": rng.uniform(0.02, 0.2), "waves.seed": number}
        keys["waves.relative_width"] = rng.uniform(0.002, 0.2)
    return sea(0, 3 if space else 2, **keys), rng


def random_line(rng, dimensions):
    """Sixty places: on a smooth line, for the recurrence, and from its middle on at random, where it is not used."""
    X = np.column_stack([np.sin(np.linspace(0.0, 2.0, 60 + axis)[:60]) for axis in range(dimensions)])
    X[:, -1] = np.linspace(0.0, DEPTH + 0.2, 60)
    middle = rng.integers(61)
    X[middle:] = rng.uniform(-10.0, 10.0, (60 - middle, dimensions))
    X[middle:, -1] = rng.uniform(0.0, DEPTH + 1.0, 60 - middle)
    return X


def test_fifty_random_seas_are_the_plain_sum_along_random_lines():
    """Three moments of each, with a line of sixty nodes; the surface at 200 places and moments."""
    for number in range(50):
        scene, rng = random_sea(number)
        for t in rng.uniform(0.0, 2000.0, 3):
            X = random_line(rng, scene.motion.dimensions)
            exact = plain_sum(scene, t, X)
            errors = np.abs(waves_at(scene, t, X) - exact).max(axis=0)
            assert np.all(errors <= 1e-12 * np.abs(exact).max(axis=0) + 1e-300)
        rows = rows_of(scene).astype(np.longdouble)
        t, x = rng.uniform(0.0, 2000.0, 200), rng.uniform(-10.0, 10.0, 200)
        spatial_phase = rows[:, K] * (np.longdouble(1.0) * x[:, None] * rows[:, COSINE])
        exact = (rows[:, AMPLITUDE] * np.cos(spatial_phase - rows[:, OMEGA] * t[:, None] + rows[:, PHASE])).sum(axis=1)
        assert np.abs(elevation_m(scene, t, x) - exact).max() <= 1e-12 * np.abs(exact).max()


def errors_of_series(seed, by_time, by_place):
    """Errors (4,) of a node at still water, of a series that is used at shares of its span and of its reach; the
    stated error of a velocity, the span."""
    scene = sea(seed, **{"waves.above_still_water": "extrapolate", "waves.jonswap": jonswap(seed)})
    upper, places = SeaLine(scene, 2), np.array([[0.0, 0.0], [1.0, DEPTH]])
    p = upper.p
    upper.water(50.0, places)
    t, moved = 50.0 + by_time * p["sea_span"], places - [0.0, by_place * p["sea_reach"]]
    F = upper.water(t, moved)
    assert upper.summed_s == 50.0  # the sums were not taken anew
    stated = LEFT_OUT * p["newton_tolerance"] / p["per_speed"]
    return F[1] - plain_sum(scene, t, moved)[1].astype(float), stated, p["sea_span"]


@pytest.mark.parametrize(("by_time", "by_place"), [(0.999, 0.0), (0.0, 0.999), (-0.6, 0.39)])
def test_a_series_has_its_stated_error_where_it_ends(by_time, by_place):
    errors, stated, span = zip(*(errors_of_series(seed, by_time, by_place) for seed in range(60)), strict=True)
    scatter = np.sqrt(np.mean(np.square(errors), axis=0)) / stated[0]
    assert np.all(scatter[:2] * (ORDER + 1) < 1.3)  # of sixty seeds: 1 ± 0.09
    if by_place == 0.0:
        assert np.all(scatter[:2] * (ORDER + 1) > 0.7) and np.all(np.abs(scatter[2:] * span[0] - 1.0) < 0.3)


def test_a_series_is_left_where_it_does_not_hold():
    scene = sea(0, **{"waves.jonswap": jonswap(0), "waves.above_still_water": "wheeler"})
    upright, X = SeaLine(scene, 5), np.column_stack([np.zeros(5), np.linspace(0.0, DEPTH, 5)])
    span, reach = upright.p["sea_span"], upright.p["sea_reach"]
    upright.water(3.0, X)
    upright.water(3.0 + 0.9 * span, X)
    upright.water(3.0, X + np.array([0.99 * reach, 0.0]))
    assert upright.summed_s == 3.0
    moved, far = X.copy(), 3.0 + 0.5 * span
    moved[2, 0] += 0.6 * reach
    F = upright.water(far, moved)
    assert upright.summed_s == far and np.array_equal(F, waves_at(scene, far, moved))


@pytest.mark.parametrize("above", ["extrapolate", "zero", "wheeler"])
def test_the_slopes_are_those_of_the_field(above):
    """By central differences of step 1e-4 m, within a ramp, over a current that grows with height."""
    current = {"law": "profile", "height_m": [0.0, 30.0], "velocity_mps": [[0.0, 0.0, 0.2], [1.5, 0.0, 0.0]]}
    scene = sea(1, **{"waves.above_still_water": above, "waves.ramp_s": 20.0, "current": current})
    X = np.column_stack([np.linspace(-2.0, 2.0, 9), np.linspace(1.0, DEPTH + 0.6, 9)])
    J, d = SeaLine(scene, 9).slopes(7.0, X), 1e-4
    for axis, step in enumerate(d * np.eye(2)):
        high, low = (waves_at(scene, 7.0, at) + current_at(scene, 7.0, at) for at in (X + step, X - step))
        slope = (high - low) / (2 * d)
        assert J[:, 4 * axis : 4 * axis + 4] == pytest.approx(slope, abs=1e-6)


@pytest.mark.parametrize("capped", [{}, CAP], ids=["whole", "cap"])
@pytest.mark.parametrize("angle", [0.0, np.pi])
def test_two_halves_of_a_wave_are_the_wave(capped, angle):
    tight = {"solver.newton_tolerance": 1e-11, "waves.above_still_water": "extrapolate", "water.depth_m": 21.3}
    half = {"period_s": 5.0, "amplitude_m": 0.3, "direction_rad": angle}

    def columns_of(**waves):
        changes = {f"waves.{key}": value for key, value in {"jonswap": None, **waves}.items()}
        return simulate(sea(0, **tight, **capped, **changes), periods=2).columns

    expected = columns_of(amplitude_m=0.6, direction_rad=angle)
    field = columns_of(components=[half, half])
    single = columns_of(components=[half | {"amplitude_m": 0.6}])
    for name in ("x_m", "z_m", "angle_rad"):
        assert np.abs(field[name] - expected[name]).max() < 1e-9
        assert np.array_equal(single[name], expected[name])


def test_the_plane_of_listed_waves_is_that_of_most_of_their_energy():
    """Waves to both sides of y, and one against them: angle and distance are those of a wave along y, in any order."""
    waves = []
    for amplitude_m, towards in ((0.2, 0.5 * np.pi - 0.4), (0.2, 0.5 * np.pi + 0.4), (0.1, -0.5 * np.pi)):
        waves.append({"period_s": 5.0, "amplitude_m": amplitude_m, "direction_rad": towards})
    kick = {"waves.jonswap": None, "start.buoy_velocity_mps": [0.3, 0.1, 0.0]}
    for components in (waves, waves[::-1]):
        columns = simulate(sea(0, 3, **kick, **{"waves.components": components}), periods=2).columns
        across_m = np.abs(columns["x_m"])
        assert np.abs(columns["angle_rad"] - np.arctan2(columns["y_m"], columns["z_m"])).max() < 1e-9
        assert (columns["offplane_m"] >= across_m - 1e-9).all()
        assert columns["offplane_m"].max() == pytest.approx(across_m.max(), rel=0.01)


def jonswap(seed):
    return {"significant_height_m": 1.6, "seed": seed, "components": 20}


@pytest.mark.parametrize("capped", [{}, CAP], ids=["whole", "cap"])
def test_in_space_a_sea_moves_a_line_as_in_its_plane(capped):
    """At the usual tolerance of Newton's method they part by what the series leaves out, which the tolerance bounds."""
    keys = {"waves.jonswap": jonswap(4) | {"significant_height_m": 0.8}, "solver.newton_tolerance": 1e-11, **capped}
    plane, space = (simulate(sea(0, axes, **keys), periods=4) for axes in (2, 3))
    assert plane.statistics["steps"] == space.statistics["steps"]
    for name in ("x_m", "z_m"):
        assert np.abs(plane[name] - space[name]).max() < 1e-9


def test_a_drawn_sea_has_more_waves_for_a_longer_run_unless_a_key_says_how_many():
    drawn = sea(0, **{"waves.jonswap": {"significant_height_m": 1.0}})
    period_s = drawn.waves.period_s
    assert enough_waves(drawn, 512 * period_s) == {}
    assert enough_waves(drawn, 1000 * period_s) == {"waves.jonswap.components": 128}
    stated_sea = sea(0, **{"waves.jonswap": {"significant_height_m": 1.0, "components": 8}})
    assert enough_waves(stated_sea, 1000 * period_s) == {}
    keys = {"waves.jonswap": None, "waves.significant_steepness": 0.1, "waves.relative_width": 0.2}
    assert enough_waves(sea(0, **keys), 1000 * period_s) == {"waves.component_count": 128}
    assert enough_waves(line(), 1000 * period_s) == {}


def test_the_envelope_is_the_slow_amplitude_of_two_waves_and_ends_with_the_ramp():
    waves = [{"period_s": period_s, "amplitude_m": 0.5, "phase_rad": 0.7} for period_s in (5.0, 5.5)]
    scene = load_scene("tethered_buoy", {"waves": {"ramp_s": 10.0, "period_s": 5.0, "components": waves}})
    t = np.linspace(0.0, 200.0, 999)
    ramp = np.where(t < 10.0, np.sin(0.05 * np.pi * t) ** 2, 1.0)
    beat = np.abs(np.cos(np.pi * (1 / 5.0 - 1 / 5.5) * t))
    assert np.abs(envelope_m(scene, t) - ramp * beat).max() < 1e-12


def test_the_surface_over_the_anchor_touches_its_envelope_and_stays_below_it():
    waves = [{"period_s": 5.0, "amplitude_m": 0.5}, {"period_s": 5.5, "amplitude_m": 0.3, "direction_rad": 2.0}]
    place = {"anchor.position_m": [70.0, -30.0, 0.0], "motion.dimensions": 3}
    scene = load_scene("tethered_buoy", {"waves": {"period_s": 5.0, "components": waves}, **place})
    t = np.linspace(0.0, 200.0, 20001)
    share = np.abs(elevation_m(scene, t, *scene.anchor.position_m[:2])) / envelope_m(scene, t)
    assert 1.0 - 1e-5 < share.max() < 1.0 + 1e-9


def test_a_gaussian_sea_has_its_energy_and_its_width_and_without_width_is_a_regular_wave():
    keys = {"waves.jonswap": None, "waves.significant_steepness": 0.1}
    broad = rows_of(sea(0, **keys, **{"waves.relative_width": 0.1, "waves.component_count": 500}))
    energy = broad[:, 6] ** 2 / 2.0
    (regular,) = rows_of(sea(0, **keys, **{"waves.relative_width": 0.0}))
    assert energy.sum() == pytest.approx((2.0 * 0.1 / regular[0]) ** 2 / 16.0, rel=1e-12)
    assert regular[6] ** 2 / 2.0 == pytest.approx(energy.sum(), rel=1e-12)
    ratio = broad[:, 1] / (2.0 * np.pi / 5.0)
    mean = np.sum(energy * ratio) / energy.sum()
    assert mean == pytest.approx(1.0, abs=1e-3)
    assert np.sqrt(np.sum(energy * (ratio - mean) ** 2) / energy.sum()) == pytest.approx(0.1, rel=1e-2)
