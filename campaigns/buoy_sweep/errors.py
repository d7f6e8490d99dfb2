"""How far the largest tension of a row holds, from companions of the same motion: `tension_top_max_error_N`.

    E^2 = (2 |dT(rtol/10)| + 2 |dT(2n - 1 nodes)| + T_ringing)^2 + s^2

dT: change of the mean of the block maxima of the tension (`batches.measured`) in as many wave periods of the motion; 2,
because the halved grid leaves a third of what it changes, and the tighter steps a part that is not known. T_ringing:
`unresolved_ringing_N`. s: standard deviation of the block maxima of the row itself, because the largest tension of a
chaotic record is one draw; 0 of a motion that repeats.

Only in a plane, where companions can go side by side; other rows stay empty. E holds for the motion of the row: where a
finer grid ends in another motion, it is large, and says so.
"""

import math

from campaigns.buoy_sweep.answer import AS_RUN
from campaigns.buoy_sweep.batches import (
    BLOCK,
    COMPANION_PERIODS,
    FINER,
    ROLE,
    TIGHTER,
    UNFOLLOWED,
    Batch,
    changed,
    finer,
    maxima_of_blocks,
    start_of,
)
from campaigns.buoy_sweep.rows import ERROR, STEEPNESS
from campaigns.columns import MESSAGE, PERIODS_RUN, RINGING, RUN_KEY, STATUS, WALL_S, Column, counted
from campaigns.judge import job_from, tighter_scene
from campaigns.machinery.folder import read_rows, run_of, write_table
from campaigns.machinery.plan import Plan, Summary
from campaigns.machinery.runner import groups_of
from campaigns.motions.along import MOTION
from engine import goes_in_lanes

FOR = Column("of_run", symbol="of", meaning="content key of the run of table.csv whose companion this is")
MEAN = Column("tension_block_max_N", "N", "T_b", f"mean of the largest tensions of every {BLOCK} wave periods", 0)
COLUMNS = (ROLE, STEEPNESS, MOTION, FOR, STATUS, PERIODS_RUN, MEAN, WALL_S, RUN_KEY, MESSAGE)


def errors(plan: Plan, summary: Summary) -> float:
    """Do the companions of every row, and fill its column of table.csv; returns seconds of analysis."""
    jobs, spread = [], {}
    for row in summary.rows:
        if row["status"] != "ok" or row.get("transient_periods") is None or (run := run_of(plan.how.out, row)) is None:
            continue
        scene, start = changed(run.scene, UNFOLLOWED), start_of(plan, row)
        largest = maxima_of_blocks(scene, run.columns, row["transient_periods"])
        spread[row["run_key"]] = float(largest.std(ddof=1)) if len(largest) > 1 else math.inf
        labels = {"steepness": row["steepness"], "motion": row.get("motion"), "of_run": row["run_key"]}
        for role, one in ((AS_RUN, scene), (TIGHTER, tighter_scene(scene)), (FINER, changed(scene, finer(scene)))):
            jobs.append(job_from({"role": role, **labels}, one, COMPANION_PERIODS, start))
    jobs = [job for job in jobs if goes_in_lanes(job.scene)] if groups_of(plan, jobs) else []
    analysis_s = Batch("errors", "errors of the largest tensions", COLUMNS, companion_row, jobs, True).do(plan)
    if not jobs:
        return analysis_s
    means: dict[str, dict[str, float]] = {}
    for companion in read_rows(plan.how.out / "errors" / "table.csv"):
        means.setdefault(companion["of_run"], {})[companion["role"]] = companion[MEAN.name]
    for row in summary.rows:
        if (of := means.get(row.get("run_key"))) is not None:
            error = error_N(of, row.get(RINGING.name) or 0.0, spread[row["run_key"]])
            row[ERROR.name] = error if math.isfinite(error) else None
    write_table(plan.how.out / "table.csv", plan.columns, summary.rows)
    return analysis_s


def companion_row(trajectory) -> dict[str, object]:
    """The columns of COLUMNS that a companion fills."""
    scene = trajectory.scene
    length_s = (len(trajectory.columns["time_s"]) - 1) * scene.sample_step_s()
    row = counted(trajectory, (WALL_S,)) | {"periods": length_s / scene.waves.period_s}
    if trajectory.status == "ok":
        row[MEAN.name] = float(maxima_of_blocks(scene, trajectory.columns, COMPANION_PERIODS // 3).mean())
    return row


def error_N(means: dict[str, float], ringing_N: float, spread_N: float) -> float:
    """E of the head of this file (N); nan where a companion did not end. means: role -> T_b (N)."""
    usual, tighter, fine = (means.get(role, math.nan) for role in (AS_RUN, TIGHTER, FINER))
    return math.hypot(2.0 * (abs(tighter - usual) + abs(fine - usual)) + ringing_N, spread_N)
