"""The report of `campaigns.validation`: what is said, in which order. Everything comes from the campaign's folder."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..figures.curves import Curve, Panel, curves
from ..parts.columns import table_of, value
from ..parts.content import Figure, Heading, Item, Report, Table, Text, heads
from ..parts.folder import Folder, FolderError, read_files, read_folder
from ..parts.provenance import appendix, provenance_items, timing_items
from ..parts.sections import section_items
from ..parts.style import BLUE, VERMILION
from ..parts.wording import count, number

FILES = {"cases.csv": "cases and verdicts", "curves.csv": "both curves of each case"}
NUMBERS = ("title", "quantity", "verdict", "ours", "theirs", "error", "bar", "unit")
RUNS = ("run", "status", "steps", "wall_s", "run_key")
MANY = 40  # points of a curve from which on it is a line without marks


@dataclass(frozen=True, eq=False)
class Study:
    """What the campaign left. cases: rows of cases.csv by case; points: by case and curve, (x, ours, theirs) (3, n)."""

    folder: Folder
    cases: dict[str, list[dict[str, str]]]
    points: dict[str, dict[str, np.ndarray]]


def read_study(directory: str | Path) -> Study:
    """Read the folder. Raises FolderError naming every file that is missing or cannot be read."""
    folder, files = read_folder(directory), read_files(directory, FILES)
    judged, rows = (files[name] for name in FILES)
    if not judged or not {"case", *NUMBERS} <= set(judged[0]):
        raise FolderError(folder.directory, ["cases.csv cannot be read: it has no rows, or not those of this campaign"])
    cases: dict[str, list[dict[str, str]]] = {}
    for row in judged:
        cases.setdefault(row["case"], []).append(row)
    points: dict[str, dict[str, list]] = {}
    for row in rows:
        place = points.setdefault(row["case"], {}).setdefault(row["curve"], [])
        place.append([float(row[name]) for name in ("x", "ours", "theirs")])
    arrays = {case: {name: np.array(at).T for name, at in panels.items()} for case, panels in points.items()}
    return Study(folder, cases, arrays)


def report(directory: str | Path) -> Report:
    """The content of the report on a validation folder. Raises FolderError for a folder that is not one."""
    study = read_study(directory)
    items: list[Item] = [
        *section_items("validation", "Question"),
        Heading("All cases"),
        summary(study),
        *(item for case in study.cases for item in case_items(study, case)),
        Heading("Runs"),
        table_of(study.folder.columns, RUNS, study.folder.table, "Every run, from `table.csv`."),
        *appendix(*timing_items(study.folder), *provenance_items(study.folder)),
    ]
    cases_text = count(len(study.cases), "case")
    return Report(
        "Beside measurements and other codes", f"{cases_text}, each with its source, a bar and a verdict", tuple(items)
    )


def summary(study: Study) -> Table:
    """One row a case and quantity that is judged."""
    rows = [row for rows_of_case in study.cases.values() for row in rows_of_case if row["verdict"] != "told"]
    caption = (
        "Error: difference of ours from theirs, along the curves where rms is said. Bar: the most that it may be, "
        "set before the run. From `cases.csv`."
    )
    return numbers(rows, ("title", "verdict", "quantity"), caption)


def numbers(rows: list[dict[str, str]], first: tuple[str, ...], caption: str) -> Table:
    """The rows of cases.csv with these columns of words, then error, bar and unit."""
    body = (
        (*(row[name] for name in first), *(number(value(row, name), 4) for name in ("error", "bar")), row["unit"])
        for row in rows
    )
    words = ("case" if name == "title" else name for name in first)
    return Table(heads(*words, ("error", ""), ("bar", ""), "unit"), tuple(body), caption, small=True)


def case_items(study: Study, case: str) -> Iterator[Item]:
    """The page of a case: source, both curves on one axis, numbers and verdicts."""
    rows = study.cases[case]
    first = rows[0]
    yield Heading(first["title"], page=True)
    verdicts = (
        f"Theirs are {first['source']}.",
        first["assumed"] and f"Assumed: {first['assumed']}.",
        first["note"] and f"{first['note'][0].upper()}{first['note'][1:]}.",
    )
    yield Text(" ".join(filter(None, verdicts)))
    if first["verdict"] == "not run":
        return
    if case in study.points:
        yield figure(study, case)
    yield numbers(rows, ("quantity", "verdict", "ours", "theirs"), "Numbers and verdicts, from `cases.csv`.")


def figure(study: Study, case: str) -> Figure:
    """Ours and theirs on one axis, a panel a pair of curves."""
    first, pairs = study.cases[case][0], study.points[case]
    panels = []
    for name, (x, ours, theirs) in pairs.items():
        looks = [{"width": 1.6}, {"width": 0.9, "line": (0, (4, 2))}]
        if len(x) < MANY:
            looks = [{"mark": "o", "size": 7.0, "line": "", "filled": False}, {"mark": "x", "size": 5.0, "line": ""}]
        drawn = [
            Curve(x, y, word, colour=colour, **look)
            for y, word, colour, look in zip((theirs, ours), ("theirs", "ours"), (VERMILION, BLUE), looks, strict=True)
        ]
        below = first["x_label"] if name == [*pairs][-1] else ""
        panels.append([Panel(drawn, below, first["y_label"], name)])
    words = "; ".join(f"{row['quantity']}: {row['verdict']}" for row in study.cases[case] if row["verdict"] != "told")
    caption = f"{first['title']}: theirs and ours ({words}). From `curves.csv`."
    alt = f"Two curves of {first['y_label']} over {first['x_label']}, theirs {first['theirs']}, ours {first['ours']}."
    return Figure(curves(panels, 2.6 * len(panels) + 0.4, "below", share="x"), caption, alt)
