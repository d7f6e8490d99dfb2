"""The work of `campaigns.stability` cut into tasks: found again or done, in worker processes, and put into tables.

A task's result is a JSON record, kept beside the runs under a key of what it is and a hash of every source that shapes
it. Files written: table.csv (a row a case, and one for each kind of random scenes), fuzz.csv (a row a random scene),
scene.toml (the scene from which cases start).
"""

import hashlib
import json
import time
from collections import Counter
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from campaigns.machinery.folder import (
    CampaignStopped,
    keep_row,
    kept_row,
    made_by,
    trajectory_path,
    write_table,
)
from campaigns.machinery.plan import Summary
from campaigns.machinery.pools import PoolBroken, opened
from campaigns.machinery.progress import stage
from campaigns.machinery.runner import ENGINE
from campaigns.stability import cases, fuzz, random_scenes
from campaigns.stability.cases import all_cases, drift_case
from engine import load_scene
from engine.atomic import write_atomic

SOURCES = ("engine", "campaigns/stability", "campaigns/stability/random_scenes.toml")
CHUNK = {random_scenes.VALID: 20, random_scenes.INVALID: 200}


@dataclass(frozen=True)
class Task:
    """One piece of work.

    kind: "case" (what: a Case), "drawn" (kind of scenes, seed, count), or "random" (the same, first and last number).
    """

    kind: str
    what: object

    def key(self) -> str:
        """Where its result is kept."""
        return hashlib.sha256(repr(self).encode()).hexdigest()


def planned(options) -> list[Task]:
    """Every task that workers do, the longest first."""
    tasks = [Task("case", drift_case(options.drift_periods))] if options.drift_periods else []
    tasks += [Task("case", case) for case in all_cases() if case.quick or not options.quick]
    for kind, size in CHUNK.items():
        for first in range(0, options.fuzz, size):
            tasks.append(Task("random", (kind, options.seed, options.fuzz, first, min(first + size, options.fuzz))))
    return tasks


def result(out: Path, maker: str, task: Task) -> dict:
    """The result of a task as it is kept, or as it is made now and kept."""
    stored = kept_row(out, task.key(), maker)
    if stored is not None:
        return stored
    fuzz.load_kernels()
    record = _computed(out, maker, task)
    rows = record.get("rows", [record])
    crashed = any("crash" in (row.get("run_status"), row.get("outcome")) for row in rows)
    if not crashed:  # by the system perhaps, for want of memory: tried again with the next call
        keep_row(out, task.key(), maker, record)
    return record


def _computed(out: Path, maker: str, task: Task) -> dict:
    if task.kind == "case":
        return cases.case_row(task.what, trajectory_path(out, task.key()))
    kind, seed, count, *part = task.what
    if task.kind == "drawn":
        return {"scenes": random_scenes.drawn(kind, seed, count)}
    drawn = list(enumerate(result(out, maker, Task("drawn", (kind, seed, count)))["scenes"]))[slice(*part)]
    rows = []
    for number, raw in drawn:
        rows.append({"kind": kind, "number": number, **fuzz.judged(kind, raw)})
    return {"rows": rows}


def perform(options, how) -> tuple[dict[str, float], Summary]:
    """Do all that is not there yet; write the tables. Returns the times and the summary for the session.

    Raises CampaignStopped where a worker dies: cases have their own processes.
    """
    out, maker = how.out, made_by({}, *SOURCES)
    write_atomic(out / "scene.toml", load_scene("tethered_buoy").to_toml().encode())
    tasks = planned(options)
    results = {task.key(): kept_row(out, task.key(), maker) for task in tasks}
    missing = [task for task in tasks if results[task.key()] is None]
    start = time.perf_counter()
    if missing:
        with stage(ENGINE):
            fuzz.load_kernels()
    timing = {"compile_s": time.perf_counter() - start}
    start = time.perf_counter()
    drawn = {}
    with stage("drawing random scenes"):
        if options.fuzz:
            for kind in CHUNK:
                drawn[kind] = result(out, maker, Task("drawn", (kind, options.seed, options.fuzz)))["scenes"]
    try:
        with (
            opened("loky", max(1, min(how.jobs, len(missing)))) as execute,
            stage("cases", len(tasks), "tasks", lambda: len(tasks) - [*results.values()].count(None)),
        ):
            if missing:
                for task, finished in execute(partial(result, out.absolute(), maker), missing):
                    results[task.key()] = finished
    except PoolBroken as broken:
        raise CampaignStopped(f"a worker process ended: {broken}; finished tasks are kept") from broken
    rows, random = [], []
    for task in tasks:
        if task.kind == "case":
            rows.append(results[task.key()] | {"run_key": task.key()})
        else:
            random += results[task.key()]["rows"]
    for kind, scenes in drawn.items():
        rows.append(_of_kind(options, kind, scenes, [row for row in random if row["kind"] == kind]))
    write_table(out / "fuzz.csv", fuzz.COLUMNS, random)
    write_table(out / "table.csv", cases.COLUMNS, rows)
    timing |= {"run_s": time.perf_counter() - start, "analysis_s": 0.0}
    return timing, Summary(rows, len(tasks) - len(missing), len(missing), 0.0)


def _of_kind(options, kind: str, drawn: list[dict], rows: list[dict]) -> dict:
    """The row of all random scenes of a kind: outcomes counted, and the smallest unsound scene where there is one."""
    counts = Counter(row["outcome"] for row in rows)
    unsound = sum(count for outcome, count in counts.items() if outcome not in fuzz.SOUND)
    message = ", ".join(f"{outcome} {count}" for outcome, count in sorted(counts.items()))
    if unsound:
        known = {json.dumps(raw): row["outcome"] for raw, row in zip(drawn, rows, strict=True)}

        def is_unsound(raw: dict) -> bool:
            outcome = known.get(json.dumps(raw)) or fuzz.judged(kind, raw)["outcome"]
            return outcome not in fuzz.SOUND

        smallest = random_scenes.smallest(kind, options.seed, options.fuzz, is_unsound)
        message += f"; the smallest scene of this kind that is unsound: {json.dumps(smallest)}"
    verdict = cases.UNEXPLAINED if unsound else cases.OK
    return {
        "part": "fuzz", "group": "random", "case": f"{len(rows)} {kind} scenes", "how": "outcomes", "verdict": verdict,
        "status": verdict, "measured": float(unsound), "bar": 0.0, "message": message, "run_status": "",
        "wall_s": sum(row["wall_s"] for row in rows), "run_key": f"fuzz-{kind}",
    }  # fmt: skip
