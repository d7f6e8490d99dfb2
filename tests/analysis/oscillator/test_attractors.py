"""Exponents, coexisting attractors, periodic orbits and grazing of eq. (33)."""

from dataclasses import replace

import numpy as np
import pytest

from analysis.oscillator import (
    SnapOscillator,
    grazing_force,
    search_periodic_orbits,
    section_dimension,
    settled_periods,
    snap_diagram,
    snap_exponents,
    snap_motion,
    start_grid,
    strobed_states,
)
from analysis.oscillator.growth import random_starts

PAPER = SnapOscillator()
LAMBDA_1 = 0.0640482  # +- 0.0000122, from an independent code


@pytest.mark.slow
def test_largest_exponent_within_three_standard_errors():
    result = snap_exponents(PAPER, count=64, transient_periods=500, periods=2000, seed=11)
    assert abs(result.first.value - LAMBDA_1) < 3 * np.hypot(result.first.error, 0.0000122)
    assert result.first.error < 5e-4
    assert abs(result.dimension - 1.7193) < 3 * np.hypot(result.dimension_error, 5e-5)


@pytest.mark.parametrize("damping", [0.0, 0.025, 0.4, 1.9])
def test_exponents_and_damping_add_up_to_zero(damping):
    oscillator = SnapOscillator(damping=damping)
    result = snap_exponents(oscillator, count=8, transient_periods=20, periods=1000)
    over_blocks = result.of_block[:, :, 0].std(axis=1, ddof=1) / np.sqrt(20)
    assert result.block_error == pytest.approx(np.linalg.norm(over_blocks) / result.starts, rel=1e-9)
    assert abs(result.first.value + result.second.value + damping) < 1e-12
    assert np.abs(result.of_start.sum(axis=1) + damping).max() < 1e-12
    if damping and result.first.value > 0.0:
        dimensions = [section_dimension(*exponents) for exponents in result.of_start]
        assert result.dimension_error == pytest.approx(np.std(dimensions, ddof=1) / np.sqrt(result.starts), rel=0.05)


@pytest.mark.slow
def test_true_value_is_within_two_errors_as_often_as_it_should():
    hits = 0
    for seed in range(40):
        result = snap_exponents(PAPER, count=16, transient_periods=500, periods=400, seed=100 + seed)
        hits += abs(result.first.value - LAMBDA_1) < 2 * result.first.error
        assert 0.5 < result.block_error / result.first.error < 2.0
    assert hits >= 34  # 0.936 for Student's t with 15 degrees: 34 or more of 40 with probability 0.97


def test_taut_motion_has_the_exponents_of_the_linear_oscillator():
    result = snap_exponents(SnapOscillator(force=0.1), starts=[(0.68, 0.0), (0.7, 0.1)], periods=2000)
    # Complex pair: both are -mu/2 in the limit; over a finite time the orthonormal frame leaves O(1/time).
    assert np.abs(result.of_start + 0.0125).max() < 1e-3
    assert result.dimension == 0.0
    assert result.starts == 2 and result.elsewhere == 0, "a start on a periodic orbit is an answer too"


def test_dimension_of_the_section():
    assert section_dimension(0.06, -0.09) == pytest.approx(1 + 2 / 3)
    assert section_dimension(-0.01, -0.02) == 0.0
    assert np.isnan(section_dimension(0.1, -0.05)) and np.isnan(section_dimension(np.nan, -1.0))


@pytest.mark.slow
def test_diagram_agrees_with_single_runs():
    starts = random_starts(3, 4)
    diagram = snap_diagram(PAPER, "force", [0.15, 1.4], starts, transient_periods=100, periods=200, points=50)
    single = snap_exponents(PAPER, starts, transient_periods=100, periods=200, blocks=10)
    assert np.allclose(diagram.exponents[1], single.of_start, rtol=0, atol=1e-14)
    assert diagram.section.shape == (2, 3, 50, 2)
    assert (diagram.exponents.sum(axis=2) + 0.025 < 1e-12).all()


def test_some_starts_end_on_the_orbit_of_period_8_which_attracts_as_its_multiplier_says():
    starts, share = random_starts(150, 8), 0.06
    periods, ends = settled_periods(PAPER, starts, 1500)
    assert set(periods) == {0, 8}
    assert abs((periods == 8).mean() - share) < 3 * np.sqrt(share * (1.0 - share) / len(starts))
    starts_nearby = ends[periods == 8][0] + np.array([1e-3, -1e-3])
    (orbit,) = search_periodic_orbits(PAPER, 8, starts_nearby)
    assert orbit.stable and orbit.gap < 1e-12 and orbit.points[:, 0].argmin() == 0
    # The slower multiplier is the rate at which a start really comes in.
    offsets = strobed_states(PAPER, orbit.points[0] + [1e-4, 0.0], 401)[::8] - orbit.points[0]
    distance = np.linalg.norm(offsets, axis=1)
    assert (distance[50] / distance[30]) ** (1 / 20) == pytest.approx(np.abs(orbit.multipliers).max(), rel=1e-3)


def test_orbits_are_found_once_and_of_the_least_period_alone():
    starts = start_grid(10, 10)
    (fixed,) = search_periodic_orbits(PAPER, 1, starts)
    assert strobed_states(PAPER, fixed.points[0], 2)[1] == pytest.approx(fixed.points[0], abs=1e-12)
    assert not search_periodic_orbits(PAPER, 6, fixed.points)
    assert not search_periodic_orbits(SnapOscillator(lift=-0.5, damping=0.2), 1, (-5.0, 0.0))


def test_a_grid_covers_its_box_evenly():
    assert np.allclose(start_grid(8, 5).mean(axis=0), [-20.0, 0.0])
    assert np.array_equal(start_grid(2, 1, (0.0, 4.0, -1.0, 1.0)), [[1.0, 0.0], [3.0, 0.0]])


@pytest.mark.parametrize("numbers", [{"damping": 0.3, "frequency": 0.4}, {"frequency": 2.5, "lift": 0.2, "phase": 1.0}])
def test_slack_begins_at_the_threshold_and_nowhere_below(numbers):
    oscillator = SnapOscillator(**numbers)
    force, taut = grazing_force(oscillator), [oscillator.lift, 0.0]
    for factor, slack in ((1 - 1e-9, False), (1 + 1e-6, True)):
        settled = strobed_states(replace(oscillator, force=0.5 * force), taut, 1, 3000)[0]
        # from the taut motion at half the forcing, twice the swing: still taut, by linearity
        motion = snap_motion(replace(oscillator, force=factor * force), taut + factor * 2 * (settled - taut), 3, 4096)
        assert (len(motion.switches) > 0) == slack
        assert motion.displacement.min() == pytest.approx(0.0, abs=1e-5)


def test_the_threshold_of_the_paper_and_none_without_lift_or_damping():
    assert abs(grazing_force(PAPER) - 0.20464770309974) < 1e-10
    assert np.isnan([grazing_force(SnapOscillator(lift=-0.1)), grazing_force(SnapOscillator(damping=0.0))]).all()
