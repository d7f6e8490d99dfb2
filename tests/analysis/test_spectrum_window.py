"""Where the window of eq. (31) lies, and what happens when it does not fit the samples or the record."""

import numpy as np
import pytest

from analysis import spectrum

T = 5.0


@pytest.mark.parametrize("shift", [1, 3])
def test_moving_a_window_over_a_periodic_motion_changes_nothing(shift):
    """The phase counts from the first sample, not from tau_0: a T-periodic motion looks the same from every period."""
    t = 0.05 * np.arange(7001)
    x = np.exp(np.sin(2 * np.pi / T * t))
    here = spectrum(x, 0.05, T, start_periods=40)
    there = spectrum(x, 0.05, T, start_periods=40 + shift)
    assert np.allclose(here.transform, there.transform, atol=1e-13)


@pytest.mark.parametrize("shift", [0.37, 1.0, 12.6])
def test_delaying_the_record_turns_the_phase_of_a_line(shift):
    """x(t - d) has e^{i w d} X(w) for a motion on the bins."""
    t = 0.05 * np.arange(1501)

    def x(time):
        return np.cos(2 * np.pi / T * time) + 0.2 * np.sin(2 * np.pi / (2 * T) * time)

    plain = spectrum(x(t), 0.05, T, start_periods=3, periods=10)
    delayed = spectrum(x(t - shift), 0.05, T, start_periods=3, periods=10)
    turned = plain.transform * np.exp(1j * plain.angular_frequency_radps * shift)
    assert np.allclose(delayed.transform, turned, atol=1e-13)


def test_the_window_begins_at_tau_0_and_ends_n_periods_later():
    """Only the samples in [tau_0, tau_0 + n T] count, the two ends by half."""
    step, begin, end = 0.5, 40, 60  # 4 periods in, 2 periods long
    for sample, weight in ((begin - 1, 0.0), (begin, 0.5), (begin + 1, 1.0), (end, 0.5), (end + 1, 0.0)):
        x = np.zeros(101)
        x[sample] = 1.0
        s = spectrum(x, step, T, start_periods=4, periods=2)
        assert s.amplitude[0] == pytest.approx(weight / (end - begin), abs=1e-15)


def test_a_start_between_samples_or_a_period_between_samples_is_interpolated_to_fourth_order():
    """The largest error over many starts, since it depends on where a start falls between samples."""
    period = 4.7123
    starts = 2 + np.linspace(0, 1, 60, endpoint=False)
    steps = np.array([0.2, 0.1, 0.05, 0.025])
    errors = []
    for step in steps:
        t = step * np.arange(int(np.ceil(13 * period / step)) + 1)
        lines = [spectrum(np.cos(2 * np.pi / period * t + 0.4), step, period, start, 10) for start in starts]
        assert all(s.interpolated for s in lines)
        errors.append(max(abs(s.transform[10] - 0.5 * np.exp(-0.4j)) for s in lines))
    assert np.polyfit(np.log(steps), np.log(errors), 1)[0] == pytest.approx(4.0, abs=0.1)
    assert errors[0] < 1e-4


def test_a_period_of_whole_steps_uses_the_samples_themselves_despite_rounding():
    t = 0.05 * np.arange(6001)
    assert not spectrum(np.sin(t), 0.05, 5.0).interpolated
    assert not spectrum(np.sin(t), 0.1 + 0.2 - 0.25, 5.0).interpolated


def test_a_short_record_is_refused_with_what_is_needed_and_given():
    complete = np.zeros(6001)
    spectrum(complete, 0.05, 5.0)
    with pytest.raises(ValueError, match=r"needs 60 forcing periods.*300 s.*given 59\.99.*299\.95 s"):
        spectrum(complete[:-1], 0.05, 5.0)
    with pytest.raises(ValueError, match=r"needs 60 forcing periods.*given 0 "):
        spectrum([], 0.05, 5.0)
