"""What the campaign writes from the folders of its parts: the data of the figures, and statements.csv."""

import json
from pathlib import Path

from campaigns.machinery.row_store import made_by
from campaigns.paper.figures import write_figure_data
from engine.atomic import write_atomic
from reports.paper.figures import NUMBERS as FIGURES
from reports.paper.figures import files_of
from reports.paper.results import read_results
from reports.paper.statements import as_csv, judged

STATEMENTS = "statements.csv"
PAGES = ("report.html", "report.pdf")
SOURCES = ("analysis", "engine", "campaigns/paper", "reports")


def maker() -> str:
    """Hash of all that shapes what is written here and the report: files of the same are not made again."""
    templates = Path(__file__).parents[2] / "reports" / "templates"
    beside = sorted(f"reports/templates/{path.name}" for path in templates.iterdir() if path.is_file())
    return made_by({}, *SOURCES, *beside)


def there(out: Path, report: bool) -> bool:
    """Whether all that `write` and the report leave is in the folder."""
    files = [out / STATEMENTS, *(out / page for page in PAGES if report)]
    missing = json_of(out / "figures" / "left_out.json")
    if missing is None:
        return False
    for number in FIGURES:
        data, *drawn = files_of(out, number)
        files += [] if str(number) in missing else [data, *(drawn if report else [])]
    return all(path.exists() for path in files)


def json_of(path: Path) -> dict | None:
    """The content of a JSON file; None where it cannot be read."""
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None


def write(out: Path) -> None:
    """Figures' data and statements.csv; files that say the same already stay as they are. Raises OSError."""
    write_figure_data(out)
    _changed(out / STATEMENTS, as_csv(judged(read_results(out))))


def _changed(path: Path, content: bytes) -> None:
    try:
        if path.read_bytes() == content:
            return
    except OSError:
        pass
    write_atomic(path, content)
