"""A column of a text file as an evenly sampled record, or every reason why it is none.

The file is that of `tables`, with a dot in its numbers.
"""

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from analysis.any_series.tables import close_to, read_table

# Fewer say nothing in any of the measures.
LEAST_SAMPLES = 100
# Share of a step by which a time may miss the even grid: three digits at 30 samples a second miss it by 1.5 %.
UNEVEN = 0.02
# Beyond, squares of differences leave the range of numbers.
LARGEST = 1e100
_CLOCK = re.compile(r"\d+[-/.]\d+[-/.]\d+|\d+:\d+")


@dataclass(frozen=True, eq=False)
class Record:
    """An evenly sampled series.

    values (n,)   in the unit of the file
    step          time from sample to sample, in `unit`
    unit          "s", or "samples" where the file and the command say nothing of time
    column, path  where it came from
    """

    values: np.ndarray
    step: float
    unit: str
    column: str
    path: Path


def read_record(path, column, time, step, faults):
    """The Record of one column; None where anything is wrong, which is then appended to `faults`, a line each.

    column, time   names of columns; None: not given (a file of one column needs no name)
    step           sampling step [s], or None
    """
    before = len(faults)
    table = read_table(Path(path), faults)
    if table is None:
        return None
    names = list(table)
    column = names[0] if column is None and len(names) == 1 else column
    for option, name in (("--column", column), ("--time", time)):
        if name is None and option == "--column":
            faults.append(f"--column: not given; allowed: {_listed(names)}")
        elif name is not None and name not in names:
            faults.append(f"{option}: no column {name!r} in {path}{close_to(name, names)}; allowed: {_listed(names)}")
    if column is not None and column == time:
        faults.append(f"--column and --time: given {column!r} as both; allowed: two columns")
    x = _numbers(table, column, "--column", faults) if column in names else None
    t = _numbers(table, time, "--time", faults) if time in names else None
    if x is not None:
        _worth_it(x, column, faults)
    unit = "samples" if t is None and step is None else "s"
    if t is not None:
        step = _even_step(t, time, faults)
    if len(faults) > before:
        return None
    return Record(x, 1.0 if step is None else step, unit, column, Path(path))


def _listed(names):
    return ", ".join(names[:40]) + (f" and {len(names) - 40} more" if len(names) > 40 else "")


def _numbers(table, name, option, faults):
    """A column as floats (n,); None with a fault where a cell is no finite number."""
    values, wrong = np.full(len(table[name]), np.nan), {}
    for k, cell in enumerate(table[name]):
        try:
            values[k] = float(cell)
        except ValueError:
            wrong.setdefault("is empty" if not cell else "is no number", []).append(k)
            continue
        if not np.isfinite(values[k]):
            wrong.setdefault("is not finite", []).append(k)
    for what, rows in wrong.items():
        first = f"row {rows[0] + 1} below the names, {table[name][rows[0]]!r}, {what}"
        more = f" (so are {len(rows) - 1} more)" if len(rows) > 1 else ""
        allowed = f"finite numbers in every row; {_cure(table[name][rows[0]], option, rows)}"
        faults.append(f"{option} {name}: {first}{more}; allowed: {allowed}")
    return None if wrong else values


def _cure(cell, option, rows):
    """What to do about a cell that is no number, in `rows` of its column."""
    if _CLOCK.search(cell):
        return "dates and clock times are not read" + ("; give --step SECONDS in its place" * (option == "--time"))
    if "," in cell:
        return "with a dot, not a comma"
    if rows == [0] and cell and not any(mark.isdigit() for mark in cell):
        return "a line of units is taken out, or begun with #"
    return "cut the record there or fill the gap"


def _worth_it(x, column, faults):
    if len(x) < LEAST_SAMPLES:
        faults.append(f"--column {column}: given {len(x)} samples; allowed: {LEAST_SAMPLES} or more")
    elif np.abs(x).max() > LARGEST:
        allowed = f"at most {LARGEST:g} in size; take a larger unit"
        faults.append(f"--column {column}: values up to {np.abs(x).max():.3g}; allowed: {allowed}")
    elif np.ptp(x) <= 64 * np.finfo(float).eps * np.abs(x).max():
        faults.append(f"--column {column}: every value is {x[0]:.6g}; allowed: a series that moves")


def _even_step(t, name, faults):
    """The step of an even column of times; a fault where it is not even."""
    if len(t) < 2:
        return None
    forward = np.diff(t)
    if np.any(forward <= 0.0):
        k = int(np.argmax(forward <= 0.0))
        given = f"{t[k + 1]:.9g} follows {t[k]:.9g} in row {k + 2}"
        faults.append(f"--time {name}: {given}; allowed: times in seconds that increase")
        return None
    step = (t[-1] - t[0]) / (len(t) - 1)
    away = np.abs(t - t[0] - step * np.arange(len(t)))
    if away.max() > UNEVEN * step:
        usual, k = np.median(forward), int(np.argmax(np.abs(forward - np.median(forward))))
        given = f"steps of {usual:.6g} s, but of {forward[k]:.6g} s after row {k + 1}"
        if abs(forward[k] - usual) <= UNEVEN * usual:
            given = f"steps that creep from {forward[0]:.9g} s to {forward[-1]:.9g} s"
        allowed = f"even sampling (to {UNEVEN:.0%} of a step); interpolate onto even times first"
        if away.max() <= np.ptp(forward) < 0.9 * step:
            # Within one digit of the even grid, as times written with few digits are.
            allowed += f", or, where times are only rounded, give --step {step:.6g} in the place of --time"
        faults.append(f"--time {name}: {given}; allowed: {allowed}")
        return None
    return float(step)
