"""What a campaign is to do, as records: its runs (`Job`), how and where they run (`Plan`), what came of them.

A run's content key is the hash of its scene, its length and the engine's sources. `trajectories/<key>.nc` is written
whole or not at all, and its presence is what "finished" means: rows are always made again from the files, so a table
can be lost at no cost.
"""

import hashlib
import json
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path

from campaigns.columns import Column
from campaigns.machinery.cli import Running


@dataclass(frozen=True)
class Job:
    """One run to do: its content key, the engine's source hash, the scene, the length, and columns that name it.

    simulate, describe: in place of the plan's, for campaigns whose runs are not all made or described alike.
    """

    key: str
    engine: str
    scene: object
    periods: float | None = None
    duration_s: float | None = None
    labels: dict[str, object] = field(default_factory=dict)
    simulate: Callable | None = None
    describe: Callable | None = None


@dataclass(frozen=True)
class Outcome:
    """What a worker hands back. `stop`: why the whole campaign has to stop, "" to go on.

    content, described: the run's file and what `describe` made of it, from a worker that does not see the folder.
    """

    key: str
    row: dict[str, object]
    computed: bool
    analysis_s: float = 0.0
    stop: str = ""
    content: bytes = b""
    described: dict[str, object] | None = None


@dataclass(frozen=True)
class Summary:
    """A campaign's rows in order, how many were found or computed, and the analysis time summed over workers."""

    rows: list[dict[str, object]]
    found: int
    computed: int
    analysis_s: float


@dataclass(frozen=True)
class Plan:
    """How to run: where, with which functions, and on what.

    simulate(scene, periods=, duration_s=) -> Trajectory, and describe(trajectory) -> row, have to be
    importable or picklable by cloudpickle. columns: of the table, among them run_key, status and message.
    row_maker: hash of whatever shapes a row (`campaigns.machinery.row_cache.made_by`); empty: rows are not kept.
    simulate_each(scenes, periods=, duration_s=): yields (number of the scene, Trajectory) as runs end; where it is
    given, runs that can go side by side share a worker (`campaigns.machinery.batches`).
    directory: None in the plan that a worker gets which does not see the folder.
    """

    directory: Path | None
    simulate: Callable
    describe: Callable
    columns: tuple[Column, ...]
    backend: str = "loky"
    jobs: int = 1
    dask_address: str | None = None
    show_progress: bool = True
    row_maker: str = ""
    simulate_each: Callable | None = None

    @property
    def sends(self) -> bool:
        """Whether workers send what they computed, because they need not see the folder."""
        return self.backend == "dask"

    def for_workers(self) -> "Plan":
        """The plan as workers get it."""
        # A worker kept from an earlier campaign of this process may stand in another folder.
        return replace(self, directory=None if self.sends else self.directory.absolute())


def plan_of(
    how: Running, simulate: Callable, describe: Callable, columns: tuple[Column, ...], row_maker: str, **more
) -> Plan:
    """The plan of a campaign as its command line wants it done; more: further fields of the plan."""
    where = how.backend, how.jobs, how.dask_address
    return Plan(how.out, simulate, describe, columns, *where, row_maker=row_maker, **more)


def make_job(
    scene,
    periods: float | None = None,
    duration_s: float | None = None,
    labels: dict | None = None,
    simulate: Callable | None = None,
    describe: Callable | None = None,
    made: str = "",
) -> Job:
    """A job with its content key: sha256 over the scene's key, the run length and the engine's source hash.

    made: what else the result depends on, where the run is not the engine's own or not the only one of its scene.
    """
    from engine import source_hash

    engine = source_hash()
    content = {"scene": scene.key(), "periods": periods, "duration_s": duration_s, "engine": engine}
    content |= {"made": made} if made else {}
    key = hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()
    return Job(key, engine, scene, periods, duration_s, dict(labels or {}), simulate, describe)
