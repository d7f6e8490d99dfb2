"""Eq. (31): closed forms of tones, Parseval, its window, records that do not fit it, and its highest lines."""

import numpy as np
import pytest

from analysis import peaks_near, spectral_peaks, spectrum
from tests.analysis.systems import normal

T = 5.0
STEP = 0.05
TIME = STEP * np.arange(6001)
WAVE = 2 * np.pi / T


@pytest.mark.parametrize("harmonic", [1, 2, 7, 0.5, 0.25, 0.2, 0.05])
@pytest.mark.parametrize("phase", [0.0, 0.7, 2.5])
def test_a_sine_on_a_bin_has_half_its_amplitude_there_and_nothing_elsewhere(harmonic, phase):
    """(1/nT) int a cos(w t + p) e^{iwt} dt = (a/2) e^{-ip} over whole periods; subharmonics up to n do not leak."""
    s = spectrum(0.37 * np.cos(WAVE * harmonic * TIME + phase), STEP, T)
    line = round(20 * harmonic)
    assert s.angular_frequency_radps[line] == pytest.approx(WAVE * harmonic, rel=1e-14)
    assert s.transform[line] == pytest.approx(0.5 * 0.37 * np.exp(-1j * phase), abs=1e-13)
    assert np.delete(s.amplitude, line).max() < 1e-13


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
        errors.append(max(abs(s.transform[10] - 0.5 * np.exp(-0.4j)) for s in lines))
    assert np.polyfit(np.log(steps), np.log(errors), 1)[0] == pytest.approx(4.0, abs=0.1)
    assert errors[0] < 1e-4


def test_a_period_of_whole_steps_uses_the_samples_themselves_despite_rounding():
    x = normal(0, len(TIME))
    exact, rounded = (spectrum(x, STEP, period).amplitude for period in (5.0, 5.0 * (0.1 + 0.2) / 0.3))
    assert np.array_equal(exact, rounded)
    assert [spectrum(x, STEP, period).interpolated for period in (5.0, 4.999)] == [False, True]


@pytest.mark.parametrize("rest", [0.0, 5.0, 1e3])
def test_lines_come_largest_first_at_their_bins_whatever_constant_is_added(rest):
    x = 0.1 * np.cos(WAVE * TIME) + 0.3 * np.cos(WAVE / 4 * TIME) + 0.02 * np.cos(3 * WAVE * TIME)
    peaks = spectral_peaks(spectrum(rest + x, STEP, T))
    assert [peak.angular_frequency_radps for peak in peaks] == pytest.approx([WAVE / 4, WAVE, 3 * WAVE])
    assert [peak.amplitude for peak in peaks] == pytest.approx([0.15, 0.05, 0.01], abs=1e-12)
    assert [peak.bin for peak in peaks] == [5, 20, 60]
    (first,) = spectral_peaks(spectrum(rest + np.cos(WAVE / 20 * TIME), STEP, T))
    assert first.angular_frequency_radps == pytest.approx(WAVE / 20)


@pytest.mark.parametrize("natural", [0.199, 0.55, 0.996])
def test_a_natural_frequency_beside_the_forcing_is_found_within_half_a_bin(natural):
    x = 20.8 + 0.1 * np.cos(natural * TIME + 1.0) + 0.2 * np.cos(WAVE * TIME)
    line, wave = peaks_near(spectrum(x, STEP, T), [natural, WAVE])
    assert abs(line.bins_away) <= 0.5 + 1e-9 and (line.reference_radps, wave.reference_radps) == (natural, WAVE)
    assert wave.bins_away == pytest.approx(0.0, abs=1e-9)
    assert line.angular_frequency_radps - natural == pytest.approx(line.bins_away * 2 * np.pi / (20 * T))


@pytest.mark.parametrize("rest", [0.0, 20.8])
def test_a_motion_at_rest_has_no_peak(rest):
    s = spectrum(np.full(6001, rest), STEP, T)
    assert spectral_peaks(s) == () and peaks_near(s, [1.0]) == (None,)


def test_small_lines_count_only_when_asked_for():
    s = spectrum(np.cos(WAVE * TIME) + 0.005 * np.cos(2 * WAVE * TIME), STEP, T)
    assert [len(spectral_peaks(s, least)) for least in (0.01, 0.004)] == [1, 2]
