"""A run in an irregular sea as a row of a sweep, and what all rows say: statistics in place of motions and regimes."""

import math
from collections import Counter
from collections.abc import Sequence

from campaigns.answers import known_rows, line, numbers_of
from campaigns.explore.answer import snap_peaks, span
from campaigns.explore.load import load, peak_at
from campaigns.sea.rows import MEAN, SNAPS
from engine.physics.sea import elevation_m
from engine.views import snaps_of
from tables import PEAK, Column, Row, names, number_of

SURFACE = Column(
    "significant_elevation_m", "m", "4 σ_η", "four standard deviations of the surface at x = 0 after the transient", 2
)
DEVIATION = Column("tension_std_N", "N", "σ_T", "standard deviation of the tension at the top after the transient", 0)
COLUMNS = SURFACE, MEAN, DEVIATION, SNAPS


def statistics(scene, columns, transient_s: float) -> Row:
    """`COLUMNS` of the samples after the transient; without snaps for a line that bears no tension at rest."""
    first = math.ceil(transient_s / scene.sample_step_s() - 1e-6)
    tension_N = columns["tension_top_N"][first:]
    row = {
        SURFACE.name: 4.0 * float(elevation_m(scene, columns["time_s"][first:]).std()),
        MEAN.name: float(tension_N.mean()),
        DEVIATION.name: float(tension_N.std()),
    }
    try:
        snaps = snaps_of(scene, columns, transient_s=transient_s)
    except ValueError:
        return row
    if snaps.watched_s > 0.0:
        row[SNAPS.name] = len(snaps) / snaps.watched_s * 3600.0
    return row


def sentences(rows: Sequence[Row], keys: Sequence[Column], scene) -> list[str]:
    """The lines SEA, LOAD, TENSION, SNAPS and OPEN of a sweep over one key or two; scene: of one of the runs."""
    good = [row for row in rows if row["status"] == "ok" and math.isfinite(number_of(row, PEAK))]
    if not good:
        return [line("LOAD", "not known, because no run lasts beyond the transient.")]
    lines = {"SEA": _sea(good, scene), "TENSION": _tension(good, keys), "SNAPS": _snaps(good, keys)}
    if len(keys) == 1:
        lines["LOAD"] = load(good, keys[0].name, keys[0].name, scene, ())
    else:
        lines["LOAD"] = peak_at(good, names(keys), scene)
    lines["OPEN"] = _open(rows, scene)
    return [line(word, lines[word]) for word in ("SEA", "LOAD", "TENSION", "SNAPS", "OPEN") if lines[word]]


def _sea(rows: Sequence[Row], scene) -> str:
    minutes = [number_of(row, "end_time_s") / 60.0 for row in rows]
    out_of = max(numbers_of(rows, "transient_periods"))
    left_out = f"its first {out_of:.3g} peak periods are left out" if out_of else "nothing of it is left out"
    return (
        f"significant elevation {span(numbers_of(rows, SURFACE.name))} m, peak period {scene.waves.period_s:.3g} s; "
        f"one run of {span(minutes, places=1)} min for each value, {left_out} (--transient)."
    )


def _tension(rows: Sequence[Row], keys: Sequence[Column]) -> str:
    """The range of the mean, and where the standard deviation is least and largest."""
    ranked = sorted(rows, key=lambda row: row[DEVIATION.name])
    ends = []
    for row in (ranked[0], ranked[-1]):
        place = ", ".join(f"{key.name} = {number_of(row, key.name):.4g}" for key in keys)
        ends.append(f"{1e-3 * row[DEVIATION.name]:.2g} kN at {place}")
    mean_kN = [1e-3 * mean for mean in numbers_of(rows, MEAN.name)]
    return f"mean {span(mean_kN)} kN; standard deviation {' to '.join(dict.fromkeys(ends))}."


def _snaps(rows: Sequence[Row], keys: Sequence[Column]) -> str:
    counted = known_rows(rows, SNAPS.name)
    if not counted:
        return ""
    rates = numbers_of(counted, SNAPS.name)
    if not any(rates):
        return "none: the tension never comes back from slack."
    return f"{span(rates, places=0)} an hour. {snap_peaks(counted, names(keys))}"


def _open(rows: Sequence[Row], scene) -> str:
    """Runs that ended early, and what one run in one sea cannot say."""
    failures = Counter(row["status"] for row in rows if row["status"] != "ok")
    parts = [f"{count} of {len(rows)} runs ended early ({status})" for status, count in failures.items()]
    parts.append("one run in one sea has its largest tension by chance")
    if scene.end.kind == "buoy":
        parts.append(
            "campaigns.sea with the same --vary and --set draws several seas, tells whether the start is forgotten, "
            "and gives the three-hour maximum"
        )
    return f"{'; '.join(parts)}."
