"""Tables of results on the pages of docs/, written by the commands that compute them.

    python -m benchmarks.write_tables FOLDER ...     # tables of finished folders of campaigns
    python -m benchmarks.verdict_rates --write       # a benchmark writes its own

A table stands in a page between two comments. The second one ends with a seal, a checksum of what stands between them,
because a number that somebody changes by hand is no longer what the command found:

    <!-- table NAME: COMMAND -->
    | ... |
    <!-- end of table SEAL -->

A table without a seal was computed before its command wrote it here; it has to name the commit and the date.
"""

import csv
import json
import math
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from hashlib import sha256
from pathlib import Path

from benchmarks.shared import DOCS, command_line

BLOCK = re.compile(
    r"<!-- table (?P<name>\w+): (?P<command>.*?) -->\n(?P<content>.*?)<!-- end of table ?(?P<seal>\w*) ?-->", re.DOTALL
)
Row = Sequence[str]


@dataclass(frozen=True)
class Table:
    """What a block of a page has to hold: the command that computes it, and the heads of its columns."""

    command: str
    heads: tuple[str, ...]


TABLES = {
    "validation": Table(
        "python -m campaigns.validation", ("case", "compared", "ours", "theirs", "error", "bar", "verdict")
    ),
    "stability": Table(
        "python -m campaigns.stability",
        (
            "extreme", "cases", "ok", "refused", "known limit", "unexplained", "motion error",
            "tension error", "runs that announce a larger one",
        ),
    ),
    "verdict_rates": Table(
        "python -m benchmarks.verdict_rates --cable",
        ("motions", "number", "right word", "wrong word", "open", "settle later", "periods judged, mean"),
    ),
    "exponent_errors": Table(
        "python -m benchmarks.verdict_rates --cable", ("motions", "200 periods", "500 periods", "2000 periods")
    ),
    "exponent_over_starts": Table(
        "python -m benchmarks.exponent_over_starts",
        (
            "H, m", "starts", "periods of a run", "mean, bits a period", "least", "largest", "scatter",
            "error of one run", "z",
        ),
    ),
    "motion_rates": Table(
        "python -m benchmarks.motion_rates --cable",
        (
            "system", "systems", "motions", "motions found", "starts", "wrong: joined", "wrong: settled", "outlasted",
            "outlasted, confirmed", "unsettled", "periods: median", "periods: 95 %",
        ),
    ),
    "record_rates": Table(
        "python -m benchmarks.record_rates",
        ("records", "number", "chaotic", "undecided", "quasi-periodic", "period-N", "transient"),
    ),
}  # fmt: skip


@dataclass(frozen=True)
class Block:
    """A table as it stands in a page."""

    name: str
    command: str
    content: str
    seal: str


def blocks(text: str) -> Iterator[Block]:
    """The tables of a page, in their order."""
    for match in BLOCK.finditer(text):
        yield Block(**match.groupdict())


def seal_of(content: str) -> str:
    """Checksum of the lines between the two comments."""
    return sha256(content.encode()).hexdigest()[:12]


def markdown(heads: Row, rows: Iterable[Row]) -> str:
    """A table in Markdown."""
    lines = [heads, ["---"] * len(heads), *rows]
    return "".join(f"| {' | '.join(cells)} |\n" for cells in lines)


def block_of(name: str, rows: Iterable[Row], date: str, commit: str, options: str = "") -> str:
    """The whole block of a table, both comments included. options: those that the command was run with."""
    table = TABLES[name]
    command = f"{table.command} {options}".strip()
    content = markdown(table.heads, rows) + f"\nWritten by `{command}` on {date}, commit {commit}.\n"
    return f"<!-- table {name}: {table.command} -->\n{content}<!-- end of table {seal_of(content)} -->"


def write(name: str, rows: Iterable[Row], date: str, commit: str, options: str = "", docs: Path = DOCS) -> Path:
    """Put a table in place of its block; returns the page. Raises ValueError where no page has such a block."""
    written = block_of(name, rows, date, commit, options)
    for page in sorted(docs.glob("*.md")):
        text = page.read_text(encoding="utf-8")
        for match in BLOCK.finditer(text):
            if match["name"] == name:
                page.write_text(text[: match.start()] + written + text[match.end() :], encoding="utf-8")
                return page
    raise ValueError(f"no page of {docs} has a block <!-- table {name}: ... -->")


def publish(name: str, rows: Sequence[Row], into_page: bool) -> None:
    """Print a table that a benchmark has just computed, and write it into its page where that is asked for."""
    print(markdown(TABLES[name].heads, rows), end="")
    if into_page:
        from campaigns.machinery.session import git_state

        commit = git_state(DOCS)["commit"] or "not known"
        page = write(name, rows, datetime.now(UTC).date().isoformat(), commit[:7])
        print(f"written to docs/{page.name}")


def read_rows(path: Path) -> list[dict[str, str]]:
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def validation_rows(folder: Path) -> list[Row]:
    """One row for each number that is held against a bar; `cases.md` of the campaign has them in words."""
    rows = []
    for line in (folder / "cases.md").read_text(encoding="utf-8").splitlines()[2:]:
        rows.append([cell.strip() for cell in line[1:-1].split("|")])
    return rows


def stability_rows(folder: Path) -> list[Row]:
    """One row for each extreme: how its cases ended, and the largest errors of those that are ok."""
    groups: dict[str, list[dict[str, str]]] = {}
    for row in read_rows(folder / "table.csv"):
        if row["part"] == "case":
            groups.setdefault(row["about"], []).append(row)
    groups["all"] = [row for rows in groups.values() for row in rows]
    return [_stability_row(title, cases) for title, cases in groups.items()]


def _stability_row(title: str, cases: list[dict[str, str]]) -> Row:
    ended = [str(_count(cases, verdict)) for verdict in ("ok", "refused", "known limit", "unexplained")]
    good = [case for case in cases if case["verdict"] == "ok"]
    motion = _largest(case["measured"] for case in good if case["how"] == "refinement")
    judged = [case for case in good if case["measured_tension"]]
    below = [case for case in judged if float(case["measured_tension"]) <= float(case["bar_tension"])]
    tension = _largest(case["measured_tension"] for case in below)
    return [title, str(len(cases)), *ended, motion, tension, str(len(judged) - len(below))]


def _count(cases: list[dict[str, str]], verdict: str) -> int:
    return sum(case["verdict"] == verdict for case in cases)


def _largest(cells: Iterable[str]) -> str:
    numbers = [float(cell) for cell in cells if cell]
    finite = [number for number in numbers if math.isfinite(number)]
    return f"{max(finite):.1e}" if finite else ""


ROWS = {"validation": validation_rows, "stability": stability_rows}


def write_folder(folder: Path, docs: Path = DOCS) -> Path:
    """Write the table of a finished folder. Raises ValueError for a campaign whose table no page has."""
    provenance = json.loads((folder / "provenance.json").read_text(encoding="utf-8"))
    name = provenance["campaign"]
    if name not in ROWS:
        raise ValueError(f"{folder}: a folder of {name}; tables of pages come from {', '.join(ROWS)}")
    commit = provenance["git"]["commit"] or "not known"
    day, options = provenance["finished_utc"][:10], options_of(provenance["command"])
    return write(name, ROWS[name](folder), day, commit[:7], options, docs)


def options_of(command: Sequence[str]) -> str:
    """The options of a command that decide what it computes: all but its folder and its processes."""
    options, words = [], iter(command[3:])
    for word in words:
        if word in ("--out", "--jobs"):
            next(words)
        else:
            options.append(word)
    return " ".join(options)


def main() -> None:
    parser = command_line(__doc__)
    parser.add_argument("folders", nargs="+", type=Path, metavar="FOLDER", help="finished folders of campaigns")
    for folder in parser.parse_args().folders:
        print(f"{folder}: written to docs/{write_folder(folder).name}")


if __name__ == "__main__":
    main()
