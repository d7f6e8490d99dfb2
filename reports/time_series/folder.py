"""The folder of `python -m analysis ... --out DIR` as its report needs it."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from ..parts.folder import FolderError, no_folder

if TYPE_CHECKING:
    import pandas

CURVES = ("series", "spectrum", "section", "divergence", "dimension")


@dataclass(frozen=True, eq=False)
class Judged:
    """What the command left: `answer` and `provenance` as written, `page` its text, `curves` by file, NaN where a cell
    is empty."""

    answer: dict
    provenance: dict
    page: str
    curves: dict[str, pandas.DataFrame]


def read_judged(directory: str | Path) -> Judged:
    """Read the folder. Raises FolderError naming every file that is missing or cannot be read."""
    import pandas

    directory = Path(directory)
    if not directory.is_dir():
        raise FolderError(directory, [no_folder(directory)])
    found, faults = {}, []
    readers = {"answer.json": _json, "provenance.json": _json, "answer.txt": lambda path: path.read_text("utf-8")}
    readers |= {f"{name}.csv": lambda path: pandas.read_csv(path, dtype=float) for name in CURVES}
    for name, reader in readers.items():
        try:
            found[name] = reader(directory / name)
        except FileNotFoundError:
            faults.append(f"{name} is missing (python -m analysis writes it)")
        except (OSError, ValueError) as error:
            faults.append(f"{name} cannot be read: {error}")
    if faults:
        raise FolderError(directory, faults)
    curves = {name: found[f"{name}.csv"] for name in CURVES}
    return Judged(found["answer.json"], found["provenance.json"], found["answer.txt"], curves)


def _json(path: Path) -> dict:
    return json.loads(path.read_text(encoding="utf-8"))
