"""Three dimensions: the small push that lets a motion leave its plane, and the runs of a sweep that need it.

Without a push nothing in the equations leaves the plane of uni-directional waves: y = 0 stays exactly 0 in three
dimensions too. The paper pushes the buoy by 1e-5 m/s across the waves (section 4.2.2, figure 20).

With `--dimensions auto` every value is run in the plane first. Where that run released loops, the same scene is run in
three dimensions, and its row takes the place of the planar one; what the planar run showed stays in the columns
planar_. Both runs are kept, so that a sweep run again decides the same from the files.
"""

import math
from dataclasses import replace

import engine.scene
from campaigns.machinery.plan import Job, Plan, Summary
from campaigns.machinery.runner import run

SEED_MPS = 1e-5
# name: components along and across the waves; a mirrored push has to give the mirrored motion, one along the waves none
DIRECTIONS = {
    "lateral": (0.0, 1.0),
    "mirrored": (0.0, -1.0),
    "oblique": (math.sqrt(0.5), math.sqrt(0.5)),
    "along": (1.0, 0.0),
}
_PLANAR = ("loop_releases", "regime", "radius_min_m", "radius_max_m")  # of the planar row, in the columns planar_


def velocity(seed_mps: float, direction: str) -> list[float]:
    """The velocity (3,) in m/s of a push of that size and direction, for waves along x."""
    x, y = DIRECTIONS[direction]
    return [seed_mps * x, seed_mps * y, 0.0]


def in_space(scene):
    """The scene in three dimensions, and whether a push had to be added: (scene, added).

    A scene whose buoy starts without a velocity across its waves gets SEED_MPS there. Perturbations that only a planar
    run can carry are left out. Raises SceneError for what three dimensions do not allow.
    """
    heading = scene.waves.direction_rad
    sine, cosine = math.sin(heading), math.cos(heading)
    vx, vy, vz = scene.start.buoy_velocity_mps
    changes = {"motion.dimensions": 3, "output.tangent_vectors": 0, "output.lateral_growth": False}
    added = math.isclose(-vx * sine + vy * cosine, 0.0, abs_tol=1e-300)
    if added:
        changes["start.buoy_velocity_mps"] = [vx - SEED_MPS * sine, vy + SEED_MPS * cosine, vz]
    return engine.scene.scene_from_toml(scene.to_toml(), changes), added


def run_where_needed(plan: Plan, jobs: list[Job]) -> tuple[dict, Summary]:
    """Do the planar jobs, then the runs in three dimensions that their rows ask for; table.csv holds one row a value.

    Returns times and summary of both halves together. Raises as `runner.run`.
    """
    timing, summary = run(plan, jobs)
    rows = summary.by_key
    chosen, spatial = [], 0
    for job in jobs:
        row = rows[job.key]
        if row.get("loop_releases"):
            labels = {**job.labels, **{f"planar_{name}": row.get(name) for name in _PLANAR}, "dimensions": 3}
            job = replace(job, scene=in_space(job.scene)[0], labels=labels)
            spatial += 1
        chosen.append(job)
    if not spatial:
        return timing, summary
    timing_in_space, final = run(plan, chosen)
    times = {name: timing[name] + timing_in_space[name] for name in timing}
    # The second half finds what the first has done; what is new in it are the runs in space.
    found = summary.found + spatial - final.computed
    computed = summary.computed + final.computed
    return times, replace(final, computed=computed, found=found, analysis_s=times["analysis_s"])
