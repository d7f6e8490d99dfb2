"""A campaign's runs from its side: which there are, which are missing, who does them, what becomes of the table.

A run's content key is the hash of its scene, its length and the engine's sources. `trajectories/<key>.nc` is written
whole or not at all, and its presence is what "finished" means: rows are always made again from the files, so a table
can be lost at no cost. What a worker does is in `campaigns.machinery.one_run`: on this machine it writes the file, and
only rows and timings travel; on a cluster it sends the content, and the campaign writes it.
"""

import contextlib
import hashlib
import json
import sys
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path

from campaigns.columns import Column
from campaigns.machinery.cli import Running
from campaigns.machinery.folder import CampaignStopped, Table, is_full
from campaigns.machinery.pools import PoolBroken, opened


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
    row_maker: hash of whatever shapes a row (`campaigns.machinery.row_store.made_by`); empty: rows are not kept.
    simulate_each(scenes, periods=, duration_s=): yields (number of the scene, Trajectory) as runs end; where it is
    given, runs that can go side by side share a worker (`campaigns.machinery.side_by_side`).
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


def run_campaign(plan: Plan, jobs: list[Job]) -> Summary:
    """Do every run that is not there yet; keep table.csv up to date while results come.

    Raises CampaignStopped (disk full, folder lost) or KeyboardInterrupt; finished runs and their rows are then on disk.
    """
    from campaigns.machinery.one_run import reuse

    jobs = list({job.key: job for job in jobs}.values())
    table = Table(plan.directory / "table.csv", plan.columns, [job.key for job in jobs])
    outcomes = {}
    for job in jobs:
        if (outcome := reuse(plan, job)) is not None:
            outcomes[job.key] = outcome
            table.rows[job.key] = outcome.row
    found = len(outcomes)
    table.write()
    missing = [job for job in jobs if job.key not in outcomes]
    try:
        for outcome in _with_progress(plan, _compute_all(plan, missing), len(jobs), found):
            if outcome.stop:
                raise CampaignStopped(outcome.stop)
            outcomes[outcome.key] = outcome
            table.add(outcome.key, outcome.row)
    except BaseException:
        with contextlib.suppress(OSError):
            table.write()
        raise
    table.write()
    computed = sum(outcome.computed for outcome in outcomes.values())
    return Summary(table.in_order(), found, computed, sum(outcome.analysis_s for outcome in outcomes.values()))


def _with_progress(plan: Plan, outcomes, total: int, found: int):
    from tqdm import tqdm

    terminal = sys.stderr.isatty()
    hidden = not plan.show_progress or total == found
    options = {"mininterval": 0.2 if terminal else 10.0, "dynamic_ncols": terminal, "disable": hidden}
    with tqdm(total=total, initial=found, unit="run", desc="runs", **options) as bar:
        for outcome in outcomes:
            bar.update()
            yield outcome


def _compute_all(plan: Plan, jobs: list[Job]):
    """Outcomes of all jobs as they come. A run that kills its worker twice, the second time alone, is given up."""
    if not jobs:
        return
    from campaigns.machinery.one_run import received, run_one
    from campaigns.machinery.side_by_side import outcomes_side_by_side

    pending = {job.key: job for job in jobs}
    call = partial(run_one, plan.for_workers())
    with opened(plan.backend, min(plan.jobs, len(jobs)), plan.dask_address) as execute:
        for outcome in outcomes_side_by_side(plan, execute, jobs):
            yield received(plan, pending.pop(outcome.key), outcome)
        while pending:
            try:
                for outcome in execute(call, list(pending.values())):
                    yield received(plan, pending.pop(outcome.key), outcome)
            except PoolBroken as broken:
                for job in broken.suspects:
                    del pending[job.key]
                    yield received(plan, job, _alone(execute, call, job))


def _alone(execute: Callable, call: Callable, job: Job) -> Outcome:
    try:
        return next(iter(execute(call, [job], alone=True)))
    except PoolBroken as broken:
        from campaigns.machinery.one_run import failed

        return failed(job, "worker-died", f"its process ended twice, the second time running alone: {broken}")


def write_failure(directory: Path | str, error: BaseException) -> str:
    """One line on a failed write: a full disk in plain words, anything else with the system's reason."""
    if is_full(error):
        return f"the disk of {directory} is full; finished runs are kept; make room and run the same command again"
    return f"cannot write to {directory}: {error}"
