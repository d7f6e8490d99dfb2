"""The tethered buoy of Table 1 against independent codes: no number below comes from this engine.

Each run takes about a second.
"""

import numpy as np
import pytest

from analysis import detect_period
from tests.engine.lines import line, ran


def buoy(steepness, depth_m, changes=None):
    given = {"waves.steepness": steepness, "water.depth_m": depth_m, "water.density_kgpm3": 1027.0}
    return line(given, changes or {})


@pytest.mark.parametrize(
    "depth_m, density_kgpm3, periods, radius_m, tension_N",
    [
        (22.5, 1027.0, 60, (20.391, 21.186), (980, 2965)),
        (22.5, 1025.0, 60, (20.380, 21.172), (950, 2932)),
        (25.0, 1027.0, 10, (20.522, 21.065), (1305, 2662)),
        (21.6, 1027.0, 10, (20.333, 21.241), (833, 3103)),
    ],
)
def test_ranges_in_small_waves(depth_m, density_kgpm3, periods, radius_m, tension_N):
    columns = ran(buoy(0.016, depth_m, {"water.density_kgpm3": density_kgpm3}), periods).columns
    r, low, high = columns["radius_m"], columns["tension_top_low_N"], columns["tension_top_high_N"]
    assert r.min() == pytest.approx(radius_m[0], abs=2e-3) and r.max() == pytest.approx(radius_m[1], abs=2e-3)
    assert low.min() == pytest.approx(tension_N[0], abs=5) and high.max() == pytest.approx(tension_N[1], abs=5)


STEEP_S = np.array([10.0, 18.0, 26.0, 34.0, 42.0, 50.0])
STEEP_M = np.array([19.49, 15.74, 20.38, 23.10, 17.32, 15.22])


@pytest.mark.parametrize(
    "changes, bound_m",
    [
        ({}, 0.03),
        ({"solver.rtol": 1e-4, "tether.nodes": 81}, 0.01),
        *(({"solver.max_step_s": longest}, 0.03) for longest in (0.1, 0.097, 0.09, 0.08, 0.05)),
    ],
)
def test_radius_in_steep_waves_to_50_seconds(changes, bound_m):
    """The line buckles at 26.15 s to the side that angles of 1 mrad choose, not to one that the steps choose."""
    columns = ran(buoy(0.13, 21.6, changes), 10).columns
    r = np.interp(STEEP_S, columns["time_s"], columns["radius_m"])  # samples every 0.05 s lie on these times
    assert np.abs(r - STEEP_M).max() <= bound_m


def test_steep_waves_run_to_the_end():
    run = ran(buoy(0.13, 21.6), 100)
    assert len(run.columns["time_s"]) == 100 * 100 + 1
    assert run.message.startswith("the sphere was in the air") and ";" not in run.message
    assert all(np.all(np.isfinite(column)) for column in run.columns.values())
    releases = run.columns["loop_releases"]  # the loops of a plane are counted, and it is known when
    assert 0 < releases[-1] <= run.statistics["loop_releases"] and np.all(np.diff(releases, prepend=0.0) >= 0.0)


def branches(scene, periods=300, last=60):
    """Strobed r by parity over the last periods, lower branch first (last/2, 2), and the period found."""
    columns = ran(scene, periods).columns
    strobed = np.stack([columns["radius_m"], columns["angle_rad"]], 1)[::100]
    # 1 % of the range within a period, 8 mm in r: the branches are 18 % apart, the step control scatters them by 0.2 %
    range_within_a_period = [np.ptp(columns[name][-600:]) for name in ("radius_m", "angle_rad")]
    estimate = detect_period(strobed[-100:], max_period=8, tolerance=0.01, scale=range_within_a_period)
    pairs = strobed[-last:, 0].reshape(-1, 2)
    return pairs[:, np.argsort(pairs.mean(axis=0))], estimate


@pytest.mark.slow
def test_period_two_at_depth_22_5():
    means = {}
    for rtol in (0.03, 0.003):
        pairs, estimate = branches(buoy(0.13, 22.5, {"solver.rtol": rtol}))
        assert estimate.period == 2, estimate.reason
        means[rtol] = pairs.mean(axis=0)
        # two values, not two bands: the scatter about them is small beside their distance, 145 mm
        assert pairs.std(axis=0).max() < 2e-3
        assert np.abs(means[rtol] - [21.520, 21.665]).max() < 5e-3
    assert np.abs(means[0.03] - means[0.003]).max() < 2e-3
