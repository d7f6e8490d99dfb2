"""The folder of `python -m analysis ... --out DIR` as its report needs it."""

from __future__ import annotations

import csv
import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..parts.folder import FolderError, no_folder

CURVES = ("series", "spectrum", "section", "divergence", "dimension")


@dataclass(frozen=True, eq=False)
class Judged:
    """What the command left: `answer` and `provenance` as written, `page` its text, `curves` by file and column (n,),
    NaN where a cell is empty, in the order of the columns."""

    answer: dict
    provenance: dict
    page: str
    curves: dict[str, dict[str, np.ndarray]]


def read_judged(directory: str | Path) -> Judged:
    """Read the folder. Raises FolderError naming every file that is missing or cannot be read."""
    directory = Path(directory)
    if not directory.is_dir():
        raise FolderError(directory, [no_folder(directory)])
    faults: list[str] = []

    def read(name, reader):
        try:
            return reader((directory / name).read_text(encoding="utf-8"))
        except FileNotFoundError:
            faults.append(f"{name} is missing (python -m analysis writes it)")
        except (OSError, ValueError, KeyError, IndexError) as error:
            faults.append(f"{name} cannot be read: {error}")
        return None

    answer, provenance = read("answer.json", json.loads), read("provenance.json", json.loads)
    page = read("answer.txt", str)
    curves = {name: read(f"{name}.csv", _columns) for name in CURVES}
    if faults:
        raise FolderError(directory, faults)
    return Judged(answer, provenance, page, curves)


def _columns(text: str) -> dict[str, np.ndarray]:
    head, *rows = csv.reader(text.splitlines())
    cells = np.array([[float(cell) if cell else np.nan for cell in row] for row in rows]).reshape(-1, len(head))
    return dict(zip(head, cells.T, strict=True))
