"""A history drawn from fewer points keeps every extreme, whatever its curves have in common."""

import numpy as np

from reports.figures.time_series import Panel, envelope, time_series


def test_the_line_keeps_its_extremes():
    x, y = np.arange(30_000.0), np.random.default_rng(0).normal(size=30_000)
    kept_x, kept_y = envelope(x, y)
    assert len(kept_x) <= 1800 and np.all(np.diff(kept_x) > 0)
    assert (kept_y.min(), kept_y.max()) == (y.min(), y.max()) and np.array_equal(y[kept_x.astype(int)], kept_y)


def test_a_band_whose_edges_rest_at_different_times_is_drawn():
    """A slack stretch in the lower edge only: it has fewer extremes there than the upper one."""
    n = 4001
    low, high = np.sin(np.arange(n)), 2.0 + np.sin(1.3 * np.arange(n))
    low[1000:2000] = -1.0
    high[1500:2600] = np.nan
    picture = time_series(np.arange(n) / 100.0, [Panel("T (kN)", high - 0.5, low, high)])
    assert picture.kind == "svg" and len(picture.data) > 1000
