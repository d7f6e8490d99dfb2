"""A run of the accuracy campaign as one row: what it was, its error, what it cost. And the measured orders.

`orders.csv` has one row a series of runs whose step, grid or tolerance is refined.

Series in time and in space are judged by the differences of neighbours in the series, which need no reference; their
slopes are log2 of the ratios of successive differences, the order the last of them. Works in which the rope goes slack
are also judged by their samples before it first does ("-early"). Breaking lines are refined in time and space at once,
and judged by their errors against the exact solution. Tolerances of one grid, against a run on it: slope
of the error against the tolerance, least squares.
"""

import math
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path

import numpy as np

from campaigns.accuracy.plan import BY_NAME, ORDERS, RADIUS, STRAIN, UNITS, Work, plain
from campaigns.machinery import run_of
from tables import MESSAGE, RUN_KEY, STATUS, WALL_S, Column, Row, Rows, columns, counted, number_of, of_words

STEPPING = (columns.STEPS, columns.REJECTED, columns.NEWTON, columns.NEWTON_FAILURES)
COUNTED = (columns.END_S, *STEPPING, columns.LOOPS, columns.TURN)
COLUMNS = (
    of_words("work", "what is simulated"),
    of_words("kind", "what the run is for"),
    of_words("method", "integrator or scheme of the engine, or the other code"),
    Column("nodes", "", "nodes", "nodes of the line; segments or elements of other codes", 0),
    of_words("control", "what is varied: a tolerance, a step, a Courant number"),
    Column("setting", "", "setting", "its value in the first round", 6),
    Column("round", "", "round", "turn of a timed setting", 0),
    STATUS,
    Column("error", "", "error", "distance from the reference, or from the exact solution, in error_unit", 4),
    Column("error_early", "", "early", "the same over the first half of the run", 4),
    of_words("error_unit", "mm, or per cent of the static strain", "unit"),
    Column("error_against_ours", "", "off ours", "distance of another code from our refined run, in error_unit", 4),
    WALL_S,
    *COUNTED,
    of_words("peer_version", "of the other code", "version"),
    RUN_KEY,
    MESSAGE,
)
EARLY = 0.5  # share of the run over which error_early is taken


def point_row(trajectory, work_name: str, reference: np.ndarray | None = None, ours: np.ndarray | None = None) -> Row:
    """The columns of `COLUMNS` that a run fills; those left out are unknown.

    reference, ours: the samples that error and error_against_ours are taken against, None for none; the error of a
    breaking line is taken against the exact solution. A run that ended early has no error.
    """
    work = BY_NAME[work_name]
    row = counted(trajectory, (WALL_S, *COUNTED)) | {"error_unit": UNITS[work.measure]}
    if trajectory.status != "ok":
        return row
    if work.measure == STRAIN:
        return row | {"error": strain_error(trajectory)}
    samples = samples_of(work, trajectory)
    if reference is not None:
        early = int(EARLY * len(reference))
        row |= {"error": rms_mm(samples, reference), "error_early": rms_mm(samples[:early], reference[:early])}
    if ours is not None:
        row["error_against_ours"] = rms_mm(samples, ours)
    return row


def samples_of(work: Work, trajectory) -> np.ndarray:
    """What is compared: r (m,) in m, or places (m, 3)."""
    if work.measure == RADIUS:
        return trajectory.columns["radius_m"]
    return np.stack([trajectory.columns[name] for name in ("x_m", "y_m", "z_m")], axis=1)


def kept_samples(work: Work, out: Path, key: str) -> np.ndarray | None:
    """The samples of a finished run; None where there is none, or where it ended early."""
    run = run_of(out, {"run_key": key, "status": "ok"})
    if run is None or run.status != "ok":
        return None
    return samples_of(work, run)


def rms_mm(samples: np.ndarray, reference: np.ndarray) -> float:
    """rms distance in mm of two series of the same length in m; inf where the lengths differ."""
    if samples.shape != reference.shape:
        return math.inf
    square = (samples - reference) ** 2
    if square.ndim == 2:
        square = square.sum(axis=1)
    return 1e3 * float(np.sqrt(np.mean(square)))


def strain_error(trajectory) -> float:
    """Mean over line and profiles of |strain - exact strain|, per cent of the static strain."""
    from campaigns.breaking_line.theory import theory_of

    scene, lines = trajectory.scene, trajectory.profiles
    motion = theory_of(scene, float(lines.time_s[-1])).motion
    exact = np.array([motion.at(lines.s_m, float(time_s))[0] for time_s in lines.time_s[1:]])
    share = np.trapezoid(np.abs(lines.strain[1:] - exact), lines.s_m, axis=1) / scene.tether.length_m
    return 100.0 * float(share.mean()) / float(lines.strain[0].mean())


KINDS = ("time", "space", "both", "tolerance")  # of runs that are series
WITHIN = 0.15  # of theory, the last slope
STEADY = 0.6  # of theory, every slope: where they jump about, the last is right by chance
ORDER_COLUMNS = (
    of_words("work", "what is simulated"),
    of_words("kind", "what is halved: time, space or both; or the tolerance", "refined"),
    of_words("method", "integrator or scheme"),
    Column("theory", "", "theory", "order that theory gives", 2),
    Column("order", "", "measured", "last of the slopes", 2),
    of_words("slopes", "log2 of the ratios of neighbours, coarse to fine"),
    of_words("errors", "differences of neighbours, or errors, coarse to fine"),
    of_words("unit", "of the errors"),
    of_words("settings", "steps, nodes or tolerances of the series"),
    Column("within", "", "within", f"1 where the last slope is within {WITHIN:g} of theory and none is far off", 0),
    of_words("rough", "why no order is expected", "not smooth"),
    of_words("note", "runs that ended early"),
)
# an adaptive method keeps its estimate of the error of a step, of order p_e + 1, at rtol: the error goes with
# rtol^(p/(p_e + 1)), p_e = 3 for esdirk43 (p = 4) and 2 for trbdf2 (p = 2), whose estimate is that of its own order
TOLERANCE_SLOPE = {"esdirk43": 1.0, "trbdf2": 2.0 / 3.0}


def orders(out: Path, rows: Rows) -> list[Row]:
    """The rows of orders.csv from those of table.csv, which name the runs in `out`; in the order of the table."""
    series = {}
    for row in rows:
        if row["kind"] in KINDS and plain(row["method"]) in ORDERS:
            series.setdefault((row["work"], row["kind"], row["method"]), []).append(row)
    slack, order_rows = {}, []
    for name, work in BY_NAME.items():
        if work.rough:
            slack[name] = first_slack(out, work, rows)
    for (work, kind, method), members in series.items():
        members.sort(key=lambda row: (row["nodes"], -row["setting"]))  # coarse to fine
        if kind == "both":  # theory: the order in space; the viscosity's limiter leaves it alone
            errors = [number_of(row, "error") for row in members]
            order_rows.append(_judged(kind, min(2, ORDERS[plain(method)]), members, errors))
        elif kind == "tolerance":
            order_rows += _over_tolerances(method, members)
        else:
            order_rows += _of_differences(out, BY_NAME[work], kind, method, members, slack.get(work, 0))
    return order_rows


def _over_tolerances(method: str, series: Rows) -> Iterator[Row]:
    """The slope of the errors over the tolerance; none of fewer than three."""
    series = [row for row in series if row.get("error") is not None]
    if len(series) > 2:
        errors = [row["error"] for row in series]
        logs = np.log([row["setting"] for row in series]), np.log(np.maximum(errors, 1e-12))
        row = _judged("tolerance", TOLERANCE_SLOPE[method], series, errors)
        yield row | {"order": float(np.polyfit(*logs, 1)[0]), "slopes": "", "within": ""}


def _of_differences(out: Path, work: Work, kind: str, method: str, series: Rows, early: int) -> Iterator[Row]:
    """The order of a series in time or in space; where the rope goes slack also that of the `early` samples before."""
    samples = [kept_samples(work, out, row["run_key"]) for row in series]
    theory = 2
    if kind == "time":
        theory = ORDERS[method]
    yield _judged(kind, theory, series, _differences(samples))
    if early:
        row = _judged(kind, theory, series, _differences(samples, early))
        yield row | {"kind": f"{kind}-early", "rough": ""}


def first_slack(out: Path, work: Work, rows: Rows) -> int:
    """Number of samples of a rough work's reference before its rope first goes slack; 0 where it does not."""
    wanted = {"work": work.name, "kind": "reference", "status": "ok"}
    for row in rows:
        if wanted.items() <= row.items():
            return int(np.argmax(run_of(out, row).columns["tension_min_N"] <= 0.0))
    return 0


def _differences(samples: list, count: int | None = None) -> list[float]:
    """Distances of neighbours, nan where one of them gave nothing; count: of so many samples, None: of all."""
    differences = []
    for coarse, fine in pairwise(samples):
        difference = math.nan
        if coarse is not None and fine is not None:
            difference = rms_mm(coarse[:count], fine[:count])
        differences.append(difference)
    return differences


def _judged(kind: str, theory: float, series: Rows, errors: list[float]) -> Row:
    work = BY_NAME[series[0]["work"]]
    with np.errstate(all="ignore"):
        slopes = np.log2(np.divide(errors[:-1], errors[1:]))
    finite = slopes[np.isfinite(slopes)]
    order, within, note = "", "", ""
    if len(finite):
        order = float(finite[-1])
        within = int(abs(order - theory) <= WITHIN and np.all(np.abs(finite - theory) <= STEADY))
    control = "nodes"
    if kind in ("time", "tolerance"):
        control = "setting"
    failed = [row["status"] for row in series if row["status"] != "ok"]
    if failed:
        note = f"{len(failed)} of {len(series)} runs ended early: {', '.join(dict.fromkeys(failed))}"
    return {
        "work": work.name,
        "kind": kind,
        "method": series[0]["method"],
        "theory": theory,
        "order": order,
        "slopes": " ".join(f"{slope:.3f}" for slope in slopes),
        "errors": " ".join(f"{error:.4g}" for error in errors),
        "unit": UNITS[work.measure],
        "settings": " ".join(f"{row[control]:g}" for row in series),
        "within": within,
        "rough": work.rough,
        "note": note,
    }
