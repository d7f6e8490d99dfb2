"""The parts of the study of eq. (33): what each computes.

A part is a function of the oscillator and the order; it gives arrays and the numbers of its row, and
`campaigns.oscillator.keep` keeps both.
"""

from __future__ import annotations

from argparse import Namespace
from dataclasses import replace

import numpy as np

from analysis.oscillator import (
    SnapOscillator,
    grazing_force,
    search_periodic_orbits,
    snap_basins,
    snap_diagram,
    snap_exponents,
    snap_motion,
    start_grid,
    strobed_states,
    strobed_states_within,
)
from analysis.oscillator.basin_grids import PAPER_BOX
from analysis.oscillator.growth import random_starts
from campaigns.columns import MESSAGE, RUN_KEY, STATUS, Column

SEED = 0
Result = tuple[dict[str, np.ndarray], dict[str, object]]  # arrays by name, numbers of the row
COLUMNS = (
    Column("part", symbol="part", meaning="what is computed"),
    STATUS,
    Column("lambda_1_nats_per_time", "nats/time", "λ_1", "largest exponent, mean over the starts", 6),
    Column("lambda_1_error", "nats/time", "error", "its standard error", 6),
    Column("lambda_1_bits_per_period", "bits/period", "λ_1", "the same in bits per forcing period", 6),
    Column("lambda_1_bits_error", "bits/period", "error", "its standard error", 6),
    Column("lambda_2_nats_per_time", "nats/time", "λ_2", "smaller exponent", 6),
    Column("sum_plus_damping", "nats/time", "λ_1 + λ_2 + μ", "zero in theory", 4),
    Column("section_dimension", "", "D", "Kaplan-Yorke dimension of the section", 4),
    Column("section_dimension_error", "", "error", "its standard error", 4),
    Column("slack_fraction", "", "χ", "share of the time in which the tether is slack", 3),
    Column("attractors", "", "attractors", "periodic attractors found", 0),
    Column("aperiodic_share", "", "aperiodic", "share of the starts that do not settle on a periodic attractor", 3),
    Column("grazing_force", "", "F", "forcing at which the taut motion first goes slack", 10),
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


def section(o: SnapOscillator, order: Namespace) -> Result:
    """Figure 19(b), and two nested zooms round the place that the orbit visits most."""
    points, transient = _scaled(120_000, order.effort, 500), 1000
    states = strobed_states(o, START, points, transient)
    boxes = zoom_boxes(states)
    most = _scaled(20_000_000, order.effort, 2000)
    zooms, seen = strobed_states_within(o, START, boxes, _scaled(40_000, order.effort, 200), most, transient)
    arrays = {"section": states, "boxes": boxes}
    arrays |= {f"zoom_{i + 1}": zoom for i, zoom in enumerate(zooms) if len(zoom)}
    return arrays, {"points": points, "transient": transient, "periods": seen}


def zoom_boxes(states: np.ndarray) -> np.ndarray:
    """Boxes (2, 4), a tenth and a hundredth of the section's extent, round its densest point."""
    from scipy.spatial import cKDTree

    low, extent = states.min(axis=0), np.maximum(np.ptp(states, axis=0), 1e-9)
    tree = cKDTree((states - low) / extent)
    candidates = tree.data[:: max(1, len(states) // 4000)]
    neighbours = tree.query_ball_point(candidates, 0.5 / ZOOMS[-1], return_length=True)
    centre = candidates[int(np.argmax(neighbours))] * extent + low
    half = [0.5 * extent / zoom for zoom in ZOOMS]
    return np.array([[centre[0] - h[0], centre[0] + h[0], centre[1] - h[1], centre[1] + h[1]] for h in half])


def history(o: SnapOscillator, order: Namespace) -> Result:
    """The first periods from START, with the switching times."""
    motion = snap_motion(o, START, HISTORY_PERIODS, 128)
    arrays = {"time": motion.time, "displacement": motion.displacement, "velocity": motion.velocity}
    if len(motion.switches):
        arrays["switches"] = motion.switches
    return arrays, {"periods": HISTORY_PERIODS, "slack_fraction": motion.slack_fraction}


def exponents(o: SnapOscillator, order: Namespace) -> Result:
    """Both exponents over many random starts, with their errors, and how they settle with time."""
    starts, periods, transient = _scaled(512, order.effort, 16), 10_000, 1000
    found = snap_exponents(o, count=starts, transient_periods=transient, periods=periods, blocks=50, seed=SEED)
    arrays = {"of_start": found.of_start, "convergence": found.convergence, "of_block": found.of_block[:, :, 0]}
    bits = found.first.in_bits_per_period(o.period)
    row = {
        "lambda_1_nats_per_time": found.first.value,
        "lambda_1_error": found.first.error,
        "lambda_1_bits_per_period": bits.value,
        "lambda_1_bits_error": bits.error,
        "lambda_2_nats_per_time": found.second.value,
        "sum_plus_damping": found.first.value + found.second.value + o.damping,
        "section_dimension": found.dimension,
        "section_dimension_error": found.dimension_error,
        "slack_fraction": found.slack_fraction,
        "starts": found.starts,
        "elsewhere": found.elsewhere,
        "periods": periods,
        "transient": transient,
    }
    return arrays | {"block_error": np.array([found.block_error])}, row


def _diagram(o: SnapOscillator, over: str, span: tuple[float, float, int], effort: float) -> Result:
    values = np.linspace(span[0], span[1], _scaled(span[2], min(effort, 1.0), 2))
    found = snap_diagram(o, over, values, count=4, transient_periods=500, periods=1000, points=150, seed=SEED)
    arrays = {
        "values": values,
        "section": found.section[..., 0].reshape(len(values), -1),
        "exponents": found.exponents,
        "errors": found.errors,
        "slack_fraction": found.slack_fraction,
    }
    return arrays, {"starts": 4, "periods": 1000, "transient": 500, "points": len(values)}


def diagram_force(o: SnapOscillator, order: Namespace) -> Result:
    """Orbit diagram over F with exponents."""
    return _diagram(o, "force", order.forces, order.effort)


def diagram_frequency(o: SnapOscillator, order: Namespace) -> Result:
    """Orbit diagram over omega with exponents."""
    return _diagram(o, "frequency", order.frequencies, order.effort)


def basins(o: SnapOscillator, order: Namespace) -> Result:
    """Where a grid of starts ends, and the shares."""
    columns, rows = (_scaled(n, order.effort**0.5, 8) for n in (120, 75))
    found = snap_basins(o, start_grid(columns, rows), 3000)
    arrays = {"label": found.label.reshape(rows, columns), "settled": found.settled, "shares": found.shares}
    arrays |= {"errors": found.errors, "box": np.array(PAPER_BOX)}
    for number, orbit in enumerate(found.orbits):
        arrays[f"orbit_{number + 1}"] = orbit
    row = {"starts": columns * rows, "periods": 3000, "attractors": len(found.orbits)}
    return arrays, row | {"aperiodic_share": float(found.shares[-1])}


def orbits(o: SnapOscillator, order: Namespace) -> Result:
    """Periodic orbits up to period 8, stable and unstable, by Newton's method from points of the section and a grid."""
    guesses = _scaled(400, order.effort, 20)
    basin = snap_basins(o, random_starts(_scaled(300, order.effort, 40), SEED), 1500)
    starts = np.concatenate([strobed_states(o, START, guesses, 1000), start_grid(12, 8)])
    table, points = [], []
    for period in range(1, LONGEST_ORBIT + 1):
        known = [orbit[:1] for orbit in basin.orbits if len(orbit) == period]
        for orbit in search_periodic_orbits(o, period, np.concatenate([*known, starts])):
            m = orbit.multipliers[np.argsort(-np.abs(orbit.multipliers), kind="stable")]
            table.append([period, *m.view(float), orbit.residual, len(points)])
            points.extend(orbit.points)
    arrays = {"table": np.array(table), "points": np.array(points)} if table else {}
    return arrays, {"points": len(table), "starts": len(starts)}


def grazing(o: SnapOscillator, order: Namespace) -> Result:
    """The forcing below which the taut motion never goes slack; random starts just below and just above it."""
    found = grazing_force(o)
    arrays = {"grazing": np.array([found.force, found.time, found.clearance, found.velocity])}
    count = _scaled(200, order.effort, 20)
    if np.isfinite(found.force):
        slack = []
        for factor in (0.999, 1.001):
            near = replace(o, force=found.force * factor)
            slack.append(snap_diagram(near, "force", [near.force], count=count, transient_periods=2000, periods=100,
                                      points=1, seed=SEED).slack_fraction[0])  # fmt: skip
        arrays["slack_below"], arrays["slack_above"] = slack
    return arrays, {"grazing_force": found.force, "starts": count, "transient": 2000, "periods": 100}


PARTS = {
    "section": section,
    "history": history,
    "exponents": exponents,
    "orbits": orbits,
    "basins": basins,
    "grazing": grazing,
    "diagram-force": diagram_force,
    "diagram-frequency": diagram_frequency,
}
