"""The cases of `campaigns.stability` as tasks: found again or computed, in worker processes, and put into table.csv.

A row is kept beside its run under a key of its case and of every source that shapes it. scene.toml is the scene from
which cases start.
"""

import time
from collections import Counter
from functools import partial
from pathlib import Path

from campaigns.machinery import ENGINE, Store, Summary, Task, key_of, made_by, results, stage, trajectory_path
from campaigns.stability.cases import COLUMNS, Case, all_cases, case_row, drift_case
from campaigns.stability.limits import DIED, load_kernels
from engine import load_scene
from engine.atomic import write_atomic
from tables import Row, write_table

SOURCES = ("engine", "campaigns/stability")


def planned(order) -> list[Case]:
    """Every case of the order, the longest first."""
    cases = all_cases()
    if order.options.quick:
        cases = [case for case in cases if case.quick]
    if order.options.drift_periods:
        cases.insert(0, drift_case(order.options.drift_periods))
    return cases


def judge_cases(order) -> Summary:
    """Judge every case that is not judged yet; write the table.

    Raises CampaignStopped where a worker dies: cases have their own processes.
    """
    out, maker = order.how.out.absolute(), made_by(*SOURCES)
    write_atomic(out / "scene.toml", load_scene("tethered_buoy").to_toml().encode())
    store = Store(out / "trajectories", ".row.json")
    tasks = []
    for case in planned(order):
        key = key_of(case, maker)
        tasks.append(Task(key, partial(judged, case, trajectory_path(out, key))))
        row = store.get(key)
        if row is not None and row["run_status"] == DIED:  # for want of memory perhaps: tried again
            store.path(key).unlink()
    start_s = time.perf_counter()
    if any(not store.path(task.key).exists() for task in tasks):
        with stage(ENGINE):
            load_kernels()
    times = Counter(compile_s=time.perf_counter() - start_s)
    start_s = time.perf_counter()
    finished = results(order.how, store, "cases", tasks)
    rows = [row | {"run_key": task.key} for task, row in zip(tasks, finished.results, strict=True)]
    write_table(out / "table.csv", COLUMNS, rows)
    times["run_s"] = time.perf_counter() - start_s
    return Summary(rows, finished.reused, len(tasks) - finished.reused, times)


def judged(case: Case, path: Path) -> Row:
    """The row of a case, in a worker."""
    load_kernels()
    return case_row(case, path)
