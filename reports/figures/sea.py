"""A sea: the responses of all its starts, the waves with their envelope and the folds, the tension with its snaps."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ..parts import Picture
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
    WIDTH_IN,
    kind_for,
    picture_of,
    sheet,
)
from .motion import envelope as thinned

_STARTS = BLUE, ORANGE, GREEN, PURPLE, SKY
_BINS = 2500


class SeaHistory(NamedTuple):
    """One sea over its peak periods.

    time (n,), surface_m, envelope_m, tension_N (n,)   of the run from rest; radius_m: of each start
    snaps       time and largest tension (N) of each snap, (k, 2); slack: begin and end of each slack interval, (k, 2)
    folds_m     amplitudes at which the small motion and the large one end; None where there are none
    together    time from which all starts are one response; NaN: never
    regular_N   largest tension in the regular wave of H_s, and its name; None where it is not known
    """

    time: np.ndarray
    radius_m: Sequence[np.ndarray]
    surface_m: np.ndarray
    envelope_m: np.ndarray
    tension_N: np.ndarray
    snaps: np.ndarray
    slack: np.ndarray
    folds_m: tuple[float, float] | None
    together: float
    regular_N: float


def sea_history(history: SeaHistory, width_in: float = WIDTH_IN) -> Picture:
    """Three panels over one time; one picture."""
    with sheet(6.2, width_in) as figure:
        figure.set_layout_engine("constrained")
        top, middle, bottom = figure.subplots(3, 1, sharex=True, height_ratios=(1.3, 1.0, 1.2))
        for number, radius_m in enumerate(history.radius_m):
            name = "from rest" if number == 0 else f"kick {number}"
            colour = _STARTS[number % len(_STARTS)]
            line = thinned(history.time[: len(radius_m)], radius_m, _BINS)
            top.plot(*line, color=colour, linewidth=0.8, label=name, rasterized=True)
        if np.isfinite(history.together):
            top.axvline(history.together, color=INK, linewidth=1.0, linestyle="--", label="all starts together")
        top.set_ylabel("$r$ (m)")
        top.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=4)

        middle.plot(*thinned(history.time, history.surface_m, _BINS), color=SOFT, linewidth=0.5, rasterized=True)
        middle.plot(history.time, history.envelope_m, color=INK, linewidth=1.2, label="envelope")
        if history.folds_m is not None:
            up, down = history.folds_m
            middle.axhline(up, color=VERMILION, linewidth=1.0, label="slowly rising: the large motion begins")
            middle.axhline(down, color=BLUE, linewidth=1.0, linestyle="--", label="slowly falling: it ends")
        middle.set_ylabel("surface (m)")
        middle.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=3)

        for begin, end in history.slack:
            bottom.axvspan(begin, end, color=SHADES[1], linewidth=0)
        line = thinned(history.time, history.tension_N / 1e3, _BINS)
        bottom.plot(*line, color=INK, linewidth=0.6, rasterized=True, label="tension, from rest")
        if len(history.snaps):
            times, peaks_N = history.snaps.T
            bottom.plot(times, peaks_N / 1e3, "v", color=VERMILION, markersize=3.5, label="snap")
        if np.isfinite(history.regular_N):
            bottom.axhline(
                history.regular_N / 1e3, color=BLUE, linewidth=1.0, linestyle="--", label="regular wave of $H_s$"
            )
        bottom.set(xlabel="time (peak periods)", ylabel="tension (kN)", xlim=(history.time[0], history.time[-1]))
        bottom.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=3)
        return picture_of(figure, kind_for(len(history.time)))


def responses_over_time(seas: Sequence[tuple[np.ndarray, np.ndarray, np.ndarray]], distance: float) -> Picture:
    """Number of responses, and largest distance of two starts, over time; (period, responses, apart) of each sea."""
    with sheet(3.4) as figure:
        top, bottom = figure.subplots(2, 1, sharex=True, height_ratios=(1.0, 1.4))
        for number, (period, count, apart) in enumerate(seas):
            colour = _STARTS[number % len(_STARTS)]
            top.step(period, count + 0.04 * number, where="post", color=colour, linewidth=0.8)
            bottom.semilogy(period, np.maximum(apart, 1e-12), color=colour, linewidth=0.6)
        bottom.axhline(distance, color=INK, linewidth=0.8, linestyle="--")
        top.set_ylabel("responses")
        top.yaxis.get_major_locator().set_params(integer=True)
        bottom.set(xlabel="time (peak periods)", ylabel="largest distance")
        return picture_of(figure)
