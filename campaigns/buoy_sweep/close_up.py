"""The most violent run of a sweep again with the whole tether kept, for the moving picture of its report.

Samples of the buoy do not show the tether; profiles of every run would be gigabytes. So the first wave periods of the
run whose tension peaks highest are computed once more, with the line kept twenty-four times a period, in the folder
`close_up` of its own: a hundredth of a sweep. Where no run goes slack nothing snaps, and nothing is computed.
"""

from campaigns.buoy_sweep.repeats import chosen
from campaigns.buoy_sweep.rows import STEEPNESS
from campaigns.columns import MESSAGE, PERIODS_RUN, RUN_KEY, STATUS, WALL_S
from campaigns.machinery.folder import claimed, trajectory_path
from campaigns.machinery.plan import Job, Plan, Summary, make_job
from campaigns.machinery.runner import run_campaign

FOLDER = "close_up"  # within that of the sweep: a table of its own, and a trajectory
COLUMNS = (STEEPNESS, STATUS, PERIODS_RUN, WALL_S, RUN_KEY, MESSAGE)
PERIODS = 12  # the first snaps come after five
FRAMES = 24  # of the line, a wave period


def close_up(plan: Plan, summary: Summary, periods: int) -> float:
    """Compute the run, unless it is there or no run goes slack; 0 s of analysis. periods: those of the sweep."""
    picked = chosen([row for row in summary.rows if (row.get("slack_fraction") or 0.0) > 0.0])
    place = plan.directory / FOLDER
    if picked or place.exists():
        own = Plan(place, plan.simulate, close_up_row, COLUMNS, "threading", 1, show_progress=False)
        # without a job the table of an earlier sweep in this folder is emptied
        with claimed(place):
            run_campaign(own, [_job(plan, row, min(periods, PERIODS)) for _, row in picked[-1:]])
    return 0.0


def _job(plan: Plan, row: dict, periods: int) -> Job:
    from engine import Trajectory
    from engine.scene import scene_from_toml

    scene = Trajectory.load(trajectory_path(plan.directory, row["run_key"])).scene
    # Perturbations are carried along as in the sweep: leaving them out would need machine code of its own (20 s).
    kept = {"output.profiles": True, "output.profiles_step_s": scene.waves.period_s / FRAMES}
    scene = scene_from_toml(scene.to_toml(), kept)
    return make_job(scene, periods, labels={"steepness": row["steepness"], "periods": periods})


def close_up_row(trajectory) -> dict[str, object]:
    """The columns of `COLUMNS` that the run fills."""
    return {
        "status": trajectory.status,
        "message": trajectory.message,
        "wall_s": trajectory.statistics.get("wall_s"),
    }
