"""Law: a few waves carry what all waves of a sea do, to rounding, within their region; outside it all waves are summed.
The surface at the buoy is that of the sea, with its slopes and rates.
"""

import numpy as np
import pytest

from engine.physics.sea import elevation_m
from engine.physics.sea_basis import LEFT_OVER, combinations, few_waves
from engine.physics.sea_series import surface_of_series
from tests.engine.kernels import SeaLine, waves_at
from tests.engine.lines import line
from tests.engine.physics.caps import CAP
from tests.engine.physics.test_sea_sum import DEPTH, plain_sum


def long_sea(components=320, **changes):
    jonswap = {"significant_height_m": 1.6, "seed": 3, "components": components}
    return line({"water.depth_m": DEPTH, "waves.jonswap": jonswap, "waves.above_still_water": "extrapolate"}, changes)


@pytest.mark.parametrize("components", [64, 320])
@pytest.mark.parametrize("farthest_m", [0.5, 19.9, 20.1, 60.0])
def test_few_waves_are_the_plain_sum(components, farthest_m):
    """At some places the line lies within the reach of 20 m, at others not."""
    scene = long_sea(components)
    few = few_waves(scene)
    assert 0 < len(few.shares) <= 40 and few.wide == 20.0
    for t in (3.0, 1e4):
        X = np.column_stack([np.linspace(0.0, farthest_m, 30), np.linspace(0.0, DEPTH + 1.5, 30)])
        exact = plain_sum(scene, t, X)
        errors = np.abs(waves_at(scene, t, X) - exact).max(axis=0)
        assert np.all(errors <= 1e-12 * np.abs(exact).max(axis=0))


def test_few_waves_serve_only_where_they_are_taken():
    """With other shares the field near the anchor is another one; the field beyond the reach is not."""
    own, wrong = SeaLine(long_sea(), 5), SeaLine(long_sea(), 5)
    wrong.tables[wrong.p["sea_few_at"] :] = 0.0
    for farthest_m, served in ((19.0, True), (21.0, False)):
        X = np.column_stack([np.linspace(0.0, farthest_m, 5), np.linspace(0.0, DEPTH, 5)])
        assert np.array_equal(own.water(3.0, X), wrong.water(3.0, X)) != served


@pytest.mark.parametrize(
    "changes",
    [
        {"tether.length_m": 2000.0, "water.depth_m": 2080.0},
        {"waves.period_s": 1.0, "waves.jonswap": {"significant_height_m": 0.05, "components": 64}},
    ],
)
def test_a_line_of_many_wave_lengths_has_no_few_waves(changes):
    assert len(few_waves(long_sea(64, **changes)).shares) == 0


def test_columns_are_combinations_of_the_chosen_ones():
    """A matrix of rank 11 with 60 columns; and one of full rank."""
    rng = np.random.default_rng(2)
    samples = rng.normal(size=(80, 11)) @ rng.normal(size=(11, 60)) + 1e-17 * rng.normal(size=(80, 60))
    columns, shares = combinations(samples, 40)
    assert len(columns) == 16 and np.all(np.diff(columns) > 0)
    assert np.abs(samples - samples[:, columns] @ shares).max() <= 100 * LEFT_OVER * np.abs(samples).max()
    assert not len(combinations(rng.normal(size=(80, 60)), 40)[0])


def test_the_surface_at_the_buoy_is_that_of_the_sea():
    """Its derivatives by central differences of step h, about the place and time of the series, within a ramp."""
    scene = long_sea(64, **CAP, **{"waves.ramp_s": 20.0})
    t, x, h = 7.0, 1.3, 1e-3
    upper = SeaLine(scene, 2)
    upper.water(t, np.array([[0.0, 0.0], [x, DEPTH]]))

    def eta(steps, later=0.0):
        return float(elevation_m(scene, t + later, x + steps * h))

    by_x, by_t = (eta(1) - eta(-1)) / (2 * h), (eta(0, h) - eta(0, -h)) / (2 * h)
    curve = (eta(1) - 2 * eta(0) + eta(-1)) / h**2
    mixed = (eta(1, h) - eta(-1, h) - eta(1, -h) + eta(-1, -h)) / (4 * h**2)
    assert surface_of_series(upper.series) == pytest.approx((eta(0), by_x, curve, by_t, mixed), rel=1e-5, abs=1e-7)


@pytest.mark.parametrize("share", [-0.99, 0.5])
def test_the_surface_holds_as_long_as_the_series_does(share):
    """To the error of the water's speed that the series may have, over the frequency of the peak."""
    scene = long_sea(64, **CAP)
    upper, X = SeaLine(scene, 2), np.array([[0.0, 0.0], [1.3, DEPTH]])
    upper.water(50.0, X)
    t, moved = 50.0 + share * upper.p["sea_span"], X.copy()
    moved[1, 0] += (0.99 - abs(share)) * upper.p["sea_reach"]
    upper.water(t, moved)
    assert upper.summed_s == 50.0
    error_m = abs(surface_of_series(upper.series)[0] - float(elevation_m(scene, t, moved[1, 0])))
    assert 0.0 < error_m < 3.0 * upper.p["newton_tolerance"] / upper.p["per_speed"] / upper.p["omega"]
