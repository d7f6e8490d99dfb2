"""The folder of `campaigns.stability` as its report needs it: cases, random scenes, one-step maps, shares."""

from __future__ import annotations

import csv
import json
import math
from dataclasses import dataclass
from pathlib import Path

from ..parts.folder import FolderError, no_folder

FILES = {
    "table.csv": "one row a case",
    "fuzz.csv": "one row a random scene",
    "step_maps.json": "eigenvalues of one-step maps",
    "scene_shares.json": "what each part of a scene costs",
    "provenance.json": "what ran, where and for how long",
}
VERDICTS = ("ok", "refused", "known limit", "unexplained")


@dataclass(frozen=True, eq=False)
class Study:
    """What the campaign left: `cases` and `random`, rows of text by column; `maps`, `shares` as their files have it."""

    directory: Path
    provenance: dict
    cases: list[dict[str, str]]
    random: list[dict[str, str]]
    maps: dict
    shares: dict

    def group(self, name: str) -> list[dict[str, str]]:
        """The cases of one group, in their order."""
        return [row for row in self.cases if row["group"] == name]

    def groups(self) -> list[str]:
        """Every group, in its order."""
        return list(dict.fromkeys(row["group"] for row in self.cases))

    def judged(self, verdict: str) -> list[dict[str, str]]:
        """The cases with that verdict."""
        return [row for row in self.cases if row["verdict"] == verdict]


def value(row: dict[str, str], column: str) -> float:
    """A cell as a number; NaN where it is empty."""
    text = row.get(column, "")
    return float(text) if text else math.nan


def read_study(directory: str | Path) -> Study:
    """Read the folder. Raises FolderError naming every file that is missing or cannot be read."""
    directory = Path(directory)
    if not directory.is_dir():
        raise FolderError(directory, [no_folder(directory)])
    faults = [f"{name} is missing ({meaning})" for name, meaning in FILES.items() if not (directory / name).exists()]
    found = {}
    for name in FILES if not faults else ():
        try:
            text = (directory / name).read_text(encoding="utf-8")
            found[name] = json.loads(text) if name.endswith(".json") else list(csv.DictReader(text.splitlines()))
        except (OSError, ValueError) as error:
            faults.append(f"{name} cannot be read: {error}")
    if not faults and not (found["table.csv"] and {"part", "group", "verdict"} <= set(found["table.csv"][0])):
        faults.append("table.csv cannot be read: it has no rows, or not those of this campaign")
    if not faults and not isinstance(found["scene_shares.json"].get("scenes"), dict):
        faults.append("scene_shares.json cannot be read: it has no scenes")
    if faults:
        raise FolderError(directory, faults)
    cases = [row for row in found["table.csv"] if row["part"] == "case"]
    return Study(
        directory,
        found["provenance.json"],
        cases,
        found["fuzz.csv"],
        found["step_maps.json"],
        found["scene_shares.json"],
    )
