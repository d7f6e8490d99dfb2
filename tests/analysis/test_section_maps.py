"""The exponent of the map of a section against known ones; what forgets, and what does not."""

import numpy as np
import pytest

from analysis import long_memory, section_lyapunov
from analysis.section_maps import prediction_gain
from tests.analysis.systems import circle_map, henon, logistic, noisy, nonchaotic_map, normal, two_tone


@pytest.mark.parametrize(
    ("section", "bits"),
    [
        (logistic(4.0, 1000, 0.1234, 999), 1.0),
        (henon(1000), 0.41922 / np.log(2.0)),
        (henon(1000)[:, 0], 0.41922 / np.log(2.0)),
        (circle_map(0.8, 0.41421356, 1000), 0.0),
    ],
    ids=["logistic map", "Henon map", "Henon map, x", "torus"],
)
def test_exponents_of_maps_are_found_within_three_errors_and_a_tenth(section, bits):
    for item in section_lyapunov(section):
        assert item.unit == "bits/period" and item.found
        assert abs(item.value - bits) < max(3.0 * item.error, 0.1)


def test_halves_are_those_of_the_record():
    """A bit an iteration, and the mean growth at a rate of 3.7, far apart."""
    slow = logistic(3.7, 400)
    _, first, second = section_lyapunov(np.append(logistic(4.0, 400), 10.0 + slow))
    bits = np.mean(np.log2(np.abs(3.7 * (1.0 - 2.0 * slow))))
    assert second.value == pytest.approx(bits, abs=0.15) and first.value > bits + 0.3


def test_the_error_covers_the_scatter_of_the_exponent_and_is_at_most_three_times_as_wide():
    result = [section_lyapunov(logistic(4.0, 400, start, 50))[0] for start in np.linspace(0.07, 0.93, 60)]
    assert 0.33 < np.std([(item.value - 1.0) / item.error for item in result]) < 1.0


def test_a_period_seen_through_noise_has_a_negative_exponent():
    """The noise of one period says nothing of that of the next."""
    exponent = section_lyapunov(noisy(logistic(3.5, 600), 0.01, 1))[0]
    assert exponent.value + 3.0 * exponent.error < 0.0


def test_units_do_not_matter():
    plain, moved = (section_lyapunov(item)[0].value for item in (henon(300), 21.0 - 1e-3 * henon(300)))
    assert moved == pytest.approx(plain, rel=1e-6)


def test_a_map_on_a_line_needs_one_row_and_henons_two():
    assert prediction_gain(logistic(3.9, 500)).delays == 1
    assert prediction_gain(henon(500)[:, 0]).delays == 2


def test_a_map_needs_eight_points_for_each_number_of_a_linear_one():
    """Of three rows: four numbers, beside one neighbour in time on either side and the rows of the first state."""
    least = 8 * 4 + 2 + 3
    assert np.isfinite(prediction_gain(logistic(3.9, least)).gain)
    assert np.isnan(prediction_gain(logistic(3.9, least - 1)).gain)


@pytest.mark.parametrize("points", [300, 3000])
def test_chaos_in_bands_or_without_and_noise_forget(points):
    bands = logistic(3.9, points) + 10.0 * (np.arange(points) % 2)
    for record in (logistic(3.9, points), henon(points), normal(0, points), bands):
        assert long_memory(record) < 7.0 / np.sqrt(points)


@pytest.mark.parametrize("sigma", [1.3, 1.5, 1.7])
@pytest.mark.parametrize("points", [300, 3000])
def test_tori_and_strange_nonchaotic_attractors_do_not_forget(sigma, points):
    assert long_memory(nonchaotic_map(sigma, points)) > 0.9
    assert long_memory(two_tone(20 * points)[::20]) > 0.9
