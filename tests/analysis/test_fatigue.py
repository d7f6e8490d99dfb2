"""Cycles by the worked example of ASTM E1049, the equivalent load of a sine, turning points, the use of a line."""

from collections import Counter

import numpy as np
import pytest

from analysis import damage_equivalent_load, rainflow_cycles, turning_points, utilisation
from tests.analysis.systems import normal


def test_cycles_are_those_of_the_worked_example_of_the_standard():
    counts = Counter()
    for size, _, count in rainflow_cycles([-2, 1, -3, 5, -1, 3, -4, 4, -2]):
        counts[size] += count
    assert counts == {3.0: 0.5, 4.0: 1.5, 6.0: 0.5, 8.0: 1.0, 9.0: 0.5}


def four_points(series):
    """Whole cycles by the four-point rule (de Jonge 1982), which leaves the residue alone: sorted ranges."""
    stack, ranges = [], []
    for point in series:
        stack.append(point)
        while len(stack) > 3:
            a, b, c, d = stack[-4:]
            if not (min(a, d) <= min(b, c) and max(b, c) <= max(a, d)):
                break
            ranges.append(abs(b - c))
            stack[-3:-1] = []
    return sorted(ranges), stack


@pytest.mark.parametrize("seed", range(100))
def test_whole_cycles_and_residue_are_those_of_another_rule(seed):
    points = normal(seed, 200)
    turns = np.concatenate([points[:1], points[1:-1][np.diff(np.sign(np.diff(points))) != 0], points[-1:]])
    inner, residue = four_points(turns)
    counted = rainflow_cycles(points)
    total = Counter(np.round(inner, 9).tolist())
    whole = Counter()
    for size, _, count in counted:
        whole[round(size, 9)] += count
    assert not total - whole  # every cycle of the four-point rule is counted; the rest stands in the residue
    assert sum(whole.values()) == pytest.approx(len(inner) + 0.5 * (len(residue) - 1))


@pytest.mark.parametrize("slope", [3.0, 5.0, 13.46])
def test_a_sine_is_equivalent_to_its_own_range(slope):
    time = np.linspace(0.25, 50.25, 50_001)
    assert damage_equivalent_load(3.0 + 2.0 * np.sin(2 * np.pi * time), 50, slope) == pytest.approx(4.0, rel=1e-3)
    assert damage_equivalent_load(np.ones(5), 1.0, slope) == 0.0


def test_a_turning_point_is_the_extreme_between_samples():
    low = np.array([0, 0.9, 1.4, 0.2, -0.7, -0.2, 0.4])
    high = np.array([0.1, 1.2, 1.9, 1.4, 0.2, 0.3, 0.9])
    assert turning_points(low, high) == pytest.approx([0.0, 1.9, -0.7, 0.9])
    assert turning_points(-high, -low) == pytest.approx([0.0, -1.9, 0.7, -0.9]), "a fall at the ends counts as a rise"


def test_a_line_is_used_by_its_mean_and_dynamic_parts():
    assert utilisation(1000.0, 3000.0, 4100.0 / 0.95) == pytest.approx(1.0)
    with pytest.raises(ValueError, match="breaking_load_N"):
        utilisation(1.0, 2.0, 0.0)
