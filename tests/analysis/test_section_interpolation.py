"""A section of a sampled sinusoid is its value at the phase asked for: exactly on samples, to fourth order between."""

import numpy as np
import pytest

from analysis import poincare_section

PERIOD = 5.0
PHASES = [0.0, 0.013, 0.25, 0.5, 0.77, 0.999]


def _motion(t):
    """A period-2 motion and its rate."""
    w = 2 * np.pi / PERIOD
    return np.column_stack([np.cos(w * t) + 0.3 * np.sin(w / 2 * t), np.sin(w * t)])


@pytest.mark.parametrize("phase", [0.0, 0.25, 0.5, 0.99])
def test_phases_on_samples_give_the_samples(phase):
    t = 0.05 * np.arange(2001)
    section = poincare_section(_motion(t), 0.05, PERIOD, phase=phase)
    assert not section.interpolated
    assert np.array_equal(section.points, _motion(t)[np.arange(len(section.points)) * 100 + round(100 * phase)])


def test_the_error_of_a_step_that_does_not_divide_the_period_is_of_fourth_order():
    """The largest error over all phases: at one phase it depends on where the strobe falls between samples."""
    steps = 0.291 / np.array([1, 2, 4, 8])
    errors = []
    for step in steps:
        t = step * np.arange(int(50 * PERIOD / step) + 1)
        sections = [poincare_section(_motion(t), step, PERIOD, phase=p) for p in np.linspace(0, 1, 100, endpoint=False)]
        assert all(section.interpolated for section in sections)
        errors.append(max(np.abs(section.points - _motion(section.time_s)).max() for section in sections))
    assert np.polyfit(np.log(steps), np.log(errors), 1)[0] == pytest.approx(4.0, abs=0.1)
    assert errors[0] < 1e-3


@pytest.mark.parametrize("phase", PHASES)
def test_a_cubic_motion_is_exact_at_any_phase(phase):
    """A cubic spline without knots of its own at the ends reproduces cubics."""
    t = 0.37 * np.arange(200)
    section = poincare_section(t**3 - 40 * t**2 + t, 0.37, PERIOD, phase=phase)
    exact = section.time_s**3 - 40 * section.time_s**2 + section.time_s
    assert np.allclose(section.points[:, 0], exact, rtol=1e-9)


def test_a_quarter_period_turns_cosine_into_minus_sine():
    t = 0.05 * np.arange(2001)
    w = 2 * np.pi / PERIOD
    quarter = poincare_section({"x": np.cos(w * t), "y": np.sin(w * t)}, 0.05, PERIOD, phase=0.25)
    assert np.allclose(quarter.column("x"), 0.0, atol=1e-12)
    assert np.allclose(quarter.column("y"), 1.0, atol=1e-12)


def test_fewer_than_four_samples_cannot_be_interpolated():
    with pytest.raises(ValueError, match="at least 4 of them, given 3"):
        poincare_section([1.0, 2.0, 3.0], 4.0, PERIOD, phase=0.5)
