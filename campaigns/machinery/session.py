"""What every campaign does around its work: faults, stops and interruptions in a line each, provenance, the report.

`provenance.json` says who ran what, where, with which versions. It describes what made the results, so a later run of
the same campaign that computes nothing leaves it alone, and a report made from the folder does not change.

Times are wall seconds of this session: compile_s (until the machine code is on disk for every worker), run_s (all
other work but the report), analysis_s (inside run_s, summed over workers), report_s.
"""

import collections
import contextlib
import json
import os
import platform
import re
import shlex
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Iterable
from datetime import UTC, datetime
from functools import partial
from pathlib import Path

import engine
from campaigns.machinery.cli import EXIT_BAD_INPUT, EXIT_FAILED, EXIT_INTERRUPTED, EXIT_OK, Running
from campaigns.machinery.finished import finished, keep_finished
from campaigns.machinery.folder import CampaignStopped, claimed, read_json, write_failure, write_json, write_new
from campaigns.machinery.plan import TIMES, Summary
from campaigns.machinery.progress import stage
from engine.streams import open_streams, printed
from tables import ANSWER, PROVENANCE

MOST_LINES = 8  # of an answer
_PACKAGES = (
    "numpy", "scipy", "numba", "llvmlite", "pandas", "xarray", "pydantic", "joblib", "dask", "distributed",
    "matplotlib", "jinja2", "typst",
)  # fmt: skip
_OF_THE_OCCASION = {
    "command", "jobs", "backend", "dask_address", "host", "cpu_count", "platform", "started_utc", "finished_utc",
    "timing", "runs",
}  # fmt: skip


def command(module: str, argv: list[str] | None, read_order: Callable, work: Callable) -> int:
    """A campaign's command, from the words of its line (None: those of this process) to its exit code.

    read_order(argv, faults) -> the order, checked, with a `cli.Running` named how; work(order, argv) -> exit code.
    """
    if argv is None:
        argv = sys.argv[1:]
    argv = list(argv)
    faults = []
    open_streams()
    try:
        with stage(module.rpartition(".")[2]):
            order = read_order(argv, faults)
    except KeyboardInterrupt:
        return _stopped("\ninterrupted; nothing was run or written", EXIT_INTERRUPTED)
    except ModuleNotFoundError as missing:
        install = ".venv/bin/pip install -c constraints.txt -e ."
        return _stopped(f"python -m {module}: no package {missing.name!r} in {sys.executable}: {install}", EXIT_FAILED)
    if faults:
        return _stopped(f"python -m {module}:{listed(faults)}\nnothing was run or written", EXIT_BAD_INPUT)
    out = order.how.out
    try:
        return work(order, argv)
    except KeyboardInterrupt:
        count = len(list((out / "trajectories").glob("*.nc")))
        rest = f"to go on with the rest: {shlex.join(command_line(module, argv))}"
        return _stopped(f"\ninterrupted; {count} finished runs are in {out}\n{rest}", EXIT_INTERRUPTED)
    except CampaignStopped as reason:
        return _stopped(f"python -m {module}: {reason}", reason.code)
    except OSError as error:
        return _stopped(f"python -m {module}: {write_failure(out, error)}", EXIT_FAILED)


def condensed(faults: list[str]) -> list[str]:
    """The faults; of those of one key that differ by their numbers only, the first, and how many more there are."""
    alike = {}  # faults by key, and reason without its numbers
    for fault in dict.fromkeys(faults):
        key, _, reason = fault.partition(": ")
        alike.setdefault((key, re.sub(r"\d[\d.e+-]*", "#", reason)), []).append(fault)
    lines = []
    for first, *others in alike.values():
        if others:
            first += f" (and {len(others)} more with other numbers)"
        lines.append(first)
    return lines


def listed(faults: list[str]) -> str:
    """One fault behind the name of the command, or several below it, each once."""
    faults = condensed(faults)
    if len(faults) == 1:
        return f" {faults[0]}"
    return "\n  ".join([f" {len(faults)} faults", *faults])


def _stopped(text: str, code: int) -> int:
    print(text, file=sys.stderr)
    return code


def command_line(module: str, argv: list[str]) -> list[str]:
    """The command as the user would type it again."""
    return ["python", "-m", module, *argv]


def conduct(study, order, argv: list[str], parameters: dict) -> int:
    """An order of a `campaigns.study.Study` from its first run to its last word; returns the exit code.

    parameters: what provenance.json says of this campaign. Raises CampaignStopped, OSError, KeyboardInterrupt, for
    `command`.
    """
    start, how = time.perf_counter(), order.how
    fault = key = ""
    answer = []
    if order.simulate is None:
        key = order.key
    with claimed(how.out), stage(study.name):
        summary = finished(how.out, key)
        if summary is not None:
            if study.answer is not None:
                answer = (how.out / ANSWER).read_text(encoding="utf-8").splitlines()
        elif key and not order.cases:
            raise CampaignStopped(f"{how.out} has just been changed; run the same command again")
        else:
            record = begun(how.out, study.name, command_line(study.called, argv), parameters)
            summary = study.work(order)
            if summary.computed or not ended(how.out):
                write_json(how.out / PROVENANCE, record | _outcome(summary))
            if study.answer is not None:
                answer = write_answer(how.out, study.answer(order, summary.rows))
            start_of_report = time.perf_counter()
            if how.report and summary.rows and not summary.whole:
                fault = _fault_of_report(how.out)
            if key and not fault:
                keep_finished(how.out, key, summary)
            summary.times["report_s"] = time.perf_counter() - start_of_report
        summary.times["total_s"] = time.perf_counter() - start
    code = printed(partial(print_summary, how, summary, study.counted, answer, fault))
    if study.strict and _failures(summary):
        return EXIT_FAILED
    return code


def _outcome(summary: Summary) -> dict:
    """What the provenance says of a campaign that has ended."""
    counts = {"total": summary.found + summary.computed, "found": summary.found, "computed": summary.computed}
    counts["failed"] = _failures(summary).total()
    rounded = {name: round(summary.times[name], 3) for name in TIMES}
    return {"runs": counts, "finished_utc": _now_utc(), "timing": rounded}


def _fault_of_report(out: Path) -> str:
    """Build the report; returns why there is none, because the results stand without it. Raises OSError."""
    try:
        from reports import build

        with stage("figures and pages of the report"):
            build(out)
    except OSError:
        raise
    except Exception as error:
        return f"{type(error).__name__}: {error}"
    return ""


def _failures(summary: Summary) -> collections.Counter:
    """How many rows have each status that is not ok."""
    counts = collections.Counter(str(row["status"]) for row in summary.rows)
    del counts["ok"]
    return counts


def write_answer(out: Path, sentences: Iterable[str]) -> list[str]:
    """Write the first MOST_LINES sentences to answer.txt, a line each, where they are new; returns them."""
    lines = list(sentences)[:MOST_LINES]
    write_new(out / ANSWER, "\n".join([*lines, ""]).encode())
    return lines


def begun(out: Path, name: str, command: list[str], parameters: dict) -> dict:
    """The provenance of a campaign that begins: what is known before the first run.

    Written, unless the folder holds that of a finished campaign which differs only in when and where it ran. seed is
    null where `parameters` names none: no random numbers are drawn. Raises OSError.
    """
    record = {
        "campaign": name,
        "command": command,
        "started_utc": _now_utc(),
        "finished_utc": None,
        "seed": None,
        "host": socket.gethostname(),
        "cpu_count": os.cpu_count(),
        "platform": platform.platform(),
        "versions": versions(),
        "git": git_state(Path(__file__).parents[1]),
        "engine_source_hash": engine.source_hash(),
    } | parameters
    if not ended(out) or _lasting(json.loads(json.dumps(record))) != _lasting(read_json(out / PROVENANCE)):
        write_json(out / PROVENANCE, record)
    return record


def _lasting(record: dict) -> dict:
    """The entries of a provenance that do not tell when and where it ran."""
    return {key: entry for key, entry in record.items() if key not in _OF_THE_OCCASION}


def ended(out: Path) -> bool:
    """Whether the provenance in a folder is that of a finished campaign; while one runs: whether it did all this."""
    record = read_json(out / PROVENANCE)
    return isinstance(record, dict) and record.get("finished_utc") is not None


def _now_utc() -> str:
    return datetime.now(UTC).strftime("%Y-%m-%dT%H:%M:%SZ")


def versions() -> dict[str, str | None]:
    """Of Python and of the libraries that shape results and reports."""
    from importlib import metadata  # 30 ms, which a refusal does not need

    versions = {"python": platform.python_version(), **dict.fromkeys(_PACKAGES)}
    for package in _PACKAGES:
        with contextlib.suppress(metadata.PackageNotFoundError):
            versions[package] = metadata.version(package)
    return versions


def git_state(directory: Path) -> dict:
    """{"commit", "dirty"} of the checkout that holds `directory`; both null outside one, or without git."""
    git = ["git", "-C", str(directory), "status", "--porcelain=v2", "--branch"]
    # An installed copy is no checkout, even when it lies inside somebody's: only our own repository counts.
    if (directory.parent / ".git").exists():
        with contextlib.suppress(OSError, subprocess.SubprocessError):
            status = subprocess.run(git, capture_output=True, text=True, timeout=10, check=True).stdout
            commit = re.search(r"^# branch\.oid (\S+)", status, re.MULTILINE)[1]
            changes = re.search(r"^[^#]", status, re.MULTILINE)
            return {"commit": commit, "dirty": changes is not None}
    return {"commit": None, "dirty": None}


def machine() -> dict:
    """The machine as a table of times has to name it: {"processor", "cores"}, cores that this process may use."""
    cores = os.cpu_count()
    if hasattr(os, "sched_getaffinity"):
        cores = len(os.sched_getaffinity(0))
    processor = platform.processor() or platform.machine()
    with contextlib.suppress(OSError):
        facts = Path("/proc/cpuinfo").read_text(encoding="utf-8")
        model = re.search(r"^model name\s*:[ \t]*(.*\S)", facts, re.MULTILINE)
        if model:
            processor = model[1]
    return {"processor": processor, "cores": cores}


def print_summary(how: Running, summary: Summary, counted: str, answer: list[str], fault: str) -> int:
    """Print the answer, what was done, where it is and where the time went; returns the exit code.

    counted: what the summary counts, as "runs"; fault: why there is no report.
    """
    out, times = how.out, summary.times
    for head, line in zip(["answer", *[""] * MOST_LINES], answer, strict=False):
        print(line if line[:4].isupper() else f"{head:<9}{line}")
    count = summary.computed + summary.found
    print(f"{counted:<9}{count}: {summary.computed} computed, {summary.found} found")
    failed = _failures(summary)
    if failed:
        reasons = ", ".join(f"{status} {count}" for status, count in sorted(failed.items()))
        print(f"failed   {failed.total()}: {reasons}; see the columns status and message")
    print(f"table    {out / 'table.csv'}")
    if how.report and not (summary.rows or summary.whole):
        print("report   none, because the table has no rows")
    elif how.report and not fault:
        print(f"report   {out / 'report.html'}\n         {out / 'report.pdf'}")
    print(
        f"time     {times['total_s']:.1f} s: compile {times['compile_s']:.1f}, run {times['run_s']:.1f}, "
        f"report {times['report_s']:.1f}; analysis took {times['analysis_s']:.1f} s of the workers' time"
    )
    if fault:
        retry = f"the runs are complete; try again: python -m reports {out}"
        return _stopped(f"no report could be made: {fault}\n{retry}", EXIT_FAILED)
    return EXIT_OK
