"""A breaking line in motion: a GIF for the page, and a strip of its frames for paper."""

from __future__ import annotations

import numpy as np

from ..parts.content import Picture
from ..parts.style import BLUE, INK, SOFT, VERMILION, moving_picture, picture_of, sheet

_FRAMES_PER_SECOND = 10
_STRIP = 6


def line_animation(time_s, s_m, x_m, z_m, tension_N) -> Picture:
    """The GIF: shape above, tension along the line below; times (m,), places (n,), the other arrays (m, n)."""
    limits = _limits(x_m, z_m)
    with sheet(3.6) as figure:
        shape, along = figure.subplots(2, 1)
        (curve,) = shape.plot([], [], color=BLUE, linewidth=1.2)
        (end,) = shape.plot([], [], "o", color=VERMILION, markersize=4)
        _frame_axes(shape, limits)
        (pull,) = along.plot([], [], color=INK, linewidth=1.0)
        ends = min(1.05e-3 * float(tension_N.min()), -20.0), 1.08e-3 * float(tension_N.max())
        words = {"xlabel": "$s$ (m), unstretched, from the fixed end", "ylabel": "$T$ (kN)"}
        along.set(xlim=(s_m[0], s_m[-1]), ylim=ends, **words)
        clock = shape.set_title("t = 0 ms")

        def show(row: int) -> None:
            curve.set_data(x_m[row], z_m[row])
            end.set_data(x_m[row, -1:], z_m[row, -1:])
            pull.set_data(s_m, 1e-3 * tension_N[row])
            clock.set_text(f"t = {1e3 * time_s[row]:.0f} ms")

        return moving_picture(figure, [curve, end, pull, clock], len(time_s), show, _FRAMES_PER_SECOND)


def line_strip(time_s: np.ndarray, x_m: np.ndarray, z_m: np.ndarray) -> Picture:
    """A few of the shapes, evenly spaced in time, below one another."""
    rows = np.linspace(0, len(time_s) - 1, _STRIP).round().astype(int)
    limits = _limits(x_m, z_m)
    with sheet(0.4 + 0.72 * _STRIP) as figure:
        grid = figure.subplots(_STRIP, 1, sharex=True)
        for axes, row in zip(grid, rows, strict=True):
            axes.plot(x_m[row], z_m[row], color=BLUE, linewidth=1.0)
            axes.plot(x_m[row, -1:], z_m[row, -1:], "o", color=VERMILION, markersize=3)
            _frame_axes(axes, limits)
            axes.set_xlabel("")
            axes.text(0.99, 0.9, f"{1e3 * time_s[row]:.0f} ms", transform=axes.transAxes, ha="right", va="top")
        grid[-1].set_xlabel("$x$ (m)")
        return picture_of(figure)


def _limits(x_m: np.ndarray, z_m: np.ndarray) -> dict[str, tuple[float, float]]:
    ends = {"xlim": (x_m, 0.03), "ylim": (z_m, 0.1)}
    return {name: (at.min() - room * np.ptp(at), at.max() + room * np.ptp(at)) for name, (at, room) in ends.items()}


def _frame_axes(axes, limits: dict[str, tuple[float, float]]) -> None:
    axes.axvline(0.0, color=SOFT, linewidth=0.7, linestyle=(0, (2, 2)))
    axes.set(xlabel="$x$ (m)", ylabel="$z$ (m)", **limits)
