"""The shade between two lines of a long history is drawn though each of them, thinned by itself, keeps other samples."""

import numpy as np

from reports.figures.time_series import Panel, time_series


def test_two_lines_with_extremes_of_their_own_can_be_shaded():
    t = np.linspace(0.0, 50.0, 2001)
    high = np.sin(3.0 * t) + 2.0
    calm = np.where(t < 25.0, 1.0, np.sin(t))  # still for half of the time, and so with fewer extremes
    assert time_series(t, [Panel("", high, calm, high)]).data
