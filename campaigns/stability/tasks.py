"""The work of `campaigns.stability` cut into tasks: found again or done, in worker processes, and put into tables.

A task's result is a JSON record, kept beside the runs under a key of what it is and a hash of every source that shapes
it. Files written: table.csv (a row a case, and one for each kind of random scenes), fuzz.csv (a row a random scene),
step_maps.json, scene_shares.json, scene.toml (the scene from which cases start).
"""

import hashlib
import sys
import time
from collections import Counter
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from campaigns.columns import Column
from campaigns.machinery.folder import Table, trajectory_path, write_json
from campaigns.machinery.pools import PoolBroken, opened
from campaigns.machinery.row_store import keep_row, kept_row, made_by
from campaigns.machinery.runner import Summary
from campaigns.stability.cases import REGULAR, Case, all_cases
from campaigns.stability.run import COLUMNS, UNEXPLAINED, case_row

SOURCES = (
    "engine", "campaigns/stability/cases", "campaigns/stability/checks.py", "campaigns/stability/run.py",
    "campaigns/stability/fuzz", "campaigns/stability/limited.py", "campaigns/stability/step_maps.py",
    "campaigns/stability/scene_shares.py", "campaigns/stability/operation_counts.py",
)  # fmt: skip
FUZZ_COLUMNS = tuple(map(Column, ("kind", "number", "outcome", "status", "message", "wall_s")))
CHUNK = {"valid": 20, "invalid": 200}
DRIFT_BAR = 0.01
DRIFT_LIMIT_S = 1800.0


@dataclass(frozen=True)
class Task:
    """One piece of work. kind: "case", "valid", "invalid", "map" or "shares"; what: a number, a range or a Case."""

    kind: str
    what: object

    def key(self) -> str:
        """Where its result is kept."""
        return hashlib.sha256(repr(self).encode()).hexdigest()


def planned(order) -> list[Task]:
    """Every task, the longest first."""
    from campaigns.stability import step_maps

    tasks = []
    if order.drift_periods:
        tasks.append(Task("case", drift_case(order.drift_periods)))
    cases = [case for case in all_cases() if case.quick or not order.quick]
    tasks += [Task("case", case) for case in cases]
    for kind, size in CHUNK.items():
        ends = range(0, order.fuzz, size)
        tasks += [Task(kind, (order.seed, start, min(start + size, order.fuzz))) for start in ends]
    return [*tasks, *(Task("map", name) for name in step_maps.LINES)]


def drift_case(periods: int) -> Case:
    """The long regular run, strobed at the wave period."""
    scene = {**REGULAR, "output.step_s": 5.0}
    options = {"limit_s": DRIFT_LIMIT_S}
    return Case("drift", f"{periods} regular waves", scene, 5.0 * periods, "drift", DRIFT_BAR, options=options)


def do(out: Path, maker: str, task: Task) -> tuple[Task, dict]:
    """(task, its result) in a worker."""
    from campaigns.stability import fuzz, step_maps

    fuzz.load_kernels()
    if task.kind == "case":
        result = case_row(task.what, trajectory_path(out, task.key()))
    elif task.kind == "map":
        result = step_maps.of_line(task.what)
    else:
        judge = fuzz.judge_valid if task.kind == "valid" else fuzz.judge_invalid
        seed, start, stop = task.what
        result = {"rows": [judge(seed, number) for number in range(start, stop)]}
    if not _crashed(result):  # by the system perhaps, for want of memory: tried again with the next call
        keep_row(out, task.key(), maker, result)
    return task, result


def _crashed(result: dict) -> bool:
    rows = result.get("rows", [result])
    return any("crash" in (row.get("run_status"), row.get("outcome")) for row in rows)


def run(order) -> tuple[dict[str, float], Summary]:
    """Do all that is not there yet; write the tables. Returns the times and the summary for the session."""
    from campaigns.stability import fuzz, scene_shares
    from engine import load_scene
    from engine.atomic import write_atomic

    out, maker = order.how.out, made_by({}, *SOURCES)
    write_atomic(out / "scene.toml", load_scene("tethered_buoy").to_toml().encode())
    tasks = planned(order)
    missing = [task for task in tasks if kept_row(out, task.key(), maker) is None]
    shares = Task("shares", order.quick)
    start = time.perf_counter()
    if missing or kept_row(out, shares.key(), maker) is None:
        print("compiling the engine, or loading it compiled ...", file=sys.stderr)
        fuzz.load_kernels()
    timing = {"compile_s": time.perf_counter() - start}
    start = time.perf_counter()
    undone = {task.key() for task in missing}
    results = {key: kept_row(out, key, maker) for key in (task.key() for task in tasks) if key not in undone}
    call = partial(do, out.absolute(), maker)
    for task, result in _progress(_all(call, missing, order.how.jobs), len(tasks), len(results)):
        results[task.key()] = result
    # alone on the machine, at the end: it takes times
    if (cost := kept_row(out, shares.key(), maker)) is None:
        cost = scene_shares.measured(order.quick)
        keep_row(out, shares.key(), maker, cost)
    timing |= {"run_s": time.perf_counter() - start, "analysis_s": 0.0}
    write_json(out / "scene_shares.json", cost)
    write_json(out / "step_maps.json", {task.what: results[task.key()] for task in tasks if task.kind == "map"})
    rows = _table(out, tasks, results)
    return timing, Summary(rows, len(tasks) - len(missing), len(missing), 0.0)


def _progress(results, total: int, found: int):
    from tqdm import tqdm

    with tqdm(total=total, initial=found, unit="task", desc="tasks", mininterval=1.0, disable=total == found) as bar:
        for result in results:
            bar.update()
            yield result


def _all(call, tasks: list[Task], jobs: int):
    """Results of all tasks as they come; a task whose worker dies is judged so."""
    pending = {task.key(): task for task in tasks}
    if not tasks:
        return
    with opened("loky", min(jobs, len(tasks))) as execute:
        while pending:
            try:
                for task, result in execute(call, list(pending.values())):
                    del pending[task.key()]
                    yield task, result
            except PoolBroken as broken:
                for task in broken.suspects:
                    del pending[task.key()]
                    yield task, _died(task, broken)


def _died(task: Task, broken: PoolBroken) -> dict:
    said = f"its worker process ended: {broken}"
    if task.kind == "case":
        case = task.what
        return {
            "part": "case", "group": case.group, "case": case.name, "verdict": UNEXPLAINED, "run_status": "crash",
            "status": UNEXPLAINED, "message": said,
        }  # fmt: skip
    if task.kind == "map":
        return {"fault": said}
    _, start, stop = task.what
    return {
        "rows": [
            {"number": n, "outcome": "crash", "status": "", "message": said, "wall_s": 0.0} for n in range(start, stop)
        ]
    }


def _table(out: Path, tasks: list[Task], results: dict) -> list[dict]:
    from campaigns.stability import fuzz

    rows = [results[task.key()] | {"run_key": task.key()} for task in tasks if task.kind == "case"]
    random = []
    for kind in CHUNK:
        found = [row for task in tasks if task.kind == kind for row in results[task.key()]["rows"]]
        random += [{"kind": kind, **row} for row in found]
        if found:
            counts = Counter(row["outcome"] for row in found)
            unsound = [row for row in found if row["outcome"] not in fuzz.SOUND]
            said = ", ".join(f"{word} {count}" for word, count in sorted(counts.items()))
            rows.append({
                "part": "fuzz", "group": "random", "case": f"{len(found)} {kind} scenes", "how": "outcomes",
                "verdict": UNEXPLAINED if unsound else "ok", "status": UNEXPLAINED if unsound else "ok",
                "measured": float(len(unsound)), "bar": 0.0, "message": said, "run_status": "",
                "wall_s": sum(row["wall_s"] for row in found), "run_key": f"fuzz-{kind}",
            })  # fmt: skip
    _write(out / "fuzz.csv", FUZZ_COLUMNS, random)
    _write(out / "table.csv", COLUMNS, rows)
    return rows


def _write(path: Path, columns: tuple[Column, ...], rows: list[dict]) -> None:
    keys = [str(number) for number in range(len(rows))]
    table = Table(path, columns, keys)
    table.rows = dict(zip(keys, rows, strict=True))
    table.write()
