"""Lines are found where they are, and a given frequency is never further than half a bin from its line."""

import numpy as np
import pytest

from analysis import peaks_near, spectral_peaks, spectrum

T = 5.0
TIME = 0.05 * np.arange(6001)
WAVE = 2 * np.pi / T


def test_lines_come_largest_first_at_their_bins():
    x = 5.0 + 0.1 * np.cos(WAVE * TIME) + 0.3 * np.cos(WAVE / 4 * TIME) + 0.02 * np.cos(3 * WAVE * TIME)
    peaks = spectral_peaks(spectrum(x, 0.05, T))
    assert [peak.bin for peak in peaks] == [5, 20, 60]
    assert [peak.amplitude for peak in peaks] == pytest.approx([0.15, 0.05, 0.01], abs=1e-12)


@pytest.mark.parametrize("natural", [0.199, 0.55, 0.996])
@pytest.mark.parametrize("phase", [0.0, 1.0, 2.0])
def test_a_natural_frequency_beside_the_forcing_is_found_within_half_a_bin(natural, phase):
    x = 20.8 + 0.1 * np.cos(natural * TIME + phase) + 0.2 * np.cos(WAVE * TIME)
    found = peaks_near(spectrum(x, 0.05, T), [natural, WAVE])
    assert [peak.reference_radps for peak in found] == [natural, WAVE]
    assert abs(found[0].bins_away) <= 0.5 + 1e-9
    assert found[1].bins_away == pytest.approx(0.0, abs=1e-9)
    assert found[0].angular_frequency_radps - natural == pytest.approx(found[0].bins_away * 2 * np.pi / (20 * T))


def test_a_constant_added_to_the_motion_changes_no_peak():
    x = np.cos(WAVE * TIME) + 0.3 * np.sin(0.3 * TIME)
    plain, lifted = (spectral_peaks(spectrum(x + rest, 0.05, T)) for rest in (0.0, 1e3))
    assert [peak.bin for peak in plain] == [peak.bin for peak in lifted]


def test_a_line_at_the_first_bin_is_a_peak():
    peaks = spectral_peaks(spectrum(9.0 + np.cos(WAVE / 20 * TIME), 0.05, T))
    assert [peak.bin for peak in peaks] == [1]


@pytest.mark.parametrize("rest", [0.0, 20.8])
def test_a_motion_at_rest_has_no_peak(rest):
    s = spectrum(np.full(6001, rest), 0.05, T)
    assert spectral_peaks(s) == ()
    assert peaks_near(s, [1.0]) == (None,)


def test_small_lines_count_only_when_asked_for():
    s = spectrum(np.cos(WAVE * TIME) + 0.005 * np.cos(2 * WAVE * TIME), 0.05, T)
    assert len(spectral_peaks(s)) == 1
    assert len(spectral_peaks(s, least_prominence=0.004)) == 2
    for share in (0.0, 1.5):
        with pytest.raises(ValueError, match="least_prominence"):
            spectral_peaks(s, least_prominence=share)
