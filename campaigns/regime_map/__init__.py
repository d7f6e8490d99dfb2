"""Map over two keys of a scene: regime, number of motions and largest tension of every cell, and its borders.

    python -m campaigns.regime_map                                 steepness and depth of water, 40 x 40
    python -m campaigns.regime_map --vary waves.steepness 0.016 0.16 40 --vary waves.period_s 3 8 40 --refine 400
    python -m campaigns.regime_map --curves results/orbits         with the folds and flips of campaigns.orbits --curves
    python -m campaigns.regime_map --screen                        a massless tether only, in a minute
    python -m campaigns.regime_map --cut water.depth_m=22.5        a row of it as a sweep, in the folder of the map

Protocol: a massless tether does the whole grid first and proposes starts. Then each cell is run from rest, from the
proposals, from kicks, and from the motions of the cells beside it where these are no motion of its own yet. A motion
that repeats at its first look is judged by that (verdict: cheap); any other goes on as docs/motions.md says, up to
--budget. Cells at borders are bisected with --refine. Kicks are drawn by --seed; nothing else is random.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from campaigns.explore import sweep as motions
from campaigns.explore.grid import place_in, varied
from campaigns.explore.sweep import BUDGET
from campaigns.machinery import Job, Jobs, Plan, Summary, cli, session
from campaigns.regime_map import curves, cuts
from campaigns.regime_map.cells import CellGrid
from campaigns.study import Measures, Order, Study
from engine.views import carries_tangents
from tables import Rows

USUAL = "waves.steepness 0.016 0.16 40 water.depth_m 20.8 25 40"
STARTS, MOST_CELLS = 3, 100_000


@dataclass
class Options(cli.Options):
    """The options of this campaign. grid: the keys of the map, read from --vary and --pages; None where at fault."""

    vary: list[str] = cli.option(
        "KEY LO HI COUNT", "twice: a key of the scene and its values, both ends included", usual=USUAL
    )
    pages: list[str] | None = cli.option(
        "KEY LO HI COUNT", "a map for each value of a third key; KEY WORD WORD of a key of words"
    )
    starts: int = cli.option("N", "from rest and N - 1 kicks in each cell", cli.whole(1, motions.MOST_KICKS), STARTS)
    kick_speed: float = motions.kick_speed()
    seed: int = cli.seed(motions.SEED_OF_KICKS)
    refine: int = cli.option("N", "bisect cells at borders into so many more", cli.whole(0, MOST_CELLS), 0)
    budget: int = cli.option("N", "wave periods after which a run ends undecided", cli.whole(1, BUDGET), BUDGET)
    cut: list[str] | dict | None = cli.option(
        "KEY=VALUE ...", "a row of the map as a sweep of the other key, in cuts/ of its folder"
    )
    curves: str | None = cli.option(
        "FOLDER",
        "draw the curves of this folder of campaigns.orbits --curves, over the same two keys",
        cli.Kind(curves.folder_of_curves, "a folder of campaigns.orbits --curves"),
    )
    screen: bool = cli.flag("a massless tether only")
    grid: CellGrid | None = None

    def read(self, faults: list[str]) -> None:
        """The keys of the map, and the values of --cut."""
        words = self.vary
        if len(words) != 8:
            given = " ".join(words) or "nothing"
            faults.append(f"--vary: given {given}; allowed: twice KEY LO HI COUNT, or none of it")
            return
        axes, pages = [varied(words[:4], faults), varied(words[4:], faults)], []
        if self.pages is not None:
            if len(self.pages) < 2:
                given = " ".join(self.pages) or "nothing"
                faults.append(f"--pages: given {given}; allowed: KEY LO HI COUNT, or KEY WORDS")
                return
            pages = [varied(self.pages, faults, "--pages", of_words=True)]
            if self.curves is not None:
                faults.append(f"--curves {self.curves}: given with --pages; allowed: one of them")
        keys = (*pages, *axes)
        if None in keys:
            return
        names = [key.key for key in keys]
        if len(set(names)) < len(names):
            faults.append(f"--vary {' '.join(names)}: given twice; allowed: different keys")
        for key in axes:
            if len(key.values) < 2:
                faults.append(f"--vary {key.key}: one value only; allowed: two or more")
        self.grid = CellGrid(keys)
        self.cut = cuts.read(self.cut, keys, faults)


def cases(order: Order) -> Iterator[Job]:
    """The run from rest of every cell of the coarse grid."""
    grid = order.options.grid
    order.look_by_look(BUDGET)
    if grid is None:
        return
    grid.refuse_set(order, "")
    base = grid.base(order, tell=True)
    if base is None:
        return
    if not carries_tangents(base):
        order.tell(f"campaigns.regime_map: given {order.name!r} as it is; allowed: {motions.ONLY}")
        return
    from engine.massless import why_not_covered

    for cell in grid.coarse():
        fault_count, job = len(order.faults), grid.job_at(order, cell)
        if job is None or len(order.faults) > fault_count:  # hundreds of others may be at fault in the same way
            place = " and ".join(f"{key} = {value}" for key, value in grid.labels(cell).items())
            order.tell(f"--vary: that is at {place}, the first cell of the map that cannot be")
            return
        reason = order.options.screen and why_not_covered(job.scene)
        if reason:
            order.tell(f"--screen: given; allowed: only what a massless tether covers, and this has {reason}")
            return
        if cell == (0, 0, 0, 0) and order.options.curves is not None:
            order.tell(*curves.faults(order.options.curves, grid, grid.labels(cell), job.scene))
        yield job


def measures(order: Order) -> Measures:
    """The row of a motion."""
    from campaigns.regime_map.maps import cell_row
    from campaigns.regime_map.tables import motion_columns

    return motions.measures_of(order, motion_columns(order.options.grid.columns), cell_row, "campaigns/regime_map")


def runs(order: Order, plan: Plan, jobs: Jobs) -> Summary:
    """In place of `runner.run`: the screen, the coarse grid, its borders."""
    from campaigns.regime_map.maps import Map

    curves.take_over(order.options.curves, plan)
    regime_map = Map(plan, order)
    regime_map.run_screen(jobs)
    if order.options.screen:
        return Summary([], 0, 0, regime_map.times)
    return regime_map.refine(regime_map.compute(order.options.grid.coarse(), jobs))


def parameters(order: Order) -> dict:
    options = order.options
    parameters = {"vary": {key.key: list(key.values) for key in options.grid.axes}}
    if options.grid.page is not None:
        parameters["pages"] = {options.grid.page.key: list(options.grid.page.values)}
    parameters |= {
        "starts": options.starts,
        "kick_speed_mps": options.kick_speed,
        "seed": options.seed,
        "budget": options.budget,
        "curves": options.curves,
        "refine": options.refine,
        "screen": options.screen,
    }
    return parameters


def answer(order: Order, rows: Rows) -> list[str]:
    """The findings of the map (`answer.sentences`)."""
    from campaigns.regime_map.answer import sentences

    grid = order.options.grid
    of_buoy = CellGrid(tuple(key for key in grid.keys if key.key.startswith("buoy.")))
    scenes = {}

    def scene(row):
        values = place_in(row, of_buoy.columns)
        if values not in scenes:
            changes, _ = grid.changes(row, grid.base(order))
            scenes[values] = order.scene(changes)
        return scenes[values]

    return [*sentences(motions.table_of(order.how.out / "cells"), rows, grid.columns, scene)]


STUDY = Study(
    name="regime_map",
    protocol=__doc__,
    scene="tethered_buoy",
    in_waves=True,
    options=Options,
    cases=cases,
    measures=measures,
    parameters=parameters,
    runs=runs,
    answer=answer,
)
read_order = STUDY.read_order


def main(argv: list[str] | None = None, simulate: Callable | None = None) -> int:
    """The command: a map, or with --cut a sweep in its folder. simulate: in place of engine.simulate."""

    def work(order, words):
        if order.options.cut:
            return cuts.cut(order, words, simulate)
        return STUDY.conduct(order, words, simulate)

    return session.command(STUDY.called, argv, read_order, work)
