"""The folder of `campaigns.accuracy` as its report needs it: rows by work and method, medians over the rounds."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from ..parts.columns import Quantity
from ..parts.folder import Folder, FolderError, read_columns, read_files, read_folder

if TYPE_CHECKING:
    import pandas

OURS, PEER = "point", "peer"
_WORDS = {
    "rtol": "rtol {:g}", "step_s": "step {:.4g} s", "courant": "Courant {:g}", "steps per period": "{:g} a period",
}  # fmt: skip


@dataclass(frozen=True)
class Setting:
    """One timed setting: medians over its rounds. error, worst: in the unit of the work; failed: rounds that ended
    early, the first of them with status and message.
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
        where = "segments" if self.peer and not self.method.startswith("scipy") else "nodes"
        return f"{self.nodes} {where}, {_WORDS[self.control].format(self.value)}"


@dataclass(frozen=True, eq=False)
class Study:
    """What the campaign left. works: {name: title, unit, period_s, duration_s, rough} in the order of the report."""

    folder: Folder
    works: dict[str, dict]
    rows: tuple[dict, ...]
    settings: tuple[Setting, ...]
    orders: tuple[dict, ...]
    order_columns: dict[str, Quantity]
    costs: dict | None

    def unit(self, work: str) -> str:
        """Unit of the errors of a work."""
        return self.works[work]["unit"]

    def timed(self, work: str, method: str = "", peer: bool | None = None) -> list[Setting]:
        """Settings of a work that ended as asked in every round, of one method, of ours or of other codes."""
        found = [one for one in self.settings if one.work == work and one.failed == 0 and math.isfinite(one.error)]
        return [one for one in found if method in ("", one.method) and peer in (None, one.peer)]


def read_study(directory: str | Path) -> Study:
    """Read the folder. Raises FolderError naming every file that is missing or cannot be read."""
    folder = read_folder(directory)
    works = folder.provenance.get("works")
    if not isinstance(works, dict) or not all(isinstance(entry, dict) and "title" in entry for entry in works.values()):
        raise FolderError(folder.directory, ["provenance.json cannot be read: it does not describe the works"])
    wanted = {"orders.csv": "orders of convergence"}
    costs = folder.directory / "costs.json"  # not there without the engine's own runs
    found = read_files(directory, wanted | ({"costs.json": "cost of each piece"} if costs.exists() else {}))
    rows, settings = tuple(folder.table.to_dict("records")), tuple(_settings(folder.table))
    order_columns = read_columns(directory, "orders.csv")
    return Study(folder, works, rows, settings, tuple(found["orders.csv"]), order_columns, found.get("costs.json"))


def _settings(table: pandas.DataFrame) -> Iterator[Setting]:
    timed = table[table["kind"].isin([OURS, PEER])].replace(math.inf, math.nan)
    for named, group in timed.groupby(["work", "method", "nodes", "control", "setting"], sort=False):
        good, bad = group[group["status"] == "ok"], group[group["status"] != "ok"]
        told = (bad if len(bad) else group).iloc[0]
        middle = good[["error", "error_against_ours", "wall_s"]].median()
        yield Setting(
            *named, middle["error"], good["error"].max(), middle["error_against_ours"], middle["wall_s"], len(group),
            len(bad), told["kind"] == PEER, told["status"], told["message"],
        )  # fmt: skip
