"""The columns of tables: what a column is, how its entries are printed, and the columns that several tables have.

A campaign declares its columns in a tuple beside the code that fills a row. `table.csv` has their names as its head,
and `columns.csv` beside it says what every column is (`files`). Reports read titles, units and digits there, and where
a column is printed, so that a column that is declared reaches every report.
"""

import math
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

from tables.words import EMPTY, decimals, number, sub

RUNS, REGIMES, COST, PLANE, PAIRS, SHEET = "runs", "regimes", "cost", "plane", "pairs", "sheet"  # pages of columns


@dataclass(frozen=True)
class Column:
    """One column of a table.

    name    in the head of the table
    unit    as printed under its title, "" for none
    symbol  its short title in a report, "" for the name itself; `_` before a word makes that word a subscript
    meaning what it holds, in one sentence
    digits  places after the decimal point in a report; None for a column of words
    page    where reports print it: RUNS, in every table of runs or motions; REGIMES, beside the regime of a motion;
            COST, beside what a run costs; PLANE, beside what leaves the plane of the waves;
            PAIRS, where runs in the plane are compared with such in space; SHEET, only on the sheet of a run
    """

    name: str
    unit: str = ""
    symbol: str = ""
    meaning: str = ""
    digits: int | None = None
    page: str = RUNS

    @property
    def head(self) -> str:
        """The symbol with its subscripts, or the name in words."""
        return re.sub(r"_(\w+)", lambda match: sub(match[1]), self.symbol) or self.name.replace("_", " ")

    @property
    def label(self) -> str:
        """The head with its unit as an axis of a figure has it, in matplotlib's mathematics."""
        symbol = re.sub(r"_(\w+)", r"$_{\\mathrm{\1}}$", self.symbol) or self.name.replace("_", " ")
        return f"{symbol} ({self.unit or EMPTY})"

    def cell(self, row: Mapping[str, object]) -> str:
        """The entry of a row in print: a dash where the table is empty.

        A number that the places after the point would show as zero gets two significant digits instead.
        """
        if self.digits is None:
            entry = row.get(self.name)
            if entry is None or entry != entry:  # nan differs from itself
                return EMPTY
            return str(entry) or EMPTY
        value = number_of(row, self.name)
        if value != 0.0 and abs(value) < 0.5 * 10.0**-self.digits:
            return number(value, 2)
        return decimals(value, self.digits)


Columns = Sequence[Column]  # of a table


def of_words(name: str, meaning: str, symbol: str = "") -> Column:
    """A column of words; its short title is its name where none is given."""
    return Column(name, "", symbol or name, meaning)


def on(page: str, *columns: Column) -> tuple[Column, ...]:
    """The columns on another page."""
    return tuple(replace(column, page=page) for column in columns)


def number_of(row: Mapping[str, object], name: str) -> float:
    """A number of a row, of a file or not; nan where it is empty, or where the row has no such column."""
    entry = row.get(name)
    if entry is None or entry == "":
        return math.nan
    return float(entry)


def of_kicks(row: Mapping[str, object]) -> str:
    """ "7 of 8": how many kicks end in the motion of a row; its share where their number is not known."""
    share, kicks = number_of(row, "share"), number_of(row, "kicks")
    if math.isfinite(share * kicks):
        return f"{share * kicks:.0f} of {kicks:.0f}"
    return number(share, 2)


def names(columns: Iterable[Column]) -> tuple[str, ...]:
    """The names of columns, in their order."""
    return tuple(column.name for column in columns)


def errors_of(columns: Mapping[str, Column]) -> dict[str, str]:
    """Column -> the column of its errors, which is called ..._error and has the same symbol behind a ±."""
    owners: dict[str, str] = {}
    errors = {}
    for name, column in columns.items():
        owners[column.symbol] = name
        owner = owners.get(column.symbol.replace("± ", ""))
        if name.endswith("_error") and owner not in (None, name):
            errors[owner] = name
    return errors


STATUS = Column("status", symbol="status", meaning="ok, or why the run ended early or has no result")
RUN_KEY = Column(
    "run_key", symbol="key", meaning="content key of the run, whose file is trajectories/<run_key>.nc", page=SHEET
)
MESSAGE = Column(
    "message",
    symbol="message",
    meaning="what to know of a run before its numbers are used, and what it went on from",
    page=SHEET,
)
PERIODS_RUN = Column("periods", "", "periods", "length of the run in wave periods", 0, REGIMES)
DEPTH = Column("depth_m", "m", "H", "depth of the water", 1)
NODES = Column("nodes", "", "nodes", "nodes of the line", 0)
STIFFNESS = Column("bending_stiffness_Nm2", "N m²", "EI", "bending stiffness of the line", 2)
TURN = Column("max_turn_rad", "rad", "turn", "largest turn of the line within one element, over the whole run", 2)
MIN_STRAIN = Column("min_strain", "", "ε_min", "smallest strain of any element, over the whole run", 4, SHEET)
RINGING = Column(
    "unresolved_ringing_N",
    "N",
    "ringing",
    "axial ringing that the steps did not resolve; 0: all that was heard was",
    0,
    SHEET,
)
LOOPS = Column("loop_releases", "", "loops", "loop releases: how often a loop of slack line was opened", 0)
STEPS = Column("steps", "", "steps", "accepted time steps", 0, SHEET)
REJECTED = Column("rejected_steps", "", "rejected", "time steps that were repeated with a shorter one", 0, SHEET)
NEWTON = Column("newton_iterations", "", "Newton", "Newton iterations of all time steps together", 0, COST)
NEWTON_FAILURES = Column(
    "newton_failures", "", "failed", "time steps at which Newton's iteration did not converge", 0, SHEET
)
END_S = Column("end_time_s", "s", "end", "simulated time at which the run ended", 2, SHEET)
WALL_S = Column("wall_s", "s", "wall", "wall-clock time of the simulation, without compilation and analysis", 2, COST)

# What the engine counts in every run (`Trajectory.statistics`), in the order of the tables.
LINE_COUNTS = (TURN, MIN_STRAIN, RINGING, LOOPS)
SOLVER_COUNTS = (STEPS, REJECTED, NEWTON, NEWTON_FAILURES, END_S, WALL_S)
STATISTICS = (*LINE_COUNTS, *SOLVER_COUNTS)


def counted(trajectory, columns: Iterable[Column] = STATISTICS) -> dict[str, object]:
    """How a run ended, and what the engine counted in it; a number that is unknown or not finite is None."""
    counts = {name: finite(trajectory.statistics.get(name)) for name in names(columns)}
    message = "; ".join(filter(None, (trajectory.message, trajectory.began)))
    return {"status": trajectory.status, "message": message, **counts}


def finite(entry: object) -> object:
    """The number itself; None for one that is unknown or not finite."""
    if entry is None or not math.isfinite(entry):
        return None
    return entry
