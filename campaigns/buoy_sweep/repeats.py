"""Runs of a sweep once more: two of them tighter and finer, and the most violent one with its whole line.

Folder `accuracy`, the sweep's own error against run time: the run whose tension peaks lowest (the regular one) and the
one whose tension peaks highest (the violent one) are repeated at a tenth of the tolerance and at twice the elements.
Error in r: rms over the first ten wave periods, and over all that were repeated; error in the verdict: whether the run
still is called what it was. Repeating both costs about as much as nine runs of the sweep, so a sweep of few runs
repeats only as many periods as its share allows, and ten at least; where those are too few there is no verdict.

Folder `close_up`, for the moving picture of the report: profiles of every run would be gigabytes. So the first wave
periods of the violent run are computed once more, with the line kept twenty-four times a period. Where no run goes
slack nothing snaps, and nothing is computed.
"""

import math
from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np

from campaigns.buoy_sweep.rows import STEEPNESS
from campaigns.columns import LOOPS, MESSAGE, NEWTON, PERIODS_RUN, RUN_KEY, STATUS, WALL_S, Column, counted
from campaigns.judge import tighter_scene
from campaigns.machinery.cli import Running
from campaigns.machinery.folder import claimed, run_of
from campaigns.machinery.plan import Job, Plan, Summary
from campaigns.machinery.runner import run_campaign
from engine.scene import scene_from_toml

COLUMNS = (
    Column("role", symbol="role", meaning="which run of the sweep was repeated: the regular or the violent one"),
    Column("label", symbol="run", meaning="the value of the sweep that names the repeated run", digits=3),
    Column("run", symbol="repeated", meaning="how it was repeated: as run, tighter, or on a finer grid"),
    STATUS,
    PERIODS_RUN,
    Column("nodes", "", "nodes", "nodes of the line", 0),
    Column("rtol", "", "rtol", "relative tolerance of the time steps; empty for fixed steps", 4),
    Column("step_s", "s", "step", "length of fixed time steps; empty for steps under control", 4),
    Column("error_early_m", "m", "early error", "rms change of r over the first ten wave periods", 6),
    Column("error_m", "m", "error", "rms change of r over all repeated wave periods", 6),
    Column("verdict", symbol="verdict", meaning="what the repeated motion is called"),
    Column(
        "same_verdict", "", "same", "1 where the repeated motion is called what the run of this length is, else 0", 0
    ),
    WALL_S,
    NEWTON,
    LOOPS,
    RUN_KEY,
    MESSAGE,
)
AS_RUN, TIGHTER, FINER = "as run", "a tenth of the tolerance", "twice the elements"
EARLY = 10  # wave periods
SHARE = 0.25  # of the cost of the sweep that the repeated runs may cost
COST = 8.6  # runs of the sweep that repeating both over their whole length costs: (2.3 + 2.0) each (measured)
# the close-up: columns of its table; wave periods, because the first snaps come after five; profiles a wave period
SHAPES = (STEEPNESS, STATUS, PERIODS_RUN, WALL_S, RUN_KEY, MESSAGE)
PERIODS = 12
FRAMES = 24


def lengths(runs: int, periods: int) -> int:
    """Wave periods to repeat, for a sweep of so many runs of that length."""
    return min(periods, max(EARLY, math.floor(periods * (SHARE * runs / COST))))


def chosen(rows: list[dict]) -> list[tuple[str, dict]]:
    """(role, row) of the regular and the violent run; one where the sweep has but one, none where none ended."""
    good = [row for row in rows if row["status"] == "ok" and row.get("run_key")]
    if not good:
        return []

    def peak(row) -> float:
        return row["tension_top_max_N"] if row.get("tension_top_max_N") is not None else -math.inf

    regular, violent = min(good, key=peak), max(good, key=peak)
    return [("regular", regular)] if regular is violent else [("regular", regular), ("violent", violent)]


def repeat(
    plan: Plan, summary: Summary, periods: int, row_of: Callable, said: str, among: set[str] | None = None
) -> float:
    """Do the repeated runs of a sweep over its share of the wave periods; returns seconds of analysis.

    row_of(trajectory) -> its row; said: the column of what its motion is called. among: keys of the runs to choose
    from, None for all. Raises as `runner.run_campaign`.
    """
    rows = [row for row in summary.rows if among is None or row["run_key"] in among]
    length = lengths(len(summary.rows), periods)
    jobs: list[Job] = []
    for role, row in chosen(rows):
        length = min(length, round(row["periods"]))
        original = first_periods(run_of(plan.how.out, row), length)
        scene = original.scene
        finer = scene_from_toml(scene.to_toml(), {"tether.nodes": 2 * scene.tether.nodes - 1})
        describe = partial(accuracy_row, original=original, row_of=row_of, said=said)
        for run, made in ((AS_RUN, scene), (TIGHTER, tighter_scene(scene)), (FINER, finer)):
            labels = {"role": role, "label": row["steepness"], "run": run, "periods": length}
            # as run: what the sweep itself has made, with which the others are compared
            simulate = (lambda *_, made=original, **__: made) if run == AS_RUN else None
            jobs.append(Job(labels, made, length, None, simulate, describe, made=f"accuracy {run}"))
    how = replace(plan.how, out=plan.how.out / "accuracy")
    with claimed(how.out):
        own = replace(plan, how=how, columns=COLUMNS, said="two runs again, tighter and finer", simulate_each=None)
        return run_campaign(own, jobs).analysis_s


def first_periods(trajectory, length: int):
    """A Trajectory cut to so many wave periods; its counts are scaled, its extremes are those of the whole."""
    scene, columns = trajectory.scene, trajectory.columns
    samples = round(length * scene.waves.period_s / scene.sample_step_s()) + 1
    whole = len(columns["time_s"])
    if samples >= whole:
        return trajectory
    share = samples / whole
    scaled = {"wall_s": share * trajectory.statistics["wall_s"]}
    scaled["newton_iterations"] = round(share * trajectory.statistics["newton_iterations"])
    if (tangent := trajectory.tangent) is not None:
        each_period = {name: values for name, values in vars(tangent).items() if isinstance(values, np.ndarray)}
        tangent = replace(tangent, **{name: values[:length] for name, values in each_period.items()})
        scaled["loop_releases"] = int(tangent.released.sum())
    kept = {name: values[:samples] for name, values in columns.items()}
    return replace(trajectory, columns=kept, statistics=trajectory.statistics | scaled, profiles=None, tangent=tangent)


def accuracy_row(trajectory, original, row_of: Callable, said: str) -> dict[str, object]:
    """The columns of `COLUMNS` that a repeated run fills. original: as much of the run as it was made."""
    scene = trajectory.scene
    row = counted(trajectory, (WALL_S, NEWTON, LOOPS)) | {
        "nodes": scene.tether.nodes,
        "rtol": None if scene.solver.step_s else scene.solver.rtol,
        "step_s": scene.solver.step_s,
    }
    if trajectory.status != "ok":
        return row
    r, r0 = trajectory.columns["radius_m"], original.columns["radius_m"]
    early = round(EARLY * scene.waves.period_s / scene.sample_step_s()) + 1
    row |= {"error_early_m": _rms(r[:early] - r0[:early]), "error_m": _rms(r - r0)} if len(r) == len(r0) else {}
    now, before = (row_of(run).get(said) for run in (trajectory, original))
    if now is not None and before is not None:
        row |= {"verdict": now, "same_verdict": int(now == before)}
    return row


def _rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(values**2)))


def close_up(plan: Plan, summary: Summary, periods: int) -> float:
    """Compute the close-up, unless it is there or no run goes slack; 0 s of analysis. periods: those of the sweep."""
    out, jobs = plan.how.out / "close_up", []
    for _, row in chosen([row for row in summary.rows if (row.get("slack_fraction") or 0.0) > 0.0])[-1:]:
        scene = run_of(plan.how.out, row).scene
        # Perturbations are carried along as in the sweep: leaving them out would need machine code of its own (20 s).
        kept = {"output.profiles": True, "output.profiles_step_s": scene.waves.period_s / FRAMES}
        length = min(periods, PERIODS)
        labels = {"steepness": row["steepness"], "periods": length}
        jobs.append(Job(labels, scene_from_toml(scene.to_toml(), kept), length))
    if jobs or out.exists():
        how, row_of = Running(out, backend="threading"), partial(counted, columns=(WALL_S,))
        own = Plan(how, plan.simulate, row_of, SHAPES, said="the close-up")
        # without a job the table of an earlier sweep in this folder is emptied
        with claimed(out):
            run_campaign(own, jobs)
    return 0.0
