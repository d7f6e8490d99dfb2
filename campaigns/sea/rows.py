"""A run in one sea as a row: its exponent, its snaps and its loads after the transient."""

import math
from dataclasses import replace

import numpy as np

from analysis import (
    damage_equivalent_load,
    growing_share,
    peaks,
    sea_lyapunov,
    slack_fraction,
    turning_points,
)
from analysis.seas import mean_of_seas
from analysis.tangent_growth import turned
from campaigns.explore.grid import place_in
from campaigns.explore.rows import OUT_OF_WATER, SLACK, TANGENT, begun_row, exponents
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

CLEAR = 3.0  # an exponent so many errors from 0 has a clear sign, and needs no more seas
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
SLACK_OF_SEA = replace(
    SLACK, meaning="share of the time after the transient with less than --slack-share of the static tension at the top"
)
_MEASURED = (
    SEA,
    START,
    Column("kick_x_mps", "m/s", "u", "velocity of the buoy along x at the start", 2, SHEET),
    Column("kick_z_mps", "m/s", "w", "velocity of the buoy upwards at the start", 2, SHEET),
    SOLVER,
    STATUS,
    PERIODS_RUN,
    *TANGENT,
    GROWING,
    SNAPS,
    SNAP_PEAK,
    SNAP_SPEED,
    SLACK_OF_SEA,
    MEAN,
    LARGEST,
    Column("peaks", "", "peaks", "peaks of the tension: one between two up-crossings of its mean", 0, SHEET),
    Column("peak_p99_N", "N", "T_99", "peak that one in a hundred exceeds", 0, SHEET),
    EQUIVALENT,
    *OUT_OF_WATER,
    *STATISTICS,
    RUN_KEY,
    MESSAGE,
)


def columns_of(keys: Columns) -> Columns:
    """The columns of the varied keys, then those of `run_row`."""
    return *keys, *(column for column in _MEASURED if column.name not in names(keys))


def run_row(trajectory, transient: int, window: int, slack_share: float, snap_share: float, slope: float) -> Row:
    """The columns of a run that are known. A record that ends within the transient has statistics only.

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
    first = round(transient_s / step_s)  # sample after the transient
    tension_N = columns["tension_top_N"]
    low_N, high_N = columns["tension_top_low_N"][first:], columns["tension_top_high_N"][first:]
    if len(high_N) < 2:
        return row
    peaks_N = high_N[peaks(high_N)]
    waves = (len(high_N) - 1) * step_s / period_s
    row |= {
        MEAN.name: float(np.mean(tension_N[first:])),
        LARGEST.name: float(high_N.max()),
        "peaks": len(peaks_N),
        EQUIVALENT.name: damage_equivalent_load(turning_points(low_N, high_N), waves, slope),
    }
    if len(peaks_N) > 100:
        row["peak_p99_N"] = float(np.quantile(peaks_N, 0.99))
    static_N = static_tension_N(scene, columns)
    if static_N > 0.0:  # else nothing says which tension is slack, and which is a snap
        snaps = snaps_of(scene, columns, transient_s=transient_s, slack_share=slack_share, snap_share=snap_share)
        row[SNAPS.name] = len(snaps) / snaps.watched_s * 3600.0
        row[SLACK.name] = slack_fraction(tension_N, step_s, slack_share * static_N, transient_s).fraction
        if len(snaps):
            row[SNAP_PEAK.name] = float(np.median(snaps.peak_N))
            row[SNAP_SPEED.name] = float(np.max(snaps.taut_speed_mps))
    return finite_row(row)


def finite_row(row: Row) -> Row:
    """The row with None in place of numbers that are not finite."""
    return {name: finite(entry) if isinstance(entry, float) else entry for name, entry in row.items()}


def unclear_places(rows: Rows, keys: Columns) -> set[tuple]:
    """The places (values of the keys) where the mean exponent of the runs from rest is within CLEAR errors of 0."""
    seas_at = {}  # by place: exponent and error of each sea
    for row in rows:
        value, error = (number_of(row, column.name) for column in TANGENT)
        if row["start"] == 0 and not row["solver"] and math.isfinite(value):
            seas_at.setdefault(place_in(row, keys), []).append((value, error))
    unclear = set()
    for place, seas in seas_at.items():
        mean, error = mean_of_seas(*zip(*seas, strict=True))
        if abs(mean) < CLEAR * error:
            unclear.add(place)
    return unclear
