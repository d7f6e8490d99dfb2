"""Stroboscopic Poincare section of a periodically forced motion: its state once per forcing period.

For a forcing of period T the flow over T maps the section onto itself, so that a period-N motion is N points, a torus a
closed curve and chaos a fractal set. The phase at which one looks moves the points but not what they are.
"""

from collections.abc import Mapping

import numpy as np
from numpy.typing import ArrayLike

from analysis.sampling import (
    ON_SAMPLE,
    checked_columns,
    checked_count,
    checked_positive,
    checked_series,
    record,
    values_at,
)

PHASES = 4


@record
class PoincareSection:
    """States at t_k = (k + phase) T.

    points (m, d)       one row per period, one column per coordinate, in the units given
    period_index (m,)   k
    time_s (m,)         t_k, from the first sample
    names (d,)          the keys given, or "0", "1", ... for an array
    phase               share of the period at which the motion is seen, 0 <= phase < 1
    interpolated        True where t_k are not all samples (cubic spline)
    """

    points: np.ndarray
    period_index: np.ndarray
    time_s: np.ndarray
    names: tuple[str, ...]
    phase: float
    interpolated: bool

    def column(self, name: str) -> np.ndarray:
        """Strobed values (m,) of one coordinate; ValueError for an unknown name."""
        if name not in self.names:
            raise ValueError(f"no coordinate {name!r} in this section; there are {', '.join(self.names)}")
        return self.points[:, self.names.index(name)]


def poincare_section(
    series: ArrayLike | Mapping[str, ArrayLike],
    step_s: float,
    period_s: float,
    phase: float = 0.0,
    transient_periods: int = 0,
) -> PoincareSection:
    """The motion at one phase of its forcing, once per period, after a transient.

        points_k = x((k + phase) T),   k = transient_periods, transient_periods + 1, ... to the end of the record

    series               {name: (n,)}, or an array (n,) or (n, d); samples from t = 0
    step_s               sampling step [s]
    period_s             T [s]
    phase                where in the period to look, as a share of it: 0 <= phase < 1 (0.25: a quarter after t = k T)
    transient_periods    whole periods to leave out at the start
    Returns a PoincareSection: samples as they are where every t_k is a sample, otherwise cubic splines, error O(step^4)
    for a smooth motion.
    Raises ValueError for values that are not finite, coordinates of unequal length, or a record that ends before the
    first t_k (says what is needed and given).
    Source: section 4.2.2 and fig. 19 of the paper show such a section at an unstated phase.
    """
    names, x = _coordinates(series)
    step_s = checked_positive(step_s, "step_s")
    period_s = checked_positive(period_s, "period_s")
    first = checked_count(transient_periods, "transient_periods", least=0)
    if not 0.0 <= phase < 1.0:
        raise ValueError(f"phase: a share of the period, 0 <= phase < 1, is needed, given {phase!r}")
    given_s = max(len(x) - 1, 0) * step_s
    last = int(np.floor((given_s + ON_SAMPLE * step_s) / period_s - phase))
    if len(x) == 0 or last < first:
        wanted = (
            f"a section at phase {phase:g} after {first} transient period(s) needs {first + phase:g} periods of record"
        )
        raise ValueError(f"{wanted} at least, given {given_s / period_s:.4g} ({given_s:g} s, {len(x)} samples)")
    index = np.arange(first, last + 1)
    time_s = (index + phase) * period_s
    points, interpolated = values_at(x, step_s, time_s)
    return PoincareSection(points, index, time_s, names, float(phase), interpolated)


def section_at_phases(series: ArrayLike, step_s: float, period_s: float, transient_periods: int = 0) -> PoincareSection:
    """One coordinate (n,) at four phases of the period, which makes up for the coordinates that are missing.

    Arguments as in poincare_section. Returns a PoincareSection of as many rows as every phase has: x((k + j/4) T) in
    column j (its name), the times those of column 0. That is enough for a state of dimension 4.
    """
    seen = [poincare_section(series, step_s, period_s, phase / PHASES, transient_periods) for phase in range(PHASES)]
    rows = min(len(section.points) for section in seen)
    points = np.hstack([section.points[:rows] for section in seen])
    names, interpolated = tuple(str(phase) for phase in range(PHASES)), any(section.interpolated for section in seen)
    return PoincareSection(points, seen[0].period_index[:rows], seen[0].time_s[:rows], names, 0.0, interpolated)


def _coordinates(series):
    """Names and an (n, d) array of the coordinates given in any of the three ways."""
    if not isinstance(series, Mapping):
        x = checked_columns(series)
        return tuple(str(j) for j in range(x.shape[1])), x
    if not series:
        raise ValueError("series: at least one coordinate is needed, given an empty mapping")
    columns = [checked_series(values, f"series[{name!r}]") for name, values in series.items()]
    if len({len(column) for column in columns}) > 1:
        lengths = ", ".join(f"{name}: {len(column)}" for name, column in zip(series, columns, strict=True))
        raise ValueError(f"series: coordinates of equal length are needed, given {lengths}")
    return tuple(str(name) for name in series), np.column_stack(columns)
