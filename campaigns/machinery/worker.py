"""One run, where it is made: reuse or compute, save or send, make a row; whatever fails becomes a row too.

A worker on this machine writes the run's file itself (`Plan.directory`). One on another machine has no such folder
(None): it hands the content of the file back, and `received` writes it where the campaign is.
"""

import socket
import time
import traceback
from dataclasses import replace
from pathlib import Path

from campaigns.machinery.folder import is_full, trajectory_path, write_failure
from campaigns.machinery.plan import Job, Outcome, Plan
from campaigns.machinery.row_cache import keep_row, kept_row
from engine.atomic import write_atomic


def run_one(plan: Plan, job: Job) -> Outcome:
    """Runs in the worker: reuse or compute, save, describe. Never raises for what goes wrong in the run itself."""
    from engine import source_hash

    if (outcome := reuse(plan, job)) is not None:
        return outcome
    if source_hash() != job.engine:
        return other_sources(job)
    try:
        trajectory = (job.simulate or plan.simulate)(job.scene, periods=job.periods, duration_s=job.duration_s)
    except (Exception, SystemExit) as error:
        if is_full(error):
            return _stopped(job, plan, error)
        return failed(job, "error", _reason(error))
    return kept(plan, job, trajectory)


def other_sources(job: Job) -> Outcome:
    """Stops a campaign whose worker has other sources of the engine."""
    reason = "the engine's sources here are not those the campaign began with; start it again"
    return Outcome(job.key, {}, computed=False, stop=reason)


def kept(plan: Plan, job: Job, trajectory) -> Outcome:
    """Save a run that has been computed, or get it ready to be sent, and make its row."""
    try:
        content = trajectory.to_bytes({"run_key": job.key})
        if plan.directory is not None:
            write_atomic(trajectory_path(plan.directory, job.key), content)
    except OSError as error:  # of the folder, not of the run: the next one would fare no better
        return _stopped(job, plan, error)
    except Exception as error:
        return failed(job, "error", f"not saved: {_reason(error)}")
    outcome = _described(plan, job, trajectory, computed=True)
    return outcome if plan.directory is not None else replace(outcome, content=content)


def received(plan: Plan, job: Job, outcome: Outcome) -> Outcome:
    """Where the folder is: write what a worker sent, if it sent anything."""
    if not outcome.content:
        return outcome
    try:
        write_atomic(trajectory_path(plan.directory, job.key), outcome.content)
    except OSError as error:
        return _stopped(job, plan, error)
    if outcome.described is not None and plan.row_maker:
        keep_row(plan.directory, job.key, plan.row_maker, outcome.described)
    return replace(outcome, content=b"", described=None)


def _load(directory: Path, job: Job):
    """The finished run, or None where there is none or its file is damaged: then it is computed again."""
    from engine import Trajectory

    path = trajectory_path(directory, job.key)
    if not path.exists():
        return None
    try:
        return Trajectory.load(path)
    except Exception:  # truncated, emptied, not netCDF, from a foreign hand: whatever it is, the cure is the same
        return None


def reuse(plan: Plan, job: Job) -> Outcome | None:
    """The outcome of a run that is there already; None where it has to be computed."""
    trajectory = None if plan.directory is None else _load(plan.directory, job)
    return None if trajectory is None else _described(plan, job, trajectory, computed=False)


def _described(plan: Plan, job: Job, trajectory, computed: bool) -> Outcome:
    start, made = time.perf_counter(), None
    row = kept_row(plan.directory, job.key, plan.row_maker) if plan.row_maker and not computed else None
    if row is None:
        try:
            row = made = (job.describe or plan.describe)(trajectory)
        except Exception as error:
            row = {"status": "analysis-failed", "message": _reason(error)}
        else:
            if plan.row_maker and plan.directory is not None:
                keep_row(plan.directory, job.key, plan.row_maker, row)
    row = {**job.labels, **row, "run_key": job.key}
    described = made if plan.directory is None else None
    return Outcome(job.key, row, computed, time.perf_counter() - start, described=described)


def _reason(error: BaseException) -> str:
    frame = traceback.extract_tb(error.__traceback__)[-1]
    return f"{type(error).__name__}: {error} (in {frame.name}, {Path(frame.filename).name}:{frame.lineno})"


def failed(job: Job, status: str, message: str) -> Outcome:
    """A run that left no record: its row says why."""
    return Outcome(job.key, {**job.labels, "status": status, "message": message, "run_key": job.key}, computed=True)


def _stopped(job: Job, plan: Plan, error: BaseException) -> Outcome:
    place = plan.directory or f"the worker on {socket.gethostname()}"
    return Outcome(job.key, {}, computed=False, stop=write_failure(place, error))
