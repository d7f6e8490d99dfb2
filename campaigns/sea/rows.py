"""A run in one sea as a row: its exponent, its snaps and its loads after the transient."""

import math

import numpy as np

from analysis import (
    damage_equivalent_load,
    extremes,
    growing_share,
    peaks,
    sea_lyapunov,
    slack_fraction,
    turning_points,
)
from analysis.seas import mean_of_seas
from analysis.tangent_growth import turned
from campaigns.explore.grid import place_in
from campaigns.explore.rows import HEIGHT, SLACK, TANGENT, begun_row, exponents
from campaigns.explore.rows import SNAPS as SNAPS_OF_RUNS
from engine.run.rest import static_tension_N
from engine.views import carried, snaps_of
from tables import (
    MESSAGE,
    PEAK,
    PERIODS_RUN,
    REGIMES,
    RUN_KEY,
    SHEET,
    STATISTICS,
    STATUS,
    Column,
    Columns,
    Row,
    Rows,
    finite,
    names,
    number_of,
    of_words,
)

CLEAR = 3.0  # errors between an exponent and 0: then its sign needs no more seas
SEA = Column("sea", "", "sea", "seed of the waves", 0)
START = Column("start", "", "start", "number of the start; 0: rest", 0)
SOLVER = of_words("solver", "finer: twice the elements at a quarter of the tolerance; empty: as given")
SNAPS = Column("snaps_per_hour", "1/h", "snaps", "snaps an hour after the transient", 1)
GROWING = Column(
    "growing_share", "", "growing", "share of windows of the record in which a small perturbation grows", 2, REGIMES
)
MEAN = Column("tension_mean_N", "N", "T_mean", "mean tension at the top after the transient", 0)
EQUIVALENT = Column(
    "equivalent_load_N", "N", "R_eq", "range that does the damage of the record in one cycle a peak period", 0
)
LARGEST = Column(PEAK, "N", "T_max", "largest tension at the top after the transient", 0)
_, SNAP_PEAK, *_, SNAP_SPEED = SNAPS_OF_RUNS
_MEASURED = (
    SEA,
    START,
    Column("kick_x_mps", "m/s", "u", "velocity of the buoy along the waves at the start", 2, SHEET),
    Column("kick_z_mps", "m/s", "w", "velocity of the buoy upwards at the start", 2, SHEET),
    SOLVER,
    STATUS,
    PERIODS_RUN,
    *TANGENT,
    GROWING,
    SNAPS,
    SNAP_PEAK,
    SNAP_SPEED,
    SLACK,
    MEAN,
    LARGEST,
    Column("peaks", "", "peaks", "peaks of the tension: one between two up-crossings of its mean", 0, SHEET),
    Column("peak_p99_N", "N", "T_99", "peak that one in a hundred exceeds", 0, SHEET),
    EQUIVALENT,
    HEIGHT,
    *STATISTICS,
    RUN_KEY,
    MESSAGE,
)


def columns_of(keys: Columns) -> Columns:
    """Those of the varied keys, then those of `run_row`."""
    return *keys, *(column for column in _MEASURED if column.name not in names(keys))


def run_row(trajectory, transient: int, window: int, slack_share: float, snap_share: float, slope: float) -> Row:
    """The columns that a trajectory fills. A record that ends within the transient has its statistics only.

    transient: peak periods left out. window, slack_share, snap_share, slope: options of the campaign.
    """
    row, columns = begun_row(trajectory)
    scene = trajectory.scene
    period_s, step_s = scene.waves.period_s, scene.sample_step_s()
    if carried(trajectory):
        growth = trajectory.tangent.growth_nats[:, 0]
        row |= exponents(TANGENT, sea_lyapunov([growth], transient))
        row[GROWING.name] = growing_share(turned(growth, transient), window)
    transient_s = transient * period_s
    first = round(transient_s / step_s)
    tension, low, high = (columns[f"tension_top{kind}_N"] for kind in ("", "_low", "_high"))
    if len(tension) - first < 2:
        return row
    crests = high[first:][peaks(high[first:])]
    waves = (len(tension) - 1 - first) * step_s / period_s
    row |= {
        MEAN.name: float(np.mean(tension[first:])),
        LARGEST.name: extremes(high, step_s, transient_s).maximum,
        "peaks": len(crests),
        EQUIVALENT.name: damage_equivalent_load(turning_points(low[first:], high[first:]), waves, slope),
    }
    if len(crests) > 100:
        row["peak_p99_N"] = float(np.quantile(crests, 0.99))
    static_N = static_tension_N(scene, columns)
    if static_N > 0.0:  # by which slack and snaps are measured
        snaps = snaps_of(scene, columns, transient_s=transient_s, slack_share=slack_share, snap_share=snap_share)
        row[SNAPS.name] = len(snaps) / snaps.watched_s * 3600.0
        row[SLACK.name] = slack_fraction(tension, step_s, slack_share * static_N, transient_s).fraction
        if len(snaps):
            row[SNAP_PEAK.name] = float(np.median(snaps.peak_N))
            row[SNAP_SPEED.name] = float(np.max(snaps.taut_speed_mps))
    return finite_row(row)


def finite_row(row: Row) -> Row:
    """The row with None in place of numbers that are not finite."""
    return {name: finite(entry) if isinstance(entry, float) else entry for name, entry in row.items()}


def unclear_places(rows: Rows, keys: Columns) -> set[tuple]:
    """The places (values of the keys) where the mean exponent of the runs from rest is within CLEAR errors of 0."""
    exponents_at = {}  # of the seas with their errors, by place
    for row in rows:
        value, error = (number_of(row, column.name) for column in TANGENT)
        if row["start"] == 0 and not row["solver"] and math.isfinite(value):
            exponents_at.setdefault(place_in(row, keys), []).append((value, error))
    unclear = set()
    for place, exponents_of_seas in exponents_at.items():
        value, error = mean_of_seas(*zip(*exponents_of_seas, strict=True))
        if abs(value) < CLEAR * error:
            unclear.add(place)
    return unclear
