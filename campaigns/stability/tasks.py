"""The work of `campaigns.stability` cut into tasks: found again or done, in worker processes, and put into tables.

A task's result is a JSON record, kept beside the runs under a key of what it is and a hash of every source that shapes
it. Files written: table.csv (a row a case, and one for each kind of random scenes), fuzz.csv (a row a random scene),
step_maps.json, scene_shares.json, scene.toml (the scene from which cases start).
"""

import hashlib
import json
import sys
import time
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from campaigns.columns import Column
from campaigns.machinery.folder import (
    CampaignStopped,
    Table,
    keep_row,
    kept_row,
    made_by,
    trajectory_path,
    write_json,
)
from campaigns.machinery.plan import Summary
from campaigns.machinery.pools import PoolBroken, opened
from campaigns.stability import fuzz, random_scenes, run, scene_shares, step_maps
from campaigns.stability.cases import Case, all_cases, regular

SOURCES = ("engine", "campaigns/stability", "campaigns/stability/random_scenes.toml")
CHUNK = {random_scenes.VALID: 20, random_scenes.INVALID: 200}
DRIFT_BAR = 0.01
DRIFT_LIMIT_S = 1800.0


@dataclass(frozen=True)
class Task:
    """One piece of work.

    kind: "case" (what: a Case), "map" (the name of a line), "shares" (whether few rounds do), "drawn" (kind of scenes,
    seed, count), or "random" (the same, first and last number).
    """

    kind: str
    what: object

    def key(self) -> str:
        """Where its result is kept."""
        return hashlib.sha256(repr(self).encode()).hexdigest()


def planned(order) -> list[Task]:
    """Every task that workers do, the longest first."""
    tasks = [Task("case", drift_case(order.drift_periods))] if order.drift_periods else []
    tasks += [Task("case", case) for case in all_cases() if case.quick or not order.quick]
    for kind, size in CHUNK.items():
        for first in range(0, order.fuzz, size):
            tasks.append(Task("random", (kind, order.seed, order.fuzz, first, min(first + size, order.fuzz))))
    return [*tasks, *(Task("map", name) for name in step_maps.LINES)]


def drift_case(periods: int) -> Case:
    """The long regular run, strobed at the wave period."""
    scene, options = {**regular(), "output.step_s": 5.0}, {"limit_s": DRIFT_LIMIT_S}
    return Case("drift", f"{periods} regular waves", scene, 5.0 * periods, "drift", DRIFT_BAR, options=options)


def kept(out: Path, maker: str, task: Task, make: Callable[[], dict]) -> dict:
    """The result of a task as it is kept, or as it is made now and kept."""
    result = kept_row(out, task.key(), maker)
    if result is None:
        result = make()
        keep_row(out, task.key(), maker, result)
    return result


def scenes(out: Path, maker: str, kind: str, seed: int, count: int) -> list[dict]:
    """The random scenes of a kind, drawn once."""
    task = Task("drawn", (kind, seed, count))
    return kept(out, maker, task, lambda: {"scenes": random_scenes.drawn(kind, seed, count)})["scenes"]


def do(out: Path, maker: str, task: Task) -> dict:
    """The result of a task, in a worker."""
    fuzz.load_kernels()
    if task.kind == "case":
        result = run.case_row(task.what, trajectory_path(out, task.key()))
    elif task.kind == "map":
        result = step_maps.of_line(task.what)
    else:
        kind, seed, count, first, last = task.what
        drawn = list(enumerate(scenes(out, maker, kind, seed, count)))[first:last]
        result = {"rows": [{"kind": kind, "number": number, **fuzz.judged(kind, raw)} for number, raw in drawn]}
    if not _crashed(result):  # by the system perhaps, for want of memory: tried again with the next call
        keep_row(out, task.key(), maker, result)
    return result


def _crashed(result: dict) -> bool:
    return any("crash" in (row.get("run_status"), row.get("outcome")) for row in result.get("rows", [result]))


def done(order) -> tuple[dict[str, float], Summary]:
    """Do all that is not there yet; write the tables. Returns the times and the summary for the session."""
    from engine import load_scene
    from engine.atomic import write_atomic

    out, maker = order.how.out, made_by({}, *SOURCES)
    write_atomic(out / "scene.toml", load_scene("tethered_buoy").to_toml().encode())
    tasks, shares = planned(order), Task("shares", order.quick)
    results = {task.key(): kept_row(out, task.key(), maker) for task in tasks}
    missing = [task for task in tasks if results[task.key()] is None]
    start = time.perf_counter()
    if missing or kept_row(out, shares.key(), maker) is None:
        print("compiling the engine, or loading it compiled ...", file=sys.stderr)
        fuzz.load_kernels()
    timing = {"compile_s": time.perf_counter() - start}
    start = time.perf_counter()
    drawn = {kind: scenes(out, maker, kind, order.seed, order.fuzz) for kind in CHUNK if order.fuzz}
    call = partial(do, out.absolute(), maker)
    for task, result in _progress(_all(call, missing, order.how.jobs), len(tasks), len(tasks) - len(missing)):
        results[task.key()] = result
    # alone on the machine, at the end: it takes times
    write_json(out / "scene_shares.json", kept(out, maker, shares, lambda: scene_shares.measured(order.quick)))
    write_json(out / "step_maps.json", {task.what: results[task.key()] for task in tasks if task.kind == "map"})
    rows = [results[task.key()] | {"run_key": task.key()} for task in tasks if task.kind == "case"]
    random = [row for task in tasks if task.kind == "random" for row in results[task.key()]["rows"]]
    rows += [_of_kind(order, kind, drawn[kind], [row for row in random if row["kind"] == kind]) for kind in drawn]
    write_table(out / "fuzz.csv", fuzz.COLUMNS, random)
    write_table(out / "table.csv", run.COLUMNS, rows)
    timing |= {"run_s": time.perf_counter() - start, "analysis_s": 0.0}
    return timing, Summary(rows, len(tasks) - len(missing), len(missing), 0.0)


def _progress(results: Iterator, total: int, found: int) -> Iterator:
    from tqdm import tqdm

    with tqdm(total=total, initial=found, unit="task", desc="tasks", mininterval=1.0, disable=total == found) as bar:
        for result in results:
            bar.update()
            yield result


def _all(call: Callable, tasks: list[Task], jobs: int) -> Iterator[tuple[Task, dict]]:
    """Results of all tasks as they come. Raises CampaignStopped where a worker dies: cases have their own processes."""
    if not tasks:
        return
    try:
        with opened("loky", min(jobs, len(tasks))) as execute:
            yield from execute(call, tasks)
    except PoolBroken as broken:
        raise CampaignStopped(f"a worker process ended: {broken}; finished tasks are kept") from broken


def _of_kind(order, kind: str, drawn: list[dict], rows: list[dict]) -> dict:
    """The row of all random scenes of a kind: outcomes counted, and the smallest unsound scene where there is one."""
    counts = Counter(row["outcome"] for row in rows)
    unsound = sum(many for word, many in counts.items() if word not in fuzz.SOUND)
    message = ", ".join(f"{word} {many}" for word, many in sorted(counts.items()))
    if unsound:
        known = {json.dumps(raw): row["outcome"] for raw, row in zip(drawn, rows, strict=True)}

        def is_unsound(raw: dict) -> bool:
            outcome = known.get(json.dumps(raw)) or fuzz.judged(kind, raw)["outcome"]
            return outcome not in fuzz.SOUND

        found = random_scenes.smallest(kind, order.seed, order.fuzz, is_unsound)
        message += f"; the smallest scene of this kind that is unsound: {json.dumps(found)}"
    verdict = run.UNEXPLAINED if unsound else run.OK
    return {
        "part": "fuzz", "group": "random", "case": f"{len(rows)} {kind} scenes", "how": "outcomes", "verdict": verdict,
        "status": verdict, "measured": float(unsound), "bar": 0.0, "message": message, "run_status": "",
        "wall_s": sum(row["wall_s"] for row in rows), "run_key": f"fuzz-{kind}",
    }  # fmt: skip


def write_table(path: Path, columns: tuple[Column, ...], rows: list[dict]) -> None:
    """Write rows that are all there, and the dictionary of their columns. Raises OSError."""
    keys = [str(number) for number in range(len(rows))]
    table = Table(path, columns, keys)
    table.rows = dict(zip(keys, rows, strict=True))
    table.write()
