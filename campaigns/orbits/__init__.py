"""Periodic orbits of the buoy in waves, stable and unstable, over one key: what makes motions appear, jump and coexist.

    python -m campaigns.orbits                                     over the paper's range of steepness
    python -m campaigns.orbits --set water.depth_m=25 --vary waves.steepness 0.1 0.17
    python -m campaigns.orbits --vary water.depth_m 22 25 --start-from results/buoy_sweep/trajectories/KEY.nc

Protocol: the motions of a few values of the key are found as in `campaigns.sweep` (from rest, from motions of a
massless tether, carried to their neighbours); --start-from takes the motion of one run in their place. Under each
periodic motion, up to period 16, Newton's method finds the orbit on the map over one wave period, at a tolerance of
0.001 or that of the scene where it is smaller. Each orbit is followed both ways, round folds, through the range of the
key; the orbits that begin at its flips are followed too. A multiplier's error is its change over three sequences of
steps; that of an event also its change on a finer grid of the line. Where the line releases a loop there is no such
map, and a branch ends. Nothing is random.
"""

import contextlib
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path

from campaigns import sweep
from campaigns.answers import known
from campaigns.explore import sweep as motions
from campaigns.explore.multipliers import TOLERANCE
from campaigns.judge import job_from
from campaigns.machinery import cli
from campaigns.machinery.folder import claimed, read_rows, run_of
from campaigns.machinery.plan import Job, Plan, Summary
from campaigns.study import Measures, Order, Study
from engine.views import LONGEST_PERIOD

USUAL, VALUES, BUDGET = "waves.steepness 0.05 0.16", 9, 700
ORBITS, BRANCHES = 60, 8
MOTIONS = "motions"


@dataclass
class Options(cli.Options):
    """The options of this campaign; after them what `campaigns.sweep` reads, and this command does not offer."""

    vary: list = cli.option(
        "KEY LO HI", "the key of the scene, and the range over which orbits are followed", usual=USUAL
    )
    values: int = cli.option("N", "values of it at which motions are looked for", cli.whole(2, 200), VALUES)
    start_from: str | None = cli.option(
        "FILE",
        "the orbit under the last state of this run (a file of trajectories/), in its own scene",
        cli.Kind(str, "a file of a run"),
    )
    motion: str | None = cli.option(
        "LETTER",
        "the orbit under this motion alone, by its letter in motions/table.csv",
        cli.Kind(str, "the letter of a motion"),
    )
    orbits: int = cli.option("N", "orbits of a branch at most, each way", cli.whole(1, 10_000), ORBITS)
    branches: int = cli.option("N", "branches that are followed at most", cli.whole(1, 1000), BRANCHES)
    no_accuracy: bool = cli.flag("do not find folds, flips and torus points again on a finer grid of the line")
    starts: int = 0
    kick_speed: float = motions.SPEED_MPS
    seed: int = 1
    duration: float | None = None
    evidence: str = "dynamics"

    def read(self, out: Path, faults: list[str]) -> None:
        """The key with its values (`campaigns.sweep.Varied`) in place of the words of --vary."""
        words = self.vary or USUAL.split()
        if len(words) != 3:
            faults.append(f"--vary: given {' '.join(words)}; allowed: KEY LO HI, for instance water.depth_m 22 25")
            words = USUAL.split()
        key = sweep.varied([*words, str(self.values)], faults)
        self.vary = [] if key is None else [key]
        if self.start_from is not None and self.motion is not None:
            faults.append(f"--motion: given {self.motion} with --start-from; allowed: one of them")


def cases(order: Order) -> Iterator[Job]:
    """The runs from rest of `campaigns.sweep`; of --start-from a run that goes on for a period."""
    from engine.period_map import why_no_map

    order.periods, order.looks, order.transient = BUDGET, True, None
    if not order.options.vary:
        return
    jobs = [*_of_file(order)] if order.options.start_from is not None else [*sweep.cases(order)]
    grids = {job.scene.tether.nodes for job in jobs}
    for why in dict.fromkeys(filter(None, (why_no_map(job.scene) for job in jobs))):
        order.tell([f"campaigns.orbits: given a scene with {why}; allowed: a buoy in regular waves, a line in a plane "
                    "with bending stiffness, an integrator with error control"])  # fmt: skip
    if len(grids) > 1:
        order.tell([f"--vary {order.options.vary[0].key}: changes the grid of the line; allowed: a key that does not"])
    yield from jobs


def _of_file(order: Order) -> Iterator[Job]:
    from engine.scene import SceneError, scene_from_toml

    (key,) = order.options.vary
    try:
        run = motions.run_in(order.options.start_from)
        scene = scene_from_toml(run.scene.to_toml(), order.changes)
        value = key.of(scene)
        if run.final_state is None:
            raise ValueError("given a run without a final state: it ended early, or kept energies")
        if value is None or not key.values[0] <= value <= key.values[-1]:
            raise ValueError(f"given a run with {key.key} = {value}; allowed: {key.values[0]:g} to {key.values[-1]:g}")
        yield job_from({key.key: value, "dimensions": 2}, scene, 1, run.final_state.at_zero())
    except SceneError as error:
        order.tell(error.faults)
    except ValueError as error:
        order.tell([f"--start-from: {error}"])


def measures(order: Order) -> Measures:
    """The rows of the runs: those of `campaigns.sweep`."""
    return sweep.measures(order)


def runs(order: Order) -> Callable:
    """In place of `runner.run`: the motions, in a folder of their own, and the orbits under them."""

    def every_orbit(plan: Plan, jobs: list[Job]) -> tuple[dict[str, float], Summary]:
        from campaigns.explore.tracing import Line, Scenes
        from campaigns.orbits.tables import tables
        from campaigns.orbits.tree import Tree

        (key,), scene = order.options.vary, jobs[0].scene
        timing = dict.fromkeys(("compile_s", "run_s", "analysis_s"), 0.0)
        if order.options.start_from is not None:
            starts = [*_under_file(order, jobs[0])]
        else:
            inner = replace(plan, how=replace(plan.how, out=plan.how.out / MOTIONS))
            with claimed(inner.how.out):
                timing, _ = sweep.runs(order)(inner, jobs)
            starts = [*_under_motions(order, inner.how.out)]
        began = time.perf_counter()
        state, value = (starts[0][3], starts[0][1]) if starts else (None, key.values[0])
        low, high = key.values[0], key.values[-1]
        line = Line(Scenes(scene.to_toml(), key.key, key.name, key.index), low, high, high - low, state, value)
        tree = Tree(plan, line, order.options.orbits, order.options.branches)
        if starts:
            tree.grow(starts)
            tree.across([start[1] for start in starts])
            if not order.options.no_accuracy:
                tree.refine()
        rows = tables(tree, key.column)
        timing["run_s"] += time.perf_counter() - began
        return timing, Summary(rows, tree.there, tree.computed, timing["analysis_s"])

    return every_orbit


def _under_motions(order: Order, folder) -> Iterator[tuple]:
    """For every period of every motion its letter, a value in the middle of where it is found, and a state there."""
    (key,) = order.options.vary
    found: dict[tuple[str, int], list[dict]] = {}
    for row in read_rows(folder / "table.csv"):
        period = known(row, "strobed_period")
        if row["status"] == "ok" and 1 <= period <= LONGEST_PERIOD and order.options.motion in (None, row["motion"]):
            found.setdefault((str(row["motion"]), int(period)), []).append(row)
    for (letter, period), rows in found.items():
        row = rows[len(rows) // 2]
        run = run_of(folder, row)
        if run is not None and run.final_state is not None:
            yield letter, known(row, key.column.name), period, run.final_state.at_zero()


def _under_file(order: Order, job: Job) -> Iterator[tuple]:
    """The same of --start-from, where its run repeats."""
    from campaigns.explore.rows import after_transient, sound_part

    (key,), run = order.options.vary, motions.run_in(order.options.start_from)
    periods = int(run.columns["time_s"][-1] / run.scene.waves.period_s + 1e-6)
    period = after_transient(run, sound_part(run.columns), periods // 2).get("strobed_period")
    if period is not None:
        yield "", job.labels[key.column.name], period, run.final_state.at_zero()


def parameters(order: Order) -> dict[str, object]:
    own = order.options
    told = {"vary": {one.key: [one.values[0], one.values[-1]] for one in own.vary}, "motion": own.motion}
    return told | {"start_from": own.start_from, "tolerance": TOLERANCE, "orbits": own.orbits, "branches": own.branches}


def answer(order: Order, rows: list[dict]) -> Iterator[str]:
    """What was found (`answer.sentences`)."""
    from campaigns.orbits.answer import sentences

    parts: dict[str, tuple[dict, ...]] = dict.fromkeys(("branches", "events", "orbits"), ())
    for name in parts:
        with contextlib.suppress(ValueError):  # a table without rows
            parts[name] = read_rows(order.how.out / name / "table.csv")
    return sentences(rows, order.options.vary[0].column, parts)


STUDY = Study(
    name="orbits",
    protocol=__doc__,
    scene="tethered_buoy",
    options=Options,
    cases=cases,
    measures=measures,
    parameters=parameters,
    runs=runs,
    answer=answer,
)
main, parser, read_order = STUDY.main, STUDY.parser, STUDY.read_order
