"""A sweep over one key with every motion of each value: the options, and what is run in place of the runs from rest."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import engine
from campaigns.columns import Column
from campaigns.judge import judged_job
from campaigns.machinery import cli
from campaigns.machinery.plan import Job, Plan, Summary
from campaigns.machinery.runner import run
from campaigns.study import Order
from engine.views import carries_tangents, in_regular_waves

KICKS, SPEED_MPS = 8, 6.0
ONLY = "a number for a buoy in regular waves in a plane, with bending stiffness and an implicit integrator"
REST = "rest"
MOST_KICKS = 10_000


def _starts(text: str):
    return REST if text == REST else cli.whole(0, MOST_KICKS).convert(text)


def kick_speed(use: str = "kicks are velocities of up to this along x and z, m/s") -> Any:
    """--kick-speed. use: of which starts."""
    return cli.option("MPS", use, cli.POSITIVE, SPEED_MPS)


KICKS_BESIDE = (
    "kicks of the buoy at each value, beside motions of a massless tether and those carried from its neighbours; "
    f"rest: one run from rest only (default: {KICKS}; with --periods: rest)"
)
SEED_OF_KICKS = "of the kicks, drawn independently and uniformly"
FULL = "full"


@dataclass
class Starts(cli.Options):
    """The options of a sweep with every motion of each value."""

    starts: str | int | None = cli.option(
        "rest|N", KICKS_BESIDE, cli.Kind(_starts, f"{REST}, or {cli.whole(0, MOST_KICKS).allowed}")
    )
    kick_speed: float = kick_speed()
    seed: int = cli.seed(SEED_OF_KICKS)
    start_from: str | None = cli.option(
        "FILE",
        "run from the final state of this run (a file of trajectories/) instead of from rest",
        cli.Kind(str, "a file of a run"),
    )
    evidence: str = cli.option(
        "dynamics|full",
        "dynamics, or full: Wolf's exponent and the tests for records of unknown origin as well, seconds a run",
        cli.one_of(("dynamics", FULL)),
        "dynamics",
    )


def start_of(order: Order, scene):
    """The state of --start-from, or None. What is wrong with it, or with going on from it in this scene, is told."""
    if order.options.start_from is None:
        return None
    from engine.simulation import checked_start

    try:
        if scene.waves is None:
            raise ValueError("given for a scene without waves; allowed: with waves")
        return checked_start(scene, run_in(order.options.start_from)).at_zero()
    except ValueError as error:
        order.tell([f"--start-from: {error}"])
    return None


@cache
def run_in(path: str):
    """The Trajectory of a file, read once. Raises ValueError."""
    return engine.Trajectory.load(path)


def kicks_of(order: Order, scenes: Iterable) -> int | None:
    """Kicks at each value; None: runs from rest only. More asked of scenes that can have nothing else is a fault.

    scenes: of the runs from rest.
    """
    asked = order.options.starts
    if order.options.start_from is not None:
        if asked not in (None, REST):
            order.tell([f"--starts: given {asked} with --start-from; allowed: one of them"])
        return None
    if asked == REST or (asked is None and not order.looks):
        return None
    can = all(in_regular_waves(scene) and carries_tangents(scene) for scene in scenes)
    if not can and asked is not None:
        order.tell([f"--starts: given {asked}; allowed: {REST}, and {ONLY}"])
    return None if not can else KICKS if asked is None else asked


def parameters(order: Order, kicks: int | None) -> dict[str, object]:
    """What the provenance says of the starts."""
    if kicks is None:
        return {"starts": REST if order.options.start_from is None else order.options.start_from}
    return {"starts": kicks, "kick_speed_mps": order.options.kick_speed, "seed": order.options.seed}


def job_of(order: Order, job: Job, motion, labels: dict, most: int | None = None) -> Job:
    """The judged run of a motion with these columns: that from rest (job), or one from its last state.

    most: as of `campaigns.judge.judged_job`.
    """
    from campaigns.explore.along import FROM_REST, KICKED
    from campaigns.explore.transients import as_long_as

    if motion.found_by == FROM_REST:
        return replace(job, labels={**job.labels, **labels})
    own = judged_job(order, {**job.labels, **labels}, job.scene, motion.state.at_zero(), most)
    return as_long_as(own, order.periods) if motion.found_by == KICKED else own


def every_motion(order: Order, kicks: int, key: Column, name: str, index: int | None = None) -> Callable:
    """In place of `runner.run`: the runs from rest, and one judged run for every other motion at each value.

    key: the column of the values; name, index: of the key in the scene (`campaigns.sweep.Varied`).
    """

    def runs(plan: Plan, jobs: list[Job]) -> tuple[dict[str, float], Summary]:
        from campaigns.explore import ends
        from campaigns.explore.along import FROM_REST, Along
        from campaigns.explore.starts import DISPLACED, start_job
        from campaigns.explore.tracing import Scenes
        from campaigns.explore.transients import outlasting

        jobs = sorted(jobs, key=lambda job: job.labels[key.name])
        real = plan.simulate is engine.simulate
        ahead = [start_job({}, jobs[0].scene, DISPLACED, ())] if real and engine.massless_covers(jobs[0].scene) else []
        timing, first = run(replace(plan, title="runs from rest"), jobs, ahead)
        if not real:
            return timing, first
        rows = {row["run_key"]: row for row in first.rows}
        longer, late = run(plan, outlasting(jobs, rows, lambda at: (at - 1, at + 1)))
        rows |= {row["run_key"]: row for row in late.rows}
        along = Along(plan, key, jobs, Scenes(jobs[0].scene.to_toml(), key.name, name, index), [*rows.values()])
        along.find(kicks, order.options.kick_speed, order.options.seed)

        others = {motion: job_of(order, job, motion, {}) for motion, job in along.beside_rest(jobs)}
        more, found = run(plan, [*jobs, *others.values()])
        along.judged(others, found.rows)
        along.name()
        if len(jobs) > 1:
            ends.bisect(along)
        ends.confirm(along)
        along.starts.write()
        judged = []
        for at, job in enumerate(jobs):
            some = sorted(along.motions[at], key=lambda one: (len(one.branch.letter), one.branch.letter))
            judged += [] if any(one.found_by == FROM_REST for one in some) else [job]
            judged += [job_of(order, job, motion, along.labels(motion)) for motion in some]
        last, summary = run(plan, judged)
        made = first.made | late.made | found.made | summary.made
        computed = sum(row["run_key"] in made for row in summary.rows)
        for times in (longer, more, last, along.starts.times):
            timing = {name: seconds + times[name] for name, seconds in timing.items()}
        return timing, replace(summary, computed=computed, found=len(summary.rows) - computed)

    return runs
