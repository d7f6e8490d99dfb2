"""What every measure needs: checked arrays, the value of a series at a given time, and the records of results."""

from dataclasses import dataclass
from functools import partial
from typing import dataclass_transform

import numpy as np
from numpy.typing import ArrayLike

# A time this close to a sample, in steps, is that sample: 5 s / 0.05 s must not turn into an interpolation, and the
# error of taking the sample instead is 1e-6 of one step's change.
ON_SAMPLE = 1e-6


def checked_series(values: ArrayLike, name: str = "series", dimensions: tuple[int, ...] = (1,)) -> np.ndarray:
    """Float copy of `values`; ValueError when it has the wrong number of dimensions, or a NaN or infinity (names the
    first), since every measure here would turn one bad sample into a plausible number."""
    array = np.array(values, dtype=float)
    if array.ndim not in dimensions:
        allowed = " or ".join(str(d) for d in dimensions)
        raise ValueError(f"{name}: an array of {allowed} dimension(s) is needed, given shape {array.shape}")
    bad = np.argwhere(~np.isfinite(array))
    if len(bad):
        position = tuple(bad[0].tolist())
        first = f"the first at index {position[0] if len(position) == 1 else position} ({array[position]})"
        raise ValueError(f"{name}: {len(bad)} value(s) not finite, {first}; cut the record before it")
    return array


def checked_columns(values: ArrayLike, name: str = "series") -> np.ndarray:
    """`checked_series` of a series (n,) or (n, d) as columns (n, d)."""
    x = checked_series(values, name, dimensions=(1, 2))
    return x[:, None] if x.ndim == 1 else x


def in_deviations(x: np.ndarray, centred: bool = False) -> np.ndarray:
    """The columns of x (n, d) that move by more than their rounding, each in its standard deviation: (n, c), c <= d.

    centred: less their means.
    """
    size = x.std(axis=0) if len(x) else np.zeros(x.shape[1])
    moves = size > 64 * np.finfo(float).eps * np.abs(x).max(axis=0, initial=0.0)
    moving = x[:, moves]
    return (moving - moving.mean(axis=0) if centred else moving) / size[moves]


def rows_of_state(coordinates: int) -> int:
    """As few rows of a section with so many coordinates, unmoved ones counted, as make a state of 3 or more numbers."""
    return -(-3 // coordinates)


def states_of(z: np.ndarray, rows: int) -> np.ndarray:
    """Consecutive rows of z (n, c) side by side, the last one first: (n - rows + 1, c rows)."""
    return np.hstack([z[rows - 1 - lag : len(z) - lag] for lag in range(rows)])


def checked_positive(value: float, name: str) -> float:
    """`value` as a float; ValueError unless it is finite and above zero."""
    if not 0.0 < float(value) < np.inf:
        raise ValueError(f"{name}: a finite number > 0 is needed, given {value!r}")
    return float(value)


def checked_not_negative(value: float, name: str) -> float:
    """`value` as a float; ValueError unless it is finite and at least zero."""
    if not 0.0 <= float(value) < np.inf:
        raise ValueError(f"{name}: a finite number >= 0 is needed, given {value!r}")
    return float(value)


def checked_count(value: int, name: str, least: int = 1) -> int:
    """`value` as an int; ValueError unless it is a whole number of at least `least`."""
    if isinstance(value, bool) or int(value) != value or value < least:
        raise ValueError(f"{name}: a whole number >= {least} is needed, given {value!r}")
    return int(value)


def values_at(series: np.ndarray, step_s: float, time_s: ArrayLike) -> tuple[np.ndarray, bool]:
    """Values of `series` (n,) or (n, d) at `time_s` (m,), and whether they were interpolated.

    The samples themselves where every time is a sample; otherwise all of them by one not-a-knot cubic spline, whose
    error is O(step^4) up to both ends of the record for a motion with four bounded derivatives. A kink (a snap) costs
    that order: sample so that the times wanted are samples. ValueError when the spline has fewer than four samples.
    """
    position = np.asarray(time_s, dtype=float) / step_s
    index = np.rint(position).astype(int)
    if np.all(np.abs(position - index) <= ON_SAMPLE):
        return series[index], False
    if len(series) < 4:
        raise ValueError(f"interpolation between samples needs at least 4 of them, given {len(series)}")
    from scipy.interpolate import CubicSpline

    return CubicSpline(np.arange(len(series)), series)(position), True


def standard_error(values: ArrayLike) -> np.ndarray:
    """Standard error of the mean of independent values (n,) or (n, ...) over the first axis; NaN for fewer than two."""
    values = np.asarray(values)
    if len(values) < 2:
        return np.full(values.shape[1:], np.nan)
    return values.std(axis=0, ddof=1) / np.sqrt(len(values))


def locked(array: ArrayLike) -> np.ndarray:
    """The same array, made read-only: a frozen record must not change through its arrays."""
    array = np.asarray(array)
    array.flags.writeable = False
    return array


@dataclass_transform(frozen_default=True, eq_default=False)
def record(fields: type, eq: bool = False) -> type:
    """A frozen dataclass of these fields: its arrays are read-only and printed by their shapes, its numbers are
    Python's and not NumPy's.

    eq: whether two of them are equal that have equal entries. Arrays have no such answer.
    """

    def finish(self):
        for name, entry in vars(self).items():
            if isinstance(entry, np.ndarray):
                object.__setattr__(self, name, locked(entry.view()))
            elif isinstance(entry, np.generic):
                object.__setattr__(self, name, entry.item())

    def __repr__(self) -> str:
        entries = []
        for name, entry in vars(self).items():
            text = repr(entry)
            if isinstance(entry, np.ndarray):
                text = f"array{entry.shape}"
            entries.append(f"{name}={text}")
        return f"{fields.__name__}({', '.join(entries)})"

    fields.__post_init__, fields.__repr__ = finish, fields.__dict__.get("__repr__", __repr__)
    return dataclass(frozen=True, eq=eq)(fields)


record_of_numbers = partial(record, eq=True)
