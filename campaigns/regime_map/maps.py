"""The motions of every cell of a map, round after round; its borders bisected; its tables and its picture as it fills.

A judged run of a cell is that of the sweep, and ends earlier: at its first look at which it repeats, and at the latest
after --budget wave periods. A cut goes on with it. What is known of the cells is written every DRAWN_S.
"""

import contextlib
import math
import time
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import replace

import engine
from analysis.evidence import read_evidence
from analysis.looks import CLOSE, NO_GROWTH
from campaigns.columns import number
from campaigns.explore.along import Lattice, Motion, from_rest
from campaigns.explore.proposals import screened
from campaigns.explore.rows import buoy_row
from campaigns.explore.starts import DISPLACED, start_job
from campaigns.explore.sweep import job_of
from campaigns.explore.transients import outlasting
from campaigns.judge import judged_job, judged_scene
from campaigns.machinery.folder import write_table
from campaigns.machinery.plan import Job, Plan, Summary
from campaigns.machinery.progress import print_line
from campaigns.machinery.runner import run
from campaigns.regime_map import tables
from campaigns.regime_map.cells import Cell, Grid, Quadtree
from campaigns.regime_map.tables import STATIC
from campaigns.study import Order
from engine.at_rest import static_tension_N

DRAWN_S = 30.0
LEAP = 1.2  # largest tensions of neighbours whose ratio is beyond this have a border between them
CHEAP, FULL = "cheap", "full"


def cell_row(trajectory, checks=None) -> dict[str, object]:
    """The row of a judged run of a cell, and which evidence its regime has.

    A run that repeats at its last look counts as periodic after this one look, where it repeats closely, or where its
    perturbations do not grow.
    """
    row = buoy_row(trajectory, None, checks)
    period = row.get("strobed_period")
    met = {name for name, *_, met in read_evidence(row.get("evidence") or "") if met == "yes"}
    if row.get("regime") == "undecided" and period and met & {CLOSE, NO_GROWTH}:
        row |= {"regime": f"period-{period:g}", "verdict": CHEAP}
    elif row.get("regime"):
        row["verdict"] = FULL
    first = (trajectory.columns[name][:1] for name in ("radius_rate_mps", "angle_rate_radps"))
    if all(len(rate) and rate[0] == 0.0 for rate in first):
        row[STATIC.name] = number(static_tension_N(trajectory.scene, trajectory.columns))
    return row


def job_at(order: Order, grid: Grid, cell: Cell) -> Job | None:
    """The run from rest of a cell; None where there is no such scene, as between two whole numbers: it is told."""
    changes, faults = grid.changes(cell, order.base())
    order.tell(faults)
    scene = None if faults else judged_scene(order, changes)
    if scene is None:
        return None
    labels = grid.labels(cell) | {"dimensions": scene.motion.dimensions}
    return judged_job(order, labels, scene, most=order.options.budget)


class Map(Lattice):
    """The motions of the cells of a map, by number."""

    like = 0.2

    def __init__(self, plan: Plan, order: Order, grid: Grid, coarse: list[Job]):
        super().__init__(replace(plan, on_row=self._hear), grid.columns)
        self.order, self.grid, self.coarse, self.tree = order, grid, coarse, Quadtree()
        self.jobs: list[Job] = []  # from rest, by cell
        self.keys_of: dict[Motion, str] = {}
        self.rows: dict[str, dict] = {}
        self.screen: list[list[dict]] = []
        self.times: Counter = Counter()
        self.made: set[str] = set()
        self.drawn_s = time.monotonic()

    def beside(self, at: int) -> dict[int, str]:
        """`Lattice.beside`."""
        return self.tree.beside(at)

    def screened(self) -> None:
        """Let a massless tether do the coarse grid. Raises OSError."""
        own, began = self.order.options, time.perf_counter()
        self.screen = screened(self.plan, [job.scene for job in self.coarse], own.kick_speed, own.seed)
        self.times["run_s"] += time.perf_counter() - began
        tables.write_screen(self.plan.how.out, self.grid, self.coarse, self.screen)
        self._show()

    def timing(self) -> dict[str, float]:
        """Seconds of all that was done."""
        return {name: self.times[name] + self.starts.times[name] for name in ("compile_s", "run_s", "analysis_s")}

    def level(self, cells: list[Cell], jobs: list[Job]) -> None:
        """Compute cells: from rest, every other motion, and its judged run. Raises as `runner.run`."""
        own, first = self.order.options, jobs[0].scene
        self.tree.add(cells)
        self.jobs += jobs
        real = self.plan.simulate is engine.simulate
        ahead = [start_job({}, first, DISPLACED, ())] if real and engine.massless_covers(first) else []
        self._run(jobs, "runs from rest", ahead)
        self._run(outlasting(self.jobs, self.rows, self.beside), "chaos that may be a transient")
        places = self.add(jobs, [self.rows[job.key] for job in jobs if job.key in self.rows])
        if real:
            self.find(own.starts - 1, own.kick_speed, own.seed, places)
        others = {motion: self._job(motion) for motion, _ in self.beside_rest(self.jobs)}
        others = {motion: job for motion, job in others.items() if motion not in self.keys_of}
        self._run([*others.values()], "judged runs of the other motions")
        self.keys_of |= {motion: job.key for motion, job in others.items()}
        self.judged(others, [*self.rows.values()])
        self.name()
        self.write()

    def _job(self, motion: Motion) -> Job:
        return job_of(self.order, self.jobs[motion.at], motion, {}, self.order.options.budget)

    def _run(self, jobs: list[Job], title: str, ahead: Sequence[Job] = ()) -> None:
        if not jobs:
            return
        timing, summary = run(replace(self.plan, title=title), jobs, ahead)
        self.made |= summary.made
        self.rows |= {row["run_key"]: row for row in summary.rows}
        self.times.update(timing)

    def refine(self, most: int) -> None:
        """Bisect cells at borders, coarse ones first, into `most` more of them. Raises as `runner.run`."""
        while most >= 4:
            cells, jobs = [], []
            for cell in self.borders():
                parts = cell.parts()
                found = [job_at(self.order, self.grid, part) for part in parts]
                if None not in found and len(cells) + 4 <= most:
                    cells += parts
                    jobs += found
            if not cells:
                return
            most -= len(cells)
            self.level(cells, jobs)

    def borders(self) -> list[Cell]:
        """The cells of the coarsest level that differ from one that touches them, the largest leap of tension first."""
        leaves = self.tree.leaves()
        found = {cell: self._apart(cell) for cell in leaves}
        wanted = [cell for cell in leaves if found[cell] > 0.0]
        least = min((cell.level for cell in wanted), default=0)
        return sorted((cell for cell in wanted if cell.level == least), key=lambda cell: -found[cell])

    def _apart(self, cell: Cell) -> float:
        """Largest ratio of largest tensions of a cell and those that touch it; 0 where no border runs there."""
        own, most = self.told(self.tree.number[cell]), 0.0
        for there in self.tree.touching(cell):
            other = self.told(self.tree.number[there])
            ratio = math.exp(abs(math.log(own[1] / other[1]))) if own[1] and other[1] else 1.0
            if own[0] != other[0] or ratio > LEAP:
                most = max(most, ratio)
        return most

    def told(self, at: int) -> tuple[tuple, float]:
        """What borders lie between: regime from rest and number of motions of a cell; and its largest tension, N."""
        some = self.motions[at]
        rest = self.rows.get(self.jobs[at].key, {})
        return (rest.get("regime"), len(some)), max((self.tension_N(one) for one in some), default=0.0)

    def row_of(self, motion: Motion) -> dict:
        """The row of the judged run of a motion; {} where there is none yet."""
        key = self.jobs[motion.at].key if from_rest({"found_by": motion.found_by}) else self.keys_of.get(motion, "")
        return self.rows.get(key, {})

    def tension_N(self, motion: Motion) -> float:
        """The largest tension of a motion, by its judged run where there is one."""
        return self.row_of(motion).get("tension_top_max_N") or motion.tension_N

    def motion_rows(self) -> Iterator[dict]:
        """Rows of table.csv: the motions of each cell, and the run from rest of one that has none."""
        for at, (cell, job) in enumerate(zip(self.tree.cells, self.jobs, strict=True)):
            some = self.motions[at] if at < len(self.motions) else []
            named = {**job.labels, "level": cell.level}
            if not any(from_rest({"found_by": one.found_by}) for one in some) and job.key in self.rows:
                yield {**self.rows[job.key], **named}
            for motion in sorted(some, key=lambda one: (len(one.branch.letter), one.branch.letter)):
                yield {**self.row_of(motion), **named, **self.labels(motion)}

    def write(self) -> Summary:
        """Write the tables, and draw the map; returns the summary of the rows. Raises OSError."""
        out, rows = self.plan.how.out, [*self.motion_rows()]
        write_table(out / "table.csv", self.plan.columns, rows)
        if self.starts.ended:
            self.starts.write()
        tables.write_strobes(out, self)
        self._show()
        kept = sum(row.get("run_key") not in self.made for row in rows)
        return Summary(rows, kept, len(rows) - kept, self.times["analysis_s"])

    def _hear(self, row: dict) -> None:
        if "regime" in row or row.get("status") != "ok":
            self.rows[row["run_key"]] = row
        if time.monotonic() - self.drawn_s > DRAWN_S:
            self._show()

    def _show(self) -> None:
        """Write what is known of the cells, and draw it where reports can."""
        out = self.plan.how.out
        tables.write_cells(out, self)
        with contextlib.suppress(ImportError):
            from reports.regime_map import draw

            try:
                draw(out, out / "map.png")
            except OSError:
                raise
            except Exception as error:  # a map without a picture is a map
                print_line(f"map.png: {type(error).__name__}: {error}")
        self.drawn_s = time.monotonic()
