"""Planar runs with loop releases against runs in three dimensions: when is the planar run good enough? `pairs.csv`.

Paths part after the first loop, so a pair is judged by what follows the transient: the range of r, the Poincare
section, the exponent of r and the regime.
"""

import math
from pathlib import Path

import numpy as np

from campaigns.machinery.folder import run_of
from engine.views import strobed_radius
from tables import DEPTH, WOLF_ERROR, WOLF_EXPONENT, Column

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
    Column("planar_key", symbol="planar run", meaning="key of the planar run"),
    Column("spatial_key", symbol="run in space", meaning="key of the run in three dimensions"),
)


def pair_row(out: Path, planar: dict, spatial: dict, transient: int) -> dict[str, object]:
    """A row of pairs.csv from two rows of table.csv, of the same scene in the plane and in three dimensions."""
    from analysis import section_distance

    flat, space = (run_of(out, row) for row in (planar, spatial))
    step_s, period_s = flat.scene.sample_step_s(), flat.scene.waves.period_s
    samples = min(len(run.columns["radius_m"]) for run in (flat, space))
    off = np.abs(flat.columns["radius_m"][:samples] - space.columns["radius_m"][:samples])
    first = spatial.get("rope_first_burst_period")
    end = samples if first is None else max(int((first - 1.0) * period_s / step_s), 1)
    parted = np.flatnonzero(off > APART_M)
    row = {
        "depth_m": planar["depth_m"],
        "apart_period": float(parted[0]) * step_s / period_s if len(parted) else None,
        "before_m": float(off[:end].max()),
        "planar_key": planar["run_key"],
        "spatial_key": spatial["run_key"],
    }
    if {"radius_min_m", "radius_max_m"} <= planar.keys() & spatial.keys():
        distance = section_distance(strobed_radius(flat, transient), strobed_radius(space, transient))
        row |= agreement(planar, spatial, distance.across, distance.within)
    return row


def agreement(planar: dict, spatial: dict, across: float, within: float) -> dict[str, object]:
    """In what two rows of table.csv agree: 1, 0, or None where the records are too short to say."""
    ends_off = [abs(planar[end] - spatial[end]) for end in ("radius_min_m", "radius_max_m")]
    range_off = max(ends_off) / (planar["radius_max_m"] - planar["radius_min_m"])
    exponents, errors = ([row.get(name) for row in (planar, spatial)] for name in (WOLF_EXPONENT, WOLF_ERROR))
    measured = all(value is not None and math.isfinite(value) for value in exponents)
    regimes = [row.get("regime") for row in (planar, spatial)]
    agreements = {
        "same_range": range_off <= MOST_OFF,
        "same_section": across <= MOST_ACROSS * within if math.isfinite(across) else None,
        "same_exponent": abs(np.subtract(*exponents)) <= 2.0 * math.hypot(*errors) if measured else None,
        "same_regime": regimes[0] == regimes[1] if all(regimes) else None,
    }
    numbers = {"range_off": range_off, "across": across, "within": within}
    return numbers | {name: None if passed is None else int(passed) for name, passed in agreements.items()}
