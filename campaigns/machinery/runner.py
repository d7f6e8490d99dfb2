"""Runs all simulations of a campaign that are not on disk yet and keeps table.csv up to date.

What the workers do is in `campaigns.machinery.worker`. Every run is saved, and has its row, as soon as it ends: a
killed campaign loses what was running and nothing else.
"""

import contextlib
import math
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path

import engine
from campaigns.machinery.folder import PROGRESS, Table, keep_row, trajectory_path
from campaigns.machinery.plan import Job, Outcome, Plan, Summary, name_of
from campaigns.machinery.pools import PoolBroken, opened
from campaigns.machinery.progress import print_line, reporter, reports, stage
from campaigns.machinery.worker import failed, reuse, run_jobs
from engine.atomic import write_atomic

ENGINE = "machine code, compiled once and then loaded"
MOST = 96  # jobs of a group: results reach the table group by group
MOST_SENT = 8  # where a group's runs are sent together: one for each lane, so a lost worker costs what was running
GOLDEN = 0.5 * (math.sqrt(5.0) - 1.0)  # its multiples, less whole numbers, fill any range evenly
FEWEST = 4  # jobs for each worker below which they are not put together
_ready: set[tuple] = set()  # pieces of machine code that are on disk since a campaign of this process compiled them


def run(plan: Plan, jobs: list[Job], ahead: Sequence[Job] = ()) -> tuple[dict[str, float], Summary]:
    """Compile and do the runs; returns the times of both and the summary. ahead: of these what they need is compiled
    too, because they come next and two processes are done sooner with all of it.
    """
    missing = [job for job in jobs if not trajectory_path(plan.how.out, job.key).exists()]
    start = time.perf_counter()
    if missing and plan.sends and plan.how.dask_address is not None:
        print_line("each worker compiles the engine in its first run, unless it has done so before")
    elif missing:
        _compile(plan, [*missing, *ahead])
    compiled = time.perf_counter()
    summary = run_campaign(plan, jobs)
    run_s = time.perf_counter() - compiled
    return {"compile_s": compiled - start, "run_s": run_s, "analysis_s": summary.analysis_s}, summary


def write_scene(directory: Path, campaign: str, jobs: list[Job]) -> None:
    """Write scene.toml. Raises OSError."""
    head = f"# the scene of the first run of {campaign}; what varies over the runs is listed in provenance.json\n"
    write_atomic(directory / "scene.toml", (head + jobs[0].scene.to_toml()).encode())


def groups_of(plan: Plan, jobs: list[Job]) -> list[tuple[Job, ...]]:
    """Jobs of one run length, all with `going` or none, that a worker does side by side, in groups as even as can be.

    An empty list where the plan or the jobs do not allow it, and for threads, because nothing can interrupt a group
    from within the process.
    """
    if plan.simulate_each is None or plan.how.backend == "threading":
        return []
    alike: dict[tuple, list[Job]] = {}
    for job in jobs:
        if engine.goes_in_lanes(job.scene):
            alike.setdefault((job.periods, job.duration_s, job.going is None), []).append(job)
    groups = []
    for members in alike.values():
        workers = min(plan.how.jobs, len(members) // FEWEST)
        count = workers * math.ceil(len(members) / (max(1, workers) * (MOST_SENT if plan.sends else MOST)))
        # dealt like cards: neighbours cost alike, and so the groups do
        groups += [tuple(_mixed(members[first::count])) for first in range(count)]
    return groups


def _mixed(jobs: list[Job]) -> list[Job]:
    """The jobs in an order in which any part of them is like the whole.

    The slow ones of a sweep are neighbours; if they began last, they would end alone. The first one, which is often the
    fastest, does not lead.
    """
    return [jobs[i] for i in sorted(range(len(jobs)), key=lambda i: i * GOLDEN % 1.0, reverse=True)]


def _compile(plan: Plan, missing: list[Job]) -> None:
    """Compile what the runs may call: what has kernels in common in one process, the rest in others meanwhile."""
    together = {job.key for group in groups_of(plan, missing) for job in group}
    ours = [job for job in missing if plan.simulate is engine.simulate and job.simulate is None]
    wanted = [(job.scene, job.key in together, job.carrying) for job in ours]
    wanted += [(job.scene, False, True) for job in ours if job.carrying]  # its last part may go alone
    pieces = engine.shares_of(wanted)
    tasks = [{key: scene for key, scene in task.items() if key not in _ready} for task in pieces]
    if not (tasks := [task for task in tasks if task]):
        return
    where = "loky", min(plan.how.jobs, max(2, len(missing)))
    if plan.how.backend == "threading":  # Numba compiles in one of them at a time
        where = "threading", 1

    finished: dict[str, list[float]] = {}

    def compiled() -> float:
        return sum(count for (count,) in (reports(Path(place)) | finished).values())

    with (
        _progress(plan) as place,
        opened(*where) as execute,
        stage(ENGINE, sum(map(len, tasks)), "pieces", compiled),
        contextlib.suppress(PoolBroken),  # a run that cannot be compiled says so itself
    ):
        for (number, pieces), _ in execute(partial(_compile_pieces, Path(place)), list(enumerate(tasks))):
            finished[str(number)] = [len(pieces)]
            _ready.update(pieces)


def _progress(plan: Plan) -> tempfile.TemporaryDirectory:
    """A folder in which workers say how far they are: in that of the campaign, which drops what a kill leaves there.

    Workers that send their results need not see the campaign's folder: theirs is a temporary one.
    """
    return tempfile.TemporaryDirectory(prefix=PROGRESS, dir=None if plan.sends else plan.how.out.absolute())


def _compile_pieces(place: Path, task: tuple[int, dict]) -> None:
    number, pieces = task
    report = reporter(place, str(number))
    for count, (key, scene) in enumerate(pieces.items()):
        report(count)
        with contextlib.suppress(Exception):  # not the place to judge a scene: its run fails in the same way
            engine.compile_piece(key, scene)


def run_campaign(plan: Plan, jobs: list[Job]) -> Summary:
    """Do every run that is not there yet; keep table.csv up to date while results come.

    Raises CampaignStopped (disk full, folder lost) or KeyboardInterrupt; finished runs and their rows are then on disk.
    """
    by_key = {job.key: job for job in jobs}
    table = Table(plan.how.out / "table.csv", plan.columns, list(by_key))
    with stage("looking for finished runs"):
        there = {key: reuse(plan, job, print_line) for key, job in by_key.items()}
        found = {key: outcome for key, outcome in there.items() if outcome is not None and _ended(by_key[key], outcome)}
    table.rows = {key: _row(by_key[key], outcome) for key, outcome in found.items()}
    table.write()
    analysis_s = sum(outcome.analysis_s for outcome in found.values())
    missing = {key: job for key, job in by_key.items() if key not in found}
    try:
        for outcome in _computed(plan, missing, len(by_key)):
            if outcome.content:
                write_atomic(trajectory_path(plan.how.out, outcome.key), outcome.content)
                keep_row(plan.how.out, outcome.key, plan.row_maker, outcome.row, outcome.content)
            analysis_s += outcome.analysis_s
            table.add(outcome.key, row := _row(by_key[outcome.key], outcome))
            if plan.on_row is not None:
                plan.on_row(row)
    except BaseException:
        with contextlib.suppress(OSError):
            table.write()
        raise
    table.write()
    return Summary(table.in_order(), len(found), len(missing), analysis_s, made=frozenset(missing))


def _ended(job: Job, outcome: Outcome) -> bool:
    return job.going is None or job.going(job.scene, None, outcome.row, {}) is None


def _row(job: Job, outcome: Outcome) -> dict[str, object]:
    return {**job.labels, **outcome.row, "run_key": job.key}


def _computed(plan: Plan, jobs: dict[str, Job], total: int) -> Iterator[Outcome]:
    """Outcomes of the jobs, by key, as they come: those that can share a worker first, then what these leave undone.

    A run that kills its worker twice, the second time alone, is given up. total: runs of the campaign, with those that
    were found, which count as done from the start.
    """
    if not jobs:
        return
    left, waiting = dict(jobs), set()
    # A worker kept from an earlier campaign of this process may stand in another folder.
    how = replace(plan.how, out=None if plan.sends else plan.how.out.absolute())
    groups = groups_of(plan, list(jobs.values()))

    def ended() -> float:
        numbers = reports(Path(place))
        return total - len(left) + sum(numbers[task][0] for task in waiting & numbers.keys())

    def simulated() -> str:
        return f"{sum(length_s for _, length_s in reports(Path(place)).values()):,.0f} s simulated"

    with (
        _progress(plan) as place,
        opened(plan.how.backend, min(plan.how.jobs, len(jobs)), plan.how.dask_address) as execute,
        stage(plan.title, total, "runs", ended, simulated),
    ):
        call = partial(run_jobs, replace(plan, how=how, reports=Path(place), on_row=None))
        while left:
            tasks = groups or [(job,) for job in left.values()]
            waiting = {name_of(task) for task in tasks}
            try:
                for task, outcomes in execute(call, list(tasks)):
                    groups = [group for group in groups if group is not task]
                    waiting = waiting - {name_of(task)}
                    for outcome in outcomes:
                        del left[outcome.key]
                    yield from outcomes
            except PoolBroken as broken:
                for task in broken.suspects:
                    if len(task) == 1:
                        yield _alone(execute, call, left.pop(task[0].key))
                groups = [group for group in groups if not any(group is task for task in broken.suspects)]


def _alone(execute: Callable, call: Callable, job: Job) -> Outcome:
    try:
        ((_, outcomes),) = execute(call, [(job,)], alone=True)
        return outcomes[0]
    except PoolBroken as broken:
        return failed(job, "worker-died", f"its process ended twice, the second time running alone: {broken}")
