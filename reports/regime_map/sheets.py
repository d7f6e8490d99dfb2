"""The sheet of every cell of a map: a page may have thousands, and a script draws the one that is chosen."""

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from analysis import read_evidence

from ..parts.columns import plus_minus
from ..parts.content import CellSheets, plain
from ..parts.folder import Folder
from ..parts.wording import number, printed
from ..sweep.quantities import at, colours_of, errors_of, further
from .maps import COMPUTED, LIMITS, PULL, SCREENED, Atlas

_FACTS = (
    "regime", "verdict", "share", "found_by", "tension_top_max_N", "slack_fraction",
    "lyapunov_tangent_bits_per_period", "multiplier_modulus", "radius_min_m", "radius_max_m", "loop_releases",
    "max_buoy_height_above_water_m", "max_turn_rad", "periods",
)  # fmt: skip
_STROBES = "radius_m", "tension_N"  # once a wave period
_HISTORY = "radius_m", "tension_top_high_N"
_LAST, _POINTS, _NOTHING = 4, 200, np.empty(0)  # wave periods of a history, and its points
_STEPS = 999  # of a drawing, from the least to the largest value of a cell
_SCREENED = "Only screened with the massless tether; the cable is not computed here."
_MET = {"yes": "met", "no": "not met"}


def cell_sheets(folder: Folder, atlas: Atlas) -> CellSheets:
    """What a click on a cell of a map shows: facts and evidence of its motions, their histories and sections."""
    columns, errors = folder.columns, errors_of(folder.columns)
    names = [name for name in _FACTS if name in columns]
    names += [name for name, _ in further(columns, (key.name for key in atlas.keys))]
    motions: dict[tuple[str, ...], list] = {}
    for row, series in zip(folder.table, _series(folder), strict=True):
        facts = [plus_minus(columns, row, name, errors.get(name, "")) for name in names]
        motions.setdefault(_where(row, atlas), []).append((row, facts, series))
    cells = []
    for page in atlas.pages:
        for row, box, area in zip(page.rows, page.cells.boxes, page.area, strict=True):
            if area > 0.0:
                sheet = {"page": page.number, "box": [float(f"{edge:.7g}") for edge in box]}
                own = motions.get(_where(row, atlas), [])
                cells.append({**sheet, "name": plain(at(atlas.keys, row)), "note": _note(row), **_drawn(own)})
    return CellSheets(tuple((columns[name].head, columns[name].unit) for name in names), tuple(cells))


def _where(row: Mapping[str, object], atlas: Atlas) -> tuple[str, ...]:
    """What joins a row of `table.csv` to its cell."""
    return tuple(str(row[key.name]) if key.digits is None else f"{row[key.name]:.9g}" for key in atlas.keys)


def _series(folder: Folder) -> Iterator[list[np.ndarray]]:
    """Of each row: histories of r and T, strobed r and T; empty ones where nothing was kept."""
    try:
        kept = np.load(folder.directory / "strobes.npz")
        places = {key: place for place, key in enumerate(kept["run_key"])}
        strobes = [kept[name] for name in _STROBES]
    except (OSError, ValueError, KeyError):
        places, strobes = {}, []
    for row in folder.table:
        place = places.get(row["run_key"])
        yield [*_history(folder, row), *((_NOTHING,) * 2 if place is None else (values[place] for values in strobes))]


def _history(folder: Folder, row) -> tuple[np.ndarray, np.ndarray]:
    """r and the largest T of _POINTS spans of the last _LAST wave periods of a run; empty for a run without a file.

    Read from the end of the file alone, because all of it takes thirty times as long.
    """
    from scipy.io import netcdf_file

    try:
        with netcdf_file(folder.trajectory_path(row["run_key"]), "r", mmap=True) as file:
            step_s = np.diff(file.variables["time_s"][-2:]).item()
            shown = round(_LAST * row["end_time_s"] / row["periods"] / step_s) + 1
            radius, tension = (np.array(file.variables[name][-shown:], float) for name in _HISTORY)
    except Exception:  # a damaged header can make the reader fail in any way at all
        return _NOTHING, _NOTHING
    starts = np.unique(np.linspace(0, len(radius), _POINTS + 1).astype(int))[:-1]
    return radius[starts], np.maximum.reduceat(tension, starts)


def _note(row) -> str:
    """What limits the result of a cell, behind its largest tension."""
    if row["source"] != COMPUTED:
        return _SCREENED if row["source"] == SCREENED else f"Failed: {row.get('message') or row.get('status')}."
    limits = "; ".join(said for name, said in LIMITS.items() if row.get(name) == 1)
    return f"Largest tension {number(row[PULL], 3)} × static.{f' Mind: {limits}.' if limits else ''}"


def _drawn(own: Sequence[tuple]) -> dict:
    """The motions of one cell (row, facts, series) in the scales of them all."""
    colours = colours_of([row for row, _, _ in own])
    r, T = (np.concatenate([[], *(series[k] for _, _, series in own for k in pair)]) for pair in ((0, 2), (1, 3)))
    scales = [_ends(r), _ends(np.append(T, 0.0))]
    motions = [
        {
            "motion": row["motion"], "colour": colours.get(row["motion"], ""), "facts": facts, "said": _evidence(row),
            "series": [_steps(values, scales[k % 2]) for k, values in enumerate(series)],
        }
        for row, facts, series in own
    ]  # fmt: skip
    return {"scales": scales, "motions": motions}


def _ends(values: np.ndarray) -> list[float]:
    known = values[np.isfinite(values)]
    return [float(f"{end:.4g}") for end in (known.min(), known.max())] if len(known) else [0.0, 1.0]


def _steps(values: np.ndarray, scale: Sequence[float]) -> list[int]:
    """Finite values as whole steps of their scale, from 0 to _STEPS."""
    share = (values[np.isfinite(values)] - scale[0]) / max(scale[1] - scale[0], 1e-12)
    return np.rint(_STEPS * np.clip(share, 0.0, 1.0)).astype(int).tolist()


def _evidence(row) -> str:
    """Why the motion has its regime, in words, with the tests behind it."""
    tests = [f"{name} {value} (threshold {bound}, {_MET.get(met, 'not made')})"
             for name, value, bound, met in read_evidence(row.get("evidence") or "")]  # fmt: skip
    said = [row.get("regime_reason") or "", "; ".join(tests), row["message"] if row["status"] != "ok" else ""]
    return printed(". ".join(filter(None, said)))
