"""The sheet of every cell of a map: a page may have thousands, and a script draws the one that is chosen."""

from collections.abc import Sequence

import numpy as np

from analysis import read_evidence
from tables import COMPUTED, REGIMES, RUNS, SCREENED, number, printed

from ..figures.quantities import colours_of
from ..parts import LONGEST_CELL, CellSheets, Folder, Row, at, plain, printed_cells, shown_on
from .maps import LIMITS, PULL, Atlas

_STROBES = "radius_m", "tension_N"  # once a wave period
_HISTORY = "radius_m", "tension_top_high_N"
_LAST, _POINTS, _NOTHING = 4, 200, np.empty(0)  # wave periods of a history, and its points
_STEPS = 999  # of a drawing, from the least to the largest value of a cell
_SCREENED = "Only screened with the massless tether; the cable is not computed here."
_MET = {"yes": "met", "no": "not met"}


def cell_sheets(folder: Folder, atlas: Atlas) -> CellSheets:
    """What a click on a cell of a map shows: facts and evidence of its motions, their histories and sections."""
    columns = folder.columns
    keys, cells = {"motion", *(key.name for key in atlas.keys)}, printed_cells(columns)
    names = [name for name in shown_on(columns, folder.table, RUNS, REGIMES, longest=LONGEST_CELL) if name not in keys]
    motions_of_places = {}
    strobes_of_runs, no_strobes = _strobes(folder), [_NOTHING] * len(_STROBES)
    for row in folder.table:
        facts = [cells[name](row) for name in names]
        curves = [*_history(folder, row), *strobes_of_runs.get(row["run_key"], no_strobes)]  # r and T, twice
        motions_of_places.setdefault(_place(row, atlas), []).append((row, facts, curves))
    sheets = []
    for page in atlas.pages:
        for row, box, area in zip(page.rows, page.boxes, page.area, strict=True):
            if area <= 0.0:
                continue
            sheet = {
                "page": page.number,
                "box": [float(f"{edge:.7g}") for edge in box],
                "name": plain(at(atlas.keys, row)),
                "note": _note(row),
            }
            motions = motions_of_places.get(_place(row, atlas), [])
            sheets.append(sheet | _drawn(motions))
    fact_heads = [(columns[name].head, columns[name].unit) for name in names]
    return CellSheets(fact_heads, sheets)


def _place(row: Row, atlas: Atlas) -> tuple[str, ...]:
    """What joins a row of `table.csv` to its cell."""
    place = []
    for key in atlas.keys:
        value = row[key.name]
        name = str(value) if key.digits is None else f"{value:.9g}"
        place.append(name)
    return tuple(place)


def _strobes(folder: Folder) -> dict[str, list[np.ndarray]]:
    """Strobed r and T of each run by its key; {} where the file cannot be read."""
    strobes_of_runs = {}
    try:
        file = np.load(folder.directory / "strobes.npz")
        radius, tension = (file[name] for name in _STROBES)
        for key, *strobes in zip(file["run_key"], radius, tension, strict=True):
            strobes_of_runs[key] = strobes
    except (OSError, ValueError, KeyError):
        return {}
    return strobes_of_runs


def _history(folder: Folder, row) -> tuple[np.ndarray, np.ndarray]:
    """r and the largest T of _POINTS spans of the last _LAST wave periods of a run; empty for a run without a file.

    Read from the end of the file alone, because all of it takes thirty times as long.
    """
    from scipy.io import netcdf_file

    try:
        with netcdf_file(folder.trajectory_path(row["run_key"]), "r", mmap=True) as file:
            step_s = np.diff(file.variables["time_s"][-2:]).item()
            shown = round(_LAST * row["end_time_s"] / row["periods"] / step_s) + 1
            radius, tension = [np.array(file.variables[name][-shown:], float) for name in _HISTORY]
    except Exception:  # a damaged header can make the reader fail in any way at all
        return _NOTHING, _NOTHING
    starts = np.unique(np.linspace(0, len(radius), _POINTS + 1).astype(int))[:-1]
    return radius[starts], np.maximum.reduceat(tension, starts)


def _note(row) -> str:
    """What limits the result of a cell, behind its largest tension."""
    if row["source"] == SCREENED:
        return _SCREENED
    if row["source"] != COMPUTED:
        return f"Failed: {row.get('message') or row.get('status')}."
    note = f"Largest tension {number(row[PULL], 3)} × static."
    limits = [reason for name, reason in LIMITS.items() if row.get(name) == 1]
    if limits:
        note += f" Mind: {'; '.join(limits)}."
    return note


def _drawn(motions: Sequence[tuple]) -> dict:
    """The motions of one cell (row, facts, curves) in the scales of them all."""
    colours = colours_of([row for row, _, _ in motions])
    radius, tension = [[]], [[0.0]]  # the scale of the tension has 0
    for _, _, curves in motions:  # r and T, twice
        radius += curves[::2]
        tension += curves[1::2]
    scales, drawn = [_ends(np.concatenate(radius)), _ends(np.concatenate(tension))], []
    for row, facts, curves in motions:
        steps = [_steps(values, scale) for values, scale in zip(curves, 2 * scales, strict=True)]
        letter = row["motion"]
        drawn.append(
            {
                "motion": letter,
                "colour": colours.get(letter, ""),
                "facts": facts,
                "said": _evidence(row),
                "series": steps,
            }
        )
    return {"scales": scales, "motions": drawn}


def _ends(values: np.ndarray) -> list[float]:
    known = values[np.isfinite(values)]
    if not len(known):
        return [0.0, 1.0]
    return [float(f"{known.min():.4g}"), float(f"{known.max():.4g}")]


def _steps(values: np.ndarray, scale: Sequence[float]) -> list[int]:
    """Finite values as whole steps of their scale, from 0 to _STEPS."""
    share = (values[np.isfinite(values)] - scale[0]) / max(scale[1] - scale[0], 1e-12)
    return np.rint(_STEPS * np.clip(share, 0.0, 1.0)).astype(int).tolist()


def _evidence(row) -> str:
    """Why the motion has its regime, in words, with the tests behind it."""
    tests = []
    for name, value, bound, met in read_evidence(row.get("evidence") or ""):
        tests.append(f"{name} {value} (threshold {bound}, {_MET.get(met, 'not made')})")
    sentences = [row.get("regime_reason") or "", "; ".join(tests)]
    if row["status"] != "ok":
        sentences.append(row["message"])
    return printed(". ".join(filter(None, sentences)))
