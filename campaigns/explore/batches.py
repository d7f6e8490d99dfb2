"""Runs beside those of a sweep, batch by batch, each in a folder of its own with a table; none of them is judged.

`between`: columns of the orbit diagram between the judged values, side by side in the lanes.
`companions`: at every value whose sphere leaves the water, a sphere that loses its buoyancy there.
`close_up`, for the moving picture of the report: the first wave periods of the violent run with its line, since
profiles of every run would be gigabytes. Where no run goes slack nothing snaps, and nothing is computed.
"""

from collections.abc import Callable
from functools import partial
from itertools import pairwise

import numpy as np

from campaigns.answers import greatest
from campaigns.explore.judgement import Judgement
from campaigns.explore.load import is_overbuoyant
from campaigns.explore.motions import MOTION, from_rest
from campaigns.explore.rows import EXTREMES, HEIGHT, REGIME, SLACK, STEEPNESS, STROBED, TRANSIENT, buoy_row
from campaigns.explore.starts import run_within
from campaigns.judge import UNFOLLOWED, job_from
from campaigns.machinery import Job, Jobs, Plan, Summary, run_of, shares_worker, spare_groups
from engine.scene import scene_from_toml
from tables import (
    CAPPED,
    LOOPS,
    MESSAGE,
    NODES,
    PEAK,
    PERIODS_RUN,
    RUN_KEY,
    STATUS,
    WALL_S,
    Columns,
    Row,
    Rows,
    counted,
    names,
    number_of,
    of_words,
)

ROLE = of_words("role", "what was changed in the run of table.csv")
OF_A_RUN = (STATUS, PERIODS_RUN, TRANSIENT, *EXTREMES, LOOPS, HEIGHT, WALL_S, RUN_KEY, MESSAGE)
BETWEEN = (STEEPNESS, REGIME, STROBED, *OF_A_RUN)
COMPANIONS = (ROLE, STEEPNESS, MOTION, NODES, *OF_A_RUN)
CLOSE_UP = (STEEPNESS, MOTION, STATUS, PERIODS_RUN, WALL_S, RUN_KEY, MESSAGE)
LEAST_COLUMNS, LEAST_VALUES = 200, 9  # of the orbit diagram; judged values from which on there is something between
BETWEEN_PERIODS, COMPANION_PERIODS = 42, 60  # of each the later third, or half, is measured
PERIODS, FRAMES = 12, 24  # of the close-up: wave periods, because the first snaps come after five; profiles in each


def batch(plan: Plan, folder: str, title: str, columns: Columns, row: Callable, jobs: Jobs, **changes) -> float:
    """Do the jobs in a folder below that of a campaign, with a table of these columns, of row(trajectory).

    Without a job the table of an earlier batch in this folder is emptied. title: of the progress. changes: further ones
    of the plan. Returns seconds of analysis. Raises as `runner.run`.
    """
    out = plan.out / folder
    if not jobs and not out.exists():
        return 0.0
    summary = run_within(plan, out, jobs, columns=columns, title=title, describe=row, judge=None, **changes)
    return summary.times["analysis_s"]


def unfollowed(scene, changes: dict):
    """The scene without perturbations, and with these keys changed."""
    return scene_from_toml(scene.to_toml(), UNFOLLOWED | changes)


def unjudged(trajectory, transient_periods: int, columns: Columns) -> Row:
    """What a run fills of these columns without a verdict."""
    row = buoy_row(trajectory, Judgement(transient_periods)) | {"nodes": trajectory.scene.tether.nodes}
    return {name: row[name] for name in names(columns) if name in row}


ROW_BETWEEN = partial(unjudged, transient_periods=2 * BETWEEN_PERIODS // 3, columns=BETWEEN)


def between(plan: Plan, summary: Summary, key: str, cases: Jobs) -> float:
    """Enough runs between those of a sweep over `key` for LEAST_COLUMNS in all, where they can go side by side."""
    plan.spare.clear()  # what is left of `between_ahead` is done here
    return batch(plan, "between", "values between", BETWEEN, ROW_BETWEEN, jobs_between(plan, key, cases))


def between_ahead(plan: Plan, key: str, cases: Jobs) -> None:
    """Let workers that would wait do the runs of `between`, which depend on nothing that the sweep finds."""
    jobs, settings = jobs_between(plan, key, cases), {"columns": BETWEEN, "describe": ROW_BETWEEN, "judge": None}
    plan.spare.extend(spare_groups(plan, plan.out / "between", jobs, **settings))


def jobs_between(plan: Plan, key: str, cases: Jobs) -> list[Job]:
    """The runs of `between`; none where they cannot go side by side."""
    scenes = {job.labels["steepness"]: job.scene for job in cases}
    values, jobs = sorted(scenes), []
    ends = np.linspace(0, max(LEAST_COLUMNS - len(values), 0), len(values)).round().astype(int)  # of those in the gaps
    for (low, high), count in zip(pairwise(values), np.diff(ends), strict=True):
        for number in range(1, count + 1):
            value = float(f"{low + (high - low) * number / (count + 1):.12g}")
            scene = unfollowed(scenes[values[0]], {key: value})
            jobs.append(Job({"steepness": value}, scene, BETWEEN_PERIODS))
    if not all(shares_worker(plan, job) for job in jobs):
        return []
    return jobs


def companions(plan: Plan, summary: Summary, key: str, periods: int) -> float:
    """Every value whose sphere flies, with the wetted cap, where these can go side by side; else that of the peak."""
    jobs = jobs_of_companions(plan, summary.rows, key, periods)
    return batch(plan, "companions", "runs with the wetted cap", COMPANIONS, row_of_companion(periods), jobs)


def companions_ahead(plan: Plan, rows: Rows, key: str, periods: int) -> None:
    """Let workers that would wait do the runs of `companions`, as soon as the rows are known."""
    jobs = jobs_of_companions(plan, rows, key, periods)
    settings = {"columns": COMPANIONS, "describe": row_of_companion(periods), "judge": None}
    plan.spare.extend(spare_groups(plan, plan.out / "companions", jobs, **settings))


def row_of_companion(periods: int) -> Callable:
    """The row of a trajectory; periods: those of the sweep."""
    return partial(unjudged, transient_periods=min(periods, COMPANION_PERIODS) // 2, columns=COMPANIONS)


def jobs_of_companions(plan: Plan, rows: Rows, key: str, periods: int) -> list[Job]:
    """The runs of `companions`."""
    length, jobs, largest = min(periods, COMPANION_PERIODS), [], []
    peak = of_largest_tension(rows)
    scene = peak and run_of(plan.out, peak).scene
    if scene is not None:
        for row in rows:
            if not is_overbuoyant(row, scene):
                continue
            labels = {"role": CAPPED, "steepness": row["steepness"], "motion": row.get("motion")}
            capped = unfollowed(scene, {key: row["steepness"], "buoy.submergence": "spherical-cap"})
            jobs.append(job_from(labels, capped, length, start_of(plan, row)))
            if row is peak:
                largest = jobs[-1:]
        if not all(shares_worker(plan, job) for job in jobs):
            jobs = largest
    return jobs


def start_of(plan: Plan, row: dict):
    """The state in which a run begins that repeats that of a row: the last of a motion that is not found from rest."""
    if from_rest(row):
        return None
    return run_of(plan.out, row).final_state.at_zero()


def of_largest_tension(rows: Rows) -> dict | None:
    """The row of the largest tension; None where no run ended as asked."""
    good = [row for row in rows if row["status"] == "ok" and row.get("run_key")]
    return greatest(good, PEAK) or next(iter(good), None)


def close_up(plan: Plan, summary: Summary, periods: int) -> float:
    """Compute the close-up, unless it is there or no run goes slack. periods: those of the sweep."""
    jobs, length = [], min(periods, PERIODS)
    row = of_largest_tension([row for row in summary.rows if number_of(row, SLACK.name) > 0.0])
    if row is not None:
        scene, start = run_of(plan.out, row).scene, start_of(plan, row)
        profiles = {"output.profiles": True, "output.profiles_step_s": scene.waves.period_s / FRAMES}
        labels = {"steepness": row["steepness"], "motion": row.get("motion"), "periods": length}
        jobs.append(job_from(labels, unfollowed(scene, profiles), length, start))
    row = partial(counted, columns=(WALL_S,))
    # its time is that of a run alone
    return batch(plan, "close_up", "the close-up", CLOSE_UP, row, jobs, simulate_each=None)
