"""A run in an irregular sea as a row of a sweep, and what all rows say: statistics in place of motions and regimes."""

import math
from collections.abc import Mapping
from contextlib import suppress
from operator import itemgetter

from campaigns.answers import NOTHING_LASTS, in_newtons, known_rows, lasting, lines, numbers_of
from campaigns.explore.answer import snap_peaks, span
from campaigns.explore.load import load, place_of
from campaigns.sea.rows import MEAN, SNAPS
from engine.physics.sea import elevation_m
from engine.views import snaps_of
from tables import Column, Row, Rows

SURFACE = Column(
    "significant_elevation_m",
    "m",
    "4 σ_η",
    "four standard deviations of the surface over the anchor after the transient",
    2,
)
DEVIATION = Column("tension_std_N", "N", "σ_T", "standard deviation of the tension at the top after the transient", 0)
COLUMNS = SURFACE, MEAN, DEVIATION, SNAPS


def statistics(scene, columns, transient_s: float) -> Row:
    """`COLUMNS` of the samples after the transient; without snaps for a line that bears no tension at rest."""
    first = math.ceil(transient_s / scene.sample_step_s() - 1e-6)
    tension_N = columns["tension_top_N"][first:]
    x_m, y_m, _ = scene.anchor.position_m
    row = {
        SURFACE.name: 4.0 * float(elevation_m(scene, columns["time_s"][first:], x_m, y_m).std()),
        MEAN.name: float(tension_N.mean()),
        DEVIATION.name: float(tension_N.std()),
    }
    with suppress(ValueError):
        snaps = snaps_of(scene, columns, transient_s=transient_s)
        row[SNAPS.name] = len(snaps) / snaps.watched_s * 3600.0
    return row


def sentences(rows: Rows, symbols: Mapping[str, str], scene) -> list[str]:
    """The lines SEA, LOAD, TENSION, SNAPS and OPEN of a sweep.

    symbols: of what is varied, by column; scene: of the largest tension.
    """
    good = lasting(rows)
    if not good:
        return lines(NOTHING_LASTS)
    texts = {
        "SEA": _sea(good, symbols, scene),
        "LOAD": load(good, symbols, scene),
        "TENSION": _tension(good, symbols),
        "SNAPS": _snaps(good, symbols),
        "OPEN": _open(rows, scene),
    }
    return lines(texts)


def _sea(rows: Rows, symbols: Mapping[str, str], scene) -> str:
    words = f"significant elevation {span(numbers_of(rows, SURFACE.name))} m"
    if "waves.period_s" not in symbols:
        words += f", peak period {scene.waves.period_s:.3g} s"
    left_out = f"the first {rows[0]['transient_periods']:.3g} peak periods left out (--transient)"
    if rows[0]["transient_periods"] == 0.0:
        left_out = "from its first moment on: waves that do not grow (waves.ramp_s) may pull hardest as they set in"
    return f"{words}; one run for each value, {left_out}."


def _tension(rows: Rows, symbols: Mapping[str, str]) -> str:
    """The range of the mean, and where the standard deviation is least and largest."""
    ranked = sorted(rows, key=itemgetter(DEVIATION.name))
    ends = [f"{in_newtons(row[DEVIATION.name])} at {place_of(row, symbols)}" for row in (ranked[0], ranked[-1])]
    means_N = numbers_of(rows, MEAN.name)
    deviations = " to ".join(dict.fromkeys(ends))
    return f"mean {in_newtons(min(means_N))} to {in_newtons(max(means_N))}; standard deviation {deviations}."


def _snaps(rows: Rows, symbols: Mapping[str, str]) -> str:
    counted = known_rows(rows, SNAPS.name)
    if not counted:
        return ""
    return f"{span(numbers_of(counted, SNAPS.name), places=0)} an hour. {snap_peaks(counted, symbols)}"


def _open(rows: Rows, scene) -> str:
    """Runs that ended early, and what one run in one sea cannot say."""
    parts = ["one run in one sea has its largest tension by chance"]
    failures = sum(row["status"] != "ok" for row in rows)
    if failures:
        parts.append(f"runs that ended early (column message): {failures}")
    if scene.end.kind == "buoy":
        parts.append(
            "campaigns.sea with the same --vary and --set draws several seas, tells whether the start is forgotten, "
            "and gives the three-hour maximum"
        )
    return f"{'; '.join(parts)}."
