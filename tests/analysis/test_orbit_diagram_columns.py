"""An orbit diagram holds every point over its own parameter value and no other."""

import numpy as np
import pytest

from analysis import orbit_diagram


def test_columns_follow_the_parameter_whatever_the_order_given():
    rng = np.random.default_rng(0)
    parameter = rng.permutation(20) / 100
    diagram = orbit_diagram(parameter, [np.full(3, value) for value in parameter])
    assert np.array_equal(diagram.parameter, np.sort(parameter))
    for value, column in zip(diagram.parameter, diagram.columns, strict=True):
        assert np.array_equal(column, np.full(3, value))


def test_points_list_every_point_once():
    arrays = [np.arange(n, dtype=float) for n in (3, 0, 5)]
    x, y = orbit_diagram([0.1, 0.2, 0.3], arrays).points()
    assert np.array_equal(x, [0.1] * 3 + [0.3] * 5)
    assert np.array_equal(y, np.concatenate(arrays))


def test_two_runs_of_one_value_share_its_column():
    diagram = orbit_diagram([0.2, 0.1, 0.2], [[1.0], [2.0], [3.0, 4.0]])
    assert np.array_equal(diagram.parameter, [0.1, 0.2])
    assert np.array_equal(diagram.columns[1], [1.0, 3.0, 4.0])


def test_only_the_last_points_are_kept_when_asked():
    diagram = orbit_diagram([1.0, 2.0], [np.arange(9.0), np.arange(2.0)], last=4)
    assert np.array_equal(diagram.columns[0], [5.0, 6.0, 7.0, 8.0])
    assert np.array_equal(diagram.columns[1], [0.0, 1.0])


def test_the_logistic_diagram_doubles_where_it_must():
    """x* = 1 - 1/r for 1 < r < 3; two points ((r+1) +- sqrt((r-3)(r+1)))/(2r) up to r = 1 + sqrt 6."""
    rates = np.array([2.0, 2.5, 3.2, 3.4])
    x = np.full(4, 0.3)
    history = []
    for _ in range(3000):
        x = rates * x * (1 - x)
        history.append(x)
    diagram = orbit_diagram(rates, np.array(history).T, last=100)
    for r, column in zip(diagram.parameter, diagram.columns, strict=True):
        root = np.sqrt(max((r - 3) * (r + 1), 0.0))
        expected = [1 - 1 / r] if r < 3 else [((r + 1) - root) / (2 * r), ((r + 1) + root) / (2 * r)]
        assert np.allclose(np.unique(column.round(9)), expected, atol=1e-8)


def test_unequal_numbers_are_refused():
    with pytest.raises(ValueError, match="given 1 arrays for 2 values"):
        orbit_diagram([0.1, 0.2], [[1.0]])
    with pytest.raises(ValueError, match="given 0 arrays for 0 values"):
        orbit_diagram([], [])
