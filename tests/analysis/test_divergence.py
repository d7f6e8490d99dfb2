"""Rosenstein's and Kantz's exponents, and the scaling region without which there is none."""

import numpy as np
import pytest

from analysis.divergence import kantz_lyapunov, rosenstein_lyapunov, scaling_region
from tests.analysis.systems import TRUTH, record, two_tone

METHODS = pytest.mark.parametrize("method", [rosenstein_lyapunov, kantz_lyapunov])
T = 0.1 * np.arange(200)


def test_a_line_between_two_plateaus_is_found_with_its_slope():
    region = scaling_region(T, np.clip(0.7 * (T - 4.0), 0.0, 5.0))
    assert region.slope == pytest.approx(0.7, rel=0.08)
    assert region.span > 4.0
    assert T[region.begin] > 3.0 and T[region.end] < 12.2


def test_a_swing_that_rides_on_the_line_is_averaged_away():
    assert scaling_region(T, 0.5 * T + np.sin(2 * np.pi * T), cycle=10).slope == pytest.approx(0.5, rel=0.03)


@pytest.mark.parametrize(
    "curve", [0.04 * np.arange(20.0), np.zeros(20), -np.arange(20.0), np.log1p(np.arange(40.0)) / 4]
)
def test_less_than_a_nat_is_refused(curve):
    region = scaling_region(np.arange(float(len(curve))), curve)
    assert np.isnan(region.slope) and region.begin == -1
    assert "no straight" in region.reason


@METHODS
@pytest.mark.parametrize("name", ["henon", "logistic"])
def test_maps_within_a_tenth(method, name):
    found = method(*record(name))
    assert found.value == pytest.approx(TRUTH[name], rel=0.1)
    assert found.details["region"].span >= 1.0 and found.details["region"].slope == found.value


@pytest.mark.slow
@pytest.mark.parametrize("name", ["lorenz", "rossler", "ueda"])
def test_flows_within_a_fifth_by_rosenstein(name):
    assert rosenstein_lyapunov(*record(name)).value == pytest.approx(TRUTH[name], rel=0.2)


@METHODS
@pytest.mark.parametrize(
    "series",
    [two_tone(), np.sin(0.1 * np.arange(5000)), np.random.default_rng(0).normal(size=5000), np.ones(5000)],
    ids=["two tones", "sine", "white noise", "constant"],
)
def test_regular_motion_and_noise_have_none(method, series):
    found = method(series, 0.1)
    assert np.isnan(found.value) and found.reason


@METHODS
def test_settings_of_ones_own_are_used(method):
    own = {"delay": 1, "dimension": 3, "theiler": 4, "horizon": 15}
    details = method(*record("henon"), **own).details
    assert (details["dimension"], details["theiler"], details["embedding"].lag, len(details["curve"])) == (3, 4, 1, 16)
    assert kantz_lyapunov(*record("henon"), radius=0.05).details["radius"] == 0.05


@METHODS
def test_units_scale(method):
    x, step = record("rossler", 6000)
    assert method(-4.0 * x, 2.0 * step).value == pytest.approx(0.5 * method(x, step).value, rel=1e-9)


def test_a_series_of_two_values_has_no_radius():
    """Most of its delay vectors coincide: the eighth neighbour is at distance 0."""
    found = kantz_lyapunov(np.sign(np.sin(0.7 * 0.1 * np.arange(2000)) + 0.1), 0.1)
    assert not found.found and "too few different values" in found.reason
