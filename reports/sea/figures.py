"""A sea: the responses of all its starts, the waves with their envelope and the folds, the tension with its snaps."""

import math

import numpy as np

from analysis import spells_of
from analysis.seas import HOLD
from engine.physics.sea import elevation_m, envelope_m
from engine.views import snaps_of
from tables import number_of

from ..figures.curves import envelope as thinned
from ..parts import Figure, Folder, Row, having, series
from ..parts.style import (
    BLUE,
    GREEN,
    INK,
    ORANGE,
    PURPLE,
    SHADES,
    SKY,
    SOFT,
    VERMILION,
    kind_for,
    picture_of,
    sheet,
)

_STARTS = BLUE, ORANGE, GREEN, PURPLE, SKY
_BINS = 2500
_SHOWN = 120  # peak periods of the picture, or 1.6 times the time until the starts are together
_PICTURE = (
    "Sea 1. Top: distance of the buoy from its anchor, from every start. Middle: the waves at the anchor with their "
    "envelope, and where the small and the large motion of regular waves end, if there are both. Bottom: tension of "
    "the run from rest; shaded: slack; triangles: snaps."
)
_RESPONSES = (
    "Every sea over the whole record. Top: how many different responses its starts have. Bottom: the largest distance "
    "of two starts, as a share of the motion; dashed: the distance below which two starts are one response."
)


def history_figure(folder: Folder, cell: Row) -> Figure | None:
    """The first sea, from t = 0 to some time after its starts came together; None without its runs."""
    rows = [row for row in having(folder.table, sea=1, status="ok") if not row["solver"]]
    runs = [folder.trajectory(row)[0] for row in sorted(rows, key=lambda row: row["start"])]
    if not runs or None in runs or rows[0]["start"] != 0:
        return None
    rest = runs[0]
    period_s = rest.scene.waves.period_s
    together = _together(folder)
    periods = _SHOWN
    if not math.isnan(together):
        periods = max(_SHOWN, 1.6 * together)
    shown = slice(0, round(periods * period_s / rest.scene.sample_step_s()) + 1)
    time = rest.columns["time_s"][shown] / period_s
    with sheet(6.2) as figure:
        panels = figure.subplots(3, 1, sharex=True, height_ratios=(1.3, 1.0, 1.2))
        _radius_panel(panels[0], time, runs, shown, together)
        _waves_panel(panels[1], time, rest.scene, period_s, cell)
        _tension_panel(panels[2], time, rest, shown, folder.provenance, number_of(cell, "regular_N"))
        for axes, columns in zip(panels, (4, 3, 3), strict=True):
            axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=columns)
        picture = picture_of(figure, kind_for(len(time)))
    alt = "Three panels over time: radius from all starts, waves with their envelope, tension with snaps."
    return Figure(picture, _PICTURE, alt)


def _radius_panel(axes, time: np.ndarray, runs, shown: slice, together: float) -> None:
    for number, run in enumerate(runs):
        name = "from rest"
        if number:
            name = f"kick {number}"
        radius_m = run.columns["radius_m"][shown]
        line = thinned(time[: len(radius_m)], radius_m, _BINS)
        axes.plot(*line, color=_STARTS[number % len(_STARTS)], linewidth=0.8, label=name, rasterized=True)
    if len(runs) > 1 and math.isfinite(together):
        axes.axvline(together, color=INK, linewidth=1.0, linestyle="--", label="all starts together")
    axes.set_ylabel("$r$ (m)")


def _waves_panel(axes, time: np.ndarray, scene, period_s: float, cell: Row) -> None:
    """The waves over the anchor, and the amplitudes at which small and large motion end, where both are known."""
    time_s = time * period_s
    x_m, y_m, _ = scene.anchor.position_m
    axes.plot(*thinned(time, elevation_m(scene, time_s, x_m, y_m), _BINS), color=SOFT, linewidth=0.5, rasterized=True)
    axes.plot(time, envelope_m(scene, time_s), color=INK, linewidth=1.2, label="envelope")
    up, down = cell["fold_up_m"], cell["fold_down_m"]
    if math.isfinite(up + down):
        axes.axhline(up, color=VERMILION, linewidth=1.0, label="slowly rising: the large motion begins")
        axes.axhline(down, color=BLUE, linewidth=1.0, linestyle="--", label="slowly falling: it ends")
    axes.set_ylabel("surface (m)")


def _tension_panel(axes, time: np.ndarray, rest, shown: slice, shares, regular_N: float) -> None:
    """Tension of the run from rest with its snaps and slack intervals. regular_N: largest in the regular wave of H_s,
    nan where it is not known.
    """
    period_s, end_s = rest.scene.waves.period_s, rest.columns["time_s"][shown][-1]
    snaps = snaps_of(rest.scene, rest.columns, slack_share=shares["slack_share"], snap_share=shares["snap_share"])
    for onset_s, taut_s in zip(snaps.onset_s, snaps.taut_s, strict=True):
        if taut_s <= end_s and math.isfinite(onset_s):
            axes.axvspan(onset_s / period_s, taut_s / period_s, color=SHADES[1], linewidth=0)
    line = thinned(time, rest.columns["tension_top_high_N"][shown] / 1e3, _BINS)
    axes.plot(*line, color=INK, linewidth=0.6, rasterized=True, label="tension, from rest")
    early = snaps.peak_s <= end_s
    if early.any():
        look = {"color": VERMILION, "markersize": 3.5, "label": "snap"}
        axes.plot(snaps.peak_s[early] / period_s, snaps.peak_N[early] / 1e3, "v", **look)
    if math.isfinite(regular_N):
        axes.axhline(regular_N / 1e3, color=BLUE, linewidth=1.0, linestyle="--", label="regular wave of $H_s$")
    axes.set(xlabel="time (peak periods)", ylabel="tension (kN)", xlim=(time[0], time[-1]))


def _together(folder: Folder) -> float:
    """When the starts of the first sea first come together and stay for ten periods; nan: never."""
    rows = having(folder.part("history").table, sea=1)
    for begin, end in spells_of([row["responses"] == 1 for row in rows]):
        if end - begin >= HOLD:
            return float(begin)
    return math.nan


def responses_figure(over_time: Folder, distance: float) -> Figure | None:
    """Number of responses, and largest distance of two starts, over time, for each sea; None where none is known."""
    seas = {}
    for row in over_time.table:
        if math.isfinite(row["responses"]):
            seas.setdefault(row["sea"], []).append(row)
    if not seas:
        return None
    with sheet(3.4) as figure:
        top, bottom = figure.subplots(2, 1, sharex=True, height_ratios=(1.0, 1.4))
        for number, sea in enumerate(sorted(seas)):
            period, colour = series(seas[sea], "period"), _STARTS[number % len(_STARTS)]
            count = series(seas[sea], "responses") + 0.04 * number
            top.step(period, count, where="post", color=colour, linewidth=0.8)
            bottom.semilogy(period, np.maximum(series(seas[sea], "apart"), 1e-12), color=colour, linewidth=0.6)
        bottom.axhline(distance, color=INK, linewidth=0.8, linestyle="--")
        top.set_ylabel("responses")
        top.yaxis.get_major_locator().set_params(integer=True)
        bottom.set(xlabel="time (peak periods)", ylabel="largest distance")
        return Figure(picture_of(figure), _RESPONSES, "Number of responses and distance over time.")
