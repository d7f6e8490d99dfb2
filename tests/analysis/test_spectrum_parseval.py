"""The lines of eq. (31) carry the mean square of the motion."""

import numpy as np
import pytest

from analysis import spectrum


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
