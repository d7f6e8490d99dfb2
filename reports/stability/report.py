"""The report of `campaigns.stability`: what is said, in which order. Everything comes from the campaign's folder."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from statistics import median

import numpy as np

from tables import EMPTY, Column, count, number, number_of

from ..figures.stability import stiffness
from ..parts.columns import table_of
from ..parts.content import Figure, Heading, Item, Notice, Report, Table, Text, heads
from ..parts.folder import FolderError, read_files
from ..parts.provenance import appendix, provenance_items, timing_items
from ..parts.sections import section_items
from ..parts.selecting import entries, having


def report(directory: str | Path) -> Report:
    """The content of the report on a stability folder. Raises FolderError for a folder that is not one."""
    study = read_study(directory)
    items: list[Item] = [
        *unexplained_items(study),  # before the first heading: on the first page, after the answer
        *section_items("stability", "Question"),
        *stiffness_items(study),
        *case_items(study),
        *limit_items(study),
        *random_items(study),
        *appendix(*timing_items(study), *provenance_items(study)),
    ]
    kind = "quick selection" if study.provenance.get("quick") else "all cases"
    return Report("Stiff and extreme scenes", f"{count(len(study.cases), 'case')} ({kind})", tuple(items))


FILES = {
    "table.csv": "one row a case",
    "columns.csv": "what its columns are",
    "fuzz.csv": "one row a random scene",
    "provenance.json": "what ran, where and for how long",
}
SOUND = ("ok", "ended", "refused")  # outcomes of random scenes; any other is a fault of the program
HOW = (
    "Checks. Closed form: the largest distance from it. Refinement, or a run on other nodes: rms difference of r "
    "from a run with twice the elements and a tenth of the tolerance (or the nodes named), over its range. "
    "Energy: largest change of the total over the largest kinetic energy, without water. Static equilibrium stays, "
    "symmetry, r stays: the largest movement over the length. Tension: how far the largest one at the top is off. "
    "Finite and complete: every sample is there and is a number; this is asked of every run. A case is ok where its "
    "numbers are below their bars, or the run itself says that its tensions hold no better (ringing)."
)
SHOWN = (
    "case", "dimensions", "verdict", "run_status", "how", "measured", "bar", "measured_tension", "bar_tension",
    "unresolved_ringing_N", "length_s", "case_wall_s",
)  # fmt: skip
DEFAULT = "EA", "EA = 50000 N, regular wave"  # whose cost is the unit


@dataclass(frozen=True, eq=False)
class Study:
    """What the campaign left: `cases` and `random`, rows of text by column."""

    provenance: dict
    columns: dict[str, Column]
    cases: list[dict[str, str]]
    random: list[dict[str, str]]

    def judged(self, verdict: str) -> list[dict[str, str]]:
        """The cases with that verdict."""
        return having(self.cases, verdict=verdict)

    def unsound(self) -> list[dict[str, str]]:
        """The random scenes in which the program is at fault."""
        return [row for row in self.random if row["outcome"] not in SOUND]


def read_study(directory: str | Path) -> Study:
    """Read the folder. Raises FolderError naming every file that is missing or cannot be read."""
    files = read_files(directory, FILES)
    table, columns, random, provenance = files.values()
    if not table or not {"part", "group", "verdict"} <= set(table[0]):
        raise FolderError(Path(directory), ["table.csv cannot be read: it has no rows, or not those of this campaign"])
    cases = having(table, part="case")
    return Study(provenance, columns, cases, random)


def case_items(study: Study) -> list[Item]:
    """One table of all cases, a row with its title before each group."""
    rows = []
    for about in dict.fromkeys(entries(study.cases, "about")):
        rows += [{"case": f"— {about} —"}, *having(study.cases, about=about)]

    def cell(name: str):
        return lambda row: study.columns[name].cell(row) if "group" in row else row.get(name, "")

    caption = "Cases and verdicts, from `table.csv`."
    cells = {name: cell(name) for name in SHOWN}
    return [Heading("Cases and verdicts"), Text(HOW), table_of(study.columns, SHOWN, rows, caption, cells)]


def stiffness_items(study: Study) -> Iterator[Item]:
    """Error of the largest tension, and cost, over stiffness; nothing without the case whose cost is the unit."""
    measured: dict[str, list[tuple[float, ...]]] = {}
    unit = math.nan
    for row in study.judged("ok"):
        shown = row["group"] == "EA" or row["how"] == "waves in a bar"
        if not shown or not row["measured_tension"] or row.get("warning", row["message"]):
            continue
        cost, stiffness_N = (
            number_of(row, "newton_iterations") / number_of(row, "length_s"),
            number_of(row, "stiffness_N"),
        )
        if (row["group"], row["case"]) == DEFAULT:
            unit = cost
        if math.isfinite(stiffness_N):
            measured.setdefault(row["how"], []).append((stiffness_N, number_of(row, "measured_tension"), cost))
    if not measured or math.isnan(unit):
        return
    points, worst, largest = {}, 0.0, 0.0
    for name, checks in measured.items():
        points[name] = np.array(checks).T / np.array([[1.0], [1.0], [unit]])
        worst, largest = max(worst, points[name][1].max()), max(largest, points[name][2].max())
    seen = f"errors up to {number(worst, 2)}, {number(largest, 2)} times as many iterations at most"
    yield Heading("Tension and cost over stiffness")
    yield Figure(
        stiffness(points),
        f"Largest tension at the top against what it should be, and its cost: {seen}. A stiff line costs more only "
        "while it rings. From `table.csv`.",
        f"Error of the largest tension and cost over axial stiffness: {seen}.",
    )


def limit_items(study: Study) -> Iterator[Item]:
    """What ended otherwise than "ok", and what the user is told."""
    cells = {"message": lambda row: row["message"].removeprefix("faulty scene: ")}
    sections = (
        (Heading("Known limits"), "known limit", ("limit", "case", "run_status"), "Endings that were expected."),
        (Heading("Refused, and what the user is told", 2), "refused", ("case", "message"), "Scenes not started."),
    )
    for heading, verdict, names, caption in sections:
        rows = sorted(study.judged(verdict), key=lambda row: row["limit"])
        yield heading
        if rows:
            yield table_of(study.columns, names, rows, f"{caption} From `table.csv`.", cells)
        else:
            yield Text("None.")


def random_items(study: Study) -> Iterator[Item]:
    """Counts of outcomes and statuses, and the times."""
    yield Heading("Random scenes")
    if not study.random:
        yield Text("None were asked for (`--fuzz 0`).")
        return
    yield Text(
        "Valid scenes are drawn section by section, and drawn again where a rule between their values is broken; in "
        "about half of them up to three numbers are replaced by extreme ones that the engine still accepts. Invalid "
        "scenes are valid ones with up to three faults put in. Each scene runs in a process of its own, for up to 40 "
        "samples, with a limit of 60 s of computing. The same seed gives the same scenes."
    )
    walls: dict[tuple[str, ...], list[float]] = {}
    for row in sorted(study.random, key=lambda row: (row["kind"] != "valid", row["outcome"] != "ok")):
        named = row["kind"], row["outcome"], row["status"] or EMPTY, row["meaning"]
        walls.setdefault(named, []).append(number_of(row, "wall_s"))
    rows = []
    for named, values in walls.items():
        rows.append((*named, str(len(values)), number(median(values), 2), number(max(values), 3)))
    columns = heads("scenes", "outcome", "ended", "meaning", ("count", ""), ("median", "s"), ("slowest", "s"))
    yield Table(columns, tuple(rows), "Outcomes of random scenes. From `fuzz.csv`.", small=True)


def unexplained_items(study: Study) -> list[Item]:
    """A warning with all that nobody expected, or a note that there is nothing of the kind."""
    lines = []
    for row in study.judged("unexplained"):
        lines.append(f"{row['group']}, {row['case']}: {row['run_status']} {row['message']}".strip())
    for row in study.unsound():
        lines.append(f"random {row['kind']} scene {row['number']}: {row['outcome']}, {row['message'][:300]}")
    if lines:
        return [Notice("warning", "Unexplained", tuple(lines))]
    return [Notice("note", "Nothing unexplained", ("Every case ended as expected, or with a reason given below.",))]
