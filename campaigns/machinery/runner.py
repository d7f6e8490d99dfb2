"""Runs all simulations of a campaign that are not on disk yet and keeps table.csv up to date."""

import contextlib
import sys
import time
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path

from campaigns.machinery.batches import groups_of, run_group
from campaigns.machinery.folder import CampaignStopped, Table, trajectory_path
from campaigns.machinery.plan import Job, Outcome, Plan, Summary
from campaigns.machinery.pools import opened
from campaigns.machinery.processes import PoolBroken
from campaigns.machinery.worker import failed, received, reuse, run_one
from engine.atomic import write_atomic

COMPILE_RUN_S = 0.1  # long enough to go through every kernel, too short to cost anything


def run(plan: Plan, jobs: list[Job], compile_run_s: float = COMPILE_RUN_S) -> tuple[dict[str, float], Summary]:
    """Compile and do the runs; returns the times of both and the summary.

    compile_run_s: length of the run that only compiles, long enough for the scenes at hand to go through every kernel.
    """
    missing = [job for job in jobs if not trajectory_path(plan.directory, job.key).exists()]
    start = time.perf_counter()
    if missing and plan.sends and plan.dask_address is not None:
        print("each worker compiles the engine in its first run, unless it has done so before", file=sys.stderr)
    elif missing:
        print("compiling the engine, or loading it compiled ...", file=sys.stderr)
        _compile_all(plan, missing, compile_run_s)
    compiled = time.perf_counter()
    summary = run_campaign(plan, jobs)
    run_s = time.perf_counter() - compiled
    return {"compile_s": compiled - start, "run_s": run_s, "analysis_s": summary.analysis_s}, summary


def write_scene(directory: Path, campaign: str, jobs: list[Job]) -> None:
    """Write scene.toml. Raises OSError."""
    head = f"# the scene of the first run of {campaign}; what varies over the runs is listed in provenance.json\n"
    write_atomic(directory / "scene.toml", (head + jobs[0].scene.to_toml()).encode())


def _compile_all(plan: Plan, missing: list[Job], compile_run_s: float) -> None:
    # A plane, space, and runs side by side have machine code of their own.
    groups = groups_of(plan, missing)
    together = {job.key for group in groups for job in group.jobs}
    first_of_a_kind = {job.scene.motion.dimensions: job for job in reversed(missing) if job.key not in together}
    for job in first_of_a_kind.values():
        _compile(plan.simulate, job.scene, compile_run_s)
    for group in groups[:1]:
        _compile(
            lambda scene, duration_s: list(plan.simulate_each([scene, scene], duration_s=duration_s)),
            group.jobs[0].scene,
            compile_run_s,
        )


def _compile(simulate: Callable, scene: object, duration_s: float) -> None:
    # Two workers that start together would each compile for ten seconds; after this they find the code on disk.
    try:
        simulate(scene, duration_s=duration_s)
    except Exception as error:
        # Not the place to judge a scene: the run itself fails in the same way, and that failure becomes its row.
        print(f"the first simulation failed ({type(error).__name__}); its run will say why", file=sys.stderr)


def run_campaign(plan: Plan, jobs: list[Job]) -> Summary:
    """Do every run that is not there yet; keep table.csv up to date while results come.

    Raises CampaignStopped (disk full, folder lost) or KeyboardInterrupt; finished runs and their rows are then on disk.
    """
    jobs = list({job.key: job for job in jobs}.values())
    table = Table(plan.directory / "table.csv", plan.columns, [job.key for job in jobs])
    outcomes = {job.key: outcome for job in jobs if (outcome := reuse(plan, job)) is not None}
    table.rows = {key: outcome.row for key, outcome in outcomes.items()}
    found = len(outcomes)
    table.write()
    missing = [job for job in jobs if job.key not in outcomes]
    try:
        for outcome in _with_progress(plan, _computed(plan, missing), len(jobs), found):
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


def _with_progress(plan: Plan, outcomes: Iterator[Outcome], total: int, found: int) -> Iterator[Outcome]:
    from tqdm import tqdm

    terminal = sys.stderr.isatty()
    hidden = not plan.show_progress or total == found
    options = {"mininterval": 0.2 if terminal else 10.0, "dynamic_ncols": terminal, "disable": hidden}
    with tqdm(total=total, initial=found, unit="run", desc="runs", **options) as bar:
        for outcome in outcomes:
            bar.update()
            yield outcome


def _computed(plan: Plan, jobs: list[Job]) -> Iterator[Outcome]:
    """Outcomes of all jobs as they come: those that can share a worker first, then what these leave undone, one by one.

    A run that kills its worker twice, the second time alone, is given up.
    """
    if not jobs:
        return
    pending = {job.key: job for job in jobs}
    sent = plan.for_workers()
    with opened(plan.backend, min(plan.jobs, len(jobs)), plan.dask_address) as execute:
        groups = {group.number: group for group in groups_of(plan, jobs)}
        for number, outcomes in _survivors(execute, partial(run_group, sent), groups):
            del groups[number]
            for outcome in outcomes:
                yield received(plan, pending.pop(outcome.key), outcome)
        while pending:
            try:
                for outcome in execute(partial(run_one, sent), list(pending.values())):
                    yield received(plan, pending.pop(outcome.key), outcome)
            except PoolBroken as broken:
                for job in broken.suspects:
                    del pending[job.key]
                    yield received(plan, job, _alone(execute, partial(run_one, sent), job))


def _survivors(execute: Callable, call: Callable, groups: dict) -> Iterator:
    """Results of all groups but those that may have killed a worker; groups: those left, which the caller takes out."""
    while groups:
        try:
            yield from execute(call, list(groups.values()))
        except PoolBroken as broken:
            for group in broken.suspects:
                del groups[group.number]


def _alone(execute: Callable, call: Callable, job: Job) -> Outcome:
    try:
        return next(iter(execute(call, [job], alone=True)))
    except PoolBroken as broken:
        return failed(job, "worker-died", f"its process ended twice, the second time running alone: {broken}")
