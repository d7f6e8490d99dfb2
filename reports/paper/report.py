"""The report of `campaigns.paper`: what is said, in which order. Everything comes from the campaign's folder."""

from pathlib import Path

from tables import FAILS, HOLDS, HOLDS_IF, count, decimals, verdict_counts

from ..figures.verdict_grid import verdict_grid
from ..parts import (
    Bullets,
    Folder,
    Heading,
    Items,
    Judged,
    Links,
    Notice,
    Report,
    Text,
    entries,
    read_folder,
    read_statements,
    report_page,
    section_items,
    statements_table,
    table_of,
)
from ..parts.style import BLUE, ORANGE, VERMILION
from .dependence import dependence_items, written
from .figures import PREFACE, figures_of, left_out
from .figures import pictures as beside
from .index import index_items

__all__ = ["beside", "report"]

PARTS = {
    "breaking_line": "the breaking line, section 4.1, figures 2 to 7",
    "buoy": "the buoy at the paper's two waves, section 4.2, figures 9 to 19",
    "doubled": "the two waves on twice the elements, section 3",
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
VERDICT_COLOURS = {HOLDS: BLUE, HOLDS_IF: ORANGE, FAILS: VERMILION}
VERDICTS = (
    "Claims are in our words. A verdict follows from checks at each place where it was looked: it “holds” where all "
    "pass, “does not hold” where none does, and otherwise “holds if”, with the places; a dash: the runs in this folder "
    "do not decide it. Numbers are of these runs; the campaign wrote the rows as `statements.csv`."
)


def report(directory: Path) -> Report:
    """The content of the report on a folder of `campaigns.paper`. Raises FolderError for a folder that is not one."""
    folder = read_folder(directory)
    judged = read_statements(folder.directory)
    items = [
        _verdicts(judged),  # before the first heading: on the first page, after the answer
        _question(folder, judged),
        _parts(folder),
        _figures(folder.directory),
        _statements(judged),
        dependence_items(folder),
        Heading("Misprints"),
        Text("Whoever programs the paper needs these corrections; with the equations as printed some runs go wrong."),
        written("misprints"),
        index_items(),
    ]
    subtitle = "Tjavaras, Zhu, Liu, Triantafyllou and Yue, Journal of Sound and Vibration 213(4), 709-737, 1998"
    return report_page(folder, "The mechanics of highly-extensible cables, run again", items, (), subtitle)


def _by_topic(judged: list[Judged]) -> dict[str, list[Judged]]:
    """The statements on each topic, by its heading."""
    topics = {}
    for heading, places in TOPICS.items():
        topic = [row for row in judged if row["place"].startswith(places)]
        if topic:
            topics[heading] = topic
    return topics


def _verdicts(judged: list[Judged]) -> Items:
    groups = {heading: entries(topic, "verdict") for heading, topic in _by_topic(judged).items()}
    if groups:
        caption = "Every statement of the paper, a cell each, in the colour of its verdict (–: not decided)."
        yield verdict_grid(groups, VERDICT_COLOURS, "statement", caption)


def _question(folder: Folder, judged: list[Judged]) -> Items:
    yield section_items("paper")
    yield Heading("What does not simply hold")
    yield Bullets(short_answer(judged))
    if folder.provenance.get("quick"):
        lines = ("This folder was made with `--quick`: runs are short and few; nothing is to be concluded from it.",)
        yield Notice("warning", "A quick look", lines)
    missing = [part for part in PARTS if not (folder.directory / part / "table.csv").exists()]
    if missing:
        lines = [f"`{part}`: {part}/table.csv is missing" for part in missing]
        yield Notice("warning", "Parts that are not there", lines)


def short_answer(judged: list[Judged]) -> list[str]:
    """How many statements hold, and which do not, each once: conclusions repeat what is said before."""
    first_told = []
    statements = set()
    for row in judged:
        if row["statement"] not in statements:
            statements.add(row["statement"])
            first_told.append(row)
    lines = [f"Of {count(len(judged), 'statement')}: {verdict_counts(judged)}."]
    for verdict in (FAILS, HOLDS_IF):
        for row in first_told:
            if row["verdict"] == verdict:
                quoted = f"“{row['statement'].rstrip('.')}” (no. {row['number']}; {row['place']})"
                verdict_words = "Does not hold"
                if row["condition"]:
                    verdict_words = f"Holds in part ({row['condition']})"
                lines.append(f"{verdict_words}: {quoted}.")
    return lines


def _parts(folder: Folder) -> Items:
    shown = ("part", "runs", "failed", "run_s", "total_s")
    descriptions, links = [], []
    for part, words in PARTS.items():
        descriptions.append(f"`{part}`: {words}")
        path = f"{part}/report.html"
        if (folder.directory / path).exists():
            links.append((f"Report on {words}", path))
    caption = f"The parts, each in a folder of its own ({'; '.join(descriptions)})."
    minutes = decimals(sum(row["total_s"] for row in folder.table) / 60.0, 1)
    time_text = f"All parts together took {minutes} minutes"
    jobs = folder.provenance.get("jobs")
    if isinstance(jobs, int):
        time_text += f", {count(jobs, 'run')} at a time"
    items = [Heading("Parts"), table_of(folder.columns, shown, folder.table, caption)]
    if not links:
        return [*items, Text(f"{time_text}. The parts' own reports were left out.")]
    reports_text = "Each part has a report of its own, with all runs, grids, warnings and sources:"
    return [*items, Text(f"{time_text}. {reports_text}"), Links(links)]


def _figures(directory: Path) -> Items:
    drawn, missing = figures_of(directory), left_out(directory)
    yield Heading("The figures of the paper")
    yield Text(PREFACE)
    yield Text("The numbers behind figure N are in `figures/fig_NN.nc`, which names its runs, settings and seconds.")
    for heading, numbers in SECTIONS.items():
        section = [drawn[number] for number in numbers if number in drawn]
        if section:
            yield [Heading(heading, 2), *section]
    if missing:
        lines = [f"Fig. {number} of the paper: {reason}." for number, reason in missing.items()]
        yield Notice("warning", "Figures of the paper that are left out", lines)


def _statements(judged: list[Judged]) -> Items:
    yield Heading("The statements of the paper")
    yield Text(VERDICTS)
    for heading, topic in _by_topic(judged).items():
        yield [Heading(heading, 2), statements_table(topic, f"{heading}: {verdict_counts(topic)}.")]
    yield [Heading("Not judged", 2), written("not_judged")]
