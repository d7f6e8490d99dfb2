"""The report of `campaigns.stability`: what is said, in which order. Everything comes from the campaign's folder."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from tables import count, number, number_of

from ..figures.verdict_grid import verdict_grid
from ..parts import (
    Figure,
    Folder,
    FolderError,
    Heading,
    Items,
    Notice,
    Report,
    Text,
    entries,
    having,
    read_files,
    report_page,
    section_items,
    table_of,
    timing_items,
)
from ..parts.style import BLUE, GREEN, ORANGE, SKY, VERMILION, picture_of, sheet


def report(directory: Path) -> Report:
    """The content of the report on a stability folder. Raises FolderError for a folder that is not one."""
    folder = read_cases(directory)
    items = [
        grid_figure(folder),
        unexplained_items(folder),  # before the first heading: on the first page, after the answer
        section_items("stability"),
        stiffness_items(folder),
        case_items(folder),
        limit_items(folder),
    ]
    kind = "quick selection" if folder.provenance.get("quick") else "all cases"
    subtitle = f"{count(len(folder.table), 'case')} ({kind})"
    return report_page(folder, "Stiff and extreme scenes", items, timing_items(folder), subtitle)


FILES = {
    "table.csv": "one row a case",
    "columns.csv": "what its columns are",
    "provenance.json": "what ran, where and for how long",
}
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
VERDICT_COLOURS = {"ok": GREEN, "refused": SKY, "known limit": ORANGE, "unexplained": VERMILION}
LEAST = 1e-8  # where smaller errors are drawn


def read_cases(directory: Path) -> Folder:
    """The folder, without a scene; its rows are those of the cases, as text: older tables have random scenes as well.

    Raises FolderError naming every file that is missing or cannot be read.
    """
    table, columns, provenance = read_files(directory, FILES).values()
    if not table or not {"part", "group", "verdict"} <= set(table[0]):
        raise FolderError(directory, "table.csv cannot be read: it has no rows, or not those of this campaign")
    return Folder(directory, provenance, tuple(having(table, part="case")), None, columns)


def case_items(folder: Folder) -> Items:
    """One table of all cases, a row with its title before each group."""
    rows = []
    for about, cases in by_group(folder).items():
        rows += [about, *cases]
    table = table_of(folder.columns, SHOWN, rows, "Cases and verdicts, from `table.csv`.")
    return [Heading("Cases and verdicts"), Text(HOW), table]


def by_group(folder: Folder) -> dict[str, list[dict[str, str]]]:
    """The cases of each group, by its title."""
    groups = {}
    for row in folder.table:
        groups.setdefault(row["about"], []).append(row)
    return groups


def grid_figure(folder: Folder) -> Figure:
    """All cases as cells in the colours of their verdicts, a row for each group."""
    groups = {about: entries(cases, "verdict") for about, cases in by_group(folder).items()}
    caption = "Every case, a cell each, in the colour of its verdict, in the order of the table of cases."
    return verdict_grid(groups, VERDICT_COLOURS, "case", caption)


def stiffness_items(folder: Folder) -> Items:
    """Error of the largest tension, and cost, over stiffness; nothing without the case whose cost is the unit."""
    measured = {}  # how it was checked -> stiffness in N, error, Newton iterations a second
    unit = math.nan
    for row in having(folder.table, verdict="ok"):
        shown = row["group"] == "EA" or row["how"] == "waves in a bar"
        if not shown or not row["measured_tension"] or row.get("warning", row["message"]):
            continue
        cost = number_of(row, "newton_iterations") / number_of(row, "length_s")
        stiffness_N = number_of(row, "stiffness_N")
        if (row["group"], row["case"]) == DEFAULT:
            unit = cost
        if math.isfinite(stiffness_N):
            measured.setdefault(row["how"], []).append((stiffness_N, number_of(row, "measured_tension"), cost))
    if not measured or math.isnan(unit):
        return
    worst, largest = 0.0, 0.0
    with sheet(2.6) as figure:
        left, right = figure.subplots(1, 2, subplot_kw={"xscale": "log", "yscale": "log"})
        for (name, checks), colour, mark in zip(
            measured.items(), (BLUE, VERMILION, GREEN, ORANGE), "osD^", strict=False
        ):
            stiff, error, cost = np.array(checks).T
            look = {"color": colour, "markersize": 3.5, "label": name}
            left.plot(stiff, np.maximum(error, LEAST), mark, **look)
            right.plot(stiff, cost / unit, mark, **look)
            worst, largest = max(worst, error.max()), max(largest, (cost / unit).max())
        left.set(xlabel="axial stiffness EA (N)", ylabel="error of the largest tension (–)")
        right.set(xlabel="axial stiffness EA (N)", ylabel="Newton iterations a second,\nover the default scene's (–)")
        handles, names = left.get_legend_handles_labels()
        figure.legend(handles, names, loc="outside upper center", ncols=len(names), fontsize=7.0)
        picture = picture_of(figure)
    seen = f"errors up to {number(worst, 2)}, {number(largest, 2)} times as many iterations at most"
    yield Heading("Tension and cost over stiffness")
    yield Figure(
        picture,
        f"Largest tension at the top against what it should be, and its cost: {seen}. A stiff line costs more only "
        "while it rings. From `table.csv`.",
        f"Error of the largest tension and cost over axial stiffness: {seen}.",
    )


def limit_items(folder: Folder) -> Items:
    """What ended otherwise than "ok", and what the user is told."""
    cells = {"message": lambda row: row["message"].removeprefix("faulty scene: ")}
    sections = (
        (Heading("Known limits"), "known limit", ("limit", "case", "run_status"), "Endings that were expected."),
        (Heading("Refused, and what the user is told", 2), "refused", ("case", "message"), "Scenes not started."),
    )
    for heading, verdict, names, caption in sections:
        rows = sorted(having(folder.table, verdict=verdict), key=lambda row: row["limit"])
        yield heading
        if rows:
            yield table_of(folder.columns, names, rows, f"{caption} From `table.csv`.", cells)
        else:
            yield Text("None.")


def unexplained_items(folder: Folder) -> Items:
    """A warning with all that nobody expected, or a note that there is nothing of the kind."""
    lines = []
    for row in having(folder.table, verdict="unexplained"):
        lines.append(f"{row['group']}, {row['case']}: {row['run_status']} {row['message']}".strip())
    if lines:
        return [Notice("warning", "Unexplained", lines)]
    return [Notice("note", "Nothing unexplained", ("Every case ended as expected, or with a reason given below.",))]
