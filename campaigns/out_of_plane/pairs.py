"""Planar runs with loop releases against runs in three dimensions: when is the planar run good enough? `pairs.csv`.

Paths part after the first loop, so a pair is judged by what follows the transient: the range of r, the Poincare
section, the exponent of r and the regime.
"""

import math
from pathlib import Path

import numpy as np

from campaigns.machinery import run_of
from engine.views import strobed_radius
from tables import DEPTH, WOLF_ERROR, WOLF_EXPONENT, Column, Row, of_words

APART_M = 0.01  # difference of the two radii from which the runs count as parted
MOST_OFF = 0.01  # of the range of r: what the ends of the ranges may differ by
MOST_ACROSS = 1.5  # times the distance of the halves of one record
_SAME = "1 where both runs have the same {}; empty where the records are too short to say"
COLUMNS = (
    DEPTH,
    Column("apart_period", "periods", "apart at", f"when the radii first differ by {1e3 * APART_M:g} mm", 1),
    Column("before_m", "m", "before", "their largest difference up to one period before the first burst", 6),
    Column("range_off", "", "ends of r", "largest difference of the ends of the ranges of r, by the planar range", 5),
    Column("across", "", "across", "energy distance of the strobed r, r' of the two runs: 0 equal, 1 apart", 3),
    Column("within", "", "within", "energy distance of the halves of each run", 3),
    Column("same_range", "", "range", _SAME.format(f"range of r, its ends within {MOST_OFF:g} of it"), 0),
    Column("same_section", "", "section", _SAME.format(f"section, across within {MOST_ACROSS:g} times the halves"), 0),
    Column("same_exponent", "", "exponent", _SAME.format("Wolf's exponent of r, within two errors"), 0),
    Column("same_regime", "", "regime", _SAME.format("regime"), 0),
    of_words("planar_key", "key of the planar run", "planar run"),
    of_words("spatial_key", "key of the run in three dimensions", "run in space"),
)


def pair_row(out: Path, planar: dict, spatial: dict, transient: int) -> Row:
    """A row of pairs.csv from two rows of table.csv, of the same scene in the plane and in three dimensions."""
    from analysis import section_distance

    flat, space = run_of(out, planar), run_of(out, spatial)
    step_s, period_s = flat.scene.sample_step_s(), flat.scene.waves.period_s
    flat_m, space_m = flat.columns["radius_m"], space.columns["radius_m"]
    samples = min(len(flat_m), len(space_m))
    off_m = np.abs(flat_m[:samples] - space_m[:samples])
    first = spatial.get("rope_first_burst_period")
    before_m = off_m
    if first is not None:
        before_m = off_m[: max(int((first - 1.0) * period_s / step_s), 1)]
    parted = np.flatnonzero(off_m > APART_M)
    apart_period = None
    if len(parted):
        apart_period = float(parted[0]) * step_s / period_s
    row = {
        "depth_m": planar["depth_m"],
        "apart_period": apart_period,
        "before_m": float(before_m.max()),
        "planar_key": planar["run_key"],
        "spatial_key": spatial["run_key"],
    }
    if {"radius_min_m", "radius_max_m"} <= planar.keys() & spatial.keys():
        distance = section_distance(strobed_radius(flat, transient), strobed_radius(space, transient))
        row |= agreement(planar, spatial, distance.across, distance.within)
    return row


def agreement(planar: dict, spatial: dict, across: float, within: float) -> Row:
    """In what two rows of table.csv agree: 1, 0, or None where the records are too short to say."""
    low_off_m = abs(planar["radius_min_m"] - spatial["radius_min_m"])
    high_off_m = abs(planar["radius_max_m"] - spatial["radius_max_m"])
    range_off = max(low_off_m, high_off_m) / (planar["radius_max_m"] - planar["radius_min_m"])
    row = {"range_off": range_off, "across": across, "within": within}
    row |= dict.fromkeys(("same_range", "same_section", "same_exponent", "same_regime"))
    row["same_range"] = int(range_off <= MOST_OFF)
    if math.isfinite(across):
        row["same_section"] = int(across <= MOST_ACROSS * within)
    exponents = planar.get(WOLF_EXPONENT), spatial.get(WOLF_EXPONENT)
    if None not in exponents and np.isfinite(exponents).all():
        error = math.hypot(planar[WOLF_ERROR], spatial[WOLF_ERROR])
        row["same_exponent"] = int(abs(np.subtract(*exponents)) <= 2.0 * error)
    if planar.get("regime") and spatial.get("regime"):
        row["same_regime"] = int(planar["regime"] == spatial["regime"])
    return row
