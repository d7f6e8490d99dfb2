"""One point per period, and its value at the phase asked for: exact on samples, to fourth order between them."""

import numpy as np
import pytest

from analysis import poincare_section, section_at_phases

PERIOD = 5.0


def motion(t):
    """A period-2 motion and its rate."""
    w = 2 * np.pi / PERIOD
    return np.column_stack([np.cos(w * t) + 0.3 * np.sin(w / 2 * t), np.sin(w * t)])


@pytest.mark.parametrize("steps", range(60, 200))
def test_a_record_of_whole_periods_has_one_point_more_than_periods_whatever_the_rounding_of_the_step(steps):
    section = poincare_section(np.zeros(40 * steps + 1), PERIOD / steps, PERIOD)
    assert section.points.shape == (41, 1)
    assert np.allclose(section.time_s, PERIOD * np.arange(41))


@pytest.mark.parametrize(("phase", "transient"), [(0.0, 1), (0.3, 40), (0.9, 1)])
def test_leaving_out_a_transient_only_drops_points_from_the_start(phase, transient):
    x = np.random.default_rng(0).normal(size=(3001, 2))
    whole, part = (poincare_section(x, 0.1, PERIOD, phase, first) for first in (0, transient))
    assert np.array_equal(part.points, whole.points[transient:])
    assert np.array_equal(part.time_s, whole.time_s[transient:])
    assert np.array_equal(part.period_index, whole.period_index[transient:]) and part.phase == phase


def test_coordinates_keep_their_order_and_phases_stand_side_by_side():
    section = poincare_section({"radius_m": np.arange(11.0), "angle_rad": -np.arange(11.0)}, 1.0, PERIOD)
    assert np.array_equal(section.points, [[0.0, 0.0], [5.0, -5.0], [10.0, -10.0]])
    assert np.array_equal(section.column("angle_rad"), [0.0, -5.0, -10.0])
    with pytest.raises(ValueError, match="there are radius_m, angle_rad"):
        section.column("r")
    assert np.array_equal(section_at_phases(np.arange(22.0), 1.0, 8.0, 1).points, [[8.0, 10.0, 12.0, 14.0]])


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (dict(series=np.zeros(101), transient_periods=3), "needs 3 periods.*given 2 "),
        (dict(series=np.zeros(0)), "given 0 .*0 samples"),
        (dict(series=np.zeros(20), phase=0.5), "needs 0.5 periods"),
        (dict(series=np.zeros(101), phase=1.0), "0 <= phase < 1"),
        (dict(series=np.zeros(101), period_s=0.0), "period_s"),
        (dict(series=np.zeros(101), transient_periods=1.5), "transient_periods"),
        (dict(series={"a": np.zeros(10), "b": np.zeros(11)}), "equal length.*a: 10, b: 11"),
        (dict(series=[1.0, 2.0, 3.0], step_s=4.0, phase=0.5), "at least 4 of them, given 3"),
        (dict(series={}), "empty mapping"),
        (dict(series=np.zeros((2, 2, 2))), "1 or 2 dimension"),
    ],
)
def test_what_cannot_be_answered_is_refused_with_a_reason(arguments, message):
    with pytest.raises(ValueError, match=message):
        poincare_section(**{"step_s": 0.1, "period_s": PERIOD, **arguments})


@pytest.mark.parametrize("phase", [0.0, 0.25, 0.5, 0.99])
def test_phases_on_samples_give_the_samples(phase):
    x = motion(0.05 * np.arange(2001))
    section = poincare_section(x, 0.05, PERIOD, phase=phase)
    assert np.array_equal(section.points, x[np.arange(len(section.points)) * 100 + round(100 * phase)])
    assert not section.interpolated and poincare_section(x, 0.05, PERIOD, phase=0.001).interpolated


def test_the_error_of_a_step_that_does_not_divide_the_period_is_of_fourth_order():
    """The largest error over all phases: at one phase it depends on where the strobe falls between samples."""
    steps = 0.291 / np.array([1, 2, 4, 8])
    errors = []
    for step in steps:
        t = step * np.arange(int(50 * PERIOD / step) + 1)
        sections = [poincare_section(motion(t), step, PERIOD, phase=p) for p in np.linspace(0, 1, 100, endpoint=False)]
        errors.append(max(np.abs(section.points - motion(section.time_s)).max() for section in sections))
    assert np.polyfit(np.log(steps), np.log(errors), 1)[0] == pytest.approx(4.0, abs=0.1)
    assert errors[0] < 1e-3


@pytest.mark.parametrize("phase", [0.0, 0.013, 0.25, 0.5, 0.77, 0.999])
def test_a_cubic_motion_is_exact_at_any_phase(phase):
    """A cubic spline without knots of its own at the ends reproduces cubics."""
    cubic = np.polynomial.Polynomial([0.0, 1.0, -40.0, 1.0])
    section = poincare_section(cubic(0.37 * np.arange(200)), 0.37, PERIOD, phase=phase)
    assert np.allclose(section.points[:, 0], cubic(section.time_s), rtol=1e-9)
