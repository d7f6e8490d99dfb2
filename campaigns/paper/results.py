"""What the campaign writes from the folders of its parts: the data of the figures, and statements.csv."""

from pathlib import Path

from campaigns.machinery import made_by, of_the_page, read_json
from campaigns.paper.figures import FIGURES, LEFT_OUT, files_of, place_of, write_figure_data
from campaigns.statements import write_statements
from tables import STATEMENTS as STATEMENTS

PAGES = ("report.html", "report.pdf")
TABLES = ("campaigns/breaking_line/statements.toml", "campaigns/paper/statements.toml", "reports/paper/tables.toml")
SOURCES = ("analysis", "engine", "campaigns", "reports", "tables", *TABLES)


def maker() -> str:
    """Hash of all that shapes what is written here and the report: files of the same are not made again."""
    return made_by(*SOURCES, *of_the_page())


def is_there(out: Path, report: bool) -> bool:
    """Whether all that `write` and the report leave is in the folder."""
    files = [out / STATEMENTS]
    if report:
        files += [out / page for page in PAGES]
    missing = read_json(place_of(out) / LEFT_OUT)
    if not isinstance(missing, dict):
        return False
    for number in FIGURES:
        if str(number) in missing:
            continue
        data, *drawings = files_of(out, number)
        files.append(data)
        if report:
            files += drawings
    return all(path.exists() for path in files)


def write(out: Path) -> None:
    """Figures' data and statements.csv; files that say the same already stay as they are. Raises OSError."""
    from campaigns.paper.measured import read_results
    from campaigns.paper.statements import claims

    write_figure_data(out)
    quick = bool((read_json(out / "provenance.json") or {}).get("quick"))
    write_statements(out, claims(quick), read_results(out))
