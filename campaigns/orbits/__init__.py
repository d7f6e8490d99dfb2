"""Periodic orbits of the buoy in waves, stable and unstable, over one key: what makes motions appear, jump and coexist.

    python -m campaigns.orbits                                     over the paper's range of steepness
    python -m campaigns.orbits --set water.depth_m=25 --vary waves.steepness 0.1 0.17
    python -m campaigns.orbits --vary water.depth_m 22 25 --start-from results/buoy_sweep/trajectories/KEY.nc
    python -m campaigns.orbits --curves water.depth_m 22 25        its folds, flips and torus points over the depth

Protocol: the motions of a few values of the key are found as in `campaigns.sweep` (from rest, from motions of a
massless tether, carried to their neighbours); --start-from takes the motion of one run in their place. Under each
periodic motion, up to period 16, Newton's method finds the orbit on the map over one wave period, at a tolerance of
0.001 or that of the scene where it is smaller. Each orbit is followed both ways, round folds, through the range of the
key; the orbits that begin at its flips are followed too. A multiplier's error is its change over three sequences of
steps; that of an event also its change on a finer grid of the line. An orbit may release loops; where a release begins
or ends, its branch ends. Nothing is random.
"""

import re
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path

from campaigns.explore import sweep as motions
from campaigns.explore.grid import Grid, varied
from campaigns.explore.multipliers import TOLERANCE
from campaigns.judge import job_from
from campaigns.machinery import Job, Plan, Summary, claimed, cli, run_of
from campaigns.study import Measures, Order, Study
from engine.views import LONGEST_PERIOD
from tables import Row, Rows, any_rows, number_of, read_table

USUAL, VALUES, BUDGET = "waves.steepness 0.05 0.16", 9, 700
ORBITS, BRANCHES = 60, 8
MOTIONS = "motions"  # the folder of the sweep that finds them


@dataclass
class Options(cli.Options):
    """The options of this campaign."""

    vary: list = cli.option(
        "KEY LO HI", "the key of the scene, and the range over which orbits are followed", usual=USUAL
    )
    values: int = cli.option("N", "values of it at which motions are looked for", cli.whole(2, 200), VALUES)
    start_from: str | None = cli.option(
        "FILE",
        "the orbit under the last state of this run (a file of trajectories/), in its own scene",
        cli.RUN_FILE,
    )
    motion: str | None = cli.option(
        "LETTER",
        "the orbit under this motion alone, by its letter in motions/table.csv",
        cli.Kind(str, "the letter of a motion"),
    )
    orbits: int = cli.option("N", "orbits of a branch at most, each way", cli.whole(1, 10_000), ORBITS)
    branches: int = cli.option("N", "branches that are followed at most", cli.whole(1, 1000), BRANCHES)
    curves: list = cli.option(
        "KEY2 LO HI", "a second key over which each fold, flip and torus point is followed; its value is within LO HI"
    )
    no_accuracy: bool = cli.flag("do not find folds, flips and torus points again on a finer grid of the line")
    second: object = None  # the key of --curves
    grid: Grid = field(default_factory=Grid)  # the key with its values, read from --vary and --values
    out: Path = Path()  # the folder of the campaign

    def read(self, faults: list[str]) -> None:
        """The key with its values in the words of --vary."""
        if self.motion is not None and self.start_from is not None:
            faults.append(f"--motion: given {self.motion} with --start-from; allowed: one of them")
        elif self.motion is not None and not re.fullmatch(r"[A-Z](1\d|[2-9])?", self.motion):
            allowed = "a capital letter, or A2 to Z19, as motions/table.csv has them"
            faults.append(f"--motion: given {self.motion!r}; allowed: {allowed}")
        elif self.motion is not None:
            faults += self.unknown_letter()
        words = self.vary or USUAL.split()
        if faults and words == USUAL.split():
            return
        if len(words) != 3:
            faults.append(f"--vary: given {' '.join(words)}; allowed: KEY LO HI, for instance water.depth_m 22 25")
            words = USUAL.split()
        key = varied(words, faults, count=self.values)
        self.grid = Grid(() if key is None else (key,))
        if self.curves is None:
            return
        if len(self.curves) != 3:
            given = " ".join(self.curves)
            faults.append(f"--curves: given {given}; allowed: KEY2 LO HI, for instance water.depth_m 22 25")
            return
        self.second = varied(self.curves, faults, "--curves", count=2)
        if key is not None and self.second is not None and self.second.key == key.key:
            faults.append(f"--curves {key.key}: is the key of --vary; allowed: another one")

    def unknown_letter(self, jobs: Sequence[Job] = ()) -> Iterator[str]:
        """The fault of --motion, if it is one: letters are given by a search, and the last one here has not given it.

        jobs: runs from rest of this command. A search that did not begin with them gave its letters to other motions.
        """
        table = self.out / MOTIONS / "table.csv"
        rows = any_rows(table)
        letters = sorted({row["motion"] for row in rows if row["motion"]})
        if self.motion not in letters or not {job.key for job in jobs} <= {row["run_key"] for row in rows}:
            found = ", ".join(letters) or "none"
            allowed = f"a letter in {table}, which the same command without --motion writes; there now: {found}"
            yield f"--motion: given {self.motion}; allowed: {allowed}"


def cases(order: Order) -> Iterator[Job]:
    """The runs from rest at the values of the key; of --start-from a run that goes on for a period."""
    order.look_by_look(BUDGET)
    if not order.options.grid.keys:
        return
    jobs_of = _jobs
    if order.options.start_from is not None:
        jobs_of = _job_of_file
    jobs = list(filter(None, jobs_of(order)))
    if not jobs:
        return
    if order.options.motion is not None:
        order.tell(*order.options.unknown_letter(jobs))
    from engine.run.period_map import why_no_map

    grids = {job.scene.tether.nodes for job in jobs}
    reasons = dict.fromkeys(why_no_map(job.scene) for job in jobs)
    for reason in filter(None, reasons):
        order.tell(
            f"campaigns.orbits: given a scene with {reason}; allowed: a buoy in regular waves, a line in a plane with "
            "bending stiffness, an integrator with error control"
        )
    if len(grids) > 1:
        key = order.options.grid.keys[0].key
        order.tell(f"--vary {key}: changes the grid of the line; allowed: a key that does not")
    if order.options.second is not None:
        _check_second(order, jobs[0].scene)
    yield from jobs


def _check_second(order: Order, scene) -> None:
    """Tell what is wrong with the key of --curves in a scene."""
    from campaigns.explore.tracing import Scenes

    key = order.options.second
    value, (low, high) = key.of(scene), (key.values[0], key.values[-1])
    if value is None:
        order.tell(f"--curves {key.key}: the scene has no value of it; allowed: a key that it has")
        return
    if not low <= value <= high:
        allowed = f"a range with the value of the scene, {value}"
        order.tell(f"--curves {key.key}: given {low:g} to {high:g}; allowed: {allowed}")
        return
    try:
        grids = {Scenes(scene, key).at(end).tether.nodes for end in (low, high)}
    except ArithmeticError as why:
        order.tell(f"--curves {key.key}: given {low:g} to {high:g}; {why}")
        return
    if all(isinstance(end, int) for end in (low, high)):
        order.tell(f"--curves {key.key}: holds a whole number; allowed: a key that holds any number")
    elif grids != {scene.tether.nodes}:
        order.tell(f"--curves {key.key}: changes the grid of the line; allowed: a key that does not")


def _jobs(order: Order) -> Iterator[Job]:
    order.options.grid.refuse_set(order)
    if order.options.grid.base(order, tell=True) is not None:
        yield from map(partial(order.options.grid.job, order), order.options.grid.places())


def _job_of_file(order: Order) -> Iterator[Job]:
    from engine.scene import SceneError, scene_from_toml

    (key,) = order.options.grid.keys
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
        order.tell(*error.faults)
    except ValueError as error:
        order.tell(f"--start-from: {error}")


def measures(order: Order) -> Measures:
    """The rows of the runs: those of `campaigns.sweep`."""
    return motions.measures_of(order, motions.columns_of(order.options.grid.columns))


def runs(order: Order, plan: Plan, jobs: list[Job]) -> Summary:
    """In place of `runner.run`: the motions, in a folder of their own, and the orbits under them."""
    from campaigns.explore.tracing import Line, Scenes
    from campaigns.orbits.tables import tables
    from campaigns.orbits.tree import Tree

    options = order.options
    (key,) = options.grid.keys
    times, at_ends = Counter(), []
    if options.start_from is not None:
        starts = [*_under_file(order, jobs[0])]
    else:
        from campaigns.explore.motions import Search

        folder = plan.how.out / MOTIONS
        with claimed(folder):
            without_kicks = Search(order, 0, None, 1)
            times = motions.every_motion(plan.within(folder), jobs, without_kicks).times
        starts = [*_under_motions(order, folder, lambda rows: rows[len(rows) // 2 :][:1])]
        at_ends = [*_under_motions(order, folder, lambda rows: (rows[0], rows[-1]))]
    low, high = key.values[0], key.values[-1]
    _, value, _, state = [*starts, ("", low, 0, None)][0]
    line = Line(Scenes(jobs[0].scene, key), low, high, high - low, state, value)
    tree = Tree(plan, line, options.orbits, options.branches)
    if starts:
        tree.grow(starts)
        tree.grow(tree.beyond(at_ends))
        tree.across([value for _, value, _, _ in starts])
        if not options.no_accuracy:
            tree.refine()
    rows = tables(tree, key.column)
    if options.second is not None:
        from campaigns.orbits.curves import FOLDER, Plane, write_curves

        points = plan.how.seen(plan.how.out / FOLDER / "points")
        write_curves(tree, Plane(line, options.second, options.second.of(line.scenes.base), points))
    return Summary(rows, tree.there, tree.computed, times)


def _under_motions(order: Order, folder, choice: Callable[[list[Row]], Sequence[Row]]) -> Iterator[tuple]:
    """Letter, value, period and state of every motion in some rows of each of its periods.

    choice: which of the rows in which a motion has a period, in the order of their values.
    """
    (key,) = order.options.grid.keys
    rows_of = {}  # by letter and period
    for row in read_table(folder / "table.csv"):
        period = number_of(row, "strobed_period")
        if row["status"] == "ok" and 1 <= period <= LONGEST_PERIOD and order.options.motion in (None, row["motion"]):
            rows_of.setdefault((str(row["motion"]), int(period)), []).append(row)
    for (letter, period), rows in rows_of.items():
        for row in choice(rows):
            run = run_of(folder, row)
            if run is not None and run.final_state is not None:
                yield letter, number_of(row, key.column.name), period, run.final_state.at_zero()


def _under_file(order: Order, job: Job) -> Iterator[tuple]:
    """The same of --start-from, where its run repeats."""
    from campaigns.explore.rows import after_transient, sound_part

    (key,), run = order.options.grid.keys, motions.run_in(order.options.start_from)
    times_s = run.columns["time_s"]  # a run that goes on begins late
    periods = (times_s[-1] - times_s[0]) / run.scene.waves.period_s
    period = after_transient(run, sound_part(run.columns), int(periods / 2)).get("strobed_period")
    if period is not None:
        yield "", job.labels[key.column.name], period, run.final_state.at_zero()


def parameters(order: Order) -> dict:
    options = order.options
    return {
        "vary": {key.key: [key.values[0], key.values[-1]] for key in options.grid.keys},
        "motion": options.motion,
        "start_from": options.start_from,
        "tolerance": TOLERANCE,
        "orbits": options.orbits,
        "branches": options.branches,
    } | ({} if options.second is None else {"curves": options.curves})


def answer(order: Order, rows: Rows) -> Iterator[str]:
    """The findings (`answer.sentences`)."""
    from campaigns.orbits.answer import sentences

    tables = motions.tables_of(order.how.out, "branches", "events", "orbits")
    return sentences(rows, order.options.grid.columns[0], tables)


STUDY = Study(
    name="orbits",
    protocol=__doc__,
    scene="tethered_buoy",
    counted="tasks",
    in_waves=True,
    options=Options,
    cases=cases,
    measures=measures,
    parameters=parameters,
    runs=runs,
    answer=answer,
)
main, read_order = STUDY.main, STUDY.read_order
