"""The study of eq. (33): what each part computes, and how it is kept.

A part is a function of the oscillator and the order; it gives arrays and the numbers of its row. Both are kept in a
netCDF-3 file, whose key is a hash of the part, its parameters and the sources of `analysis`. The row is an attribute of
the file, so table.csv can be made again from the files.
"""

import json
import time
from collections import Counter
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import asdict
from functools import partial
from pathlib import Path

import numpy as np
import xarray

from analysis.compiled import source_hash
from analysis.oscillator import (
    SnapOscillator,
    search_periodic_orbits,
    settled_periods,
    snap_diagram,
    snap_exponents,
    snap_motion,
    start_grid,
    strobed_states,
    strobed_states_within,
)
from analysis.oscillator.growth import random_starts
from campaigns.figure_data import attribute_of, store
from campaigns.machinery import Summary, Table, made_by, stage, trajectory_path
from campaigns.oscillator.options import Options
from campaigns.study import Order
from engine.atomic import write_atomic
from tables import MESSAGE, RUN_KEY, STATUS, Column, Row, of_words

SEED = 0
Result = tuple[dict[str, np.ndarray], Row]  # arrays by name, numbers of the row
COLUMNS = (
    of_words("part", "what is computed"),
    STATUS,
    Column("lambda_1_nats_per_time", "nats/time", "λ_1", "largest exponent, mean over the starts", 6),
    Column("lambda_1_error", "nats/time", "± λ_1", "its standard error", 6),
    Column("lambda_1_bits_per_period", "bits/period", "λ_1", "the same in bits per forcing period", 6),
    Column("lambda_1_bits_error", "bits/period", "± λ_1", "its standard error", 6),
    Column("lambda_2_nats_per_time", "nats/time", "λ_2", "smaller exponent", 6),
    Column("sum_plus_damping", "nats/time", "λ_1 + λ_2 + μ", "zero in theory", 4),
    Column("section_dimension", "", "D", "Kaplan-Yorke dimension of the section", 4),
    Column("section_dimension_error", "", "± D", "its standard error", 4),
    Column("slack_fraction", "", "χ", "share of the time in which the tether is slack", 3),
    Column("starts", "", "starts", "motions followed", 0),
    Column("elsewhere", "", "elsewhere", "starts left out because they settled on a periodic attractor", 0),
    Column("periods", "", "periods", "forcing periods of each motion", 0),
    Column("transient", "", "left out", "forcing periods left out before", 0),
    Column("points", "", "points", "points, orbits or values in the arrays of the part", 0),
    Column("wall_s", "s", "wall", "wall-clock time of the part", 2),
    RUN_KEY,
    MESSAGE,
)
START = (0.68, 0.0)  # the rest position of the taut tether
ZOOMS = (10.0, 100.0)
LONGEST_ORBIT = 8
HISTORY_PERIODS = 24


def _scaled(usual: int, effort: float, least: int) -> int:
    return max(least, round(usual * effort))


def section(o: SnapOscillator, options: Options) -> Result:
    """Figure 19(b), and two nested zooms round the place that the orbit visits most."""
    points, transient = _scaled(120_000, options.effort, 500), 1000
    states = strobed_states(o, START, points, transient)
    boxes = zoom_boxes(states)
    longest = _scaled(20_000_000, options.effort, 2000)
    zooms, seen = strobed_states_within(o, START, boxes, _scaled(40_000, options.effort, 200), longest, transient)
    arrays = {"section": states, "boxes": boxes}
    for number, zoom in enumerate(zooms, 1):
        if len(zoom):
            arrays[f"zoom_{number}"] = zoom
    return arrays, {"points": points, "transient": transient, "periods": seen}


def zoom_boxes(states: np.ndarray) -> np.ndarray:
    """Boxes (2, 4), a tenth and a hundredth of the section's extent, round its densest point."""
    from scipy.spatial import cKDTree

    low, extent = states.min(axis=0), np.maximum(np.ptp(states, axis=0), 1e-9)
    tree = cKDTree((states - low) / extent)
    candidates = tree.data[:: max(1, len(states) // 4000)]
    neighbours = tree.query_ball_point(candidates, 0.5 / ZOOMS[-1], return_length=True)
    centre = candidates[int(np.argmax(neighbours))] * extent + low
    half = 0.5 * extent / np.array(ZOOMS)[:, None]
    return np.stack([centre - half, centre + half], axis=2).reshape(len(ZOOMS), 4)


def history(o: SnapOscillator, options: Options) -> Result:
    """The first periods from START, with the switching times."""
    motion = dict(vars(snap_motion(o, START, HISTORY_PERIODS, 128)))
    row = {"periods": HISTORY_PERIODS, "slack_fraction": motion.pop("slack_fraction")}
    return {name: values for name, values in motion.items() if len(values)}, row


def exponents(o: SnapOscillator, options: Options) -> Result:
    """Both exponents over many random starts, with their errors, and how they settle with time."""
    starts, periods, transient = _scaled(512, options.effort, 16), 10_000, 1000
    exponent = snap_exponents(o, count=starts, transient_periods=transient, periods=periods, blocks=50, seed=SEED)
    arrays = {
        "of_start": exponent.of_start,
        "convergence": exponent.convergence,
        "of_block": exponent.of_block[:, :, 0],
    }
    bits = exponent.first.in_bits_per_period(o.period)
    row = {
        "lambda_1_nats_per_time": exponent.first.value,
        "lambda_1_error": exponent.first.error,
        "lambda_1_bits_per_period": bits.value,
        "lambda_1_bits_error": bits.error,
        "lambda_2_nats_per_time": exponent.second.value,
        "sum_plus_damping": exponent.first.value + exponent.second.value + o.damping,
        "section_dimension": exponent.dimension,
        "section_dimension_error": exponent.dimension_error,
        "slack_fraction": exponent.slack_fraction,
        "starts": exponent.starts,
        "elsewhere": exponent.elsewhere,
        "periods": periods,
        "transient": transient,
    }
    return arrays | {"block_error": np.array([exponent.block_error])}, row


def diagram(over: str, o: SnapOscillator, options: Options) -> Result:
    """Orbit diagram over "force" or "frequency" with exponents."""
    ranges = {"force": options.forces, "frequency": options.frequencies}
    low, high, count = ranges[over]
    values = np.linspace(low, high, _scaled(count, min(options.effort, 1.0), 2))
    points = snap_diagram(o, over, values, count=4, transient_periods=500, periods=1000, points=150, seed=SEED)
    displacement = points.section[..., 0].reshape(len(values), -1)
    arrays = dict(vars(points)) | {"values": values, "section": displacement}
    del arrays["over"]
    return arrays, {"starts": 4, "periods": 1000, "transient": 500, "points": len(values)}


def orbits(o: SnapOscillator, options: Options) -> Result:
    """Periodic orbits up to period 8, stable and unstable, by Newton's method from points of the section and a grid."""
    guesses = _scaled(400, options.effort, 20)
    settled, ends = settled_periods(o, random_starts(_scaled(300, options.effort, 40), SEED), 1500)
    starts = np.concatenate([strobed_states(o, START, guesses, 1000), start_grid(12, 8)])
    table, points = [], []
    for period in range(1, LONGEST_ORBIT + 1):
        for orbit in search_periodic_orbits(o, period, np.concatenate([ends[settled == period][:1], starts])):
            table.append([period, *orbit.multipliers.view(float), orbit.gap, len(points)])
            points.extend(orbit.points)
    arrays = {}
    if table:
        arrays = {"table": np.array(table), "points": np.array(points)}
    return arrays, {"points": len(table), "starts": len(starts)}


PARTS = {
    "section": section,
    "history": history,
    "exponents": exponents,
    "orbits": orbits,
    "diagram-force": partial(diagram, "force"),
    "diagram-frequency": partial(diagram, "frequency"),
}


def parameters(options: Options) -> dict:
    """What the provenance says of this study besides who ran it, where and with what."""
    return {
        "oscillator": asdict(SnapOscillator(**options.changes)),
        "force_range": list(options.forces),
        "frequency_range": list(options.frequencies),
        "effort": options.effort,
        "seed": SEED,
        "analysis_source_hash": source_hash(),
    }


def perform(order: Order) -> Summary:
    """Do every part that is not there yet; keep table.csv up to date. Returns times and the summary.

    Parts run beside each other in threads, because the compiled loops that they spend their time in hold no lock.
    """
    options = order.options
    oscillator, out = SnapOscillator(**options.changes), order.how.out
    numbers = [f"{key} = {value!r}" for key, value in asdict(oscillator).items()]
    head = "# eq. (33), dimensionless, as run\n[oscillator]\n"
    write_atomic(out / "scene.toml", (head + "\n".join(numbers) + "\n").encode())
    keys = {part: _key(part, options) for part in PARTS}
    table = Table(out / "table.csv", COLUMNS, list(keys.values()))
    missing = []
    for part, key in keys.items():
        row = attribute_of(trajectory_path(out, key), "row")
        if row is None:
            missing.append(part)
        else:
            table.rows[key] = json.loads(row) | {"run_key": key}
    table.write()
    times = Counter()
    if missing:
        times["compile_s"] = _compile(oscillator)
    begun = time.perf_counter()
    with stage("parts", len(PARTS), "parts", lambda: len(table.rows)), ThreadPoolExecutor(order.how.jobs) as threads:
        parts = {
            threads.submit(_done, part, oscillator, options, trajectory_path(out, keys[part])): part for part in missing
        }
        try:
            for done in as_completed(parts):
                key = keys[parts[done]]
                table.rows[key] = done.result() | {"run_key": key}
                table.write()
        except BaseException:  # Ctrl-C, a full disk: what has not begun is left
            threads.shutdown(wait=False, cancel_futures=True)
            raise
    times["run_s"] = time.perf_counter() - begun
    return Summary(table.in_order(), len(PARTS) - len(missing), len(missing), times)


def _key(part: str, options: Options) -> str:
    settings = {"part": part} | parameters(options)
    if part != "diagram-force":
        del settings["force_range"]
    if part != "diagram-frequency":
        del settings["frequency_range"]
    return made_by(**settings)


def _compile(oscillator: SnapOscillator) -> float:
    begun = time.perf_counter()
    with stage("eq. (33), loaded or compiled"):
        snap_exponents(oscillator, count=2, transient_periods=1, periods=2, blocks=2)
    return time.perf_counter() - begun


def _done(part: str, oscillator: SnapOscillator, options: Options, path: Path) -> Row:
    begun = time.perf_counter()
    try:
        arrays, row = PARTS[part](oscillator, options)
    except Exception as error:  # one part that fails must not take the others along
        return {"part": part, "status": "error", "message": f"{type(error).__name__}: {error}"}
    row = {"part": part, "status": "ok", **row, "wall_s": round(time.perf_counter() - begun, 3)}
    variables = {}
    for name, values in arrays.items():
        axes = [f"{name}_{axis}" for axis in range(values.ndim)]
        variables[name] = axes, values
    store(path, xarray.Dataset(variables, attrs={"row": json.dumps(row, default=lambda number: number.item())}))
    return row
