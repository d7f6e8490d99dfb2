"""Amplitude spectrum of a forced motion, eq. (31) of the paper exactly as printed, and the peaks in it.

    X(w) = 1/(n T_i)  integral from tau_0 to tau_0 + n T_i of  x(t) e^{i w t} dt                              (31)

No window, no removal of the mean: the integral spans n whole forcing periods, so at the bins w_j = 2 pi j/(n T_i) the
forcing and all its harmonics and subharmonics of order up to n fall on bins and do not leak. Whatever is not a multiple
of 2 pi/(n T_i), a natural frequency for one, spreads over the bins beside it as 1/(distance in bins).

In the paper: eq. (31) spectral amplitude.
"""

from collections.abc import Iterable
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from analysis.sampling import (
    ON_SAMPLE,
    checked_count,
    checked_not_negative,
    checked_positive,
    checked_series,
    record,
    record_of_numbers,
    values_at,
)


@record
class Spectrum:
    """Eq. (31) at its bins.

    angular_frequency_radps (m,)  w_j = j bin_radps, j = 0 ... up to half the sampling rate
    transform (m,) complex        X(w_j), unit of the series; t in e^{i w t} counts from the first sample
    amplitude (m,)                |X(w_j)|: HALF the amplitude of a sine at bin j >= 1; at j = 0 the size of the mean
    bin_radps                     2 pi/(n T_i)
    periods                       n
    interpolated                  True where the window was resampled because its ends are not on samples
    """

    angular_frequency_radps: np.ndarray
    transform: np.ndarray
    amplitude: np.ndarray
    bin_radps: float
    periods: int
    interpolated: bool


@record_of_numbers
class SpectralPeak:
    """A local maximum of a spectrum; beside a reference frequency where one was asked for.

    angular_frequency_radps, amplitude   of the bin
    bin                                  its index j
    reference_radps                      the frequency it was compared with, or None
    bins_away                            (w_j - reference)/bin width, signed; None without a reference
    """

    angular_frequency_radps: float
    amplitude: float
    bin: int
    reference_radps: float | None = None
    bins_away: float | None = None


def spectrum(
    series: ArrayLike, step_s: float, forcing_period_s: float, start_periods: float = 40, periods: int = 20
) -> Spectrum:
    """Eq. (31) of a record that reaches over tau_0 + n T_i, by the composite trapezoid rule on the sample grid.

        X(w_j) = e^{i w_j tau_0} / M * [ (x_0 + x_M)/2 + sum_{k=1}^{M-1} x_k e^{2 pi i j k/M} ],   M = n T_i/step

    On these bins the rule is exact for every harmonic below half the sampling rate. The paper's series is the excursion
    from rest; the rest value changes bin 0 alone, so a whole r(t) will do.

    series (k,)          samples from t = 0, any unit
    step_s               sampling step [s]
    forcing_period_s     T_i [s]
    start_periods        tau_0/T_i; 40 in the paper's fig. 12
    periods              n, whole; 20 in the paper's fig. 12
    Returns a Spectrum. Where tau_0 or n T_i is no multiple of the step, the window is resampled by cubic splines onto
    the next finer grid that fits, and the record says so.
    Raises ValueError for a record that ends before tau_0 + n T_i (says how many periods are needed and given), and for
    values that are not finite.
    Source: Tjavaras et al. 1998, eq. (31) and the lines below it.
    """
    x = checked_series(series)
    step_s = checked_positive(step_s, "step_s")
    forcing_period_s = checked_positive(forcing_period_s, "forcing_period_s")
    start_periods = checked_not_negative(start_periods, "start_periods")
    periods = checked_count(periods, "periods")
    begin_s, window_s = start_periods * forcing_period_s, periods * forcing_period_s
    given_s = max(len(x) - 1, 0) * step_s
    if given_s < begin_s + window_s - ON_SAMPLE * step_s:
        parts = f"{start_periods:g} before the window and {periods} in it; {begin_s + window_s:g} s"
        wanted = f"eq. (31) needs {start_periods + periods:g} forcing periods ({parts}) of record"
        raise ValueError(f"{wanted}, given {given_s / forcing_period_s:.4g} ({given_s:g} s)")
    # As sampled where the window fits, else the next whole number above (never coarser).
    intervals = max(int(np.ceil(window_s / step_s - ON_SAMPLE)), 2)
    window, interpolated = values_at(x, step_s, begin_s + window_s / intervals * np.arange(intervals + 1))
    folded = window[:-1].copy()
    folded[0] = 0.5 * (window[0] + window[-1])  # both ends carry weight 1/2 and the same e^{i w_j t}
    bins = np.arange(intervals // 2 + 1)
    # e^{+i w t}, as printed, is numpy's inverse transform; start_periods/periods keeps the phase exact for large tau_0.
    transform = np.fft.ifft(folded)[bins] * np.exp(2j * np.pi * np.mod(bins * (start_periods / periods), 1.0))
    bin_radps = 2.0 * np.pi / window_s
    return Spectrum(bin_radps * bins, transform, np.abs(transform), bin_radps, periods, interpolated)


def spectral_peaks(spectrum: Spectrum, least_prominence: float = 0.01) -> tuple[SpectralPeak, ...]:
    """The local maxima of a spectrum that stand out, largest first.

    A maximum counts when it rises above the higher of the two valleys that part it from higher ground by at least
    `least_prominence` times the largest amplitude outside bin 0. Bin 0 is taken as zero: the mean is no oscillation,
    and a constant added to the series must not change the list. A slow drift therefore shows as a peak at bin 1.

    Returns a tuple of SpectralPeak without reference; empty for a constant series.
    Raises ValueError unless 0 < least_prominence <= 1.
    """
    if not 0.0 < least_prominence <= 1.0:
        raise ValueError(f"least_prominence: a share in (0, 1] is needed, given {least_prominence!r}")
    from scipy.signal import find_peaks

    amplitude = np.array(spectrum.amplitude)
    # What summation leaves of a constant (a few eps of it in each bin) is not a line.
    noise = 64 * np.finfo(float).eps * amplitude[0]
    amplitude[0] = 0.0
    largest = amplitude.max()
    if largest <= noise:
        return ()
    indices, _ = find_peaks(amplitude, prominence=least_prominence * largest)
    return tuple(
        SpectralPeak(spectrum.angular_frequency_radps[j], amplitude[j], j)
        for j in indices[np.argsort(-amplitude[indices], kind="stable")]
    )


def peaks_near(
    spectrum: Spectrum, frequencies_radps: Iterable[float], least_prominence: float = 0.01
) -> tuple[SpectralPeak | None, ...]:
    """For each given frequency, the nearest peak and by how many bins it misses.

        bins_away = (w_peak - w_given)/(2 pi/(n T_i))

    A line lies at best half a bin away, since bins are all that eq. (31) offers; within 1 is agreement.

    frequencies_radps    numbers [rad/s], e.g. natural frequencies and that of the waves
    least_prominence     as in spectral_peaks
    Returns one SpectralPeak with reference per frequency, in the order given; None where the spectrum has no peak.
    Raises ValueError for a frequency that is not finite or below zero.
    """
    peaks = spectral_peaks(spectrum, least_prominence)

    def beside(frequency_radps: float) -> SpectralPeak:
        nearest = min(peaks, key=lambda peak: abs(peak.angular_frequency_radps - frequency_radps))
        bins = (nearest.angular_frequency_radps - frequency_radps) / spectrum.bin_radps
        return replace(nearest, reference_radps=frequency_radps, bins_away=bins)

    wanted = [checked_not_negative(frequency_radps, "frequencies_radps") for frequency_radps in frequencies_radps]
    return tuple(beside(given) if peaks else None for given in wanted)
