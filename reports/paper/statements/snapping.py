"""Section 4.2.2: how the line snaps - slack, compression, buckling, and the peaks that turn the buoy (fig. 13)."""

from __future__ import annotations

import math

from ...parts.statements import Statement
from ...parts.wording import decimals, number, percent
from ..results import LARGE, Results
from ..snaps import NEAR_ZERO
from .calm import AGAIN, DEPTHS
from .rows import at, good, value

SLACK, PEAK = 0.01, 2.0  # share of the time; maximum over the static tension
HIGH_MODE = 4  # half waves
MOSTLY, ALWAYS = 0.5, 0.99  # shares


def _known(results: Results, column: str) -> list[dict]:
    return [row for row in good(results.over_depth(LARGE)) if math.isfinite(value(row, column))]


def _told(rows: list[dict], *columns: str) -> str:
    return ", ".join(f"{' and '.join(percent(value(row, name)) for name in columns)} at {at(row)}" for row in rows)


def snapping(results: Results) -> Statement:
    rows = _known(results, "near_zero")
    static = results.modes.static_tension_N if results.modes else math.nan
    claim = "In large waves intervals of almost no tension are followed by large peaks."
    if not rows or not math.isfinite(static):
        return Statement(claim, "No run shows it.", ())
    words, checks = [], []
    for row in rows:
        share, peak = value(row, "near_zero"), value(row, "tension_top_max_N") / static
        checks.append((at(row), share > SLACK and peak > PEAK))
        words.append(f"{percent(share)} and {number(peak, 2)} at {at(row)}")
    found = f"Time below {NEAR_ZERO} of the static tension, and largest over static tension: {', '.join(words)}."
    return Statement(claim, found, tuple(checks), f"{percent(SLACK)} of the time; {number(PEAK)} times the static one")


def compressed(results: Results) -> Statement:
    rows = _known(results, "compressed_inwards")
    claim = "In large waves the line is at times in compression, while the buoy moves towards the anchor."
    if not rows:
        return Statement(claim, "No run shows it.", ())
    found = (
        f"Share of the time with less than no tension, and of that time while r falls: "
        f"{_told(rows, 'compressed', 'compressed_inwards')}. Share of the slack intervals that begin while r falls: at "
        f"least {percent(min(value(row, 'begun_inwards') for row in rows))}."
    )
    checks = tuple((at(row), value(row, "compressed_inwards") > MOSTLY) for row in rows)
    return Statement(claim, found, checks, f"more than {percent(MOSTLY)} of the time in compression")


def turned(results: Results) -> Statement:
    rows = _known(results, "turned")
    claim = "In large waves the tension builds up as the buoy moves away from the anchor; its peaks stop and turn it."
    if not rows:
        return Statement(claim, "No run shows it.", ())
    lengths = ", ".join(
        f"{decimals(value(row, 'peak_periods'), 2)} every {decimals(value(row, 'apart_periods'), 2)} at {at(row)}"
        for row in rows
    )
    found = f"Share of the peaks that do: {_told(rows, 'turned')}. Length at half height, wave periods: {lengths}."
    checks = tuple((at(row), value(row, "turned") > ALWAYS) for row in rows)
    return Statement(claim, found, checks, f"more than {percent(ALWAYS)} of the peaks")


def impulsive(results: Results) -> Statement:
    """A mass on the taut line takes half a natural period, and at half height a third of one, however it comes in."""
    rows, modes = _known(results, "peak_periods"), results.modes
    claim = "In large waves the peaks of tension are nearly impulses."
    if not rows or modes is None:
        return Statement(claim, "No run shows it.", ())
    elastic = modes.wave_radps / modes.radial_radps / 3.0  # wave periods
    shares = [(at(row), value(row, "peak_periods") / elastic) for row in rows]
    words = ", ".join(f"{decimals(share, 2)} at {where}" for where, share in shares)
    found = f"Length at half height over that of a free elastic rebound, {decimals(elastic, 2)} wave periods: {words}."
    checks = tuple((where, share < MOSTLY) for where, share in shares)
    return Statement(claim, found, checks, f"shorter than {percent(MOSTLY)} of the rebound")


def buckles(results: Results) -> Statement:
    claim = "In large waves the slack line buckles into a mode of high order."
    if results.buckle is None:
        return Statement(claim, "No run shows it.", ())
    depth_m, waves = results.buckle
    found = f"Half waves along the slack line, median over the samples: {number(waves)}."
    return Statement(claim, found, ((f"H = {number(depth_m)} m", waves >= HIGH_MODE),), f"{HIGH_MODE} or more")


STATEMENTS = (
    ("4.2, 4.2.2, fig. 13", snapping, f"{DEPTHS}; {AGAIN}"),
    ("4.2.2", compressed, DEPTHS),
    ("4.2.2", buckles, "shape of the rope in three dimensions, part `out_of_plane`; one grid"),
    ("4.2.2, fig. 13", turned, DEPTHS),
    ("4.2.2, fig. 13", impulsive, f"closed form of an elastic rebound; {DEPTHS}"),
)
