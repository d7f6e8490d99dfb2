"""Exponents of eq. (33): the known value, the exact sum, errors that behave as errors."""

import numpy as np
import pytest

from analysis.oscillator import SnapOscillator, section_dimension, snap_diagram, snap_exponents
from analysis.oscillator.growth import random_starts
from analysis.oscillator.pieces import tables
from analysis.oscillator.strobing import tangent_map

PAPER = SnapOscillator()
LAMBDA_1 = 0.0640482  # +- 0.0000122, from an independent code


def test_largest_exponent_within_three_standard_errors():
    found = snap_exponents(PAPER, count=64, transient_periods=500, periods=2000, seed=11)
    assert abs(found.first.value - LAMBDA_1) < 3 * np.hypot(found.first.error, 0.0000122)
    assert found.first.error < 5e-4
    bits = found.first.in_bits_per_period(PAPER.period)
    assert abs(bits.value - 0.50928) < 3 * np.hypot(bits.error, 0.0001)
    assert abs(found.dimension - 1.7193) < 3 * np.hypot(found.dimension_error, 5e-5)


@pytest.mark.parametrize(("damping", "frequency"), [(0.0, 1.14), (0.025, 1.14), (0.4, 1.14), (1.9, 1.14)])
def test_exponents_and_damping_add_up_to_zero(damping, frequency):
    oscillator = SnapOscillator(damping=damping, frequency=frequency)
    found = snap_exponents(oscillator, count=8, transient_periods=20, periods=1000, keep_periodic=True)
    assert abs(found.first.value + found.second.value + damping) < 1e-12
    assert np.abs(found.of_start.sum(axis=1) + damping).max() < 1e-12


def test_tangent_map_against_differences():
    table = tables(PAPER)
    for start in ((0.68, 0.0), (-3.0, 2.0), (2.0, -4.0)):
        _, _, jacobian = tangent_map(*start, 3, table)
        for column, shift in enumerate(np.eye(2) * 1e-6):
            plus, minus = (np.array(tangent_map(*(start + s * shift), 3, table)[:2]) for s in (1, -1))
            assert np.allclose((plus - minus) / 2e-6, jacobian[:, column], rtol=1e-5, atol=1e-6)
        assert np.isclose(np.linalg.det(jacobian), np.exp(-0.025 * 3 * PAPER.period), rtol=1e-12)


@pytest.mark.slow
def test_scatter_over_starts_falls_as_the_root_of_their_number():
    rates = snap_exponents(PAPER, count=1024, transient_periods=500, periods=500, seed=3).of_start[:, 0]
    sizes = np.array([1, 2, 4, 8, 16])
    scatter = [rates[: len(rates) // n * n].reshape(-1, n).mean(axis=1).std(ddof=1) for n in sizes]
    slope = np.polyfit(np.log(sizes), np.log(scatter), 1)[0]
    assert abs(slope + 0.5) < 0.1


@pytest.mark.slow
def test_true_value_is_within_two_errors_as_often_as_it_should():
    hits = 0
    for seed in range(40):
        found = snap_exponents(PAPER, count=16, transient_periods=500, periods=400, seed=100 + seed)
        hits += abs(found.first.value - LAMBDA_1) < 2 * found.first.error
        assert 0.5 < found.block_error / found.first.error < 2.0
    assert hits >= 34  # 0.936 for Student's t with 15 degrees: 34 or more of 40 with probability 0.97


def test_taut_motion_has_the_exponents_of_the_linear_oscillator():
    found = snap_exponents(SnapOscillator(force=0.1), starts=[(0.68, 0.0), (0.7, 0.1)], periods=2000)
    # Complex pair: both are -mu/2 in the limit; over a finite time the orthonormal frame leaves O(1/time).
    assert np.abs(found.of_start + 0.0125).max() < 1e-3
    assert found.dimension == 0.0
    assert found.starts == 2 and found.elsewhere == 0, "a start on a periodic orbit is an answer too"


def test_dimension_of_the_section():
    assert section_dimension(0.06, -0.09) == pytest.approx(1 + 2 / 3)
    assert section_dimension(-0.01, -0.02) == 0.0
    assert np.isnan(section_dimension(0.1, -0.05)) and np.isnan(section_dimension(np.nan, -1.0))


@pytest.mark.slow
def test_diagram_agrees_with_single_runs():
    starts = random_starts(3, 4)
    diagram = snap_diagram(PAPER, "force", [0.15, 1.4], starts, transient_periods=100, periods=200, points=50)
    alone = snap_exponents(PAPER, starts, transient_periods=100, periods=200, blocks=10, keep_periodic=True)
    assert np.allclose(diagram.exponents[1], alone.of_start, rtol=0, atol=1e-14)
    assert diagram.section.shape == (2, 3, 50, 2)
    assert (diagram.exponents.sum(axis=2) + 0.025 < 1e-12).all()


def test_faults_are_named():
    with pytest.raises(ValueError, match="over"):
        snap_diagram(PAPER, "mass", [1.0])
    with pytest.raises(ValueError, match="periods"):
        snap_exponents(PAPER, periods=101, blocks=20)
