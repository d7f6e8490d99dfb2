"""What a worker does: reuse or compute, save or send, make a row; whatever fails becomes a row too.

A worker on this machine writes a run's file itself (`Plan.how.out`). One on another machine has no such folder (None):
it hands the content of the file back, and the runner writes it where the campaign is.
"""

import socket
import time
import traceback
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

import engine
from campaigns.machinery.folder import (
    CampaignStopped,
    is_full,
    keep_row,
    kept_row,
    stored_run,
    trajectory_path,
    write_failure,
)
from campaigns.machinery.plan import Further, Job, Outcome, Plan, name_of
from campaigns.machinery.progress import reporter, with_progress
from engine.atomic import write_atomic

SAVED_S = 10.0  # of work that a killed campaign may lose of a run, beside the part at which it is


def run_jobs(plan: Plan, jobs: Sequence[Job]) -> list[Outcome]:
    """The outcome of one job, whatever goes wrong in its run; of several jobs, those that came to an end.

    Raises CampaignStopped where no other run would fare better: a full disk, other sources of the engine.
    """
    first = jobs[0]
    if engine.source_hash() != first.engine:
        raise CampaignStopped("the engine's sources here are not those the campaign began with; start it again")
    report = reporter(plan.reports, name_of(jobs))
    if first.going is not None:
        return _carried_on(plan, jobs, report)
    outcomes, length = [], {"periods": first.periods, "duration_s": first.duration_s}
    length_s = sum(job.length_s for job in jobs)

    def progress(share: float) -> None:
        report(len(outcomes), share * length_s)

    if len(jobs) == 1:
        return [_run_one(plan, first, progress)]
    try:
        scenes = [job.scene for job in jobs]
        for i, trajectory in plan.simulate_each(scenes, **length, **with_progress(plan.simulate_each, progress)):
            outcomes.append(_kept(plan, jobs[i], trajectory))
    except CampaignStopped:
        raise
    except (Exception, SystemExit):
        pass  # run again one by one, each of the jobs left says for itself what is wrong
    return outcomes


@dataclass
class _Standing:
    """How far a run has come that takes as long as it needs: its Trajectory and Outcome, the runs that went on from it
    at a tighter tolerance, by its periods then, what it does at present (`Further`), and when it was last saved (None:
    it has not been looked at).
    """

    trajectory: object = None
    outcome: Outcome | None = None
    checks: dict[int, object] = field(default_factory=dict)
    further: Further | None = None
    saved_s: float | None = None


def _carried_on(plan: Plan, jobs: Sequence[Job], report: Callable[..., None]) -> list[Outcome]:
    """As `run_jobs`, of jobs that take as long as they need: each goes on when it has been judged, among the others.

    What a run has done is on disk when it ends, and every SAVED_S at a look: a killed campaign goes on from there.
    """
    runs = [_so_far(plan, job) for job in jobs]
    length_s = 0.0  # of all parts that are known by now

    def next_of(i: int) -> Further | None:
        nonlocal length_s
        run, job = runs[i], jobs[i]
        row = None if run.outcome is None else run.outcome.row
        run.further = further = job.going(job.scene, run.trajectory, row, run.checks)
        if further is not None:
            length_s += further.periods * further.scene.waves.period_s
        return further

    def judged(i: int, part) -> tuple | None:
        run, job = runs[i], jobs[i]
        if run.further.check:
            periods = round(run.outcome.row["periods"])
            run.checks[periods] = run.checks[periods].followed_by(part) if periods in run.checks else part
        else:
            run.trajectory = part if run.trajectory is None else run.trajectory.followed_by(part)
        run.outcome = _described(plan, job, run.trajectory, run.checks)
        further, now = next_of(i), time.monotonic()
        run.saved_s = now if run.saved_s is None else run.saved_s  # it may have waited long for its lane
        # not between the parts of a check, which are not kept: a run that was killed there would go on otherwise
        if further is None or (not further.check and now - run.saved_s > SAVED_S):
            run.outcome, run.saved_s = _kept(plan, job, run.trajectory, run.outcome), time.monotonic()
        return None if further is None else (further.scene, further.periods, further.start)

    def progress(share: float) -> None:
        report(sum(run.further is None for run in runs), share * length_s)

    try:
        asked = [i for i in range(len(jobs)) if next_of(i) is not None]
        first = [runs[i].further for i in asked]
        if plan.simulate_each is None:
            for i in asked:
                while (further := runs[i].further) is not None:
                    start = {} if further.start is None else {"start": further.start}
                    judged(i, plan.simulate(further.scene, periods=further.periods, **start))
        elif asked:
            lengths, starts = [further.periods for further in first], [further.start for further in first]
            scenes, then = [further.scene for further in first], lambda number, part: judged(asked[number], part)
            more = with_progress(plan.simulate_each, progress)
            for _ in plan.simulate_each(scenes, periods=lengths, starts=starts, then=then, **more):
                pass
    except CampaignStopped:
        raise
    except (Exception, SystemExit) as error:
        if is_full(error):
            raise _stopped(plan, error) from error
        if len(jobs) == 1:  # alone it says what is wrong; the others are run again one by one
            return [failed(jobs[0], "error", _reason(error))]
    return [run.outcome for run in runs if run.further is None]


def _so_far(plan: Plan, job: Job) -> _Standing:
    """As much of a run as is there."""
    outcome = reuse(plan, job)
    if outcome is None or outcome.row.get("status") not in ("ok", None):
        return _Standing(outcome=outcome)
    return _Standing(stored_run(plan.how.out, job.key), outcome)


def _run_one(plan: Plan, job: Job, progress: Callable[[float], None]) -> Outcome:
    if (outcome := reuse(plan, job)) is not None:
        return outcome
    simulate = job.simulate or plan.simulate
    try:
        length = {"periods": job.periods, "duration_s": job.duration_s}
        trajectory = simulate(job.scene, **length, **with_progress(simulate, progress))
    except (Exception, SystemExit) as error:
        if is_full(error):
            raise _stopped(plan, error) from error
        return failed(job, "error", _reason(error))
    return _kept(plan, job, trajectory)


def _kept(plan: Plan, job: Job, trajectory, outcome: Outcome | None = None) -> Outcome:
    """Save a run that has been computed, or get it ready to be sent, and its row; outcome: where that is made."""
    try:
        content = trajectory.to_bytes({"run_key": job.key})
        if plan.how.out is not None:
            write_atomic(trajectory_path(plan.how.out, job.key), content)
    except OSError as error:
        raise _stopped(plan, error) from error
    except Exception as error:
        return failed(job, "error", f"not saved: {_reason(error)}")
    outcome = _described(plan, job, trajectory) if outcome is None else outcome
    if plan.how.out is None:
        return replace(outcome, content=content)
    keep_row(plan.how.out, job.key, plan.row_maker, outcome.row, content)
    return outcome


def reuse(plan: Plan, job: Job, said: Callable[[str], None] = lambda _: None) -> Outcome | None:
    """The outcome of a run that is there already; None where it has to be computed.

    A file that is damaged, or not of the run that its name and the order say, is as good as none; said: hears of it.
    """
    out = plan.how.out
    if out is None or not (path := trajectory_path(out, job.key)).exists():
        return None
    try:
        content = path.read_bytes()
        trajectory = engine.Trajectory.from_bytes(content, "", {"run_key": job.key})
        if trajectory.scene.model_copy(update={"output": job.scene.output}) != job.scene:  # it may carry perturbations
            raise ValueError("another run: its scene is not the one of its key")
    except Exception as error:  # whatever it is, from a foreign hand or cut short, the cure is the same
        said(f"{path}: {str(error).removeprefix(': ')}; computed again")
        return None
    if (row := kept_row(out, job.key, plan.row_maker, content)) is not None:
        return Outcome(job.key, row)
    outcome = _described(plan, job, trajectory)
    keep_row(out, job.key, plan.row_maker, outcome.row, content)
    return outcome


def _described(plan: Plan, job: Job, trajectory, checks: dict | None = None) -> Outcome:
    start, more = time.perf_counter(), {} if job.going is None else {"checks": checks or {}}
    try:
        row = (job.describe or plan.describe)(trajectory, **more)
    except Exception as error:
        row = {"status": "analysis-failed", "message": _reason(error)}
    return Outcome(job.key, row, time.perf_counter() - start)


def _reason(error: BaseException) -> str:
    frame = traceback.extract_tb(error.__traceback__)[-1]
    return f"{type(error).__name__}: {error} (in {frame.name}, {Path(frame.filename).name}:{frame.lineno})"


def failed(job: Job, status: str, message: str) -> Outcome:
    """A run that left no record: its row says why."""
    return Outcome(job.key, {"status": status, "message": message})


def _stopped(plan: Plan, error: BaseException) -> CampaignStopped:
    return CampaignStopped(write_failure(plan.how.out or f"the worker on {socket.gethostname()}", error))
