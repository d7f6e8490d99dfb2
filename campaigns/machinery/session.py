"""What every campaign does around its runs: compile first, keep provenance, build the report, say what happened.

Times are wall seconds of this session: compile_s (the first simulation of all, after which the machine code is on disk
for every worker), run_s (all runs), analysis_s (inside run_s, summed over workers), report_s.
"""

import collections
import shlex
import sys
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path

from campaigns.machinery import cli, provenance
from campaigns.machinery.folder import CampaignStopped, claimed, trajectory_path
from campaigns.machinery.runner import Job, Plan, Summary, run_campaign, write_failure
from campaigns.machinery.side_by_side import grouped

_COMPILE_RUN_S = 0.1  # long enough to go through every kernel, too short to cost anything


def guarded(module: str, argv: list[str], out: Path, work: Callable[[], int]) -> int:
    """Run `work` and turn what may end a campaign into one line and an exit code."""
    prog = f"python -m {module}"
    again = shlex.join(provenance.command_line(module, argv))
    try:
        return work()
    except KeyboardInterrupt:
        kept = sum(1 for _ in (out / "trajectories").glob("*.nc"))
        print(f"\ninterrupted; {kept} finished runs are in {out}\nto go on with the rest: {again}", file=sys.stderr)
        return cli.EXIT_INTERRUPTED
    except CampaignStopped as reason:
        print(f"{prog}: {reason}", file=sys.stderr)
    except OSError as error:
        print(f"{prog}: {write_failure(out, error)}", file=sys.stderr)
    return cli.EXIT_FAILED


def conduct(campaign: str, module: str, argv: list[str], plan: Plan, jobs: list[Job], parameters: dict, **how) -> int:
    """A campaign of simulations from its first run to its last word; returns the exit code.

    how: report, whether one is wanted; runs(plan, jobs), in place of `run`. Raises CampaignStopped, OSError and
    KeyboardInterrupt, for `guarded`.
    """
    start, wanted = time.perf_counter(), how.get("report", True)
    with claimed(plan.directory):
        record = begin(campaign, module, argv, plan, jobs, parameters)
        timing, summary = how.get("runs", run)(plan, jobs)
        finish(plan.directory, record, summary, timing)
        fault = report(plan.directory, wanted, timing, start)
    return say(plan.directory, summary, timing, wanted, fault)


def begin(campaign: str, module: str, argv: list[str], plan: Plan, jobs: list[Job], parameters: dict) -> dict:
    """Write scene.toml and, where this session is a new one, provenance.json; returns the record for `finish`."""
    from engine.atomic import write_atomic

    record = provenance.gather(campaign, provenance.command_line(module, argv))
    record |= {**parameters, "backend": plan.backend, "jobs": plan.jobs}
    head = f"# the scene of the first run of {campaign}; what varies over the runs is listed in provenance.json\n"
    write_atomic(plan.directory / "scene.toml", (head + jobs[0].scene.to_toml()).encode())
    if provenance.read_if_same(plan.directory / "provenance.json", record) is None:
        provenance.write(plan.directory / "provenance.json", record)
    return record


def run(plan: Plan, jobs: list[Job], compile_run_s: float = _COMPILE_RUN_S) -> tuple[dict[str, float], Summary]:
    """Compile and do the runs; returns the times of both and the summary.

    compile_run_s: length of the run that only compiles, long enough for the scenes at hand to go through every kernel.
    """
    missing = [job for job in jobs if not trajectory_path(plan.directory, job.key).exists()]
    # A plane, space, and runs side by side have machine code of their own.
    groups = grouped(plan, missing)
    together = {job.key for group in groups for job in group.jobs}
    first_of_a_kind = {job.scene.motion.dimensions: job for job in reversed(missing) if job.key not in together}
    start = time.perf_counter()
    if missing:
        print("compiling the engine, or loading it compiled ...", file=sys.stderr)
    for job in first_of_a_kind.values():
        _compile(plan.simulate, job.scene, compile_run_s)
    for group in groups[:1]:
        _compile(partial(_a_pair, plan.simulate_each), group.jobs[0].scene, compile_run_s)
    timing = {"compile_s": time.perf_counter() - start}
    start = time.perf_counter()
    summary = run_campaign(plan, jobs)
    timing |= {"run_s": time.perf_counter() - start, "analysis_s": summary.analysis_s}
    return timing, summary


def _a_pair(simulate_each: Callable, scene: object, duration_s: float) -> None:
    list(simulate_each([scene, scene], duration_s=duration_s))


def _compile(simulate: Callable, scene: object, duration_s: float) -> None:
    # Two workers that start together would each compile for ten seconds; after this they find the code on disk.
    try:
        simulate(scene, duration_s=duration_s)
    except Exception as error:
        # Not the place to judge a scene: the run itself fails in the same way, and that failure becomes its row.
        print(f"the first simulation failed ({type(error).__name__}); its run will say why", file=sys.stderr)


def finish(out: Path, record: dict, summary: Summary, timing: dict[str, float]) -> None:
    """Write the provenance of a finished campaign, unless the one on disk says how these very results were made."""
    path = out / "provenance.json"
    if summary.computed == 0 and provenance.read_if_same(path, record) is not None:
        return
    failed = sum(row["status"] != "ok" for row in summary.rows)
    counts = {"total": len(summary.rows), "found": summary.found, "computed": summary.computed, "failed": failed}
    record["runs"] = counts
    record |= {"finished_utc": provenance.now_utc(), "timing": _rounded(timing)}
    provenance.write(path, record)


def report(out: Path, wanted: bool, timing: dict[str, float], start: float) -> str:
    """Build report.html and report.pdf where they are wanted; adds report_s and total_s to `timing`.

    Returns "", or why there is no report: the results stand without one.
    """
    fault = ""
    began = time.perf_counter()
    if wanted:
        try:
            import reports

            reports.build(out)
        except OSError:
            raise
        except Exception as error:
            fault = f"{type(error).__name__}: {error}"
    timing |= {"report_s": time.perf_counter() - began, "total_s": time.perf_counter() - start}
    return fault


def _rounded(timing: dict[str, float]) -> dict[str, float]:
    return {name: round(seconds, 3) for name, seconds in timing.items()}


def say(out: Path, summary: Summary, timing: dict[str, float], wanted: bool, fault: str) -> int:
    """Print what was done, where it is and where the time went; returns the exit code."""
    failed = collections.Counter(str(row["status"]) for row in summary.rows if row["status"] != "ok")
    reasons = ", ".join(f"{status} {count}" for status, count in sorted(failed.items()))
    print(f"runs     {len(summary.rows)}: {summary.computed} computed, {summary.found} found")
    if failed:
        print(f"failed   {sum(failed.values())}: {reasons}; see the columns status and message")
    print(f"table    {out / 'table.csv'}")
    if wanted and not fault:
        print(f"report   {out / 'report.html'}\n         {out / 'report.pdf'}")
    print(
        f"time     {timing['total_s']:.1f} s: compile {timing['compile_s']:.1f}, run {timing['run_s']:.1f} "
        f"(of it analysis {timing['analysis_s']:.1f}, summed over workers), report {timing['report_s']:.1f}"
    )
    if fault:
        again = f"the runs are complete; try again: python -m reports {out}"
        print(f"no report could be made: {fault}\n{again}", file=sys.stderr)
        return cli.EXIT_FAILED
    return cli.EXIT_OK
