"""The motions of every cell of a map, level after level; its borders bisected; its tables and its picture as it fills.

A judged run of a cell is that of the sweep, and ends earlier: at its first look at which it repeats, and at the latest
after --budget wave periods. A cut goes on with it. What is known of the cells is written every DRAWN_S.
"""

import contextlib
import math
import time
from dataclasses import replace

from analysis.evidence import read_evidence
from analysis.looks import CLOSE, NO_GROWTH
from campaigns.explore.motions import Motion, Motions, Search
from campaigns.explore.proposals import screened
from campaigns.explore.rows import buoy_row
from campaigns.explore.stages import explore
from campaigns.machinery import Jobs, Plan, Summary, print_line
from campaigns.regime_map import tables
from campaigns.regime_map.cells import Cell, Quadtree
from campaigns.regime_map.tables import STATIC
from campaigns.study import Order
from engine.run.rest import static_tension_N
from tables import Row, finite

DRAWN_S = 30.0
LEAP = 1.2  # largest tensions of neighbours whose ratio is beyond this have a border between them
MATCH_DISTANCE = 0.2  # of motions of neighbours
CHEAP, FULL = "cheap", "full"


def cell_row(trajectory, judgement) -> Row:
    """The row of a judged run of a cell, and which evidence its regime has.

    A run that repeats at its last look counts as periodic after this one look, where it repeats closely, or where its
    perturbations do not grow.
    """
    row = buoy_row(trajectory, judgement)
    period = row.get("strobed_period")
    passed = {name for name, *_, met in read_evidence(row.get("evidence") or "") if met == "yes"}
    if row.get("regime") == "undecided" and period and passed & {CLOSE, NO_GROWTH}:
        row |= {"regime": f"period-{period:g}", "verdict": CHEAP}
    elif row.get("regime"):
        row["verdict"] = FULL
    columns = trajectory.columns
    if [*columns["radius_rate_mps"][:1], *columns["angle_rate_radps"][:1]] == [0.0, 0.0]:
        row[STATIC.name] = finite(static_tension_N(trajectory.scene, columns))
    return row


class Map(Motions):
    """The cells of a map with their motions, both by number of the cell."""

    def __init__(self, plan: Plan, order: Order):
        self.order, self.grid, self.tree = order, order.options.grid, Quadtree()
        plan = replace(plan, on_row=self._hear)
        super().__init__(plan, self.grid.columns, self.tree.neighbours, MATCH_DISTANCE)
        self.screen = []  # motions of a massless tether, by coarse cell
        self.drawn_s = time.monotonic()

    def run_screen(self, coarse: Jobs) -> None:
        """Let a massless tether do the coarse grid, of which these are the runs from rest. Raises OSError."""
        options = self.order.options
        self.screen = screened(self.plan, [job.scene for job in coarse], options.kick_speed, options.seed)
        tables.write_screen(self.plan, self.grid, coarse, self.screen)
        self._show()

    def compute(self, cells: list[Cell], jobs: Jobs) -> Summary:
        """Compute the motions of cells, whose runs from rest these are. Raises as `runner.run`."""
        options = self.order.options
        search = Search(self.order, options.starts - 1, options.kick_speed, options.seed, options.budget)
        self.tree.add(cells)
        explore(self, jobs, search)
        summary = self.write()
        tables.write_strobes(self)
        self._show()
        return summary

    def refine(self, summary: Summary) -> Summary:
        """Bisect cells at borders, coarse ones first, into --refine more of them. Raises as `runner.run`."""
        room = self.order.options.refine
        while room >= 4:
            cells, jobs = [], []
            for cell in self.borders():
                parts = cell.parts()
                jobs_of_parts = [self.grid.job_at(self.order, part) for part in parts]
                if None not in jobs_of_parts and len(cells) + 4 <= room:
                    cells += parts
                    jobs += jobs_of_parts
            if not cells:
                break
            room -= len(cells)
            summary = self.compute(cells, jobs)
        return summary

    def borders(self) -> list[Cell]:
        """The cells of the coarsest level that differ from one that touches them, the largest leap of tension first."""
        leaps = {}  # by level and cell
        for cell in self.tree.leaves():
            leap = self._leap(cell)
            if leap > 0.0:
                leaps.setdefault(cell.level, {})[cell] = leap
        if not leaps:
            return []
        coarsest = leaps[min(leaps)]
        return sorted(coarsest, key=lambda cell: -coarsest[cell])

    def _leap(self, cell: Cell) -> float:
        """Largest ratio of largest tensions of a cell and those that touch it; 0 where no border runs there."""
        kind, tension_N = self.kind(cell), self.largest_N(cell)
        leap = 0.0
        for neighbour in self.tree.touching(cell):
            neighbour_N, ratio = self.largest_N(neighbour), 1.0
            if tension_N and neighbour_N:
                ratio = math.exp(abs(math.log(tension_N / neighbour_N)))
            if kind != self.kind(neighbour) or ratio > LEAP:
                leap = max(leap, ratio)
        return leap

    def kind(self, cell: Cell) -> tuple[object, int]:
        """Regime from rest and number of motions of a cell: where they differ, a border runs."""
        place = self.tree.number[cell]
        rest = self.rows.get(self.jobs[place].key, {})
        return rest.get("regime"), len(self.at[place])

    def largest_N(self, cell: Cell) -> float:
        """The largest tension of the motions of a cell."""
        return max(map(self.tension_N, self.at[self.tree.number[cell]]), default=0.0)

    def tension_N(self, motion: Motion) -> float:
        """The largest tension of a motion, by its judged run where there is one."""
        return self.row_of(motion).get("tension_top_max_N") or motion.tension_N

    def _hear(self, row: dict) -> None:
        if "regime" in row or row.get("status") != "ok":
            self.rows[row["run_key"]] = row
        if time.monotonic() - self.drawn_s > DRAWN_S:
            self._show()

    def _show(self) -> None:
        """Write what is known of the cells, and draw it where reports can."""
        out = self.plan.out
        tables.write_cells(self)
        with contextlib.suppress(ImportError):
            from reports.regime_map import draw

            try:
                draw(out, out / "map.png")
            except OSError:
                raise
            except Exception as error:  # a map without a picture is a map
                print_line(f"map.png: {type(error).__name__}: {error}")
        self.drawn_s = time.monotonic()
