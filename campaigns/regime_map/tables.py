"""Tables of a map: its motions, its cells, the massless screen, and the strobes of every motion.

map_: `campaigns.regime_map.maps.Map`.
"""

import io
from collections.abc import Iterator, Sequence

import numpy as np

from campaigns.explore.motions import Motion, write_part
from campaigns.explore.rows import EXTREMES, OUT_OF_WATER, REGIME, TANGENT
from campaigns.explore.sweep import columns_of
from campaigns.machinery import Plan
from campaigns.regime_map.cells import CellGrid
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
    Columns,
    Row,
    number_of,
    of_words,
)

STROBES = 64  # wave periods of a motion at most
LEVEL = Column("level", "", "level", "bisections that made the cell; 0: of the coarse grid", 0, SHEET)
VERDICT = Column(
    "verdict",
    "",
    "verdict",
    "cheap: the motion repeats at one look; full: the procedure of docs/motions.md#how-a-run-is-judged",
    None,
    REGIMES,
)
STATIC = Column("tension_static_N", "N", "T_0", "tension at the top at rest, of a run that begins there", 0, SHEET)
COUNT = Column("motions", "", "motions", "number of motions of the cell", 0)
TENSION = Column("tension_top_max_N", "N", "T_max", "largest tension of all motions of the cell", 0)
RATIO = Column("tension_over_static", "", "T_max/T_0", "largest tension of all motions, in tensions at rest", 2)
SHARE = Column("share_of_largest", "", "share", "share of the kicks that end in the motion of the largest tension", 2)
SOURCE = of_words("source", "computed, failed, or only screened: with a massless tether")
OF_REST = of_words("regime_rest", "regime of the motion to which rest leads", "regime")
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
    Column(
        "leaves_water", "", "out", "1 where a sphere rises above still water or, uncapped, out of a wave, else 0", 0
    ),
    Column("wall_s", "s", "wall", "time of the judged runs of the cell", 2),
    of_words("run_key_rest", "content key of the run from rest", "key"),
    STATUS,
    MESSAGE,
)
OF_THE_SCREEN = (COUNT, OF_REST, RATIO, SHARE)


def motion_columns(keys: Columns) -> Columns:
    """Those of table.csv, behind those of the keys: a row is a motion of a computed cell."""
    columns = [column for column in columns_of(keys) if column.name != "confirmed"]
    columns.insert(columns.index(REGIME) + 1, VERDICT)
    columns.insert(columns.index(EXTREMES[-1]) + 1, STATIC)
    columns.insert(len(keys), LEVEL)
    return tuple(columns)


def write_screen(plan: Plan, grid: CellGrid, jobs: Sequence, screen: Sequence[list]) -> None:
    """screen/table.csv: what a massless tether does in each cell of the coarse grid. Raises OSError."""
    rows = [{**job.labels, **screen_row(motions)} for job, motions in zip(jobs, screen, strict=True)]
    write_part(plan, "screen", (*grid.columns, *OF_THE_SCREEN), rows)


def screen_row(motions: list[dict]) -> Row:
    """The columns OF_THE_SCREEN; empty of a scene without a massless model."""
    if not motions:
        return {}
    regime = None
    for motion in motions:
        if motion["rest"]:
            regime = "irregular"
            if motion["period"]:
                regime = f"period-{motion['period']}"
            break
    largest = max(motions, key=lambda motion: motion["tension_N"])
    row = {"motions": len(motions), "regime_rest": regime, "share_of_largest": largest["share"]}
    static_N = motions[0]["static_N"]
    if static_N:
        row[RATIO.name] = largest["tension_N"] / static_N
    return row


def write_cells(map_) -> None:
    """cells/table.csv: a row for each cell of every level. Raises OSError."""
    widths = []
    for key in map_.grid.axes:
        unit, symbol = key.column.unit, f"Δ{key.column.symbol}"
        widths.append(Column(f"width_{key.key}", unit, symbol, "size of the cell", 5))
    write_part(map_.plan, "cells", (*map_.grid.columns, *widths, *OF_A_CELL), _cells(map_))


def _cells(map_) -> Iterator[dict]:
    grid, rows = map_.grid, {}
    for cell, screened in zip(grid.coarse(), map_.screen, strict=True):
        rows[cell] = {"source": SCREENED, **screen_row(screened)}
    for job, motions_of_cell, cell in zip(map_.jobs, map_.at, map_.tree.cells, strict=False):
        if job.key in map_.rows:  # the run from rest has ended
            rows.pop(cell, None)
            rows[cell] = _cell(map_, motions_of_cell, map_.rows[job.key])
    for cell, row in rows.items():
        yield {**grid.labels(cell), **grid.widths(cell), "level": cell.level, **row}


def _cell(map_, motions: Sequence[Motion], rest: dict) -> Row:
    """The columns OF_A_CELL of a cell, by its motions so far and the row of its run from rest."""
    rows = list(filter(None, map(map_.row_of, motions))) or [rest]
    exponents = [row[TANGENT[0].name] for row in rows if row.get(TANGENT[0].name) is not None]
    largest = max(motions, key=map_.tension_N, default=None)
    tension_N, source = rest.get(TENSION.name), COMPUTED
    if largest is not None:
        tension_N = map_.tension_N(largest)
    elif rest["status"] != "ok":
        source = FAILED
    static_N = rest.get(STATIC.name)
    cell = {
        "source": source,
        "motions": len(motions) or None,
        "regime_rest": rest.get("regime"),
        "period_rest": rest.get("strobed_period"),
        TENSION.name: tension_N,
        RATIO.name: None,
        "exponent_max_per_period": max(exponents, default=None),
        "loops": int(_any_above_zero(rows, LOOPS)),
        "leaves_water": int(_any_above_zero(rows, *OUT_OF_WATER)),
        "wall_s": sum(row.get(WALL_S.name) or 0.0 for row in rows),
        "run_key_rest": rest["run_key"],
        "status": rest["status"],
        "message": rest.get("message"),
    }
    if tension_N and static_N:
        cell[RATIO.name] = tension_N / static_N
    if largest is not None and map_.kicks:
        cell[SHARE.name] = largest.kicks / map_.kicks
    return cell


def _any_above_zero(rows: Sequence[dict], *columns: Column) -> bool:
    return any(number_of(row, column.name) > 0.0 for row in rows for column in columns)


def write_strobes(map_) -> None:
    """strobes.npz: r (m) once a wave period, and the largest tension (N) of the period that begins there, of a motion.

    run_key (n,), motion (n,); radius_m, tension_N (n, STROBES): nan behind the last. Raises OSError.
    """
    motions = [*map_.all_motions()]
    radius, tension = np.full((2, len(motions), STROBES), np.nan, np.float32)
    keys, letters = [], []
    for number, motion in enumerate(motions):
        points, measures = motion.settled.points[-STROBES:], motion.settled.measures[-STROBES:]
        radius[number, : len(points)] = np.hypot(points[:, 0], points[:, 1])
        tension[number, : len(measures)] = measures[:, 2]
        keys.append(map_.row_of(motion).get(RUN_KEY.name, ""))
        letters.append(motion.branch.letter)
    content, words = io.BytesIO(), {"run_key": np.array(keys, "U64"), "motion": np.array(letters, "U8")}
    np.savez_compressed(content, **words, radius_m=radius, tension_N=tension)
    write_atomic(map_.plan.out / "strobes.npz", content.getvalue())
