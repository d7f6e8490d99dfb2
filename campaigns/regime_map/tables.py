"""Tables of a map: its motions, its cells, the massless screen, and the strobes of every motion."""

import math
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from campaigns.explore.rows import COLUMNS, EXTREMES, HEIGHT, REGIME, STEEPNESS, TANGENT
from engine.atomic import write_atomic
from tables import (
    COMPUTED,
    FAILED,
    LOOPS,
    MESSAGE,
    REGIMES,
    RUN_KEY,
    SCREENED,
    SHEET,
    STATUS,
    WALL_S,
    Column,
    write_table,
)

STROBES = 64  # wave periods of a motion at most
LEVEL = Column("level", "", "level", "bisections that made the cell; 0: of the coarse grid", 0, SHEET)
VERDICT = Column(
    "verdict",
    symbol="verdict",
    meaning="cheap: the motion repeats at one look; full: the procedure of docs/motions.md#how-a-run-is-judged",
    page=REGIMES,
)
STATIC = Column("tension_static_N", "N", "T_0", "tension at the top at rest, of a run that begins there", 0, SHEET)
COUNT = Column("motions", "", "motions", "number of motions of the cell", 0)
TENSION = Column("tension_top_max_N", "N", "T_max", "largest tension of all motions of the cell", 0)
RATIO = Column("tension_over_static", "", "T_max/T_0", "largest tension of all motions, in tensions at rest", 2)
SHARE = Column("share_of_largest", "", "share", "share of the kicks that end in the motion of the largest tension", 2)
SOURCE = Column("source", symbol="source", meaning="computed, failed, or only screened: with a massless tether")
OF_REST = Column("regime_rest", symbol="regime", meaning="regime of the motion to which rest leads")
OF_A_CELL = (
    LEVEL,
    SOURCE,
    COUNT,
    OF_REST,
    Column("period_rest", "", "N", "wave periods after which the motion from rest repeats; empty: it does not", 0),
    TENSION,
    RATIO,
    SHARE,
    Column("exponent_max_per_period", "bits/period", "σ", "largest exponent of the motions that have one", 3),
    Column("loops", "", "loops", "1 where a motion released loops, else 0", 0),
    Column("leaves_water", "", "out", "1 where the sphere of a motion rises above still water, else 0", 0),
    Column("wall_s", "s", "wall", "time of the judged runs of the cell", 2),
    Column("run_key_rest", symbol="key", meaning="content key of the run from rest"),
    STATUS,
    MESSAGE,
)
OF_THE_SCREEN = (COUNT, OF_REST, RATIO, SHARE)


def motion_columns(keys: tuple[Column, ...]) -> tuple[Column, ...]:
    """Those of table.csv, behind those of the keys: a row is a motion of a computed cell."""
    left = {STEEPNESS.name, "confirmed", *(one.name for one in keys)}
    own = [one for one in COLUMNS if one.name not in left and not one.name.startswith("planar_")]
    own.insert(own.index(REGIME) + 1, VERDICT)
    own.insert(own.index(EXTREMES[-1]) + 1, STATIC)
    own.insert(0, LEVEL)
    return *keys, *own


def write_screen(out: Path, grid, jobs: Sequence, found: Sequence[list[dict]]) -> None:
    """screen/table.csv: what a massless tether does in each cell of the coarse grid. Raises OSError."""
    (out / "screen").mkdir(exist_ok=True)
    rows = [{**job.labels, **screen_row(some)} for job, some in zip(jobs, found, strict=True)]
    write_table(out / "screen" / "table.csv", (*grid.columns, *OF_THE_SCREEN), rows)


def screen_row(some: list[dict]) -> dict[str, object]:
    """The columns OF_THE_SCREEN; empty of a scene without a massless model."""
    if not some:
        return {}
    rest = next((one for one in some if one["rest"]), None)
    largest = max(some, key=lambda one: one["tension_N"])
    word = None if rest is None else f"period-{rest['period']}" if rest["period"] else "irregular"
    found = {"motions": len(some), "regime_rest": word, "share_of_largest": largest["share"]}
    return found | ({RATIO.name: largest["tension_N"] / some[0]["static_N"]} if some[0]["static_N"] else {})


def write_cells(out: Path, found) -> None:
    """cells/table.csv: a row for each cell of every level. Raises OSError."""
    (out / "cells").mkdir(exist_ok=True)
    widths = tuple(
        Column(f"width_{one.key}", one.column.unit, f"Δ{one.column.symbol}", "size of the cell", 5)
        for one in found.grid.keys
    )
    write_table(out / "cells" / "table.csv", (*found.grid.columns, *widths, *OF_A_CELL), [*_cells(found)])


def _cells(found) -> Iterator[dict]:
    grid = found.grid
    done = {cell: job for cell, job in zip(found.tree.cells, found.jobs, strict=True) if job.key in found.rows}
    for number, cell in enumerate(grid.coarse()):
        if cell not in done:
            seen = screen_row(found.screen[number]) if found.screen else {}
            yield {**_place(grid, cell), "source": SCREENED, **seen}
    for cell, job in done.items():
        yield {**_place(grid, cell), **_cell(found, found.tree.number[cell], job)}


def _place(grid, cell) -> dict[str, object]:
    widths = {f"width_{one.key}": width for one, width in zip(grid.keys, grid.widths(cell), strict=True)}
    return {**grid.labels(cell), **widths, "level": cell.level}


def _cell(found, at: int, job) -> dict[str, object]:
    """The columns OF_A_CELL of a cell whose run from rest has ended, by what is known of its motions so far."""
    some = found.motions[at] if at < len(found.motions) else []
    rest = found.rows[job.key]
    rows = [row for row in (found.row_of(one) for one in some) if row] or [rest]
    told = {"run_key_rest": job.key, "status": rest["status"], "message": rest.get("message")}
    told |= {"source": FAILED if rest["status"] != "ok" and not some else COMPUTED, "motions": len(some) or None}
    told |= {"regime_rest": rest.get("regime"), "period_rest": rest.get("strobed_period")}
    told["wall_s"] = sum(row.get(WALL_S.name) or 0.0 for row in rows)
    for name, column, above in (("loops", LOOPS, 0.0), ("leaves_water", HEIGHT, 0.0)):
        told[name] = int(any((row.get(column.name) or -math.inf) > above for row in rows))
    exponents = [row[TANGENT[0].name] for row in rows if row.get(TANGENT[0].name) is not None]
    told["exponent_max_per_period"] = max(exponents, default=None)
    largest = max(some, key=found.tension_N, default=None)
    tension = found.tension_N(largest) if largest is not None else rest.get(TENSION.name)
    static = rest.get(STATIC.name)
    told |= {TENSION.name: tension, RATIO.name: tension / static if tension and static else None}
    if largest is not None and found.kicked:
        told[SHARE.name] = largest.kicks / found.kicked
    return told


def write_strobes(out: Path, found) -> None:
    """strobes.npz: r (m) once a wave period, and the largest tension (N) of the period that begins there, of a motion.

    run_key (n,), motion (n,); radius_m, tension_N (n, STROBES): nan behind the last. Raises OSError.
    """
    import io

    some = [one for motions in found.motions for one in motions]
    radius, tension = (np.full((len(some), STROBES), np.nan, np.float32) for _ in range(2))
    for number, motion in enumerate(some):
        r, pulls = np.hypot(*motion.settled.points[-STROBES:, :2].T), motion.settled.measures[-STROBES:, 2]
        radius[number, : len(r)], tension[number, : len(pulls)] = r, pulls
    keys = np.array([str(found.row_of(one).get(RUN_KEY.name, "")) for one in some], "U64")
    letters = np.array([one.branch.letter if one.branch else "" for one in some], "U8")
    content = io.BytesIO()
    np.savez_compressed(content, run_key=keys, motion=letters, radius_m=radius, tension_N=tension)
    write_atomic(out / "strobes.npz", content.getvalue())
