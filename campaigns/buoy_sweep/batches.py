"""Runs beside those of a sweep, batch by batch, each in a folder of its own with a table; none of them is judged.

`between`: columns of the orbit diagram between the judged values, side by side in the lanes.
`companions`: what the largest tension becomes with twice the elements, and, at every value whose sphere leaves the
water, with a sphere that loses its buoyancy there. `as run` is the same run over the same periods.
`accuracy`, the sweep's own error against run time: the run whose tension peaks lowest (the regular one, of those that
need no more periods than are repeated) and the one whose tension peaks highest (the violent one) again as they are, at
a tenth of the tolerance and with twice the elements, each alone on its core, for as many periods as a verdict needs.
Each is compared with its original in all that table.csv reports, and in the distribution of its largest tensions: of a
chaotic motion two histories differ by the size of the motion, and a largest value is one draw.
`close_up`, for the moving picture of the report: the first wave periods of the violent run with its line, since
profiles of every run would be gigabytes. Where no run goes slack nothing snaps, and nothing is computed.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from itertools import pairwise

import numpy as np

from analysis.looks import next_look
from campaigns.buoy_sweep.answer import AS_RUN, CAPPED
from campaigns.buoy_sweep.rows import (
    EXTREMES,
    HEIGHT,
    REGIME,
    STEEPNESS,
    STROBED,
    TANGENT,
    TRANSIENT,
    buoy_row,
    exponents,
    settled,
)
from campaigns.columns import LOOPS, MESSAGE, NEWTON, PERIODS_RUN, RUN_KEY, STATUS, WALL_S, Column, counted, names
from campaigns.judge import LATERAL, OPEN, TANGENTS, job_from, tangent_of, tighter_scene
from campaigns.machinery.folder import claimed, run_of, trajectory_path
from campaigns.machinery.plan import Job, Plan, Summary
from campaigns.machinery.runner import groups_of, run
from campaigns.motions.along import MOTION, from_rest
from engine.atomic import write_atomic
from engine.scene import scene_from_toml
from engine.views import carried

ROLE = Column("role", symbol="role", meaning="which run of the sweep was repeated, or how")
NODES = Column("nodes", "", "nodes", "nodes of the line", 0)
OF_A_RUN = (STATUS, PERIODS_RUN, TRANSIENT, *EXTREMES, LOOPS, HEIGHT, WALL_S, RUN_KEY, MESSAGE)
BETWEEN = (STEEPNESS, REGIME, STROBED, *OF_A_RUN)
COMPANIONS = (ROLE, STEEPNESS, MOTION, NODES, *OF_A_RUN)
CLOSE_UP = (STEEPNESS, MOTION, STATUS, PERIODS_RUN, WALL_S, RUN_KEY, MESSAGE)
BLOCK, LEFT_OUT = 5, 1 / 3  # wave periods, of whose largest tensions the mean is compared; share of a repeated run
AGAIN = (  # what a repeated run is asked beside its history, in what follows the share that is left out
    *(column for column in EXTREMES if "compression" not in column.name and column.name != "tension_top_max_N"),
    Column("tension_block_max_N", "N", "T_b", f"mean of the largest tensions of every {BLOCK} wave periods", 0),
    TANGENT[0],
)
ERRORS = (
    Column("tension_block_max_error_N", "N", "± T_b", "standard error of the mean of the largest tensions", 0),
    TANGENT[1],
)
ACCURACY = (
    ROLE,
    Column("label", symbol="run", meaning="the value of the sweep that names the repeated run", digits=3),
    Column("run", symbol="repeated", meaning="how it was repeated: as run, tighter, or on a finer grid"),
    STATUS,
    PERIODS_RUN,
    NODES,
    Column("rtol", "", "rtol", "relative tolerance of the time steps; empty for fixed steps", 4),
    Column("step_s", "s", "step", "length of fixed time steps; empty for steps under control", 4),
    Column("error_early_m", "m", "early error", "rms change of r over the first ten wave periods", 6),
    Column("error_m", "m", "error", "rms change of r over all repeated wave periods", 6),
    Column("tension_top_max_N", "N", "T_max", "largest tension at the top over all repeated wave periods", 0),
    Column("error_tension_early_N", "N", "early ΔT_max", "change of the largest tension of the first ten periods", 1),
    Column("error_tension_N", "N", "ΔT_max", "change of the largest tension of all repeated wave periods", 1),
    *AGAIN,
    *ERRORS,
    *(
        Column(f"error_{one.name}", one.unit, f"Δ{one.symbol}", f"change of: {one.meaning}", one.digits + 2)
        for one in AGAIN
    ),
    Column("verdict", symbol="verdict", meaning="what the repeated motion is called; empty where that is not decided"),
    Column("same_verdict", "", "same", "1 where the repeated motion is called what that of the sweep is, else 0", 0),
    WALL_S,
    NEWTON,
    LOOPS,
    RUN_KEY,
    MESSAGE,
)
TIGHTER, FINER = "a tenth of the tolerance", "twice the elements"
UNFOLLOWED = {TANGENTS: 0, LATERAL: False}  # without perturbations
LEAST_COLUMNS, LEAST_VALUES = 200, 9  # of the orbit diagram; judged values from which on there is something between
BETWEEN_PERIODS, COMPANION_PERIODS = 42, 60  # of each the later third, or half, is measured
EARLY = 10  # wave periods
PERIODS, FRAMES = 12, 24  # of the close-up: wave periods, because the first snaps come after five; profiles in each


@dataclass(frozen=True)
class Batch:
    """Jobs in a folder below that of a campaign, with a table of these columns, of row(trajectory).

    together: whether runs may share a worker, where times are not those of a run alone; said: what they are called.
    """

    folder: str
    said: str
    columns: tuple[Column, ...]
    row: Callable
    jobs: list[Job]
    together: bool = False

    def do(self, plan: Plan) -> float:
        """Do what is not there yet; returns seconds of analysis. A run of another of these folders is taken from there.

        Without a job the table of an earlier batch in this folder is emptied. Raises as `runner.run`.
        """
        out = plan.how.out / self.folder
        if not self.jobs and not out.exists():
            return 0.0
        each = plan.simulate_each if self.together else None
        own = replace(plan, how=replace(plan.how, out=out), columns=self.columns, said=self.said)
        own = replace(own, describe=partial(unchecked, row=self.row))
        with claimed(out):
            for path in (trajectory_path(out, job.key) for job in self.jobs):
                for other in () if path.exists() else plan.how.out.glob(f"*/trajectories/{path.name}"):
                    write_atomic(path, other.read_bytes())
            return run(replace(own, simulate_each=each), self.jobs)[1].analysis_s


def unchecked(trajectory, row: Callable, checks=None) -> dict[str, object]:
    """row(trajectory); checks: what a run gets that begins in the state of another one, and none of these has."""
    return row(trajectory)


def changed(scene, *changes: dict):
    """The scene with these keys changed."""
    return scene_from_toml(scene.to_toml(), {key: value for one in changes for key, value in one.items()})


def finer(scene) -> dict[str, int]:
    """The key that gives the line of a scene twice the elements."""
    return {"tether.nodes": 2 * scene.tether.nodes - 1}


def unjudged(trajectory, transient_periods: int, columns: tuple[Column, ...]) -> dict[str, object]:
    """What a run fills of these columns without a verdict."""
    row = buoy_row(trajectory, transient_periods) | {"nodes": trajectory.scene.tether.nodes}
    return {name: row[name] for name in names(columns) if name in row}


def between(plan: Plan, summary: Summary, key: str, cases: list[Job]) -> float:
    """Enough runs between those of a sweep over `key` for LEAST_COLUMNS in all, where they can go side by side."""
    scenes = {job.labels["steepness"]: job.scene for job in cases}
    values = sorted(scenes)
    ends = np.linspace(0, max(LEAST_COLUMNS - len(values), 0), len(values)).round().astype(int)  # of those in the gaps
    gaps = zip(pairwise(values), np.diff(ends), strict=True)
    fine = [float(f"{a + (b - a) * i / (more + 1):.12g}") for (a, b), more in gaps for i in range(1, more + 1)]
    jobs = [Job({"steepness": kA}, changed(scenes[values[0]], UNFOLLOWED, {key: kA}), BETWEEN_PERIODS) for kA in fine]
    row = partial(unjudged, transient_periods=2 * BETWEEN_PERIODS // 3, columns=BETWEEN)
    return Batch("between", "values between", BETWEEN, row, jobs if groups_of(plan, jobs) else [], True).do(plan)


def companions(plan: Plan, summary: Summary, key: str, periods: int) -> float:
    """The largest tension again, and values whose sphere flies: all where they can go side by side, else that one."""
    length, jobs = min(periods, COMPANION_PERIODS), []
    if good := chosen(summary.rows):
        peak = good[-1][1]
        scene = changed(run_of(plan.how.out, peak).scene, UNFOLLOWED)

        def job(role: str, row: dict, *changes: dict) -> Job:
            labels = {"role": role, "steepness": row["steepness"], "motion": row.get("motion")}
            return job_from(labels, changed(scene, {key: row["steepness"]}, *changes), length, start_of(plan, row))

        if scene.buoy.submergence == "full":
            high = [row for row in summary.rows if (row.get(HEIGHT.name) or 0.0) > scene.buoy.diameter_m]
            cap = {"buoy.submergence": "spherical-cap"}
            jobs = [job(CAPPED, row, cap) for row in high]
            jobs = jobs if groups_of(plan, jobs) else [job(CAPPED, peak, cap)] if peak in high else []
        nodes = finer(scene)
        jobs += [job(AS_RUN, peak), job(f"{nodes['tether.nodes']} nodes", peak, nodes)]
    row = partial(unjudged, transient_periods=length // 2, columns=COMPANIONS)
    return Batch("companions", "companions of the largest tension", COMPANIONS, row, jobs, True).do(plan)


def start_of(plan: Plan, row: dict):
    """The state in which a run begins that repeats that of a row: the last of a motion that is not found from rest."""
    return None if from_rest(row) else run_of(plan.how.out, row).final_state.at_zero()


def chosen(rows: list[dict], length: float = math.inf) -> list[tuple[str, dict]]:
    """(role, row) of the regular and the violent run; one where the sweep has but one, none where none ended.

    length: the regular one is taken from the runs of as many wave periods at most, where there are any.
    """
    good = [row for row in rows if row["status"] == "ok" and row.get("run_key")]
    if not good:
        return []

    def peak(row) -> float:
        return row["tension_top_max_N"] if row.get("tension_top_max_N") is not None else -math.inf

    short = [row for row in good if (row.get("periods") or 0.0) <= length]
    regular, violent = min(short or good, key=peak), max(good, key=peak)
    return [("regular", regular)] if regular is violent else [("regular", regular), ("violent", violent)]


def repeat(
    plan: Plan, summary: Summary, carrying: bool, row_of: Callable, said: str, among: set[str] | None = None
) -> float:
    """Do the repeated runs of a sweep; returns seconds of analysis.

    carrying: whether they carry perturbations, as a sweep of one length does; else the violent run, whose verdict needs
    some, goes only as far as its companions, and carries one where the sweep has found its exponent.
    row_of(trajectory) -> its row; said: the column of what its motion is called. among: keys of the runs to choose
    from, None for all. Raises as `runner.run`.
    """
    most, jobs = next_look(next_look()), []
    rows = [row for row in summary.rows if from_rest(row) and (among is None or row["run_key"] in among)]
    for role, row in chosen(rows, math.inf if carrying else most):
        length = min(most if carrying or role == "regular" else COMPANION_PERIODS, round(row["periods"]))
        original = run_of(plan.how.out, row)
        grows = row.get(TANGENT[0].name) is not None
        free = {name: kept for name, kept in UNFOLLOWED.items() if not grows or name != TANGENTS}
        scene = original.scene if carrying else changed(original.scene, free)
        samples = round(length * scene.waves.period_s / scene.sample_step_s()) + 1
        before = {name: values[:samples] for name, values in original.columns.items()}
        describe = partial(accuracy_row, before=before, original=row, row_of=row_of, said=said)
        for how, made in ((AS_RUN, scene), (TIGHTER, tighter_scene(scene)), (FINER, changed(scene, finer(scene)))):
            labels = {"role": role, "label": row["steepness"], "run": how, "periods": length}
            jobs.append(Job(labels, made, length, describe=describe))
    return Batch("accuracy", "two runs again, tighter and finer", ACCURACY, row_of, jobs).do(plan)


def accuracy_row(
    trajectory, before: dict[str, np.ndarray], original: dict, row_of: Callable, said: str
) -> dict[str, object]:
    """The columns of ACCURACY that a run fills; before, original: columns and row of the run that it repeats."""
    scene, columns = trajectory.scene, trajectory.columns
    row = counted(trajectory, (WALL_S, NEWTON, LOOPS)) | {
        "nodes": scene.tether.nodes,
        "rtol": None if scene.solver.step_s else scene.solver.rtol,
        "step_s": scene.solver.step_s,
    }
    if trajectory.status != "ok" or len(columns["radius_m"]) != len(before["radius_m"]):
        return row
    off, high = columns["radius_m"] - before["radius_m"], columns["tension_top_high_N"]
    row["tension_top_max_N"] = float(high.max())
    for name, end in (("_early", round(EARLY * scene.waves.period_s / scene.sample_step_s()) + 1), ("", None)):
        row[f"error{name}_m"] = float(np.sqrt(np.mean(off[:end] ** 2)))
        row[f"error_tension{name}_N"] = float(high[:end].max() - before["tension_top_high_N"][:end].max())
    new, old = measured(scene, columns), measured(scene, before)
    if carried(trajectory):
        new |= exponents(TANGENT, tangent_of(trajectory, math.ceil(LEFT_OUT * len(trajectory.tangent.growth_nats))))
    old[TANGENT[0].name] = original.get(TANGENT[0].name)
    both = [name for name in names(AGAIN) if new.get(name) is not None and old.get(name) is not None]
    row |= new | {f"error_{name}": new[name] - old[name] for name in both}
    now, called = row_of(trajectory).get(said), original.get(said)
    if not {now, called} & {None, *OPEN}:
        row |= {"verdict": now, "same_verdict": int(now == called)}
    return row


def maxima_of_blocks(scene, columns, transient_periods: float, block: int = BLOCK) -> np.ndarray:
    """The largest tension (N) of every `block` wave periods after the transient."""
    from analysis import block_maxima

    step_s, period_s = scene.sample_step_s(), scene.waves.period_s
    first = round(transient_periods * period_s / step_s) + 1
    return block_maxima(columns["tension_top_high_N"][first:], round(block * period_s / step_s))


def measured(scene, columns) -> dict[str, object]:
    """What AGAIN and ERRORS hold of a record but for its exponent, in what follows the share LEFT_OUT."""
    step_s, period_s = scene.sample_step_s(), scene.waves.period_s
    periods = (len(columns["time_s"]) - 1) * step_s / period_s
    first_s = math.ceil(LEFT_OUT * periods) * period_s
    found, largest = settled(scene, columns, first_s), maxima_of_blocks(scene, columns, first_s / period_s)
    found["tension_block_max_N"] = float(largest.mean()) if len(largest) else None
    if len(largest) > 1:
        found["tension_block_max_error_N"] = float(largest.std(ddof=1) / math.sqrt(len(largest)))
    return {name: found[name] for name in names((*AGAIN, *ERRORS)) if found.get(name) is not None}


def close_up(plan: Plan, summary: Summary, periods: int) -> float:
    """Compute the close-up, unless it is there or no run goes slack. periods: those of the sweep."""
    jobs, length = [], min(periods, PERIODS)
    for _, row in chosen([row for row in summary.rows if (row.get("slack_fraction") or 0.0) > 0.0])[-1:]:
        scene, start = run_of(plan.how.out, row).scene, start_of(plan, row)
        kept = {"output.profiles": True, "output.profiles_step_s": scene.waves.period_s / FRAMES}
        labels = {"steepness": row["steepness"], "motion": row.get("motion"), "periods": length}
        jobs.append(job_from(labels, changed(scene, UNFOLLOWED, kept), length, start))
    return Batch("close_up", "the close-up", CLOSE_UP, partial(counted, columns=(WALL_S,)), jobs).do(plan)
