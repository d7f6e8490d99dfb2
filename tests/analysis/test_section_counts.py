"""One point per period, from the first after the transient to the last the record reaches."""

import numpy as np
import pytest

from analysis import poincare_section


def test_a_record_of_whole_periods_has_one_point_more_than_periods():
    section = poincare_section(np.zeros(3001), 0.1, 5.0)
    assert np.array_equal(section.period_index, np.arange(61))
    assert section.points.shape == (61, 1)
    assert np.allclose(section.time_s, 5.0 * np.arange(61))


def test_rounding_of_the_step_loses_no_point():
    for steps in range(60, 200):
        section = poincare_section(np.zeros(40 * steps + 1), 5.0 / steps, 5.0)
        assert len(section.points) == 41 and not section.interpolated


@pytest.mark.parametrize("phase", [0.0, 0.3, 0.9])
@pytest.mark.parametrize("transient", [0, 1, 40])
def test_leaving_out_a_transient_only_drops_points_from_the_start(phase, transient):
    x = np.random.default_rng(0).normal(size=(3001, 2))
    whole = poincare_section(x, 0.1, 5.0, phase=phase)
    part = poincare_section(x, 0.1, 5.0, phase=phase, transient_periods=transient)
    assert np.array_equal(part.points, whole.points[transient:])
    assert np.array_equal(part.period_index, whole.period_index[transient:])


def test_starting_the_record_one_period_later_gives_the_same_points():
    x = np.random.default_rng(0).normal(size=3001)
    assert np.array_equal(
        poincare_section(x, 0.1, 5.0, phase=0.5).points[1:], poincare_section(x[50:], 0.1, 5.0, phase=0.5).points
    )


def test_coordinates_keep_their_names_and_order():
    section = poincare_section({"radius_m": np.arange(11.0), "angle_rad": -np.arange(11.0)}, 1.0, 5.0)
    assert section.names == ("radius_m", "angle_rad")
    assert np.array_equal(section.column("angle_rad"), [0.0, -5.0, -10.0])
    with pytest.raises(ValueError, match=r"no coordinate 'r'.*radius_m, angle_rad"):
        section.column("r")


def test_points_cannot_be_written_to():
    section = poincare_section(np.zeros(101), 0.1, 5.0)
    with pytest.raises(ValueError, match="read-only"):
        section.points[0] = 1.0


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (dict(series=np.zeros(101), step_s=0.1, period_s=5.0, transient_periods=3), "needs 3 periods.*given 2 "),
        (dict(series=np.zeros(0), step_s=0.1, period_s=5.0), "given 0 .*0 samples"),
        (dict(series=np.zeros(20), step_s=0.1, period_s=5.0, phase=0.5), "needs 0.5 periods"),
        (dict(series=np.zeros(101), step_s=0.1, period_s=5.0, phase=1.0), "0 <= phase < 1"),
        (dict(series=np.zeros(101), step_s=0.1, period_s=0.0), "period_s"),
        (dict(series=np.zeros(101), step_s=0.1, period_s=5.0, transient_periods=1.5), "transient_periods"),
        (dict(series={"a": np.zeros(10), "b": np.zeros(11)}, step_s=0.1, period_s=5.0), "equal length.*a: 10, b: 11"),
        (dict(series={}, step_s=0.1, period_s=5.0), "empty mapping"),
        (dict(series=np.zeros((2, 2, 2)), step_s=0.1, period_s=5.0), "1 or 2 dimension"),
    ],
)
def test_what_cannot_be_answered_is_refused_with_a_reason(arguments, message):
    with pytest.raises(ValueError, match=message):
        poincare_section(**arguments)
