"""Eq. (31) on signals whose integral is known in closed form."""

import numpy as np
import pytest

from analysis import spectrum

T = 5.0
STEP = 0.05


def _time(periods, step=STEP):
    return step * np.arange(round(periods * T / step) + 1)


@pytest.mark.parametrize("harmonic", [1, 2, 7])
@pytest.mark.parametrize("phase", [0.0, 0.7, 2.5])
def test_a_sine_on_a_bin_has_half_its_amplitude_there_and_nothing_elsewhere(harmonic, phase):
    """(1/nT) int a cos(w t + p) e^{iwt} dt = (a/2) e^{-ip} over whole periods."""
    a, t = 0.37, _time(60)
    s = spectrum(a * np.cos(2 * np.pi * harmonic / T * t + phase), STEP, T)
    line = 20 * harmonic
    assert s.angular_frequency_radps[line] == pytest.approx(2 * np.pi * harmonic / T, rel=1e-14)
    assert s.transform[line] == pytest.approx(0.5 * a * np.exp(-1j * phase), abs=1e-13)
    assert np.delete(s.amplitude, line).max() < 1e-13


def test_subharmonics_up_to_the_number_of_periods_do_not_leak():
    t = _time(60)
    for order in (2, 4, 5, 20):
        s = spectrum(np.sin(2 * np.pi / (order * T) * t), STEP, T)
        line = 20 // order
        assert s.amplitude[line] == pytest.approx(0.5, abs=1e-13)
        assert np.delete(s.amplitude, line).max() < 1e-13


def test_two_tones_and_an_offset_add():
    t = _time(60)
    first, second = 2 * np.pi / T, 2 * np.pi * 7 / (20 * T)
    s = spectrum(20.8 + 0.3 * np.cos(first * t) + 0.1 * np.cos(second * t), STEP, T)
    assert s.amplitude[0] == pytest.approx(20.8, rel=1e-14)
    assert s.amplitude[20] == pytest.approx(0.15, abs=1e-13)
    assert s.amplitude[7] == pytest.approx(0.05, abs=1e-13)
    assert np.delete(s.amplitude, [0, 7, 20]).max() < 1e-12


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


def test_bins_are_spaced_by_the_inverse_of_the_window():
    s = spectrum(np.zeros(len(_time(9))), STEP, T, start_periods=2, periods=7)
    assert np.allclose(np.diff(s.angular_frequency_radps), 2 * np.pi / (7 * T))
    assert s.bin_radps == pytest.approx(2 * np.pi / (7 * T))
