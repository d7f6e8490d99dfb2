"""Orbit diagram as an image of counts, with a second quantity under it on the same axis."""

from __future__ import annotations

import numpy as np

from analysis import density_image, orbit_diagram

from ..parts.content import Picture
from ..parts.style import BLUE, DENSITY_COLOURS, SKY, SOFT, VERMILION, picture_of, sheet

# any place inside a panel may hold points
_ABOVE = {"loc": "lower left", "bbox_to_anchor": (0.0, 1.0), "ncols": 2, "borderaxespad": 0.0}
_ROWS = 200  # pixels of the value axis: one is thick enough to be seen in print


def orbit_diagram_over(parameter, strobed, label: str, below, below_label: str, missing, exponents=()) -> Picture:
    """Density of strobed points over a parameter, and one more number per run below.

    Args: `parameter` (p,) e.g. steepness; `strobed` p arrays of strobed values, `label` their axis with unit;
    `below` (p,) with `below_label` (nan leaves a gap); `missing` parameter values of runs without points (crosses).
    `exponents`: label, values (p,) and errors (p,) of each, drawn in a third panel in bits per period.
    At least one of the arrays must hold a point.
    """
    from matplotlib.colors import LinearSegmentedColormap, LogNorm

    diagram = orbit_diagram(parameter, strobed)
    image = density_image(diagram, _ROWS)
    with sheet(5.4 if exponents else 4.2) as figure:
        panels = figure.subplots(
            3 if exponents else 2, 1, sharex=True, gridspec_kw={"height_ratios": [3, 1, 1.3][: 3 if exponents else 2]}
        )
        top, low = panels[:2]
        top.grid(False)
        shades = LogNorm(1, max(int(image.counts.max()), 2))
        half = _half_width(np.concatenate([diagram.parameter, np.asarray(missing, float)]))
        colours = LinearSegmentedColormap.from_list("density", DENSITY_COLOURS)
        mesh = None
        for x, counts in zip(diagram.parameter, image.counts.T, strict=True):
            if counts.any():
                mesh = top.pcolormesh(
                    [x - half, x + half],
                    image.value_edges,
                    np.ma.masked_equal(counts[:, None], 0),
                    norm=shades,
                    cmap=colours,
                )
        bar = figure.colorbar(mesh, ax=list(panels), label="points in a pixel", aspect=40, pad=0.01)
        bar.set_ticks(_round_counts(shades.vmax), labels=[f"{c}" for c in _round_counts(shades.vmax)])
        bar.minorticks_off()
        top.set_ylabel(label)
        low.vlines(parameter, 0, below, color=SKY, linewidth=1.2)
        low.plot(parameter, below, "o", color=BLUE, markersize=3.5)
        low.set_ylabel(below_label)
        panels[-1].set_xlabel(r"wave steepness $kA$ (–)")
        for (name, values, errors), colour, mark in zip(exponents, (BLUE, VERMILION), "os", strict=False):
            panels[-1].errorbar(
                parameter, values, errors, fmt=mark, color=colour, markersize=3, elinewidth=0.8, label=name
            )
        if exponents:
            panels[-1].axhline(0.0, color=SOFT, linewidth=0.7)
            panels[-1].set_ylabel(r"$\sigma$ (bits/$T_i$)")
            panels[-1].legend(fontsize="small", **_ABOVE)
        low.set_ylim(bottom=0.0, top=max(0.1, 1.15 * float(np.nanmax(below))) if np.isfinite(below).any() else 1.0)
        if len(missing):
            top.plot(
                missing,
                np.full(len(missing), 0.02),
                "x",
                color=VERMILION,
                markersize=6,
                clip_on=False,
                transform=top.get_xaxis_transform(),
                label="run without strobed points",
            )
            top.legend(**_ABOVE)
        everything = np.concatenate([diagram.parameter, np.asarray(missing, float)])
        margin = half * (2 if np.ptp(everything) > 0 else 12)
        top.set_xlim(everything.min() - margin, everything.max() + margin)
        low.axhline(0.0, color=SOFT, linewidth=0.7)
        return picture_of(figure, "png")


def _round_counts(highest: float) -> list[int]:
    """1, 2, 5, 10, ... up to the highest count."""
    return [m * 10**e for e in range(7) for m in (1, 2, 5) if m * 10**e <= highest]


def _half_width(parameter: np.ndarray) -> float:
    """Half the width of a column: short of touching the nearest neighbour, and too narrow to claim a range."""
    values = np.unique(parameter)
    if len(values) == 1:
        return 0.02 * abs(float(values[0])) or 0.02
    return float(min(0.45 * np.diff(values).min(), 0.012 * (values[-1] - values[0])))
