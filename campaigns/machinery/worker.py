"""Runs, where they are made: reuse or compute, save or send, make a row; whatever fails becomes a row too.

A worker on this machine writes a run's file itself (`Plan.how.out`). One on another machine has no such folder (None):
it hands the content of the file back, and the runner writes it where the campaign is.

Every run is saved, and has its row, as soon as it ends: a killed campaign loses what was running and nothing else.
"""

import socket
import time
import traceback
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import engine
from campaigns.machinery.folder import CampaignStopped, is_full, keep_row, kept_row, trajectory_path, write_failure
from campaigns.machinery.plan import Job, Outcome, Plan
from engine.atomic import write_atomic


def run_jobs(plan: Plan, jobs: Sequence[Job]) -> list[Outcome]:
    """The outcome of one job, whatever goes wrong in its run; of several jobs, those that came to an end.

    Raises CampaignStopped where no other run would fare better: a full disk, other sources of the engine.
    """
    first = jobs[0]
    if engine.source_hash() != first.engine:
        raise CampaignStopped("the engine's sources here are not those the campaign began with; start it again")
    if len(jobs) == 1:
        return [_run_one(plan, first)]
    outcomes = []
    try:
        scenes = [job.scene for job in jobs]
        for i, trajectory in plan.simulate_each(scenes, periods=first.periods, duration_s=first.duration_s):
            outcomes.append(_kept(plan, jobs[i], trajectory))
    except CampaignStopped:
        raise
    except (Exception, SystemExit):
        pass  # run again one by one, each of the jobs left says for itself what is wrong
    return outcomes


def _run_one(plan: Plan, job: Job) -> Outcome:
    if (outcome := reuse(plan, job)) is not None:
        return outcome
    try:
        trajectory = (job.simulate or plan.simulate)(job.scene, periods=job.periods, duration_s=job.duration_s)
    except (Exception, SystemExit) as error:
        if is_full(error):
            raise _stopped(plan, error) from error
        return failed(job, "error", _reason(error))
    return _kept(plan, job, trajectory)


def _kept(plan: Plan, job: Job, trajectory) -> Outcome:
    """Save a run that has been computed, or get it ready to be sent, and make its row."""
    try:
        content = trajectory.to_bytes({"run_key": job.key})
        if plan.how.out is not None:
            write_atomic(trajectory_path(plan.how.out, job.key), content)
    except OSError as error:
        raise _stopped(plan, error) from error
    except Exception as error:
        return failed(job, "error", f"not saved: {_reason(error)}")
    outcome = _described(plan, job, trajectory)
    return outcome if plan.how.out is not None else replace(outcome, content=content)


def reuse(plan: Plan, job: Job) -> Outcome | None:
    """The outcome of a run that is there already; None where it has to be computed, as where its file is damaged."""
    out = plan.how.out
    if out is None or not (path := trajectory_path(out, job.key)).exists():
        return None
    try:
        trajectory = engine.Trajectory.load(path)
    except Exception:  # truncated, emptied, not netCDF, from a foreign hand: whatever it is, the cure is the same
        return None
    row = kept_row(out, job.key, plan.row_maker)
    return _described(plan, job, trajectory) if row is None else Outcome(job.key, row)


def _described(plan: Plan, job: Job, trajectory) -> Outcome:
    start = time.perf_counter()
    try:
        row = (job.describe or plan.describe)(trajectory)
    except Exception as error:
        row = {"status": "analysis-failed", "message": _reason(error)}
    outcome = Outcome(job.key, row, time.perf_counter() - start)
    if plan.how.out is not None:
        keep_row(plan.how.out, job.key, plan.row_maker, row)
    return outcome


def _reason(error: BaseException) -> str:
    frame = traceback.extract_tb(error.__traceback__)[-1]
    return f"{type(error).__name__}: {error} (in {frame.name}, {Path(frame.filename).name}:{frame.lineno})"


def failed(job: Job, status: str, message: str) -> Outcome:
    """A run that left no record: its row says why."""
    return Outcome(job.key, {"status": status, "message": message})


def _stopped(plan: Plan, error: BaseException) -> CampaignStopped:
    return CampaignStopped(write_failure(plan.how.out or f"the worker on {socket.gethostname()}", error))
