"""What every campaign does around its work: hold the folder, keep provenance, build the report, say what happened.

Times are wall seconds of this session: compile_s (the first simulation of all, after which the machine code is on disk
for every worker), run_s (all runs), analysis_s (inside run_s, summed over workers), report_s.
"""

import collections
import sys
import time
from collections.abc import Callable
from pathlib import Path

from campaigns.machinery import cli, provenance
from campaigns.machinery.command import command_line
from campaigns.machinery.folder import claimed
from campaigns.machinery.plan import Summary


def conduct(name: str, module: str, argv: list[str], how: cli.Running, parameters: dict, work: Callable) -> int:
    """A campaign from its first run to its last word; returns the exit code.

    parameters: what provenance.json says of this campaign. work() -> (times, Summary): the runs and their table, with
    compile_s, run_s and analysis_s among the times. Raises CampaignStopped, OSError, KeyboardInterrupt, for `command`.
    """
    start = time.perf_counter()
    with claimed(how.out):
        record = provenance.gather(name, command_line(module, argv)) | parameters
        if provenance.read_if_same(how.out / "provenance.json", record) is None:
            provenance.write(how.out / "provenance.json", record)
        timing, summary = work()
        finish(how.out, record, summary, timing)
        fault = report(how.out, how.report, timing, start)
    return say(how.out, summary, timing, how.report, fault)


def finish(out: Path, record: dict, summary: Summary, timing: dict[str, float]) -> None:
    """Write the provenance of a finished campaign, unless the one on disk says how these very results were made."""
    path = out / "provenance.json"
    if summary.computed == 0 and provenance.read_if_same(path, record) is not None:
        return
    failed = sum(row["status"] != "ok" for row in summary.rows)
    record["runs"] = {
        "total": len(summary.rows),
        "found": summary.found,
        "computed": summary.computed,
        "failed": failed,
    }
    rounded = {name: round(seconds, 3) for name, seconds in timing.items()}
    provenance.write(path, record | {"finished_utc": provenance.now_utc(), "timing": rounded})


def report(out: Path, wanted: bool, timing: dict[str, float], start: float) -> str:
    """Build report.html and report.pdf where they are wanted; adds report_s and total_s to `timing`.

    Returns "", or why there is no report: the results stand without one.
    """
    fault = ""
    began = time.perf_counter()
    if wanted:
        try:
            from reports import build

            build(out)
        except OSError:
            raise
        except Exception as error:
            fault = f"{type(error).__name__}: {error}"
    timing |= {"report_s": time.perf_counter() - began, "total_s": time.perf_counter() - start}
    return fault


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
