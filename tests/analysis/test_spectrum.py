"""Eq. (31): closed forms of tones, Parseval, where its window lies, and records that do not fit it."""

import numpy as np
import pytest

from analysis import spectrum

T = 5.0
STEP = 0.05


def _time(periods, step=STEP):
    return step * np.arange(round(periods * T / step) + 1)


@pytest.mark.parametrize("harmonic", [1, 2, 7, 0.5, 0.25, 0.2, 0.05])
@pytest.mark.parametrize("phase", [0.0, 0.7, 2.5])
def test_a_sine_on_a_bin_has_half_its_amplitude_there_and_nothing_elsewhere(harmonic, phase):
    """(1/nT) int a cos(w t + p) e^{iwt} dt = (a/2) e^{-ip} over whole periods; subharmonics up to n do not leak."""
    a, t = 0.37, _time(60)
    s = spectrum(a * np.cos(2 * np.pi * harmonic / T * t + phase), STEP, T)
    line = round(20 * harmonic)
    assert s.angular_frequency_radps[line] == pytest.approx(2 * np.pi * harmonic / T, rel=1e-14)
    assert s.transform[line] == pytest.approx(0.5 * a * np.exp(-1j * phase), abs=1e-13)
    assert np.delete(s.amplitude, line).max() < 1e-13


def test_the_rest_value_changes_only_bin_zero():
    rng = np.random.default_rng(1)
    x = rng.normal(size=len(_time(60)))
    assert np.allclose(spectrum(x, STEP, T).transform[1:], spectrum(x + 3.0, STEP, T).transform[1:], atol=1e-13)


def test_a_tone_between_bins_agrees_with_the_integral_to_second_order_of_the_step():
    """(1/L) int_0^L cos(nu t) e^{iwt} dt in closed form; the trapezoid rule's error falls as step^2."""
    nu, length = 0.996, 20 * T
    errors = []
    for step in (0.1, 0.05, 0.025):
        t = _time(60, step)
        s = spectrum(np.cos(nu * t), step, T)
        w = s.angular_frequency_radps[:60]
        begin, end = 40 * T, 40 * T + length
        exact = 0.0
        for rate in (w + nu, w - nu):
            exact = exact + (np.exp(1j * rate * end) - np.exp(1j * rate * begin)) / (2j * rate * length)
        errors.append(np.abs(s.transform[:60] - exact).max())
    assert np.log2(errors[0] / errors[1]) == pytest.approx(2.0, abs=0.1)
    assert np.log2(errors[1] / errors[2]) == pytest.approx(2.0, abs=0.1)
    assert errors[2] < 1e-4


@pytest.mark.parametrize("samples", [200, 201])
def test_squares_of_both_sides_add_up_to_the_mean_square(samples):
    """|X_0|^2 + 2 sum |X_j|^2 = mean of x^2 over one repeat; the line at half the sampling rate has no mirror image."""
    rng = np.random.default_rng(samples)
    window = rng.normal(size=samples)
    x = np.concatenate([rng.normal(size=3 * samples), window, window[:1]])
    s = spectrum(x, 1.0, float(samples), start_periods=3, periods=1)
    weight = np.full(len(s.amplitude), 2.0)
    weight[0] = 1.0
    if samples % 2 == 0:
        weight[-1] = 1.0
    assert np.sum(weight * s.amplitude**2) == pytest.approx(np.mean(window**2), rel=1e-13)


def test_the_sum_is_linear():
    rng = np.random.default_rng(3)
    x, y = rng.normal(size=(2, 401))
    together = spectrum(2 * x - 3 * y, 0.5, 10.0, start_periods=5, periods=12).transform
    apart = [spectrum(z, 0.5, 10.0, start_periods=5, periods=12).transform for z in (x, y)]
    assert np.allclose(together, 2 * apart[0] - 3 * apart[1], atol=1e-14)


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
