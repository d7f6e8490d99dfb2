"""The report of `campaigns.paper`: what is said, in which order. Everything comes from the campaign's folder."""

from __future__ import annotations

from pathlib import Path

from ..parts.content import Bullets, Column, Heading, Item, Links, Notice, Report, Table, Text
from ..parts.folder import Folder, read_folder
from ..parts.provenance import provenance_items
from ..parts.statements import FAILS, HOLDS, HOLDS_IF
from ..parts.wording import EMPTY, count, decimals, listed, number
from .dependence import dependence_items
from .figures import figures_of, left_out, preface
from .figures import pictures as beside
from .index import index_items
from .misprints import misprint_items
from .results import Results, read_results
from .statements import Placed, judged
from .statements.closing import NOT_JUDGED

__all__ = ["beside", "report"]

COLUMNS = ("part", "status", "command", "runs", "failed", "compile_s", "run_s", "total_s", "run_key", "message")
WORDS = ("part", "command")
PARTS = {
    "breaking_line": "the breaking line, section 4.1, figures 2 to 7",
    "buoy": "the buoy at the paper's two waves, section 4.2, figures 9 to 19",
    "sweep": "the buoy over wave steepness",
    "dependence": "other depths, treatments and stiffnesses (told below)",
    "out_of_plane": "out of the plane of the waves, figure 20",
    "oscillator": "eq. (33), figure 19b",
}
SECTIONS = {
    "Fast breaks (4.1.2)": (2, 3, 4),
    "Slow breaks (4.1.3)": (5, 6, 7),
    "The buoy in small waves (4.2.1)": (9, 10, 11, 12),
    "The buoy in large waves (4.2.2)": (13, 14, 15, 16, 17, 18, 19, 20),
}
TOPICS = {
    "Accuracy (section 3)": ("3",),
    "The breaking line (abstract, section 4.1)": ("abstract", "4.1"),
    "The buoy in waves (section 4.2)": ("4.2",),
    "Conclusions (section 5)": ("5",),
}


def report(directory: str | Path) -> Report:
    """The content of the report on a folder of `campaigns.paper`. Raises FolderError for a folder that is not one."""
    folder = read_folder(directory, COLUMNS, WORDS)
    results = read_results(folder.directory)
    placed = judged(results)
    items = [
        *_question(folder, results, placed),
        *_parts(folder),
        *_figures(folder.directory),
        *_statements(placed),
        *dependence_items(results, folder.scene),
        *misprint_items(),
        *index_items(),
        *provenance_items(folder),
    ]
    subtitle = "Tjavaras, Zhu, Liu, Triantafyllou and Yue, Journal of Sound and Vibration 213(4), 709-737, 1998"
    return Report("The mechanics of highly-extensible cables, run again", subtitle, tuple(items))


def _question(folder: Folder, results: Results, placed: tuple[Placed, ...]) -> list[Item]:
    items: list[Item] = [
        Heading("Question"),
        Text(
            "The paper simulates a synthetic line that breaks and a buoy on a short tether in waves, and draws "
            "conclusions from both. Here its figures are drawn again from runs of this workbench, each of its "
            "statements gets a verdict with a number and the evidence for it, and what it leaves out is varied to see "
            "what the answer depends on."
        ),
        Heading("Short answer"),
        Bullets(short_answer(placed)),
    ]
    if folder.provenance.get("quick"):
        lines = ("This folder was made with `--quick`: runs are short and few; nothing is to be concluded from it.",)
        items.append(Notice("warning", "A quick look", lines))
    if results.missing:
        lines = tuple(f"`{part}`: {why}" for part, why in results.missing.items())
        items.append(Notice("warning", "Parts that are not there", lines))
    return items


def short_answer(placed: tuple[Placed, ...]) -> tuple[str, ...]:
    """How many statements hold, and which do not, each once: conclusions repeat what is said before."""
    first = {one.statement.claim: one for one in reversed(placed)}
    words = HOLDS, HOLDS_IF, FAILS
    by_verdict = {word: [one for one in placed if one.statement.verdict == word] for word in words}
    open_ones = [one for one in placed if one.statement.verdict == EMPTY]
    lines = [
        f"Of {count(len(placed), 'statement')}, {len(by_verdict[HOLDS])} hold, {len(by_verdict[HOLDS_IF])} hold under "
        f"a condition, {len(by_verdict[FAILS])} do not hold"
        + (f", and {len(open_ones)} cannot be decided from this folder." if open_ones else ".")
    ]
    lines += [f"Does not hold: {_quoted(one)}." for one in by_verdict[FAILS] if one is first[one.statement.claim]]
    lines += [
        f"Holds if {one.statement.condition}: {_quoted(one)}."
        for one in by_verdict[HOLDS_IF]
        if one is first[one.statement.claim]
    ]
    return tuple(lines)


def _quoted(one: Placed) -> str:
    return f"“{one.statement.claim.rstrip('.')}” (no. {one.number}; {one.place})"


def _parts(folder: Folder) -> list[Item]:
    heads = (
        Column("part", align="left"),
        Column("what", align="left"),
        Column("runs"),
        Column("failed"),
        Column("computing", "s"),
        Column("all", "s"),
    )
    rows = tuple(
        (
            f"`{row['part']}`",
            PARTS.get(row["part"], ""),
            number(row["runs"]),
            number(row["failed"]),
            decimals(row["run_s"], 0),
            decimals(row["total_s"], 0),
        )
        for row in folder.table.to_dict("records")
    )
    caption = (
        "The parts, each in a folder of that name. computing: runs with their analysis; all: with compiling and the "
        "part's report, in the session that finished it. From `table.csv`."
    )
    found = [
        (f"Report on {what}", f"{part}/report.html")
        for part, what in PARTS.items()
        if (folder.directory / part / "report.html").exists()
    ]
    links: list[Item] = [Text("Each part has a report of its own, with all runs, grids, warnings and sources:")]
    links.append(Links(tuple(found)))
    none = Text("The parts' own reports were left out.")
    seconds = float(folder.table["total_s"].sum())
    jobs = folder.provenance.get("jobs")
    at_once = f", {count(jobs, 'run')} at a time" if isinstance(jobs, int) else ""
    whole = Text(f"All parts together took {decimals(seconds / 60.0, 1)} minutes{at_once}.")
    return [Heading("Parts"), Table(heads, rows, caption), whole, *(links if found else [none])]


def _figures(directory: Path) -> list[Item]:
    drawn, missing = figures_of(directory), left_out(directory)
    items: list[Item] = [
        Heading("The figures of the paper"),
        Text(preface()),
        Text("The numbers behind figure N are in `figures/fig_NN.nc`, which names its runs, settings and seconds."),
    ]
    for heading, numbers in SECTIONS.items():
        some = [drawn[n] for n in numbers if n in drawn]
        items += [Heading(heading, 2), *some] if some else []
    if missing:
        lines = tuple(f"Fig. {n} of the paper: {reason}." for n, reason in missing.items())
        items.append(Notice("warning", "Figures of the paper that are left out", lines))
    return items


def _statements(placed: tuple[Placed, ...]) -> list[Item]:
    items: list[Item] = [
        Heading("The statements of the paper"),
        Text(
            "Claims are in our words. A verdict follows from checks at each place where it was looked: it “holds” "
            "where all pass, “does not hold” where none does, and otherwise “holds if”, with the places; a dash: "
            "the runs in this folder do not decide it. Numbers are of these runs; `statements.csv` has the same rows."
        ),
    ]
    for heading, places in TOPICS.items():
        some = [one for one in placed if one.place.startswith(places)]
        if some:
            items += [Heading(heading, 2), _table(some, heading)]
    heads = tuple(Column(title, align="left") for title in ("place", "the paper", "why"))
    caption = "What the paper says and no run here can judge: background, analogies, other papers."
    return [*items, Heading("Not judged", 2), Table(heads, NOT_JUDGED, caption, small=True)]


def _table(placed: list[Placed], heading: str) -> Table:
    heads = (
        Column("no."),
        Column("place", align="left"),
        Column("the paper", align="left", share=3),
        Column("verdict", align="left", share=3),
        Column("the runs", align="left", share=5),
        Column("decided by, evidence", align="left", share=3),
    )
    rows = tuple(
        (
            str(one.number),
            one.place,
            one.statement.claim,
            one.statement.said,
            one.statement.found,
            f"{one.statement.threshold}. {one.evidence}" if one.statement.threshold else one.evidence,
        )
        for one in placed
    )
    verdicts = listed(
        f"{sum(one.statement.verdict == word for one in placed)} {said}"
        for word, said in (
            (HOLDS, "hold"),
            (HOLDS_IF, "hold under a condition"),
            (FAILS, "do not hold"),
            (EMPTY, "are not decided"),
        )
        if word != EMPTY or any(one.statement.verdict == EMPTY for one in placed)
    )
    caption = f"{heading}: {verdicts}. From the tables of the parts, by `statements.csv`."
    return Table(heads, rows, caption, small=True)
