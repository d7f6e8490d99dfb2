"""A sea of given height and period as a sum of linear waves: the JONSWAP spectrum and its components.

    S(f) = c f^-5 exp(-5/4 (f/f_p)^-4) gamma^g,    g = exp(-(f/f_p - 1)^2/(2 sigma^2))

with sigma = 0.07 below f_p and 0.09 above. gamma = 1 is the spectrum of Pierson and Moskowitz. c is chosen so that the
components together carry H_s^2/16, the variance of a sea of significant height H_s. The band from f_p/2 to 3 f_p,
which holds 98.5 % of the energy at gamma = 1 and more above, is cut into parts of equal width; in each lies one
component, at a random place (even frequencies would repeat the sea after 1/df) and with a random phase. Its amplitude
carries the energy of its part: it is not random, so that every seed has the same H_s.

Source: K. Hasselmann et al., Deutsche Hydrographische Zeitschrift A8, no. 12 (1973); W. J. Pierson & L. Moskowitz,
J. Geophys. Res. 69 (1964) 5181.
"""

import numpy as np

LOWEST, HIGHEST = 0.5, 3.0  # of the peak frequency
_POINTS = 200  # over which the energy of one part is summed


def components(
    significant_height_m: float, peak_period_s: float, gamma: float, count: int, seed: int
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Periods (s), amplitudes (m) and phases (rad), each (count,), of a sea; the same arguments give the same numbers.

    sum A^2/2 = H_s^2/16 to rounding.
    """
    rng = np.random.default_rng(seed)
    edges = np.linspace(LOWEST, HIGHEST, count + 1)
    ratio = edges[:-1] + (edges[1:] - edges[:-1]) * rng.random(count)
    inner = edges[:-1, None] + np.diff(edges)[:, None] * np.linspace(0.0, 1.0, _POINTS + 1)
    energy = np.trapezoid(_shape(inner, gamma), inner, axis=1)
    amplitude = np.sqrt(2.0 * energy / energy.sum() * significant_height_m**2 / 16.0)
    return peak_period_s / ratio, amplitude, 2.0 * np.pi * rng.random(count)


def _shape(ratio, gamma):
    """The spectrum without its scale, at f/f_p."""
    width = np.where(ratio > 1.0, 0.09, 0.07)
    peak = np.exp(-((ratio - 1.0) ** 2) / (2.0 * width**2))
    return ratio**-5.0 * np.exp(-1.25 * ratio**-4.0) * gamma**peak
