"""The runs in all seas of one state together, as a row of cells/table.csv.

exponent     mean over the seas, from the run from rest in each
responses    from the states of all starts in a sea once a peak period
motions      from pieces of MOTION_PERIODS peak periods of all runs, by the folds of the regular waves
loads        from the runs from rest, because starts that have come together are no independent draws
"""

import math
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import chain

import numpy as np

from analysis import (
    growing_share,
    residence,
    responses,
    sea_lyapunov,
    storm_maximum,
    utilisation,
)
from analysis.sampling import standard_error
from analysis.seas import Responses
from analysis.tangent_growth import turned
from campaigns.explore.grid import place_in
from campaigns.explore.motions import write_part
from campaigns.explore.rows import EMERGENCE, TANGENT, exponents
from campaigns.explore.sweep import table_of
from campaigns.machinery import Plan, Summary, filled, run_of, stage
from campaigns.sea.regular import DESIGN, Folds, design_loads, folds_of, one_set, significant_height_m
from campaigns.sea.regular import FOLDER as REGULAR
from campaigns.sea.rows import EQUIVALENT, GROWING, MEAN, SEA, SNAPS, finite_row
from campaigns.study import Order
from engine.physics.sea import envelope_m
from engine.views import carried, state_of
from tables import EMERGED, MESSAGE, REGIMES, SHEET, STATUS, Column, Row, Rows, number_of, of_words

FOLDER = "cells"
MOTION_PERIODS = 3  # peak periods of a piece of a record: a motion of period 3 has its largest tension in each piece
ENVELOPE_SAMPLES = 8  # of the envelope of the waves, in a peak period
WELL_ABOVE = 4.0  # a distance of two responses is at least so many times the noise of the steps
BLOCK_PERIODS = 20  # peak periods of the shortest block that has a maximum
_BITS = "bits/period"
_REST = "; of the runs from rest"
COLUMNS = (
    STATUS,
    Column("significant_height_m", "m", "H_s", "significant height: four standard deviations of the surface", 2),
    Column("seas", "", "seas", "seas of this state, drawn independently", 0),
    Column("starts", "", "starts", "starts in each sea", 0),
    *TANGENT,
    of_words("sign", "of the exponent: +, − or open, by two standard errors"),
    Column("finer_bits_per_period", _BITS, "σ finer", "exponent of the runs marked finer", 3, SHEET),
    Column("finer_error", _BITS, "± σ finer", "standard error of the exponent of the finer runs", 3, SHEET),
    GROWING,
    Column("responses_mean", "", "responses", "mean number of different responses after the transient", 2),
    Column("together_periods", "periods", "together", "median time at which all starts are first one response", 0),
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
    Column("largest_N", "N", "T_max", f"largest tension after the transient{_REST}", 0),
    Column("storm_maximum_N", "N", "T_3h", "most probable largest tension in three hours", 0),
    Column("storm_low_N", "N", "T_3h low", "lower end of its 90 % interval", 0),
    Column("storm_high_N", "N", "T_3h high", "upper end of its 90 % interval", 0),
    Column(
        "load_scatter", "", "scatter",
        "range of the largest tensions of all runs in the same waves over their mean: median over the seas", 3, SHEET,
    ),
    Column("storm_reason", "", "by", "how the maximum was found, or why there is none", None, SHEET),
    EQUIVALENT,
    Column("utilisation", "", "u", "design tension over design strength, DNV-OS-E301, consequence class 1", 2),
    EMERGENCE,
    Column("regular_N", "N", "T_reg", "largest tension in the regular wave of the height H_s, of all its motions", 0),
    Column("regular_high_N", "N", "T_1.86", "largest tension in the regular wave of 1.86 H_s, of all its motions", 0),
    Column("regular_high_motions", "", "motions high", "tension of each motion in that of 1.86 H_s, kN", None, SHEET),
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
class Digest:
    """What a row of cells/table.csv needs of a run in a sea.

    row           of the run in table.csv
    states        (p, 4) once a peak period (`engine.views.state_of`)
    scale         (4,) what counts as 1 in each coordinate of these
    growth_nats   (p,) growth of its perturbation in each peak period; None: it carried none
    high_N        (n,) largest tension in each step of the samples after the transient
    large         (m,) whether each piece of the record is in the large motion
    forecast      (m,) whether it would be in the large motion if the motion followed a slow envelope
    """

    row: Row
    scene: object
    states: np.ndarray
    scale: np.ndarray
    growth_nats: np.ndarray | None
    high_N: np.ndarray
    large: np.ndarray
    forecast: np.ndarray


def digest(run, row: Row, transient: int, folds: Folds | None) -> Digest:
    """The digest of a run that reached its end. transient: peak periods left out."""
    period_s, step_s, columns = run.scene.waves.period_s, run.scene.sample_step_s(), run.columns
    samples = period_s / step_s  # of a peak period
    strobes = np.rint(np.arange(0.0, len(columns["time_s"]) - 0.5, samples)).astype(int)
    coordinates, scale = state_of(run.scene, columns, 0)
    states = np.column_stack([series[strobes] for series in coordinates.values()])
    growth_nats = run.tangent.growth_nats[:, 0] if carried(run) else None
    high_N = columns["tension_top_high_N"]
    large = forecast = np.zeros(0, bool)
    ends = strobes[transient + MOTION_PERIODS :]
    begins = strobes[transient : len(strobes) - MOTION_PERIODS]
    if folds is not None and len(ends):
        amplitude_m = _amplitudes_of_pieces(run.scene, len(strobes) - 1)[transient:]
        largest_N = np.array([high_N[begin:end].max() for begin, end in zip(begins, ends, strict=True)])
        large = folds.is_large(amplitude_m, largest_N)
        forecast = folds.forecast(amplitude_m, bool(large[0]))
    late_N = high_N[round(transient * samples) :]
    return Digest(row, run.scene, states, np.array(scale), growth_nats, late_N, large, forecast)


def _amplitudes_of_pieces(scene, periods: int) -> np.ndarray:
    """Mean of the envelope of the waves (m) over each piece in the first `periods` peak periods.

    A piece of MOTION_PERIODS begins in every peak period.
    """
    count = periods * ENVELOPE_SAMPLES
    times_s = np.arange(count) * scene.waves.period_s / ENVELOPE_SAMPLES
    of_periods = envelope_m(scene, times_s).reshape(periods, ENVELOPE_SAMPLES).mean(axis=1)
    return np.convolve(of_periods, np.full(MOTION_PERIODS, 1.0 / MOTION_PERIODS), "valid")


def write_cells(order: Order, plan: Plan, summary: Summary) -> float:
    """Write cells/table.csv, a row a sea state, and of a single state history/table.csv. Returns seconds."""
    start_s = time.perf_counter()
    options = order.options
    folds, regular_rows = None, ()
    if not options.no_regular and one_set(order):
        folder = order.how.out / REGULAR
        regular_rows = table_of(folder)
        folds = folds_of(regular_rows, table_of(folder / "ends"))
    keys = options.grid.columns
    rows_at = {}  # by the values of the keys
    for row in summary.rows:
        rows_at.setdefault(place_in(row, keys), []).append(row)
    cells = []
    with stage("what the runs of each sea state say together", len(rows_at), "states", lambda: len(cells)):
        for place, rows in rows_at.items():
            digests = []
            for row in rows:
                run = run_of(plan.out, row)
                if run is not None:
                    digests.append(digest(run, row, options.transient, folds))
            cell = filled(keys, place) | cell_row(rows, digests, options, folds)
            if digests:
                height_m = significant_height_m(digests[-1].scene)
                cell |= {"significant_height_m": height_m, **_regular_loads(regular_rows, height_m)}
            cells.append(cell)
    write_part(plan, FOLDER, (*keys, *COLUMNS), cells)
    if not keys:
        in_history = [run for run in digests if run.row["sea"] <= options.seeds]
        write_part(plan, HISTORY, HISTORY_COLUMNS, history(in_history, options))
    return time.perf_counter() - start_s


def _regular_loads(regular_rows: Rows, height_m: float) -> Row:
    """The columns on the loads in regular waves of the significant height, and of DESIGN times this height."""
    row = {}
    for name, ratio in (("regular", 1.0), ("regular_high", DESIGN)):
        loads = design_loads(regular_rows, 0.5 * ratio * height_m)
        if loads:
            motions = ", ".join(f"{letter} {load_N / 1e3:.3g}" for letter, load_N in loads)
            row |= {f"{name}_N": loads[-1][1], f"{name}_motions": motions}
    return row


def cell_row(rows: Rows, digests: Sequence[Digest], options, folds: Folds | None) -> Row:
    """The columns of one sea state but for its height and its regular waves.

    rows: of all its runs. digests: of the runs that reached their end.
    """
    if not digests:
        return {"status": str(rows[0]["status"]), "message": str(rows[0]["message"])}
    seas = seas_of(digests)
    cell = {"status": "ok", "seas": len(seas), "starts": options.starts}
    lost = len(rows) - len(digests)
    if lost:
        cell["message"] = f"{lost} of {len(rows)} runs failed"
    rest = [run for run in digests if run.row["start"] == 0 and not run.row["solver"]]
    finer = [run for run in digests if run.row["solver"]]
    cell |= _exponent(rest, finer, options) | _together(seas, options)
    if folds is not None:
        cell |= {"fold_up_m": folds.jump(True), "fold_down_m": folds.jump(False)}
        cell |= _visits("large", seas) | _visits("forecast", seas)
    if rest:
        cell |= _loads(rest, options) | {"load_scatter": _scatter(digests)}
    cell[EMERGED] = max(number_of(run.row, EMERGED) for run in digests)
    return finite_row(cell)


def seas_of(digests: Sequence[Digest]) -> list[list[Digest]]:
    """The runs in each sea, in the order of their seeds, without finer runs."""
    seas = {}
    for run in sorted(digests, key=lambda run: run.row["sea"]):
        if not run.row["solver"]:
            seas.setdefault(run.row["sea"], []).append(run)
    return [*seas.values()]


def _exponent(rest: Sequence[Digest], finer: Sequence[Digest], options) -> Row:
    """The columns on the exponent, from the runs from rest, and from the finer ones."""
    growths = _growths(rest)
    exponent = sea_lyapunov(growths, options.transient)
    row = exponents(TANGENT, exponent)
    if not exponent.found:
        return row
    row["sign"] = "open"
    if abs(exponent.value) > 2.0 * exponent.error:
        row["sign"] = "+" if exponent.value > 0.0 else "−"
    shares = [growing_share(turned(growth, options.transient), options.window) for growth in growths]
    row[GROWING.name] = float(np.mean(shares))
    check = sea_lyapunov(_growths(finer), options.transient)
    return row | {"finer_bits_per_period": check.value, "finer_error": check.error}


def _growths(runs: Sequence[Digest]) -> list[np.ndarray]:
    """The growth of the perturbations of those runs that carry one."""
    return [run.growth_nats for run in runs if run.growth_nats is not None]


def responses_of(sea: Sequence[Digest], distance: float) -> Responses:
    """The responses of all starts in one sea."""
    states = np.stack([run.states for run in sea])
    return responses(states, np.max([run.scale for run in sea], axis=0), distance)


def _together(seas: Sequence[Sequence[Digest]], options) -> Row:
    """The columns on the responses of all starts."""
    answers = [responses_of(sea, options.distance) for sea in seas if len(sea) > 1]
    if not answers:
        return {}
    met = [answer for answer in answers if math.isfinite(answer.together_at)]
    mean_count = np.mean([answer.counts[options.transient :].mean() for answer in answers])
    row = {"responses_mean": mean_count, "apart_seas": len(answers) - len(met), "distance": options.distance}
    if met:
        periods = sum(len(answer.counts) - answer.together_at for answer in met)
        duration_s = periods * seas[0][0].scene.waves.period_s
        row |= {
            "together_periods": np.median([answer.together_at for answer in met]),
            "together_share": np.mean([answer.together_share for answer in met]),
            "together_mean_periods": np.mean([answer.together_mean for answer in met]),
            "partings_per_hour": 3600.0 * sum(answer.partings for answer in met) / duration_s,
            "noise": np.median([answer.noise for answer in met]),
        }
    return row


def _visits(name: str, seas: Sequence[Sequence[Digest]]) -> Row:
    """The columns on the large motion, from the field of this name of the runs: "large" or "forecast"."""
    flags = []  # of the runs in each sea
    for sea in seas:
        flags.append([getattr(run, name) for run in sea])
    visits = residence(list(chain.from_iterable(flags)))
    row = {f"{name}_share": visits.share, f"{name}_mean_periods": visits.mean}
    if len(seas) > 1:
        row[f"{name}_share_error"] = standard_error([residence(of_sea).share for of_sea in flags])
    return row


def _scatter(digests: Sequence[Digest]) -> float:
    """Range of the largest tensions of all runs in the same waves over their mean: the median over the seas.

    The runs in a sea are compared over the length of the shortest one, which is a finer run. Seas of one run do not
    count.
    """
    tensions_N = {}  # of the runs, by sea
    for run in digests:
        tensions_N.setdefault(run.row["sea"], []).append(run.high_N)
    ranges = []
    for sea in tensions_N.values():
        if len(sea) > 1:
            shortest = min(map(len, sea))
            largest_N = [high_N[:shortest].max() for high_N in sea]
            ranges.append(np.ptp(largest_N) / np.mean(largest_N))
    return float(np.median(ranges)) if ranges else math.nan


def history(digests: Sequence[Digest], options) -> Iterator[Row]:
    """The responses in every sea over time, and the motion of its first run: a row a peak period."""
    for sea in seas_of(digests):
        first = sea[0]
        answer = responses_of(sea, options.distance)
        for period, (count, distance) in enumerate(zip(answer.counts, answer.apart, strict=True)):
            row = {"sea": first.row["sea"], "period": period, "responses": count, "apart": distance}
            piece = period - options.transient
            if 0 <= piece < len(first.large):
                row |= {"large": int(first.large[piece]), "forecast": int(first.forecast[piece])}
            yield row


def _loads(rest: Sequence[Digest], options) -> Row:
    """The columns on snaps and loads, from the runs from rest."""
    rates, means_N, ranges_N = (
        np.array([number_of(run.row, column.name) for run in rest]) for column in (SNAPS, MEAN, EQUIVALENT)
    )
    mean_N = float(np.mean(means_N))
    row = {
        SNAPS.name: float(np.mean(rates)),
        MEAN.name: mean_N,
        EQUIVALENT.name: float(np.mean(ranges_N**options.slope) ** (1.0 / options.slope)),
    }
    if len(rates) > 1:
        row["snaps_per_hour_error"] = standard_error(rates)
    highs_N, scene = [run.high_N for run in rest], rest[0].scene
    storm = storm_maximum(highs_N, scene.sample_step_s(), least_block_s=BLOCK_PERIODS * scene.waves.period_s)
    row |= {"largest_N": max(high_N.max() for high_N in highs_N), "storm_reason": storm.reason}
    if storm.found:
        row |= {"storm_maximum_N": storm.value, "storm_low_N": storm.low, "storm_high_N": storm.high}
        breaking_N = options.breaking_load or scene.tether.breaking_load_N
        if breaking_N is not None:
            row["utilisation"] = utilisation(mean_N, storm.value, breaking_N)
    return row
