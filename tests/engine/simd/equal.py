"""What it means that two runs are the same: everything but the time they took, bit for bit."""

import numpy as np


def assert_equal(one, other):
    assert one.status == other.status and one.message == other.message and one.scene == other.scene
    for name, column in one.columns.items():
        assert np.array_equal(column, other.columns[name]), name
    for name, value in one.statistics.items():
        assert name == "wall_s" or value == other.statistics[name], name
    for part in ("profiles", "tangent"):
        mine, theirs = getattr(one, part), getattr(other, part)
        assert (mine is None) == (theirs is None)
        for name, values in vars(mine).items() if mine is not None else ():
            assert np.array_equal(values, getattr(theirs, name)), name
