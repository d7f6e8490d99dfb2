"""One bad sample or a step without meaning stops every measure, by name."""

import numpy as np
import pytest

import analysis

CALLS = {
    "spectrum": lambda x: analysis.spectrum(x, 0.1, 5.0, 0, 1),
    "poincare_section": lambda x: analysis.poincare_section(x, 0.1, 5.0),
    "poincare_section by name": lambda x: analysis.poincare_section({"radius_m": x}, 0.1, 5.0),
    "orbit_diagram": lambda x: analysis.orbit_diagram([1.0], [x]),
    "detect_period": lambda x: analysis.detect_period(x),
    "slack_fraction": lambda x: analysis.slack_fraction(x, 0.1),
    "extremes": lambda x: analysis.extremes(x, 0.1),
    "zero_one_test": lambda x: analysis.zero_one_test(x),
    "growth_or_bursts": lambda x: analysis.growth_or_bursts(x, 0.1, 5.0),
    "wolf_lyapunov": lambda x: analysis.wolf_lyapunov(x, 0.1),
    "kantz_lyapunov": lambda x: analysis.kantz_lyapunov(x, 0.1),
    "tangent_lyapunov": lambda x: analysis.tangent_lyapunov(x),
    "record_drift": lambda x: analysis.record_drift(x),
    "neighbour_growth": lambda x: analysis.neighbour_growth(x),
    "prediction_gain": lambda x: analysis.prediction_gain(x),
    "correlation_dimension": lambda x: analysis.correlation_dimension(x),
    "spectral_lines": lambda x: analysis.spectral_lines(x),
    "regime": lambda x: analysis.regime(strobed=x),
}


@pytest.mark.parametrize("call", CALLS.values(), ids=CALLS)
@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_values_that_are_not_finite_are_refused_with_their_place(call, bad):
    x = np.zeros(101)
    call(x)
    x[[17, 40]] = bad
    with pytest.raises(ValueError, match=r"2 value\(s\) not finite, the first at index 17"):
        call(x)


def test_the_coordinate_with_the_bad_sample_is_named():
    with pytest.raises(ValueError, match=r"series\['angle_rad'\].*index 3"):
        analysis.poincare_section({"radius_m": np.zeros(9), "angle_rad": [0, 0, 0, np.nan, 0, 0, 0, 0, 0]}, 1.0, 5.0)


@pytest.mark.parametrize("step", [0.0, -0.1, np.nan, np.inf])
def test_a_step_that_is_no_positive_number_is_refused(step):
    x = np.zeros(101)
    for call in (
        lambda: analysis.spectrum(x, step, 5.0),
        lambda: analysis.poincare_section(x, step, 5.0),
        lambda: analysis.slack_fraction(x, step),
        lambda: analysis.extremes(x, step),
    ):
        with pytest.raises(ValueError, match="step_s"):
            call()


def test_the_arrays_given_are_left_alone():
    x = np.random.default_rng(0).normal(size=101)
    before = x.copy()
    for call in CALLS.values():
        call(x)
    assert np.array_equal(x, before) and x.flags.writeable
