"""A column of a text file as an evenly sampled record, or every reason why it is none.

The file: columns separated by commas, semicolons, tabs or spaces, a dot in numbers, one line of names above them (a
file of numbers only has the columns 1, 2, ...), lines that begin with # left out.
"""

import difflib
from dataclasses import dataclass
from pathlib import Path

import numpy as np

# Fewer say nothing in any of the measures.
LEAST_SAMPLES = 100
# Share of a step by which a time may miss the even grid: three digits at 30 samples a second miss it by 1.5 %.
UNEVEN = 0.02
FORMAT = "a text file of columns separated by commas, semicolons, tabs or spaces, with their names in the first line"


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
    table = _table(Path(path), faults)
    if table is None:
        return None
    names = list(table)
    column = names[0] if column is None and len(names) == 1 else column
    for option, name in (("--column", column), ("--time", time)):
        if name is None and option == "--column":
            faults.append(f"--column: not given; allowed: {_listed(names)}")
        elif name is not None and name not in names:
            faults.append(f"{option}: no column {name!r} in {path}{_close(name, names)}; allowed: {_listed(names)}")
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


def _close(name, names):
    close = difflib.get_close_matches(name, names, n=1)
    return f"; did you mean {close[0]!r}?" if close else ""


def _table(path, faults):
    """{name: cells (n,) of text}, or None with a fault."""
    if path.is_dir():
        faults.append(f"{path}: a folder; allowed: {FORMAT}")
        return None
    try:
        lines = path.read_text(encoding="utf-8-sig").splitlines()
    except FileNotFoundError:
        folder = path.absolute().parent
        beside = [other.name for other in folder.iterdir()] if folder.is_dir() else []
        where = "" if folder.is_dir() else f", nor a folder {folder}"
        faults.append(f"{path}: there is no such file{where}{_close(path.name, beside)}; allowed: {FORMAT}")
        return None
    except UnicodeDecodeError:
        faults.append(f"{path}: not text; allowed: {FORMAT} (of a trajectory: its table().to_csv(...))")
        return None
    except OSError as error:
        faults.append(f"{path}: cannot be read: {error.strerror}; allowed: {FORMAT}")
        return None
    lines = [line for line in lines if line.strip() and not line.lstrip().startswith("#")]
    if not lines:
        faults.append(f"{path}: empty; allowed: {FORMAT}")
        return None
    split = _splitter(lines[0])
    rows = [split(line) for line in lines]
    names = rows[0]
    if all(_is_number(cell) for cell in names):
        names = [str(place + 1) for place in range(len(names))]
    else:
        rows = rows[1:]
    ragged = next((k for k, row in enumerate(rows) if len(row) != len(names)), None)
    if ragged is not None:
        given = f"row {ragged + 1} below the names has {len(rows[ragged])} cells, the names are {len(names)}"
        faults.append(f"{path}: {given}; allowed: {FORMAT}")
        return None
    if len(set(names)) < len(names):
        twice = next(name for name in names if names.count(name) > 1)
        faults.append(f"{path}: two columns are called {twice!r}; allowed: a name of its own for each")
        return None
    return {name: [row[place] for row in rows] for place, name in enumerate(names)}


def _splitter(line):
    """How a line falls into cells, judged by the first one."""
    for mark in ("\t", ";", ","):
        if mark in line:
            return lambda text: [cell.strip().strip('"') for cell in text.split(mark)]
    return str.split


def _is_number(cell):
    try:
        float(cell)
    except ValueError:
        return False
    return True


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
        comma = " with a dot, not a comma" if "," in table[name][rows[0]] else ""
        allowed = f"finite numbers{comma} in every row; cut the record there or fill the gap"
        faults.append(f"{option} {name}: {first}{more}; allowed: {allowed}")
    return None if wrong else values


def _worth_it(x, column, faults):
    if len(x) < LEAST_SAMPLES:
        faults.append(f"--column {column}: given {len(x)} samples; allowed: {LEAST_SAMPLES} or more")
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
        faults.append(f"--time {name}: {given}; allowed: {allowed}")
        return None
    return float(step)
