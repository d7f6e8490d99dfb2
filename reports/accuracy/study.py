"""The folder of `campaigns.accuracy` as its report needs it: rows by work and method, medians over the rounds."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..parts.folder import Folder, FolderError, read_files, read_folder

OURS, PEER = "point", "peer"


@dataclass(frozen=True)
class Setting:
    """One timed setting: medians over its rounds. error, worst: in the unit of the work; failed: rounds that ended
    early.
    """

    work: str
    method: str
    nodes: int
    control: str
    value: float
    error: float
    worst: float
    against_ours: float
    wall_s: float
    rounds: int
    failed: int
    peer: bool
    status: str
    message: str

    @property
    def named(self) -> str:
        """The setting in words: "41 nodes, rtol 0.03"."""
        words = {"rtol": "rtol {:g}", "step_s": "step {:.4g} s", "courant": "Courant {:g}"}
        words["steps per period"] = "{:g} a period"
        where = "segments" if self.peer and not self.method.startswith("scipy") else "nodes"
        return f"{self.nodes} {where}, " + words.get(self.control, self.control + " {:g}").format(self.value)


@dataclass(frozen=True, eq=False)
class Study:
    """What the campaign left. works: {name: title, unit, period_s, duration_s, rough} in the order of the report."""

    folder: Folder
    works: dict[str, dict]
    rows: tuple[dict, ...]
    settings: tuple[Setting, ...]
    orders: tuple[dict, ...]
    costs: dict | None

    def of(self, work: str, **wanted) -> list[dict]:
        """Rows of a work with the given entries."""
        return [row for row in self.rows if row["work"] == work and all(row[k] == v for k, v in wanted.items())]

    def unit(self, work: str) -> str:
        """Unit of the errors of a work."""
        return self.works[work]["unit"]

    def timed(self, work: str) -> list[Setting]:
        """Settings of a work that ended as asked in every round."""
        return [one for one in self.settings if one.work == work and one.failed == 0 and math.isfinite(one.error)]


def read_study(directory: str | Path) -> Study:
    """Read the folder. Raises FolderError naming every file that is missing or cannot be read."""
    folder = read_folder(directory)
    works = folder.provenance.get("works")
    if not isinstance(works, dict) or not all(isinstance(entry, dict) and "title" in entry for entry in works.values()):
        raise FolderError(folder.directory, ["provenance.json cannot be read: it does not describe the works"])
    rows = tuple(folder.table.to_dict("records"))
    wanted = {"orders.csv": "orders of convergence"}
    costs = folder.directory / "costs.json"  # not there without the engine's own runs
    found = read_files(directory, wanted | ({"costs.json": "cost of each piece"} if costs.exists() else {}))
    return Study(folder, works, rows, tuple(_settings(rows)), tuple(found["orders.csv"]), found.get("costs.json"))


def _settings(rows: tuple[dict, ...]) -> list[Setting]:
    grouped: dict[tuple, list[dict]] = {}
    for row in rows:
        if row["kind"] in (OURS, PEER):
            key = (row["work"], row["method"], row["nodes"], row["control"], row["setting"])
            grouped.setdefault(key, []).append(row)
    return [_setting(group) for group in grouped.values()]


def _setting(group: list[dict]) -> Setting:
    good = [row for row in group if row["status"] == "ok"]
    bad = next((row for row in group if row["status"] != "ok"), group[0])

    def median(column: str) -> float:
        values = [float(row[column]) for row in good if math.isfinite(float(row[column]))]
        return float(np.median(values)) if values else math.nan

    errors = [float(row["error"]) for row in good]
    first = group[0]
    return Setting(
        first["work"], first["method"], int(first["nodes"]), first["control"], float(first["setting"]),
        median("error"), max(errors, default=math.nan), median("error_against_ours"), median("wall_s"), len(group),
        len(group) - len(good), first["kind"] == PEER, bad["status"], bad["message"],
    )  # fmt: skip
