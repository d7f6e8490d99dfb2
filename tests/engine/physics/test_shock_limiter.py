"""Law: the viscosity of shocks is off where a line is stretched evenly, and on at a front, whichever way that runs."""

import numpy as np
import pytest

from engine.physics.shocks import _limiter


def test_the_limiter_sees_a_front_that_comes_from_either_side():
    even, front = np.linspace(1.0, 1.1, 20), np.repeat([0.0, 1.0], 10)
    assert [_limiter(even, k) for k in range(20)] == pytest.approx(np.zeros(20), abs=0.01)
    assert _limiter(front, 9) == _limiter(front[::-1].copy(), 10) == 1.0
