"""What a worker does: reuse or compute, save or send, make a row; whatever fails becomes a row too.

A worker on this machine writes a run's file itself (`Plan.how.out`). One on another machine has no such folder (None):
it hands the content of the file back, and the runner writes it where the campaign is.
"""

import contextlib
import socket
import time
import traceback
from collections.abc import Callable, Sequence
from dataclasses import replace
from hashlib import sha256
from pathlib import Path
from typing import NamedTuple

import engine
from campaigns.machinery.folder import CampaignStopped, is_full, stored_run, trajectory_path, write_failure
from campaigns.machinery.long_runs import LongRun, Part
from campaigns.machinery.plan import Job, Jobs, Outcome, Plan, name_of
from campaigns.machinery.progress import reporter, with_progress
from campaigns.machinery.store import Store, orbits_in
from engine.atomic import write_atomic

SAVED_S = 10.0  # of work that a killed campaign may lose of a long run, beside the part that is under way


def run_jobs(plan: Plan, jobs: Jobs) -> list[tuple]:
    """Key and outcome of one job, whatever goes wrong in its run; of several jobs, of those that came to an end.

    Raises CampaignStopped where no other run would fare better: a full disk, other sources of the engine.
    """
    if engine.source_hash() != jobs[0].engine:
        raise CampaignStopped("the engine's sources here are not those the campaign began with; start it again")
    report = reporter(plan.reports, name_of(jobs))
    outcomes = {}  # by key
    try:
        _run_side_by_side(plan, jobs, outcomes, report)
    except CampaignStopped:
        raise
    except (Exception, SystemExit) as error:
        if is_full(error):
            raise _stopped(plan, error) from error
        if len(jobs) == 1:  # of several, those that are left are run again, one by one
            outcomes[jobs[0].key] = failed(jobs[0], "error", _reason(error))
    return list(outcomes.items())


class Spare(NamedTuple):
    """Runs of a later step, which does those that fail here, and finds the others finished. plan: of that step."""

    plan: Plan
    jobs: Sequence[Job]

    def __call__(self) -> None:
        with contextlib.suppress(Exception):
            run_jobs(self.plan, self.jobs)


def _run_side_by_side(plan: Plan, jobs: Jobs, outcomes: dict[str, Outcome], report: Callable) -> None:
    """Runs of one part, or of as many as they need (`campaigns.machinery.long_runs`).

    A run is on disk when it has ended, and after a part of it where SAVED_S have passed: a campaign that was killed
    goes on from there.
    """
    under_way = []
    for job in jobs:
        run, outcome = _resumed(plan, job)
        if run.next_part() is None:
            outcomes[job.key] = outcome
        else:
            under_way.append(run)
    saved_s = {}
    length_s = sum(_length_s(run.part) for run in under_way)  # of all parts that are known by now
    ended_s = 0.0  # of those that have ended

    def progress(share):
        report(len(outcomes), share * length_s)

    def progress_alone(share):
        report(len(outcomes), ended_s + share * _length_s(run.part))

    def go_on(number, trajectory):
        """Take a part that has ended; what the run does next, as `engine.simulate_each` asks for it."""
        nonlocal length_s, ended_s
        run = under_way[number]
        ended_s += _length_s(run.part)
        run.take(trajectory)
        outcome = _described(plan, run.job, run.trajectory, run.checks)
        run.row = outcome.row
        part = run.next_part()
        now = time.monotonic()
        # its first part may have waited long for a lane
        late = now - saved_s.setdefault(number, now) > SAVED_S
        # not between the parts of a check: checks are not kept, so a run that is killed there would go on otherwise
        if part is None or (late and not part.check):
            outcome = _saved(plan, run.job, run.trajectory, outcome)
            saved_s[number] = time.monotonic()
        if part is None:
            outcomes[run.job.key] = outcome
            under_way[number] = None  # its record has been saved: some 20 MB of a sea of three hours
            return None
        length_s += _length_s(part)
        return part.scene, part.periods, part.start

    if plan.simulate_each is not None and under_way:
        scenes, periods, starts, _, durations_s = zip(*(run.part for run in under_way), strict=True)
        further = with_progress(plan.simulate_each, progress)
        for _ in plan.simulate_each(scenes, periods, durations_s[0], starts=starts, then=go_on, **further):
            pass
        report(len(outcomes), ended_s, last=True)
        return
    for number, run in enumerate(under_way):
        simulate = run.job.simulate or plan.simulate
        further = with_progress(simulate, progress_alone)
        while run.part is not None:
            scene, periods, start, _, duration_s = run.part
            if start is not None:
                further["start"] = start
            go_on(number, simulate(scene, periods=periods, duration_s=duration_s, **further))
    report(len(outcomes), ended_s, last=True)


def _length_s(part: Part) -> float:
    return part.duration_s or part.periods * part.scene.waves.period_s


def _resumed(plan: Plan, job: Job) -> tuple[LongRun, Outcome | None]:
    """A run as far as it is on disk."""
    outcome = reuse(plan, job)
    if outcome is None:
        return LongRun(job), None
    trajectory = None
    if outcome.row.get("status") in ("ok", None):
        trajectory = stored_run(plan.out, job.key)
    return LongRun(job, trajectory, outcome.row), outcome


def _saved(plan: Plan, job: Job, trajectory, outcome: Outcome) -> Outcome:
    """Save a run that has been computed and its row, or get them ready to be sent."""
    try:
        content = trajectory.to_bytes({"run_key": job.key})
        if plan.out is not None:
            write_atomic(trajectory_path(plan.out, job.key), content)
    except OSError as error:
        raise _stopped(plan, error) from error
    except Exception as error:
        return failed(job, "error", f"not saved: {_reason(error)}")
    if plan.out is None:
        return replace(outcome, content=content)
    keep_row(plan, outcome, content)
    return outcome


def reuse(plan: Plan, job: Job, report: Callable = lambda _: None) -> Outcome | None:
    """The outcome of a run that is there already; None where it has to be computed.

    A file that is damaged, or not of the run that its name and the order say, is as good as none; report(why).
    """
    out = plan.out
    if out is None:
        return None
    path = trajectory_path(out, job.key)
    if not path.exists():
        return None
    try:
        content = path.read_bytes()
        trajectory = engine.Trajectory.from_bytes(content, "", {"run_key": job.key})
        if trajectory.scene.model_copy(update={"output": job.scene.output}) != job.scene:  # it may carry perturbations
            raise ValueError("another run: its scene is not the one of its key")
    except Exception as error:  # whatever it is, from a foreign hand or cut short, the cure is the same
        report(f"{path}: {str(error).removeprefix(': ')}; computed again")
        return None
    row = kept_row(plan, job.key, content)
    if row is not None:
        return Outcome(job.key, row)
    outcome = _described(plan, job, trajectory, {})
    keep_row(plan, outcome, content)
    return outcome


def keep_row(plan: Plan, outcome: Outcome, content: bytes) -> None:
    """Save the row of a run whose file has this content, unless it has no maker or its analysis failed."""
    if plan.row_maker and outcome.row.get("status") != "analysis-failed":
        copy = {"made_by": plan.row_maker, "run": sha256(content).hexdigest(), "row": outcome.row}
        _rows(plan).put(outcome.key, copy)


def kept_row(plan: Plan, key: str, content: bytes) -> dict | None:
    """The row of a run whose file has this content, if the maker of today made it."""
    copy = _rows(plan).get(key) or {}
    is_current = copy.get("made_by") == plan.row_maker and copy.get("run") == sha256(content).hexdigest()
    if is_current:
        return copy["row"]
    return None


def _rows(plan: Plan) -> Store:
    return Store(trajectory_path(plan.out, "").parent, ".row.json")


def _described(plan: Plan, job: Job, trajectory, checks: dict | None) -> Outcome:
    """The row of a run. What a row needs beside its run is computed here, and kept (`Plan.judge`); a row reads it."""
    start_s = time.perf_counter()
    orbits = orbits_in(plan.out)
    try:
        if job.describe is not None or plan.judge is None:
            row = (job.describe or plan.describe)(trajectory)
        else:
            if job.going is None:
                checks = None
            row = plan.describe(trajectory, plan.judge(trajectory, checks, orbits))
    except Exception as error:
        row = {"status": "analysis-failed", "message": _reason(error)}
    return Outcome(job.key, row, time.perf_counter() - start_s, orbits=orbits.unsaved)


def _reason(error: BaseException) -> str:
    frame = traceback.extract_tb(error.__traceback__)[-1]
    return f"{type(error).__name__}: {error} (in {frame.name}, {Path(frame.filename).name}:{frame.lineno})"


def failed(job: Job, status: str, message: str) -> Outcome:
    """A run that left no record: its row says why."""
    return Outcome(job.key, {"status": status, "message": message})


def _stopped(plan: Plan, error: BaseException) -> CampaignStopped:
    return CampaignStopped(write_failure(plan.out or f"the worker on {socket.gethostname()}", error))
