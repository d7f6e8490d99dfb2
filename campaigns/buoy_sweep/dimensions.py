"""Three dimensions where a plane is not enough: the second half of a sweep with `--dimensions auto`.

Every value is run in the plane first. Where that run released loops, the same scene is run in three dimensions, and its
row takes the place of the planar one; what the planar run showed stays in the columns planar_. Both runs are kept, so
that a sweep run again decides the same from the files.
"""

from dataclasses import replace

from campaigns.buoy_sweep.seeds import in_space
from campaigns.machinery.plan import Job, Plan, Summary, make_job
from campaigns.machinery.runner import run

_KEPT = ("loop_releases", "regime", "radius_min_m", "radius_max_m")


def run_where_needed(plan: Plan, jobs: list[Job], periods: float) -> tuple[dict, Summary]:
    """Do the planar jobs, then the runs in three dimensions that their rows ask for; table.csv holds one row a value.

    Returns times and summary of both halves together. Raises as `runner.run`.
    """
    timing, summary = run(plan, jobs)
    rows = {row["run_key"]: row for row in summary.rows}
    chosen = [_spatial(job, rows[job.key], periods) if _loops(rows[job.key]) else job for job in jobs]
    if chosen == jobs:
        return timing, summary
    more, final = run(plan, chosen)
    times = {name: timing[name] + more[name] for name in timing}
    # The second half finds what the first has computed: what is new is what both computed.
    computed = summary.computed + final.computed
    found = max(len(final.rows) - computed, 0)
    return times, replace(final, computed=computed, found=found, analysis_s=times["analysis_s"])


def _loops(row: dict) -> bool:
    return bool(row.get("loop_releases"))


def _spatial(job: Job, row: dict, periods: float) -> Job:
    kept = {f"planar_{name}": row.get(name) for name in _KEPT}
    return make_job(in_space(job.scene)[0], periods, labels={**job.labels, **kept, "dimensions": 3})
