"""K of the 0-1 test on maps whose regime is known: near 0 for regular motion, near 1 for chaos, whatever the units."""

import numpy as np
import pytest

from analysis import zero_one_test
from tests.analysis.systems import circle_map, henon, logistic, normal


# Chaotic parameters away from band mergings; exponent at 4 is ln 2 exactly. White noise: the reason why the test alone
# proves nothing about a record in which noise is possible.
@pytest.mark.parametrize(
    "orbit",
    [
        *(logistic(rate, points) for rate in (3.7, 4.0) for points in (200, 1000)),
        *henon(1000).T,
        normal(0, 1000),
    ],
)
def test_chaos_and_noise_have_k_near_1(orbit):
    assert zero_one_test(orbit).value > 0.95


@pytest.mark.parametrize("rate", [3.2, 3.5, 3.55, 3.83])
def test_windows_of_the_logistic_map_have_k_near_0(rate):
    assert abs(zero_one_test(logistic(rate, 1000)).value) < 0.05


@pytest.mark.parametrize("coupling", [0.0, 0.5, 1.6, 2.4, 4.6, 5.0, 6.0])
def test_k_has_the_sign_of_the_exponent_of_the_circle_map(coupling):
    """The derivative of the map is 1 - coupling cos(2 pi angle)."""
    orbit = circle_map(coupling, 0.606661, 2000)
    exponent = np.mean(np.log(np.abs(1.0 - coupling * orbit[:, 0])))
    result = zero_one_test(orbit[:, 0])
    assert result.value > 0.9 if exponent > 0.1 else result.value < 0.2


@pytest.mark.parametrize(("samples", "judged"), [(17.9, True), (22.1, False)])
def test_a_sine_is_judged_up_to_a_range_of_ten_mean_steps(samples, judged):
    """Of so many samples a cycle the range is pi/2/sin(pi/samples) steps: 9.0 and 11.1."""
    sine = np.sin(2.0 * np.pi * np.arange(1000) / samples)
    assert np.isfinite(zero_one_test(sine).value) == judged


def test_the_sum_by_transforms_is_the_sum_of_its_definition():
    phi = logistic(3.9, 120)
    test = zero_one_test(21.0 + 1e-3 * phi, angles=3)  # units and origin do not matter
    phi, cut, lag = phi - phi.mean(), 12, np.arange(1, 13)
    for c, growth in zip(test.angles_rad, test.growth, strict=True):
        walk = np.array([sum(phi[k] * np.exp(1j * c * (k + 1)) for k in range(n + 1)) for n in range(120)])
        distance = [np.mean(np.abs(walk[n : n + 120 - cut] - walk[: 120 - cut]) ** 2) for n in lag]
        assert np.pi / 5 < c < 4 * np.pi / 5 and growth == pytest.approx(np.corrcoef(lag, distance)[0, 1], abs=1e-8)
