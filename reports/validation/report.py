"""The report of `campaigns.validation`: what is said, in which order. Everything comes from the campaign's folder."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy as np

from tables import count, number, number_of

from ..figures.curves import Curve, Panel, curves, dots
from ..parts import (
    Figure,
    Folder,
    FolderError,
    Heading,
    Items,
    Report,
    Table,
    Text,
    heads,
    read_files,
    read_folder,
    report_page,
    section_items,
    table_of,
    timing_items,
)
from ..parts.style import BLUE, SOFT, VERMILION

FILES = {"cases.csv": "cases and verdicts", "curves.csv": "both curves of each case"}
NUMBERS = ("title", "quantity", "verdict", "ours", "theirs", "error", "bar", "unit")
RUNS = ("run", "status", "steps", "wall_s", "run_key")
_HEADS = {"title": "case"}  # of columns of cases.csv that are not called by their name
MANY = 40  # points of a curve from which on it is a line without marks


class Study(NamedTuple):
    """What the campaign left. cases: rows of cases.csv by case; points: (x, ours, theirs) by case and curve."""

    folder: Folder
    cases: dict[str, list[dict[str, str]]]
    points: dict[str, dict[str, list]]


def read_study(directory: Path) -> Study:
    """Read the folder. Raises FolderError naming every file that is missing or cannot be read."""
    folder, files = read_folder(directory), read_files(directory, FILES)
    judged = files["cases.csv"]
    if not judged or not {"case", *NUMBERS} <= set(judged[0]):
        raise FolderError(folder.directory, "cases.csv cannot be read: it has no rows, or not those of this campaign")
    cases, points = {}, {}
    for row in judged:
        cases.setdefault(row["case"], []).append(row)
    for row in files["curves.csv"]:
        point = [float(row[name]) for name in ("x", "ours", "theirs")]
        points.setdefault(row["case"], {}).setdefault(row["curve"], []).append(point)
    return Study(folder, cases, points)


def report(directory: Path) -> Report:
    """The content of the report on a validation folder. Raises FolderError for a folder that is not one."""
    study = read_study(directory)
    items = [overview(study), section_items("validation"), Heading("All cases"), summary(study)]
    for case in study.cases:
        items.append(case_items(study, case))
    items += [
        Heading("Runs"),
        table_of(study.folder.columns, RUNS, study.folder.table, "Every run, from `table.csv`."),
    ]
    subtitle = f"{count(len(study.cases), 'case')}, each with its source, a bar and a verdict"
    return report_page(study.folder, "Beside measurements and other codes", items, timing_items(study.folder), subtitle)


def overview(study: Study) -> Figure:
    """All cases: ours over theirs, point by point, and the error of every judged quantity over its bar."""
    ours, theirs = [], []
    for pairs in study.points.values():
        for points in pairs.values():
            _, our_values, their_values = np.array(points).T
            scale = np.nanmax(np.abs(their_values))
            if scale > 0.0:
                ours.append(our_values / scale)
                theirs.append(their_values / scale)
    names, shares = [], []
    for case, rows in study.cases.items():
        for row in _judged(rows):
            share = number_of(row, "error") / number_of(row, "bar")
            if np.isfinite(share):
                names.append(f"{case}, {row['quantity']}")
                shares.append(share)
    places, shares = np.arange(len(names)), np.array(shares)
    missing = shares > 1.0
    x, y = (np.concatenate([*curves_of, np.empty(0)]) for curves_of in (theirs, ours))
    ends = np.array([min(x.min(initial=0.0), 0.0), 1.0])
    drawn = [
        Curve(ends, ends, colour=SOFT),
        dots(x, y, ".", BLUE, 2.0, alpha=0.5, pixels=True),
    ]
    errors = []
    for chosen, colour in ((~missing, BLUE), (missing, VERMILION)):
        errors.append(dots(shares[chosen], places[chosen], "o", colour, 4.5))
    axis = {"yticks": places, "yticklabels": names}
    ends_of_names = (len(names) - 0.5, -0.5)
    panels = [
        Panel(drawn, "theirs, over its largest value", "ours, over the largest of theirs"),
        Panel(errors, "error over the most it may be", log="x", settings=axis, marks=[(1.0, "")], ylim=ends_of_names),
    ]
    caption = (
        "Left: ours over theirs at every point of every case; on the line both agree. Right: the error of each judged "
        "quantity over its bar, the most that it may be (dashed); beyond it a case misses. From `curves.csv` and "
        "`cases.csv`."
    )
    alt = f"Ours against theirs, and {count(len(names), 'error')} over their bars, {int(missing.sum())} beyond."
    return Figure(curves([panels], max(2.6, 0.8 + 0.16 * len(names)), widths=(1.0, 0.9)), caption, alt)


def summary(study: Study) -> Table:
    """One row a case and quantity that is judged."""
    rows = []
    for rows_of_case in study.cases.values():
        rows += _judged(rows_of_case)
    caption = (
        "Error: difference of ours from theirs, along the curves where rms is said. Bar: the most that it may be, "
        "set before the run. From `cases.csv`."
    )
    return numbers(rows, ("title", "verdict", "quantity"), caption)


def _judged(rows: list[dict[str, str]]) -> list[dict[str, str]]:
    return [row for row in rows if row["verdict"] != "told"]


def numbers(rows: list[dict[str, str]], first: tuple[str, ...], caption: str) -> Table:
    """The rows of cases.csv with these columns of words, then error, bar and unit."""
    body = []
    for row in rows:
        words = [row[name] for name in first]
        body.append((*words, number(number_of(row, "error"), 4), number(number_of(row, "bar"), 4), row["unit"]))
    word_heads = [_HEADS.get(name, name) for name in first]
    return Table(heads(*word_heads, ("error", ""), ("bar", ""), "unit"), body, caption)


def case_items(study: Study, case: str) -> Items:
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
    *_, last = pairs
    panels = []
    for name, points in pairs.items():
        x, ours, theirs = np.array(points).T
        theirs_look, ours_look = {"width": 1.6}, {"width": 0.9, "line": (0, (4, 2))}
        if len(x) < MANY:
            theirs_look = {"mark": "o", "size": 7.0, "line": "", "filled": False}
            ours_look = {"mark": "x", "size": 5.0, "line": ""}
        drawn = [
            Curve(x, theirs, "theirs", colour=VERMILION, **theirs_look),
            Curve(x, ours, "ours", colour=BLUE, **ours_look),
        ]
        below = first["x_label"] if name == last else ""
        panels.append([Panel(drawn, below, first["y_label"], name)])
    words = "; ".join(f"{row['quantity']}: {row['verdict']}" for row in _judged(study.cases[case]))
    caption = f"{first['title']}: theirs and ours ({words}). From `curves.csv`."
    alt = f"Two curves of {first['y_label']} over {first['x_label']}, theirs {first['theirs']}, ours {first['ours']}."
    return Figure(curves(panels, 2.6 * len(panels) + 0.4, "below", share="x"), caption, alt)
