"""Coexisting attractors, periodic orbits and grazing of eq. (33)."""

from dataclasses import replace

import numpy as np
import pytest

from analysis.oscillator import (
    SnapOscillator,
    clearance,
    grazing_force,
    periodic_orbit,
    search_periodic_orbits,
    snap_basins,
    snap_motion,
    start_grid,
    strobed_states,
    strobed_states_within,
)
from analysis.oscillator.growth import random_starts

PAPER = SnapOscillator()


@pytest.fixture(scope="module")
def basins():
    return snap_basins(PAPER, random_starts(600, 8), 3000)


@pytest.mark.slow
def test_about_six_in_a_hundred_starts_end_on_the_orbit_of_period_8(basins):
    assert [len(orbit) for orbit in basins.orbits] == [8]
    assert abs(basins.shares[0] - 0.06) < 3 * basins.errors[0]
    assert basins.shares.sum() == pytest.approx(1.0)


@pytest.mark.slow
def test_newton_finds_the_orbit_of_period_8_with_its_multipliers(basins):
    orbit = periodic_orbit(PAPER, 8, basins.orbits[0][3] + [1e-3, -1e-3])
    assert orbit.period == 8 and orbit.stable and orbit.residual < 1e-12
    assert np.prod(orbit.multipliers).real == pytest.approx(np.exp(-0.025 * 8 * PAPER.period), rel=1e-12)
    # The slower multiplier is the rate at which a start really comes in.
    away = strobed_states(PAPER, orbit.points[0] + [1e-4, 0.0], 401)[::8] - orbit.points[0]
    distance = np.linalg.norm(away, axis=1)
    assert (distance[50] / distance[30]) ** (1 / 20) == pytest.approx(np.abs(orbit.multipliers).max(), rel=1e-3)


@pytest.mark.slow
def test_points_of_an_orbit_are_its_own_images():
    for orbit in search_periodic_orbits(PAPER, 3, strobed_states(PAPER, (0.68, 0.0), 60, 100)):
        again = strobed_states(PAPER, orbit.points[0], 4)
        assert np.abs(again[:3] - orbit.points).max() < 1e-9 and np.abs(again[3] - again[0]).max() < 1e-11
        assert not orbit.stable


def test_a_divisor_is_reported_as_the_period():
    fixed = search_periodic_orbits(PAPER, 1, start_grid(10, 10))[0]
    assert periodic_orbit(PAPER, 6, fixed.points[0]).period == 1


def test_newton_gives_up_where_there_is_no_orbit():
    assert periodic_orbit(SnapOscillator(lift=-0.5, damping=0.2), 1, (-5.0, 0.0)) is None


def test_a_single_attractor_takes_every_start():
    found = snap_basins(SnapOscillator(force=0.05), start_grid(12, 8), 2000)
    assert list(found.shares) == [1.0, 0.0]
    assert (found.label == 0).all() and (found.settled > 0).all()


def test_grid_covers_the_box_evenly():
    grid = start_grid(8, 5)
    assert grid.shape == (40, 2)
    assert np.allclose(grid.mean(axis=0), [-20.0, 0.0]) and grid[:, 0].min() == -55.0 and grid[:, 1].max() == 20.0


def test_zoom_points_lie_in_their_boxes_and_on_the_orbit():
    boxes = [[-5.0, 0.0, -4.0, 0.0], [50.0, 60.0, 0.0, 1.0]]
    (inside, empty), seen = strobed_states_within(PAPER, (0.68, 0.0), boxes, 30, 2000)
    section = strobed_states(PAPER, (0.68, 0.0), 2000)
    wanted = section[(np.abs(section[:, 0] + 2.5) <= 2.5) & (np.abs(section[:, 1] + 2.0) <= 2.0)][:30]
    assert np.array_equal(inside, wanted)
    assert len(empty) == 0 and seen == 2000


def test_grazing_threshold():
    found = grazing_force(PAPER)
    assert abs(found.force - 0.20464770309974) < 1e-10
    assert abs(found.clearance) < 1e-14 and abs(found.velocity) < 1e-14


@pytest.mark.parametrize(
    "numbers", [{}, {"damping": 0.3, "frequency": 0.4}, {"frequency": 2.5, "lift": 0.2, "phase": 1.0}]
)
def test_slack_begins_at_the_threshold_and_nowhere_below(numbers):
    oscillator = SnapOscillator(**numbers)
    force = grazing_force(oscillator).force
    assert force == pytest.approx(oscillator.lift * oscillator.impedance, rel=1e-13)
    for factor, slack in ((1 - 1e-9, False), (1 + 1e-6, True)):
        near = replace(oscillator, force=force * factor)
        least, _, _ = clearance(near)
        assert (least < 0.0) == slack
        taut = 0.68 if not numbers else oscillator.lift
        settled = strobed_states(replace(near, force=0.5 * force), (taut, 0.0), 1, 3000)[0]
        # from the taut motion at half the forcing, twice the swing: still taut, by linearity
        start = [taut, 0.0] + factor * 2 * (settled - [taut, 0.0])
        assert (len(snap_motion(near, start, 3).switches) > 0) == slack


def test_no_threshold_without_lift_or_damping():
    assert np.isnan(grazing_force(SnapOscillator(lift=-0.1)).force)
    assert np.isnan(grazing_force(SnapOscillator(damping=0.0)).force)
    with pytest.raises(ValueError, match="damping"):
        clearance(SnapOscillator(damping=0.0))
