"""An exponent carries its unit, converts by eq. (32), and is never a number for want of one."""

import pickle

import numpy as np
import pytest

from analysis.exponents import Exponent, no_exponent


def test_one_bit_a_period_is_ln_2_nats_over_the_period():
    sigma = Exponent(np.log(2.0) / 5.0, 0.1 * np.log(2.0) / 5.0, "nats/time", "method").in_bits_per_period(5.0)
    assert (sigma.value, sigma.error, sigma.unit) == (pytest.approx(1.0), pytest.approx(0.1), "bits/period")
    assert sigma.in_bits_per_period(7.0) is sigma


def test_without_a_value_there_is_a_reason_and_no_error():
    none = no_exponent("method", "nothing qualified")
    assert np.isnan(none.value) and np.isnan(none.error) and not none.found
    assert none.in_bits_per_period(5.0).reason == "nothing qualified"


@pytest.mark.parametrize(
    ("value", "error", "unit"), [(1.0, -0.1, "nats/time"), (1.0, 0.1, "nats"), (np.nan, 0.1, "nats/time")]
)
def test_nonsense_is_refused(value, error, unit):
    with pytest.raises(ValueError):
        Exponent(value, error, unit, "method")


def test_details_are_read_only_and_travel_between_processes():
    record = Exponent(1.0, 0.1, "nats/time", "method", details={"curve": np.arange(3.0)})
    with pytest.raises(TypeError):
        record.details["curve"] = None
    again = pickle.loads(pickle.dumps(record))
    assert again.value == 1.0 and np.array_equal(again.details["curve"], np.arange(3.0))
