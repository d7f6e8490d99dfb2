"""A sweep over one key with every motion of each value: its options, its runs, and the tables that an answer reads."""

import contextlib
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path
from typing import Any

import engine
from campaigns.answers import greatest, lasting
from campaigns.explore.grid import place_in
from campaigns.machinery import Job, Jobs, Plan, Summary, cli, run
from campaigns.study import Measures, Order
from engine.views import carries_tangents, in_regular_waves
from tables import PEAK, Columns, Rows, names, read_table

ROW_SOURCES = ("analysis", "engine", "campaigns/explore", "campaigns/judge.py")
BUDGET = 1500  # wave periods after which a run ends undecided
KICKS = 8
ONLY = "a buoy in regular waves in a plane, with bending stiffness and an implicit integrator"
REST = "rest"
MOST_KICKS = 10_000


def _starts(text: str):
    return REST if text == REST else cli.whole(0, MOST_KICKS).convert(text)


def kick_speed(use: str = "kicks are velocities of up to this along x and z, m/s") -> Any:
    """--kick-speed (`campaigns.explore.starts.kick_speed_mps`). use: of which starts."""
    sound = cli.number("a number above 0 and at most 100", lambda speed: 0.0 < speed <= 100.0)
    return cli.option("MPS", f"{use} (default: 6 m/s in waves of 5 s, and in proportion to their period)", sound)


SEED_OF_KICKS = "of the kicks, drawn independently and uniformly"
FULL = "full"


@dataclass
class SweepOptions(cli.Options):
    """The options of a sweep with every motion of each value."""

    starts: str | int | None = cli.option(
        "rest|N",
        "kicks of the buoy at each value, beside motions of a massless tether and those carried from its neighbours; "
        f"rest: one run from rest only (default: {KICKS}; with --periods: rest)",
        cli.Kind(_starts, f"{REST}, or {cli.whole(0, MOST_KICKS).allowed}"),
    )
    kick_speed: float = kick_speed()
    seed: int = cli.seed(SEED_OF_KICKS)
    start_from: str | None = cli.option(
        "FILE",
        "run from the final state of this run (a file of trajectories/) instead of from rest",
        cli.RUN_FILE,
    )
    evidence: str = cli.option(
        "dynamics|full",
        "dynamics, or full: Wolf's exponent and the tests for records of unknown origin as well, seconds a run",
        cli.one_of(("dynamics", FULL)),
        "dynamics",
    )
    no_accuracy: bool = cli.flag(
        "leave out what tells how exact the results are: errors of the largest tensions, runs with the wetted cap, "
        "runs of each motion on a finer grid, orbits at the ends of ranges (which then are known by bisection)"
    )


def start_of(order: Order, scene):
    """The state of --start-from, or None. What is wrong with it, or with going on from it in this scene, is told."""
    if order.options.start_from is None:
        return None
    from engine.run.start import checked_start

    try:
        if scene.waves is None:
            raise ValueError("given for a scene without waves; allowed: with waves")
        return checked_start(scene, run_in(order.options.start_from)).at_zero()
    except ValueError as error:
        order.tell(f"--start-from: {error}")
    return None


@cache
def run_in(path: str):
    """The Trajectory of a file, read once. Raises ValueError."""
    return engine.Trajectory.load(path)


def with_kicks(cases: Callable, order: Order) -> list[Job]:
    """The cases of an order. It is a fault if they do not allow its starts."""
    order.cases = list(cases(order))
    kicks_of(order)
    return order.cases


def kicks_of(order: Order) -> int | None:
    """Kicks at each value; None: runs from rest only. Kicks asked for cases that allow none are a fault."""
    options = order.options
    if len(options.grid.keys) > 1:
        allowed = f" with two keys; allowed: {REST}, or one key"
    elif options.start_from is not None:
        allowed = " with --start-from; allowed: one of them"
    elif not all(in_regular_waves(scene) and carries_tangents(scene) for scene in order.scenes):
        allowed = f"; allowed: {REST}, and a number for {ONLY}"
    elif options.starts is None and order.looks:
        return KICKS
    elif options.starts != REST:
        return options.starts
    if options.starts not in (None, REST):
        order.tell(f"--starts: given {options.starts}{allowed}")
    return None


def parameters(order: Order) -> dict:
    """The starts, for the provenance."""
    options, kicks = order.options, kicks_of(order)
    if kicks is None:
        return {"starts": REST if options.start_from is None else options.start_from}
    return {"starts": kicks, "kick_speed_mps": options.kick_speed, "seed": options.seed}


def runs(order: Order, plan: Plan, jobs: Jobs, ahead: Callable | None = None) -> Summary:
    """In place of `runner.run`: runs from rest only, or every motion of each value of the only key of the order's grid,
    with the ends of their ranges.

    ahead: called with the rows of all motions before their ends are looked for, which leaves workers without work.
    """
    kicks = kicks_of(order)
    if kicks is None:
        return run(plan, jobs)
    from campaigns.explore.ends import confirm, find_ends
    from campaigns.explore.motions import Search
    from campaigns.explore.tracing import Scenes

    (key,), options = order.options.grid.keys, order.options
    exact = not options.no_accuracy

    def ends(motions):
        if ahead is not None:
            ahead(motions.table())
        if len(jobs) > 1:
            find_ends(motions, Scenes(motions.jobs[0].scene, key), exact)

    later = [ends]
    if exact:
        later.append(confirm)
    return every_motion(plan, jobs, Search(order, kicks, options.kick_speed, options.seed), *later)


def every_motion(plan: Plan, jobs: Jobs, search, *later: Callable) -> Summary:
    """In place of `runner.run`: the motions of each value of the only key of the order of a search.

    search: `campaigns.explore.motions.Search`; later: further parts of the work, called with the `Motions` when these
    have their letters in table.csv.
    """
    from campaigns.explore.motions import Motions, in_a_row
    from campaigns.explore.stages import explore

    (key,) = search.order.options.grid.keys
    jobs = sorted(jobs, key=lambda job: job.labels[key.column.name])
    if plan.simulate is not engine.simulate:
        return run(plan, jobs)
    motions = Motions(plan, [key.column], in_a_row(len(jobs)))
    parts = [partial(part, motions) for part in later]
    explore(motions, jobs, search, motions.write, *parts)
    return motions.write()


def table_of(folder: Path) -> Rows:
    """The rows of table.csv in a folder; none where there is no table, or an empty one."""
    with contextlib.suppress(OSError, ValueError):
        return read_table(folder / "table.csv")
    return ()


def tables_of(out: Path, *folders: str) -> dict[str, Rows]:
    """The rows of `table_of` in these folders of a campaign."""
    return {folder: table_of(out / folder) for folder in folders}


def answer(order: Order, rows: Rows, symbol: str, *folders: str) -> list[str]:
    """The findings of a sweep over one key (`campaigns.explore.answer`), which is called `symbol` in words.

    folders: within that of the sweep, whose tables count too; that of the ends of motions is one where there are some.
    """
    from campaigns.explore.answer import sentences

    if kicks_of(order) is not None:
        folders = *folders, "ends"
    (key,) = names(order.options.grid.columns)
    return sentences(rows, key, symbol, scene_of_peak(order, rows), **tables_of(order.how.out, *folders))


def scene_of_peak(order: Order, rows: Rows):
    """The scene of the largest tension; without one, that of the first run."""
    peak, columns = greatest(lasting(rows), PEAK), order.options.grid.columns
    for case in order.cases:
        if peak is not None and place_in(peak, columns) == place_in(case.labels, columns):
            return case.scene
    return order.cases[0].scene


def measures_of(order: Order, columns: Columns, row: Callable | None = None, *sources: str) -> Measures:
    """The rows of a buoy in regular waves; row: in place of `rows.buoy_row`, with what else shapes it."""
    from campaigns.explore.judgement import judgement_of
    from campaigns.explore.rows import buoy_row

    settings = {"transient_periods": order.transient, "full": None}
    if getattr(order.options, "evidence", "") == FULL:
        settings["full"] = order.periods
    judge = partial(judgement_of, **settings)
    return Measures(columns, row or buoy_row, (*ROW_SOURCES, *sources), settings, judge)


def columns_of(keys: Columns) -> Columns:
    """Those of the places of a grid, then those of the rows of a buoy in a plane."""
    from campaigns.explore.rows import COLUMNS, STEEPNESS

    of_places = names((STEEPNESS, *keys))
    measured = [column for column in COLUMNS if column.name not in of_places and not column.name.startswith("planar_")]
    return *keys, *measured
