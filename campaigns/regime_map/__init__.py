"""Map over two keys of a scene: regime, number of motions and largest tension of every cell, and its borders.

    python -m campaigns.regime_map                                 steepness and depth of water, 40 x 40
    python -m campaigns.regime_map --vary waves.steepness 0.016 0.16 40 --vary waves.period_s 3 8 40 --refine 400
    python -m campaigns.regime_map --screen                        a massless tether only, in a minute
    python -m campaigns.regime_map --cut water.depth_m=22.5        a row of it as a sweep, in the folder of the map

Protocol: a massless tether does the whole grid first and proposes starts. Then each cell is run from rest, from the
proposals, from kicks, and from the motions of the cells beside it where these are no motion of its own yet. A motion
that repeats at its first look is judged by that (verdict: cheap); any other goes on as docs/verdicts.md says, up to
--budget. Cells at borders are bisected with --refine. Kicks are drawn by --seed; nothing else is random.
"""

import contextlib
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

from campaigns.buoy_sweep import STUDY as SWEEP
from campaigns.explore import sweep as motions
from campaigns.explore.settings import ROW_SOURCES
from campaigns.machinery import cli, session
from campaigns.machinery.folder import read_rows
from campaigns.machinery.plan import Job, Plan, Summary
from campaigns.regime_map import cuts
from campaigns.regime_map.cells import Grid
from campaigns.study import Measures, Order, Study
from campaigns.sweep import varied
from engine.views import carries_tangents, in_regular_waves

USUAL = "waves.steepness 0.016 0.16 40 water.depth_m 20.8 25 40"
BUDGET = SWEEP.lengths.budget
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
    screen: bool = cli.flag("a massless tether only")
    grid: Grid | None = None

    def read(self, out: Path, faults: list[str]) -> None:
        """The keys of the map, and the values of --cut."""
        words = self.vary
        if len(words) != 8:
            faults.append(
                f"--vary: given {' '.join(words) or 'nothing'}; allowed: twice KEY LO HI COUNT, or none of it"
            )
            return
        keys, page = [varied(words[:4], faults), varied(words[4:], faults)], None
        if self.pages is not None:
            if len(self.pages) < 2:
                faults.append(
                    f"--pages: given {' '.join(self.pages) or 'nothing'}; allowed: KEY LO HI COUNT, or KEY WORDS"
                )
                return
            page = varied(self.pages, faults, "--pages", of_words=True)
            keys.insert(0, page)
        if None in keys:
            return
        if len({key.key for key in keys}) < len(keys):
            faults.append(f"--vary {' '.join(key.key for key in keys)}: given twice; allowed: different keys")
        for key in keys:
            if key is not page and len(key.values) < 2:
                faults.append(f"--vary {key.key}: one value only; allowed: two or more")
        self.grid = Grid((keys[-2], keys[-1]), page)
        self.cut = cuts.read(self.cut, self.grid.every, faults)


def cases(order: Order) -> Iterator[Job]:
    """The run from rest of every cell of the coarse grid."""
    from campaigns.regime_map.maps import job_at
    from engine.massless import why_not_covered

    grid = order.options.grid
    order.periods, order.looks, order.transient = BUDGET, True, None
    if grid is None:
        return
    order.tell(f"--set {one.key}: this campaign sets it" for one in grid.every if one.key in order.changes)
    base = order.base(tell=True)
    if base is None:
        return
    if not (in_regular_waves(base) and carries_tangents(base)):
        allowed = motions.ONLY.removeprefix("a number for ")
        order.tell([f"campaigns.regime_map: given {order.name!r} as it is; allowed: {allowed}"])
        return
    for cell in grid.coarse():
        before, job = len(order.faults), job_at(order, grid, cell)
        if job is None or len(order.faults) > before:  # hundreds of others may be at fault in the same way
            at = " and ".join(f"{key} = {value}" for key, value in grid.labels(cell).items())
            order.tell([f"--vary: that is at {at}, the first cell of the map that cannot be"])
            return
        if order.options.screen and (reason := why_not_covered(job.scene)):
            order.tell([f"--screen: given; allowed: only what a massless tether covers, and this has {reason}"])
            return
        yield job


def measures(order: Order) -> Measures:
    """The row of a motion."""
    from campaigns.regime_map.maps import cell_row
    from campaigns.regime_map.tables import motion_columns

    columns = motion_columns(order.options.grid.columns)
    return Measures(columns, cell_row, (*ROW_SOURCES, "campaigns/regime_map"), {})


def runs(order: Order) -> Callable:
    """In place of `runner.run`: the screen, the coarse grid, its borders."""

    def whole_map(plan: Plan, jobs: list[Job]) -> tuple[dict[str, float], Summary]:
        from campaigns.regime_map.maps import Map

        found = Map(plan, order, order.options.grid, jobs)
        found.screened()
        summary = Summary([], 0, 0, 0.0)
        if not order.options.screen:
            found.level(order.options.grid.coarse(), jobs)
            found.refine(order.options.refine)
            summary = found.write()
        return found.timing(), summary

    return whole_map


def parameters(order: Order) -> dict[str, object]:
    own = order.options
    told: dict[str, object] = {"vary": {one.key: list(one.values) for one in own.grid.keys}}
    if own.grid.page is not None:
        told["pages"] = {own.grid.page.key: list(own.grid.page.values)}
    told |= {"starts": own.starts, "kick_speed_mps": own.kick_speed, "seed": own.seed, "budget": own.budget}
    return told | {"refine": own.refine, "screen": own.screen}


def answer(order: Order, rows: list[dict]) -> list[str]:
    """What the map shows (`answer.sentences`)."""
    from campaigns.regime_map.answer import sentences

    cells: tuple[dict, ...] = ()
    with contextlib.suppress(OSError, ValueError):
        cells = read_rows(order.how.out / "cells" / "table.csv")
    keys = [one for one in order.options.grid.every if one.key.startswith("buoy.")]
    known: dict[tuple, object] = {}

    def scene(row: dict) -> object:
        values = tuple(row[one.key] for one in keys)
        if values not in known:
            changes: dict[str, object] = {}
            for one, value in zip(keys, values, strict=True):
                order.tell(one.put(value, order.base(), changes))
            known[values] = order.scene(changes)
        return known[values]

    return [*sentences(cells, rows, order.options.grid.columns, scene)]


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
parser, read_order = STUDY.parser, STUDY.read_order


def main(argv: list[str] | None = None, simulate: Callable | None = None) -> int:
    """The command: a map, or with --cut a sweep in its folder. simulate: in place of engine.simulate."""
    argv = list(sys.argv[1:] if argv is None else argv)

    def work(order: Order, words: list[str]) -> int:
        return cuts.cut(order, simulate) if order.options.cut else STUDY.conduct(order, words, simulate)

    return session.command(STUDY.called, argv, read_order, work)
