"""The folder of `campaigns.stability` as its report needs it: cases, random scenes, one-step maps, shares."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from ..parts.columns import Quantity
from ..parts.folder import FolderError, read_columns, read_files

FILES = {
    "table.csv": "one row a case",
    "columns.csv": "what its columns are",
    "fuzz.csv": "one row a random scene",
    "step_maps.json": "eigenvalues of one-step maps",
    "scene_shares.json": "what each part of a scene costs",
    "provenance.json": "what ran, where and for how long",
}
VERDICTS = ("ok", "refused", "known limit", "unexplained")
SOUND = ("ok", "ended", "refused")  # outcomes of random scenes; any other is a fault of the program


@dataclass(frozen=True, eq=False)
class Study:
    """What the campaign left: `cases` and `random`, rows of text by column; `maps`, `shares` as their files have it."""

    directory: Path
    provenance: dict
    columns: dict[str, Quantity]
    cases: list[dict[str, str]]
    random: list[dict[str, str]]
    maps: dict
    shares: dict

    def judged(self, verdict: str) -> list[dict[str, str]]:
        """The cases with that verdict."""
        return [row for row in self.cases if row["verdict"] == verdict]

    def unsound(self) -> list[dict[str, str]]:
        """The random scenes in which the program is at fault."""
        return [row for row in self.random if row["outcome"] not in SOUND]


def read_study(directory: str | Path) -> Study:
    """Read the folder. Raises FolderError naming every file that is missing or cannot be read."""
    found, columns = read_files(directory, FILES), read_columns(directory)
    table, shares = found["table.csv"], found["scene_shares.json"]
    faults = []
    if not table or not {"part", "group", "verdict"} <= set(table[0]):
        faults.append("table.csv cannot be read: it has no rows, or not those of this campaign")
    if not isinstance(shares.get("scenes"), dict):
        faults.append("scene_shares.json cannot be read: it has no scenes")
    if faults:
        raise FolderError(Path(directory), faults)
    cases = [row for row in table if row["part"] == "case"]
    provenance, random, maps = found["provenance.json"], found["fuzz.csv"], found["step_maps.json"]
    return Study(Path(directory), provenance, columns, cases, random, maps, shares)
