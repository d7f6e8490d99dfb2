"""What a campaign is to do, as records: its runs (`Job`), how and where they run (`Plan`), what came of them.

`trajectories/<key>.nc` is written whole or not at all, and a run is finished when its file is there. table.csv can be
lost at no cost: its rows come from these files, or from the copies of rows beside them.
"""

import hashlib
import json
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path

import engine
from campaigns.machinery.cli import Running
from tables import Columns, Row, names

TIMES = "compile_s", "run_s", "analysis_s"


@dataclass(frozen=True)
class Job:
    """One run to do: the columns that name it, its scene, and its length in wave periods or in seconds.

    simulate    in place of the plan's, for campaigns whose runs are not all made alike
    describe    describe(trajectory) -> row, in place of the plan's
    going       for a run that takes as long as it needs: what it does next (`campaigns.machinery.long_runs`). `periods`
                is then the most that it may take
    carrying    whether it may go on with perturbations that its scene does not carry
    made        what else the result depends on, where the run is not the engine's own or not the only one of its scene
    engine      hash of the engine's sources with which the campaign began
    """

    labels: Mapping[str, object]
    scene: object
    periods: float | None = None
    duration_s: float | None = None
    simulate: Callable | None = None
    describe: Callable | None = None
    going: Callable | None = None
    carrying: bool = False
    made: str = ""
    engine: str = field(default_factory=lambda: engine.source_hash())

    @cached_property
    def key(self) -> str:
        """The content key: sha256 over the scene's key, the run length, the engine's source hash, and `made`."""
        length = {"periods": self.periods, "duration_s": self.duration_s}
        content = {"scene": self.scene.key(), **length, "engine": self.engine}
        if self.made:
            content["made"] = self.made
        return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()


Jobs = Sequence[Job]


@dataclass(frozen=True)
class Outcome:
    """What a worker hands back: the row of a run, but for its labels and key, and the seconds that it took to make.

    content    the run's file, from a worker that does not see the folder
    orbits     results of the store of orbits, from the same worker
    """

    key: str
    row: Row
    analysis_s: float = 0.0
    content: bytes = b""
    orbits: Mapping[str, dict] = field(default_factory=dict)


@dataclass(frozen=True)
class Summary:
    """A campaign's rows in order, and how many were found or computed.

    times    seconds by TIMES, and of the report and of all together; 0 where there is no entry. Those of analysis are
             summed over workers
    whole    whether nothing was done, and the report that is there stays as it is
    made     keys of the runs that were computed, or went on
    """

    rows: list[Row]
    found: int
    computed: int
    times: Counter = field(default_factory=Counter)
    whole: bool = False
    made: frozenset[str] = frozenset()

    def joined_to(self, earlier: "Summary") -> "Summary":
        """The summary of both, where this is of all runs of the earlier one and of further runs."""
        computed = earlier.made | self.made
        counts = len(self.rows) - len(computed), len(computed)
        return Summary(self.rows, *counts, earlier.times + self.times, made=computed)

    @property
    def by_key(self) -> dict[str, Row]:
        """The rows by the keys of their runs."""
        return {row["run_key"]: row for row in self.rows}


@dataclass(frozen=True)
class Plan:
    """How to run: where, with which functions, and on what. Functions go to workers (importable, or by cloudpickle).

    how             `out` is None in the plan that a worker gets which does not see the folder
    simulate        simulate(scene, periods=, duration_s=) -> Trajectory
    describe        describe(trajectory) -> row; with `judge`: describe(trajectory, judgement)
    columns         of the table, among them run_key, status and message
    row_maker       hash of everything that shapes a row (`folder.made_by`); empty: rows are not kept
    judge           judge(trajectory, checks, orbits) -> what a row reads beside its run. checks: runs that went on from
                    it at a tighter tolerance, None where none ever does; orbits: the Store of what is computed for it
    simulate_each   simulate_each(scenes, periods=, duration_s=) yields (number of the scene, Trajectory) as runs end.
                    Where it is given, runs that can go side by side share a worker (`runner.groups_of`)
    title           what the runs are called
    reports         folder where workers say how far they are
    on_row          called with every row as it comes
    spare           groups of runs of later steps (`campaigns.machinery.worker.Spare`), which workers take off the list
                    and do while they would wait for the last runs of this one
    """

    how: Running
    simulate: Callable
    describe: Callable
    columns: Columns
    row_maker: str = ""
    judge: Callable | None = None
    simulate_each: Callable | None = None
    title: str = "runs"
    reports: Path | None = None
    on_row: Callable[[dict], None] | None = None
    spare: list = field(default_factory=list)

    @property
    def out(self) -> Path | None:
        """The folder of the campaign."""
        return self.how.out

    def within(self, folder: Path | None, **changes: object) -> "Plan":
        """The plan for another folder, with further changes."""
        return replace(self, how=replace(self.how, out=folder), **changes)


def filled(columns: Columns, values: Iterable) -> Row:
    """The row that has these values in these columns."""
    return dict(zip(names(columns), values, strict=True))


def name_of(task: Jobs) -> str:
    """The name of the file in which a worker says how far it is with these jobs."""
    return f"{len(task)}-{task[0].key}"
