"""What the campaign writes from the folders of its parts: the data of the figures, and statements.csv."""

from pathlib import Path

from campaigns.paper.figures import write_figure_data
from engine.atomic import write_atomic
from reports.paper.results import read_results
from reports.paper.statements import as_csv, judged

STATEMENTS = "statements.csv"


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
