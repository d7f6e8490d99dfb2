"""Measured orders: `orders.csv`, one row a series of runs whose step, grid or tolerance is refined.

Series in time and in space are judged by the differences of neighbours in the series, which need no reference; their
slopes are log2 of the ratios of successive differences, the order the last of them. Works in which the rope goes slack
are also judged by their samples before it first does ("-early"). Breaking lines are refined in time and space at once,
and judged by their errors against the exact solution. Tolerances of one grid, against a run on it: slope
of the error against the tolerance, least squares.
"""

import math
from itertools import pairwise
from pathlib import Path

import numpy as np

from campaigns.accuracy.points import ORDERS, plain
from campaigns.accuracy.rows import kept_samples, rms_mm
from campaigns.accuracy.works import BY_NAME, UNITS
from campaigns.columns import Column
from campaigns.machinery.folder import Table, trajectory_path
from campaigns.machinery.plan import KeptRun

WITHIN = 0.15  # of theory, the last slope
STEADY = 0.6  # of theory, every slope: where they jump about, the last is right by chance
COLUMNS = (
    Column("work", symbol="work", meaning="what is simulated"),
    Column("kind", symbol="refined", meaning="what is halved: time, space or both; or the tolerance"),
    Column("method", symbol="method", meaning="integrator or scheme"),
    Column("theory", "", "theory", "order that theory gives", 2),
    Column("order", "", "measured", "last of the slopes", 2),
    Column("slopes", symbol="slopes", meaning="log2 of the ratios of neighbours, coarse to fine"),
    Column("errors", symbol="errors", meaning="differences of neighbours, or errors, coarse to fine"),
    Column("unit", symbol="unit", meaning="of the errors"),
    Column("settings", symbol="settings", meaning="steps, nodes or tolerances of the series"),
    Column("within", "", "within", f"1 where the last slope is within {WITHIN:g} of theory and none is far off", 0),
    Column("rough", symbol="not smooth", meaning="why no order is expected"),
    Column("note", symbol="note", meaning="runs that ended early"),
)
# an adaptive method keeps its estimate of the error of a step, of order p_e + 1, at rtol: the error goes with
# rtol^(p/(p_e + 1)), p_e = 3 for esdirk43 (p = 4) and 2 for trbdf2 (p = 2), whose estimate is that of its own order
TOLERANCE_SLOPE = {"esdirk43": 1.0, "trbdf2": 2.0 / 3.0}


def write(out: Path, rows: list[dict]) -> None:
    """Write orders.csv and its dictionary beside table.csv. Raises OSError."""
    found = orders(out, rows)
    table = Table(out / "orders.csv", COLUMNS, list(map(str, range(len(found)))))
    table.rows = dict(zip(table.keys, found, strict=True))
    table.write()


def orders(out: Path, rows: list[dict]) -> list[dict]:
    """The rows of orders.csv from those of table.csv, which name the runs in `out`."""
    found = []
    for work in BY_NAME.values():
        own = [row for row in rows if row["work"] == work.name]
        for kind in ("time", "space"):
            for method in _methods(own, kind):
                theory = ORDERS[method] if kind == "time" else 2
                series = _series(own, kind, method)
                found.append(_by_differences(out, work, kind, method, theory, series))
                if early := first_slack(out, work, own):
                    found.append(_by_differences(out, work, kind, method, theory, series, early))
        found += [_by_errors(work, method, _series(own, "both", method)) for method in _methods(own, "both")]
        found += [_by_tolerance(work, method, own) for method in _methods(own, "tolerance")]
    return [row for row in found if row]


def _methods(rows: list[dict], kind: str) -> list[str]:
    return list(dict.fromkeys(row["method"] for row in rows if row["kind"] == kind and _is_ours(row)))


def _is_ours(row: dict) -> bool:
    return plain(row["method"]) in ORDERS


def _series(rows: list[dict], kind: str, method: str) -> list[dict]:
    """Rows of a series, coarse to fine."""
    chosen = [row for row in rows if row["kind"] == kind and row["method"] == method]
    return sorted(chosen, key=lambda row: (row["nodes"], -row["setting"]))


def first_slack(out: Path, work, rows: list[dict]) -> int:
    """Number of samples of a rough work's reference before its rope first goes slack; 0 where it does not."""
    from engine import Trajectory

    reference = next((row for row in rows if row["kind"] == "reference" and row["status"] == "ok"), None)
    if not work.rough or reference is None:
        return 0
    run = Trajectory.load(trajectory_path(out, reference["run_key"]))
    return int(np.argmax(run.columns["tension_min_N"] <= 0.0))


def _by_differences(out: Path, work, kind: str, method: str, theory: float, series: list[dict], early: int = 0) -> dict:
    """early: number of samples that are compared, 0 for all."""
    samples = [kept_samples(work, KeptRun(trajectory_path(out, row["run_key"]))) for row in series]
    if early:
        samples = [None if values is None else values[:early] for values in samples]
        kind = f"{kind}-early"
    named = [row["nodes"] if kind.startswith("space") else row["setting"] for row in series]
    found = [_difference(*pair) for pair in pairwise(samples)]
    row = _judged(work, kind, method, theory, found, named, _failures(series))
    return row | ({"rough": ""} if early else {})


def _difference(coarse, fine) -> float:
    return math.nan if coarse is None or fine is None else rms_mm(coarse, fine)


def _failures(series: list[dict]) -> str:
    failed = [row for row in series if row["status"] != "ok"]
    statuses = ", ".join(dict.fromkeys(row["status"] for row in failed))
    return f"{len(failed)} of {len(series)} runs ended early: {statuses}" if failed else ""


def _by_errors(work, method: str, series: list[dict]) -> dict:
    theory = min(2, ORDERS[plain(method)])  # that of space; the viscosity's limiter leaves it alone
    errors = [row["error"] if row.get("error") is not None else math.nan for row in series]
    return _judged(work, "both", method, theory, errors, [row["nodes"] for row in series], _failures(series))


def _by_tolerance(work, method: str, rows: list[dict]) -> dict:
    series = [row for row in _series(rows, "tolerance", method) if row.get("error") is not None]
    if len(series) < 3:
        return {}
    settings = [row["setting"] for row in series]
    errors = [row["error"] for row in series]
    fitted = float(np.polyfit(np.log(settings), np.log(np.maximum(errors, 1e-12)), 1)[0])
    row = _judged(work, "tolerance", method, TOLERANCE_SLOPE[method], errors, settings, "")
    return row | {"order": fitted, "slopes": "", "within": ""}


def _judged(work, kind, method, theory, errors, settings, note) -> dict:
    with np.errstate(all="ignore"):
        slopes = np.log2(np.divide(errors[:-1], errors[1:])) if len(errors) > 1 else np.array([])
    known = slopes[np.isfinite(slopes)]
    order = float(known[-1]) if len(known) else math.nan
    steady = np.all(np.abs(known - theory) <= STEADY)
    return {
        "work": work.name,
        "kind": kind,
        "method": method,
        "theory": theory,
        "order": "" if math.isnan(order) else order,
        "slopes": " ".join(f"{slope:.3f}" for slope in slopes),
        "errors": " ".join(f"{error:.4g}" for error in errors),
        "unit": UNITS[work.measure],
        "settings": " ".join(f"{setting:g}" for setting in settings),
        "within": "" if math.isnan(order) else int(bool(abs(order - theory) <= WITHIN and steady)),
        "rough": work.rough,
        "note": note,
    }
