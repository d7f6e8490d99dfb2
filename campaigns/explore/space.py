"""Runs in three dimensions: the small push that lets a motion leave its plane, and the runs of a sweep that need it.

Without a push no motion leaves the plane of uni-directional waves: y = 0 stays exactly 0 in three dimensions too. The
paper therefore pushes the buoy across the waves with 1e-5 m/s (section 4.2.2, figure 20).

With `--dimensions auto` a sweep runs every value in the plane first. If a planar run releases loops, the same scene is
run in three dimensions, and the row of this run replaces the row of the planar run. The columns planar_ keep the
results of the planar run. Both runs stay on disk, so that the same command decides in the same way again.
"""

import math
from dataclasses import replace

import engine.scene
from campaigns.judge import UNFOLLOWED
from campaigns.machinery import Jobs, Plan, Summary, run

SEED_MPS = 1e-5  # size of the push
ROUNDING = 1e-15  # of a velocity along the waves: so much of it may seem to be across them
# components of a push along and across the waves; a mirrored push has to give the mirrored motion, and a push along the
# waves no motion across them
DIRECTIONS = {
    "lateral": (0.0, 1.0),
    "mirrored": (0.0, -1.0),
    "oblique": (math.sqrt(0.5), math.sqrt(0.5)),
    "along": (1.0, 0.0),
}
_PLANAR_COLUMNS = ("loop_releases", "regime", "radius_min_m", "radius_max_m")  # kept in the columns planar_


def velocity(seed_mps: float, direction: str) -> list[float]:
    """The velocity (3,) in m/s of a push of the size seed_mps in one of DIRECTIONS, for waves along x."""
    x, y = DIRECTIONS[direction]
    return [seed_mps * x, seed_mps * y, 0.0]


def in_space(scene):
    """The scene in three dimensions, and whether a push had to be added: (scene, added).

    If the buoy starts without a velocity across its waves, it gets the velocity SEED_MPS there. Perturbations are left
    out, because only a planar run can carry them. Raises SceneError if the scene is not allowed in three dimensions.
    """
    heading = scene.waves.heading_rad
    sine, cosine = math.sin(heading), math.cos(heading)
    vx, vy, vz = scene.start.buoy_velocity_mps
    changes = {"motion.dimensions": 3, **UNFOLLOWED}
    across = vy * cosine - vx * sine
    added = abs(across) <= ROUNDING * math.hypot(vx, vy)
    if added:
        changes["start.buoy_velocity_mps"] = [vx - SEED_MPS * sine, vy + SEED_MPS * cosine, vz]
    return engine.scene.scene_from_toml(scene.to_toml(), changes), added


def run_where_needed(plan: Plan, jobs: Jobs) -> Summary:
    """Do the planar jobs, then the runs in three dimensions of the values whose planar run released loops.

    table.csv has one row for each value. Raises the same errors as `runner.run`.
    """
    summary = run(plan, jobs)
    rows = summary.by_key
    jobs_of_rows, in_space_count = [], 0
    for job in jobs:
        row = rows[job.key]
        if row.get("loop_releases"):
            planar = {f"planar_{name}": row.get(name) for name in _PLANAR_COLUMNS}
            labels = {**job.labels, **planar, "dimensions": 3}
            job = replace(job, scene=in_space(job.scene)[0], labels=labels)
            in_space_count += 1
        jobs_of_rows.append(job)
    if not in_space_count:
        return summary
    final = run(plan, jobs_of_rows)
    # The second half finds the planar runs of the first half on disk; only its runs in space are new.
    found = summary.found + in_space_count - final.computed
    computed = summary.computed + final.computed
    return replace(final, computed=computed, found=found, times=summary.times + final.times)
