"""The columns of the campaigns' tables, each declared once, and the dictionary of them that lies beside every table.

A campaign declares its columns in a tuple beside the code that fills a row. `table.csv` has their names as its head,
and `columns.csv` beside it says what every column is; reports read titles, units and digits there.
"""

import csv
import io
import math
from collections.abc import Iterable
from dataclasses import astuple, dataclass, fields
from pathlib import Path


@dataclass(frozen=True)
class Column:
    """One column of a table.

    unit: as printed under its title, "" for none. symbol: its short title in a report's table. meaning: what it holds,
    in one sentence. digits: places after the decimal point in a report; None for a column of words.
    """

    name: str
    unit: str = ""
    symbol: str = ""
    meaning: str = ""
    digits: int | None = None


STATUS = Column("status", symbol="status", meaning="ok, or why the run ended early or has no result")
RUN_KEY = Column("run_key", symbol="key", meaning="content key of the run, whose file is trajectories/<run_key>.nc")
MESSAGE = Column(
    "message", symbol="message", meaning="what to know of a run before its numbers are used, and what it went on from"
)
PERIODS_RUN = Column("periods", "", "periods", "length of the run in wave periods", 0)
DEPTH = Column("depth_m", "m", "H", "depth of the water", 1)
STIFFNESS = Column("bending_stiffness_Nm2", "N m²", "EI", "bending stiffness of the line", 2)
TURN = Column("max_turn_rad", "rad", "turn", "largest turn of the line within one element, over the whole run", 2)
MIN_STRAIN = Column("min_strain", "", "ε_min", "smallest strain of any element, over the whole run", 4)
RINGING = Column(
    "unresolved_ringing_N", "N", "ringing", "axial ringing that the steps did not resolve; 0: all that was heard was", 0
)
LOOPS = Column("loop_releases", "", "loops", "loop releases: how often a loop of slack line was opened", 0)
STEPS = Column("steps", "", "steps", "accepted time steps", 0)
REJECTED = Column("rejected_steps", "", "rejected", "time steps that were repeated with a shorter one", 0)
NEWTON = Column("newton_iterations", "", "Newton", "Newton iterations of all time steps together", 0)
NEWTON_FAILURES = Column("newton_failures", "", "failed", "time steps at which Newton's iteration did not converge", 0)
END_S = Column("end_time_s", "s", "end", "simulated time at which the run ended", 2)
WALL_S = Column("wall_s", "s", "wall", "wall-clock time of the simulation, without compilation and analysis", 2)

# What the engine counts in every run (`Trajectory.statistics`), in the order of the tables.
LINE_COUNTS = (TURN, MIN_STRAIN, RINGING, LOOPS)
SOLVER_COUNTS = (STEPS, REJECTED, NEWTON, NEWTON_FAILURES, END_S, WALL_S)
STATISTICS = (*LINE_COUNTS, *SOLVER_COUNTS)


def names(columns: Iterable[Column]) -> tuple[str, ...]:
    """The names of columns, in their order."""
    return tuple(column.name for column in columns)


def counted(trajectory, columns: Iterable[Column] = STATISTICS) -> dict[str, object]:
    """How a run ended, and what the engine counted in it; a number that is unknown or not finite is None."""
    counts = {name: number(trajectory.statistics.get(name)) for name in names(columns)}
    message = "; ".join(filter(None, (trajectory.message, trajectory.began)))
    return {"status": trajectory.status, "message": message, **counts}


def number(entry: object) -> object:
    """The number itself; None for one that is unknown or not finite."""
    return None if entry is None or not math.isfinite(entry) else entry


def dictionary_path(table: Path) -> Path:
    """Where the columns of a table are told: columns.csv for table.csv, X_columns.csv for any other X.csv."""
    return table.with_name("columns.csv" if table.name == "table.csv" else f"{table.stem}_columns.csv")


def dictionary(columns: Iterable[Column]) -> bytes:
    """The content of columns.csv: name, unit, symbol, meaning, digits (empty for a column of words)."""
    return csv_of([field.name for field in fields(Column)], map(astuple, columns))


def csv_of(head: Iterable[str], rows: Iterable[Iterable[object]]) -> bytes:
    """The content of a CSV file."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(head)
    writer.writerows(rows)
    return text.getvalue().encode()
