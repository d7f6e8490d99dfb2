"""What all runs in one sea state say together, as a row of cells/table.csv.

exponent     mean over the seas, from their runs from rest
responses    all starts of a sea, strobed once a peak period, with the same seed
motions      pieces of MOTION_PERIODS peak periods of all runs, by the folds of the regular waves
loads        runs from rest, because starts that have come together are no independent draws
"""

import math
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from analysis import (
    envelope,
    growing_share,
    residence,
    responses,
    sea_lyapunov,
    storm_maximum,
    utilisation,
)
from analysis.tangent_growth import turned
from campaigns.explore.motions import subfolder
from campaigns.explore.rows import TANGENT, exponents
from campaigns.machinery.folder import run_of
from campaigns.machinery.plan import Plan, Summary
from campaigns.machinery.progress import stage
from campaigns.sea.regular import (
    DESIGN,
    Folds,
    design_loads,
    folds_of,
    one_set,
    regular_tables,
    significant_height_m,
)
from campaigns.sea.rows import EQUIVALENT, GROWING, MEAN, SEA, SNAPS
from campaigns.study import Order
from engine.physics.sea import elevation_m
from engine.views import carried, state_of
from tables import MESSAGE, REGIMES, SHEET, STATUS, Column, Row, finite, names, number_of, write_table

FOLDER = "cells"
MOTION_PERIODS = 3  # of a piece of a record that belongs to a motion: a period 3 shows all its waves
WELL_ABOVE = 4.0  # times the noise of the steps: the least distance of two responses
BLOCK_PERIODS = 20  # of the shortest block of a maximum
_BITS = "bits/period"
_REST = "; of the runs from rest"
COLUMNS = (
    STATUS,
    Column("significant_height_m", "m", "H_s", "significant height: four standard deviations of the surface", 2),
    Column("seas", "", "seas", "seas of this state, drawn independently", 0),
    Column("starts", "", "starts", "starts in each sea", 0),
    *TANGENT,
    Column("sign", "", "sign", "of the exponent: +, − or open, by two standard errors", None),
    Column("finer_bits_per_period", _BITS, "σ finer", "exponent of the run marked finer", 3, SHEET),
    Column("finer_error", _BITS, "± σ finer", "standard error of the exponent of the finer run", 3, SHEET),
    GROWING,
    Column("responses_mean", "", "responses", "mean number of different responses after the transient", 2),
    Column("together_periods", "periods", "together", "median time at which all starts are first one response", 0),
    Column("together_latest_periods", "periods", "latest", "the latest of these times over the seas", 0, REGIMES),
    Column("apart_seas", "", "apart", "seas in which the starts are never one response", 0),
    Column("together_share", "", "stays", "share of the time, once together, that they are one response", 2),
    Column("together_mean_periods", "periods", "stay", "mean time for which they stay together", 0, REGIMES),
    Column("partings_per_hour", "1/h", "partings", "how often they part again", 1, REGIMES),
    Column("distance", "", "distance", "nearer starts are one response, as a share of the motion", 3, SHEET),
    Column("noise", "", "noise", "median distance of the starts while together: what the steps leave", 5, SHEET),
    Column("large_share", "", "large", "share of the time in the large motion of regular waves", 3),
    Column("large_share_error", "", "± large", "standard error over seas", 3),
    Column("large_mean_periods", "periods", "visit", "mean length of a visit to the large motion", 1),
    Column("forecast_share", "", "forecast", "share if the motion followed the envelope from fold to fold", 3),
    Column("forecast_share_error", "", "± forecast", "standard error over seas", 3),
    Column("forecast_mean_periods", "periods", "visit, forecast", "mean length of a visit by that forecast", 1),
    Column("fold_up_m", "m", "A up", "amplitude at which a slowly rising wave brings the large motion", 3, SHEET),
    Column("fold_down_m", "m", "A down", "amplitude at which a slowly falling wave ends it", 3, SHEET),
    SNAPS,
    Column("snaps_per_hour_error", "1/h", "± snaps", f"standard error over seas{_REST}", 1),
    MEAN,
    Column("storm_maximum_N", "N", "T_3h", "most probable largest tension in three hours", 0),
    Column("storm_low_N", "N", "T_3h low", "lower end of its 90 % interval", 0),
    Column("storm_high_N", "N", "T_3h high", "upper end of its 90 % interval", 0),
    Column("storm_reason", "", "by", "how the maximum was found, or why there is none", None, SHEET),
    EQUIVALENT,
    Column("utilisation", "", "u", "design tension over design strength, DNV-OS-E301, consequence class 1", 2),
    Column("regular_N", "N", "T_reg", "largest tension in the regular wave of the height H_s, of all its motions", 0),
    Column("regular_high_N", "N", "T_1.86", "largest tension in the regular wave of 1.86 H_s, of all its motions", 0),
    Column("regular_motions", "", "motions", "largest tension of each motion in the regular wave, kN", None, SHEET),
    MESSAGE,
)  # fmt: skip
HISTORY = "history"
HISTORY_COLUMNS = (
    SEA,
    Column("period", "periods", "t/T_p", "time in peak periods", 0),
    Column("responses", "", "responses", "different responses of the starts", 0),
    Column("apart", "", "apart", "largest distance of two starts, as a share of the motion", 4),
    Column("large", "", "large", "1 while the run from rest is in the large motion", 0),
    Column("forecast", "", "forecast", "1 while a slow envelope would have it there", 0),
)


@dataclass(frozen=True)
class Record:
    """A run of a cell: its row, scene, trajectory and the first sample after the transient."""

    row: Row
    run: object
    first: int

    @property
    def step_s(self) -> float:
        return self.run.scene.sample_step_s()

    def samples(self, periods: float) -> float:
        """Samples in so many peak periods."""
        return periods * self.run.scene.waves.period_s / self.step_s


def write_cells(order: Order, plan: Plan, summary: Summary) -> float:
    """Write cells/table.csv: a row a sea state. Returns seconds."""
    began = time.perf_counter()
    folds, regular_rows = None, ()
    if not order.options.no_regular and one_set(order):
        regular_rows, ends = regular_tables(order)
        folds = folds_of(regular_rows, ends)
    keys = order.options.grid.columns
    of_cell: dict[tuple, list[Row]] = {}
    for row in summary.rows:
        of_cell.setdefault(tuple(row[name] for name in names(keys)), []).append(row)
    cells: list[Row] = []
    with stage("what the runs of each sea state say together", len(of_cell), "states", lambda: len(cells)):
        for place, rows in of_cell.items():
            cell = dict(zip(names(keys), place, strict=True))
            cells.append(cell | cell_row(order, plan, rows, folds, regular_rows))
    write_table(subfolder(plan, FOLDER) / "table.csv", (*keys, *COLUMNS), cells)
    if not keys:
        records = [record for record in _records(order, plan, summary.rows) if not record.row["solver"]]
        write_table(subfolder(plan, HISTORY) / "table.csv", HISTORY_COLUMNS, history(records, order.options, folds))
    return time.perf_counter() - began


def history(records: Sequence[Record], options, folds: Folds | None) -> Iterator[Row]:
    """The responses of every sea over time, and the motion of its run from rest: a row a peak period."""
    for sea in seas_of(records):
        counts, apart = np.ones(0), np.ones(0)
        if len(sea) > 1:
            states, scale = strobed(sea)
            answer = responses(states, scale, options.distance)
            counts, apart = answer.counts, answer.apart
        inside = forecast = np.zeros(0, bool)
        if folds is not None:
            inside, forecast = motion_of(sea[0], folds)
        length = max(len(counts), options.transient + len(inside))
        for period in range(length):
            row: Row = {"sea": sea[0].row["sea"], "period": period}
            if period < len(counts):
                row |= {"responses": int(counts[period]), "apart": float(apart[period])}
            piece = period - options.transient
            if 0 <= piece < len(inside):
                row |= {"large": int(inside[piece]), "forecast": int(forecast[piece])}
            yield row


def cell_row(order: Order, plan: Plan, rows: Sequence[Row], folds: Folds | None, regular_rows: Sequence[Row]) -> Row:
    """The columns of one sea state from the rows of its runs."""
    options = order.options
    records, finer = [], None
    for record in _records(order, plan, rows):
        if record.row["solver"]:
            finer = record
        else:
            records.append(record)
    if not records:
        return {"status": str(rows[0]["status"]), "message": str(rows[0]["message"])}
    height_m = significant_height_m(records[0].run.scene)
    lost = sum(row["status"] != "ok" for row in rows)
    cell: Row = {
        "status": "ok",
        "significant_height_m": height_m,
        "seas": len({record.row["sea"] for record in records}),
        "starts": options.starts,
        "message": f"{lost} of {len(rows)} runs failed" if lost else "",
    }
    rest = [record for record in records if record.row["start"] == 0]
    cell |= _exponent(rest, finer, options) | _together(records, options)
    if folds is not None:
        cell |= _motions(records, folds)
    if rest:
        cell |= _loads(rest, options)
    for name, height in (("regular_N", 1.0), ("regular_high_N", DESIGN)):
        loads = design_loads(regular_rows, 0.5 * height * height_m)
        if loads:
            cell[name] = loads[-1][1]
        if loads and height == 1.0:
            cell["regular_motions"] = ", ".join(f"{letter} {load_N / 1e3:.3g}" for letter, load_N in loads)
    return {name: finite(entry) if isinstance(entry, float) else entry for name, entry in cell.items()}


def _records(order: Order, plan: Plan, rows: Sequence[Row]) -> Iterator[Record]:
    """The runs of rows that reached their end."""
    for row in rows:
        run = run_of(plan.how.out, row)
        if run is not None:
            transient_s = order.options.transient * run.scene.waves.period_s
            yield Record(row, run, round(transient_s / run.scene.sample_step_s()))


def _exponent(rest: Sequence[Record], finer: Record | None, options) -> Row:
    growths = [record.run.tangent.growth_nats[:, 0] for record in rest if carried(record.run)]
    exponent = sea_lyapunov(growths, options.transient)
    row = exponents(TANGENT, exponent)
    if not exponent.found:
        return row
    row["sign"] = "open"
    if abs(exponent.value) > 2.0 * exponent.error:
        row["sign"] = "+" if exponent.value > 0.0 else "−"
    shares = [growing_share(turned(growth, options.transient), options.window) for growth in growths]
    row[GROWING.name] = float(np.mean(shares))
    if finer is not None and carried(finer.run):
        check = sea_lyapunov([finer.run.tangent.growth_nats[:, 0]], options.transient)
        row |= {"finer_bits_per_period": check.value, "finer_error": check.error}
    return row


def seas_of(records: Sequence[Record]) -> Iterator[list[Record]]:
    """The records of each sea."""
    for seed in sorted({record.row["sea"] for record in records}):
        yield [record for record in records if record.row["sea"] == seed]


def strobed(sea: Sequence[Record]) -> tuple[np.ndarray, np.ndarray]:
    """States (starts, periods, 4) of the runs in one sea once a peak period, and what counts as 1 in each (4,)."""
    states, scales = [], []
    for record in sea:
        period_s = record.run.scene.waves.period_s
        coordinates, scale = state_of(record.run.columns, record.step_s, period_s, 0)
        count = int((len(record.run.columns["time_s"]) - 1) / record.samples(1.0) + 1e-6)
        index = np.rint(np.arange(count + 1) * record.samples(1.0)).astype(int)
        states.append(np.column_stack([series[index] for series in coordinates.values()]))
        scales.append(scale)
    shortest = min(map(len, states))
    return np.stack([state[:shortest] for state in states]), np.max(scales, axis=0)


def _together(records: Sequence[Record], options) -> Row:
    """The columns on the responses of all starts."""
    if options.starts < 2:
        return {}
    counts, times, shares, stays, noises, partings, hours, apart = [], [], [], [], [], 0, 0.0, 0
    for sea in seas_of(records):
        if len(sea) < 2:
            continue
        states, scale = strobed(sea)
        answer = responses(states, scale, options.distance)
        counts.append(answer.counts[options.transient :].mean())
        if math.isnan(answer.together_at):
            apart += 1
            continue
        times.append(answer.together_at)
        shares.append(answer.together_share)
        stays.append(answer.together_mean)
        noises.append(answer.noise)
        partings += answer.partings
        hours += (len(answer.counts) - answer.together_at) * sea[0].run.scene.waves.period_s / 3600.0
    if not counts:
        return {}
    row: Row = {"responses_mean": float(np.mean(counts)), "apart_seas": apart, "distance": options.distance}
    if times:
        noise = float(np.median(noises))
        row |= {
            "together_periods": float(np.median(times)),
            "together_latest_periods": float(max(times)),
            "together_share": float(np.mean(shares)),
            "together_mean_periods": float(np.mean(stays)),
            "partings_per_hour": partings / hours,
            "noise": noise,
        }
    return row


def pieces_of(record: Record) -> tuple[np.ndarray, np.ndarray]:
    """First sample and end of each piece of a record, one about each peak period after the transient."""
    last = len(record.run.columns["time_s"]) - record.samples(MOTION_PERIODS)
    begins = np.rint(np.arange(record.first, last, record.samples(1.0))).astype(int)
    return begins, begins + round(record.samples(MOTION_PERIODS))


def motion_of(record: Record, folds: Folds) -> tuple[np.ndarray, np.ndarray]:
    """Whether each piece of a record is in the large motion, and whether the forecast says so."""
    columns = record.run.columns
    begins, ends = pieces_of(record)
    surface_m = elevation_m(record.run.scene, columns["time_s"])
    amplitude_m = envelope(surface_m)
    if not len(begins):
        return np.zeros(0, bool), np.zeros(0, bool)
    mean_m = np.array([amplitude_m[begin:end].mean() for begin, end in zip(begins, ends, strict=True)])
    largest_N = np.array(
        [columns["tension_top_high_N"][begin:end].max() for begin, end in zip(begins, ends, strict=True)]
    )
    inside = folds.is_large(mean_m, largest_N)
    return inside, folds.forecast(mean_m, bool(inside[0]))


def _motions(records: Sequence[Record], folds: Folds) -> Row:
    """The columns on the small and the large motion."""
    flags: dict[str, list] = {"large": [], "forecast": []}
    shares: dict[str, list[float]] = {"large": [], "forecast": []}
    for sea in seas_of(records):
        pairs = [motion_of(record, folds) for record in sea]
        for name, series in zip(flags, zip(*pairs, strict=True), strict=True):
            flags[name] += series
            shares[name].append(residence(series).share)
    row: Row = {"fold_up_m": folds.jump(True), "fold_down_m": folds.jump(False)}
    for name in flags:
        answer = residence(flags[name])
        row |= {f"{name}_share": answer.share, f"{name}_mean_periods": answer.mean}
        if len(shares[name]) > 1:
            row[f"{name}_share_error"] = float(np.std(shares[name], ddof=1)) / math.sqrt(len(shares[name]))
    return row


def _loads(rest: Sequence[Record], options) -> Row:
    """The columns on snaps and loads."""
    rates = [number_of(record.row, SNAPS.name) for record in rest]
    means = [number_of(record.row, MEAN.name) for record in rest]
    ranges = np.array([number_of(record.row, EQUIVALENT.name) for record in rest])
    mean_N = float(np.mean(means))
    row: Row = {
        SNAPS.name: float(np.mean(rates)),
        MEAN.name: mean_N,
        EQUIVALENT.name: float(np.mean(ranges**options.slope) ** (1.0 / options.slope)),
    }
    if len(rates) > 1:
        row["snaps_per_hour_error"] = float(np.std(rates, ddof=1)) / math.sqrt(len(rates))
    highs = [record.run.columns["tension_top_high_N"][record.first :] for record in rest]
    block_s = BLOCK_PERIODS * rest[0].run.scene.waves.period_s
    storm = storm_maximum(highs, rest[0].step_s, least_block_s=block_s)
    row["storm_reason"] = storm.reason
    if storm.found:
        row |= {"storm_maximum_N": storm.value, "storm_low_N": storm.low, "storm_high_N": storm.high}
        if options.breaking_load is not None:
            row["utilisation"] = utilisation(mean_N, storm.value, options.breaking_load)
    return row
