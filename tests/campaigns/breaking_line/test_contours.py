"""Contours of waves that run as told: their speed is that of the way to the fixed end, not of what comes back."""

from types import SimpleNamespace

import numpy as np
import pytest

from campaigns.breaking_line.motion_measures import contour, contour_speed

LENGTH_M, SPEED_MPS = 60.0, 400.0
ARRIVAL_S = LENGTH_M / SPEED_MPS


@pytest.mark.parametrize("echo_mps", [0.0, 150.0, 400.0])
def test_the_speed_of_a_contour_is_measured_until_something_arrives(echo_mps):
    """From then on the contour runs back, from the middle of the line."""
    time_s, s_m = np.linspace(0.0, 2.0 * ARRIVAL_S, 121), np.linspace(0.0, LENGTH_M, 241)
    back_m = 0.5 * LENGTH_M + echo_mps * (time_s - ARRIVAL_S)
    places_m = np.where(time_s < ARRIVAL_S, LENGTH_M - SPEED_MPS * time_s, back_m)
    profiles = SimpleNamespace(time_s=time_s, s_m=s_m)
    strain = 0.1 - 1e-3 * (s_m - places_m[:, None])
    inside = (places_m > 1.0) & (places_m < LENGTH_M - 1.0)
    assert contour(profiles, strain, 0.1)[inside] == pytest.approx(places_m[inside])
    theory = SimpleNamespace(length_m=LENGTH_M, arrival_s=ARRIVAL_S)
    assert contour_speed(profiles, strain, 0.1, theory) == pytest.approx(SPEED_MPS)
