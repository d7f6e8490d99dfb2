"""What a table measures, as a report draws it: its numbers with their errors, least and greatest values together."""

from collections.abc import Iterable, Mapping, Sequence
from itertools import cycle

import numpy as np

from ..figures.curves import COLOURS, Curve, Panel, curves
from ..parts.columns import Quantity, number_of, value
from ..parts.content import Picture, Table, heads
from ..parts.style import BLUE, GREEN, ORANGE, PURPLE, SKY, SOFT, VERMILION
from ..parts.wording import EMPTY, number

PER_ROW = 2
_CALM = BLUE, GREEN, ORANGE, PURPLE, SKY  # of all motions but that of the largest tension
# numbers of a run for which the reports on buoys have chosen a place, or none
PLACED = frozenset(
    """
    steepness dimensions kicks share share_low share_high periods transient_periods strobed_period radius_min_m
    radius_max_m angle_min_rad angle_max_rad tension_top_min_N tension_top_max_N tension_top_max_error_N slack_fraction
    compression_fraction lyapunov_wolf_bits_per_period lyapunov_wolf_error lyapunov_tangent_bits_per_period
    lyapunov_tangent_error multiplier_modulus multiplier_angle_rad multiplier_error offplane_growth_bits_per_period
    offplane_growth_error max_buoy_height_above_water_m max_turn_rad min_strain unresolved_ringing_N loop_releases
    buoy_lateral_max_m rope_lateral_max_m planar_loop_releases planar_radius_min_m planar_radius_max_m steps
    rejected_steps newton_iterations newton_failures end_time_s wall_s tension_static_N level
    """.split()
)
Measured = tuple[tuple[Quantity, Quantity | None], ...]  # one panel: columns of one unit, each with its errors or None


def measured(
    columns: Mapping[str, Quantity], rows: Sequence[Mapping[str, object]], without: Iterable[str]
) -> list[Measured]:
    """The numeric columns of a table that are not the same in all rows, in its order.

    A column X_..._error belongs to the column X_... before it; X_min_U and X_max_U share a panel. without: names left
    out, such as those of the varied keys.
    """
    names = [name for name, one in columns.items() if one.digits is not None and name not in set(without)]
    errors, found = errors_of(names), []
    for name in names:
        if name.endswith("_error"):
            continue
        known = series(rows, name)
        if len(np.unique(known[np.isfinite(known)])) < 2:
            continue
        least = name.replace("_max_", "_min_")
        pair = (columns[name], columns[errors[name]] if name in errors else None)
        if found and least != name and found[-1][-1][0].name == least:
            found[-1] = (*found[-1], pair)
        else:
            found.append((pair,))
    return found


def colours_of(rows: Sequence[Mapping[str, object]]) -> dict[str, str]:
    """The colour of each motion of a table by its letter; {} where it has one motion, or does not tell of any.

    The motion of the largest tension is vermilion; "", of runs that ended before they had one, is grey.
    """
    peaks: dict[str, float] = {}
    for row in in_order(rows, []):
        peaks[row.get("motion") or ""] = max(peaks.get(row.get("motion") or "", 0.0), value(row, "tension_top_max_N"))
    nameless, left = peaks.pop("", None), cycle(_CALM)
    worst = max(peaks, key=peaks.get, default="")
    colours = {letter: VERMILION if letter == worst else next(left) for letter in peaks}
    return colours | ({} if nameless is None else {"": SOFT}) if len(peaks) > 1 else {}


def in_order(rows: Iterable[Mapping[str, object]], keys: Sequence[str]) -> list:
    """The rows of a table by their keys, then by motion."""
    return sorted(rows, key=lambda row: [*(row[name] for name in keys), row.get("motion") or ""])


def series(rows: Iterable[Mapping[str, object]], column: str) -> np.ndarray:
    """A column of a table over its rows (p,), nan where it is empty."""
    return np.array([number_of(row.get(column)) for row in rows])


def over_key(
    rows: Sequence[Mapping[str, object]], key: Quantity, shown: Sequence[Measured], motions: Mapping[str, str]
) -> Picture:
    """`panels_over` as one picture."""
    panels = panels_over(rows, key, shown, motions)
    grid = [panels[first : first + PER_ROW] for first in range(0, len(panels), PER_ROW)]
    return curves(grid, 0.6 + 1.7 * len(grid), "best")


def panels_over(
    rows: Sequence[Mapping[str, object]], key: Quantity, shown: Sequence[Measured], motions: Mapping[str, str]
) -> list[Panel]:
    """Every quantity over a varied key, a panel each, with error bars where there are errors.

    Runs that did not reach their full length are crosses. motions: `colours_of` the table; where there are several,
    the columns of one panel are told apart by their marks alone.
    """
    good = np.array([row["status"] == "ok" for row in rows], dtype=bool)
    x, panels = series(rows, key.name), []
    of = np.array([(row.get("motion") or "") if motions else "" for row in rows])
    for one in shown:
        lines = []
        *others, last = (column.label for column, _ in one)
        label = ", ".join([*(other.rpartition(" (")[0] for other in others), last])  # the unit once, at the end
        for (column, error), mark, colour in zip(one, "os^D", COLOURS, strict=False):
            y, name = series(rows, column.name), column.label.rpartition(" (")[0] if len(one) > 1 else ""
            bars = series(rows, error.name) if error else None
            for letter, own in (motions or {"": colour}).items():
                some, rest = (of == letter) & good, (of == letter) & ~good
                which = (letter if mark == "o" else "") if motions else name
                lines.append(Curve(x[some], y[some], which, "", mark, own, bars[some] if error else None, 3.0))
                lines.append(Curve(x[rest], y[rest], "", "", "x", own, size=5.0))
        level = 0.0 if any(error for _, error in one) else None
        panels.append(Panel(lines, key.label, label, level=level))
    return panels


def extremes(
    keys: Sequence[Quantity], rows: Sequence[Mapping[str, object]], shown: Iterable[Quantity], caption: str
) -> list[Table]:
    """The least and the greatest value of every quantity, and where; nothing where no run has one."""
    cells = []
    for column in shown:
        values = series(rows, column.name)
        if np.isfinite(values).any():
            ends = (rows[int(np.nanargmin(values))], rows[int(np.nanargmax(values))])
            found = [text for row in ends for text in (column.cell(row[column.name]), at(keys, row))]
            cells.append((column.meaning or column.head, column.unit or EMPTY, *found))
    columns = heads("quantity", "unit", ("least", ""), "at", ("greatest", ""), "at")
    return [Table(columns, tuple(cells), caption, small=True)] if cells else []


def at(keys: Sequence[Quantity], row: Mapping[str, object]) -> str:
    """Where a row stands: "H = 21 m, kA = 0.1"; with the letter of its motion, where keys have that: "motion B"."""
    return ", ".join(
        f"{key.head} {row[key.name]}"
        if key.digits is None
        else f"{key.head} = {number(float(row[key.name]))} {key.unit}".strip()
        for key in keys
    )


def further(columns: Mapping[str, Quantity], placed: Iterable[str] = ()) -> tuple[tuple[str, str], ...]:
    """The numbers of a table that no report has chosen a place for, each with its error, "" for none.

    A column that a campaign declares so reaches its report. placed: names beside PLACED.
    """
    errors, placed = errors_of(columns), PLACED.union(placed)
    return tuple(
        (name, errors.get(name, ""))
        for name, column in columns.items()
        if column.digits is not None and name not in placed and name not in errors.values()
    )


def errors_of(names: Iterable[str]) -> dict[str, str]:
    """Column -> the column of its standard errors: X_error belongs to X, or X_..., where these stand before it."""
    names, found = list(names), {}
    for place, name in enumerate(names):
        if name.endswith("_error"):
            stem = name.removesuffix("error")
            owners = (one for one in names[:place] if f"{one}_".startswith(stem) and not one.endswith("_error"))
            found |= dict.fromkeys(owners, name)
    return found
