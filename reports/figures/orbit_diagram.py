"""Orbit diagram as an image of counts, with curves of other quantities under it on the same axis."""

from collections.abc import Sequence

import numpy as np

from analysis import density_image, orbit_diagram

from ..parts.content import Picture
from ..parts.style import DENSITY_COLOURS, SOFT, VERMILION, picture_of, sheet
from .curves import Panel, draw

# above a panel: any place inside it may hold points
_ABOVE = {"loc": "lower left", "bbox_to_anchor": (0.0, 1.0), "ncols": 3, "borderaxespad": 0.0, "borderpad": 0.1}


def orbit_diagram_over(
    parameter: np.ndarray,
    strobed: Sequence[np.ndarray],
    labels: tuple[str, str],
    below: Sequence[Panel],
    missing: Sequence[float] = (),
    marks: Sequence[tuple[float, str]] = (),
    rows: int = 200,
) -> Picture:
    """Density of strobed points over a parameter, panels of curves over the same parameter below.

    Args: `parameter` (p,); `strobed` p arrays of points, one of which at least is not empty; `labels` of the parameter
    and of the points, with units; `missing` parameter values of runs without points (crosses); `marks` (value, text)
    drawn as vertical lines; `rows` pixels of the value axis. A run is a column of pixels, `half` its half width.
    """
    from matplotlib.colors import LinearSegmentedColormap, LogNorm
    from matplotlib.ticker import LogLocator

    diagram = orbit_diagram(parameter, strobed)
    image = density_image(diagram, rows)
    counts, value_edges = image.counts, image.value_edges
    places = np.concatenate([diagram.parameter, np.asarray(missing, float)])  # of all runs on the axis
    half = _half_width(places)
    shades = LogNorm(1, max(int(counts.max()), 2))
    colours = LinearSegmentedColormap.from_list("density", DENSITY_COLOURS)
    with sheet(3.0 + 1.2 * len(below)) as figure:
        heights = [3.0, *([1.2] * len(below))]
        top, *lower = figure.subplots(len(heights), 1, sharex=True, squeeze=False, height_ratios=heights)[:, 0]
        top.grid(False)
        for x, column in zip(diagram.parameter, counts.T, strict=True):
            if column.any():
                shown = np.ma.masked_equal(column[:, None], 0)  # pixels without points stay blank
                mesh = top.pcolormesh([x - half, x + half], value_edges, shown, norm=shades, cmap=colours)
        ticks = {"ticks": LogLocator(subs=(1, 2, 5)), "format": "%d"}
        bar = figure.colorbar(mesh, ax=[top, *lower], label="points in a pixel", aspect=45, pad=0.01, **ticks)
        bar.minorticks_off()
        top.set_ylabel(labels[1])
        for axes, panel in zip(lower, below, strict=True):
            draw(axes, panel)
            if axes.get_legend_handles_labels()[1]:
                axes.legend(markerscale=1.5, **_ABOVE)
        if len(missing):
            look = {"color": VERMILION, "markersize": 6, "linestyle": "none", "clip_on": False}
            low = np.full(len(missing), 0.02)
            on_axis = top.get_xaxis_transform()  # x as data, y as a share of the height
            top.plot(missing, low, marker="x", transform=on_axis, label="run without strobed points", **look)
            top.legend(**_ABOVE)
        for at, text in marks:
            for axes in (top, *lower):
                axes.axvline(at, color=SOFT, linewidth=0.8, linestyle=(0, (3, 2)))
            place = ("data", "axes fraction")
            top.annotate(text, (at, 1.0), xycoords=place, fontsize=7.5, ha="center", va="bottom")
        margin = half * (2 if np.ptp(places) > 0 else 12)
        top.set_xlim(places.min() - margin, places.max() + margin)
        (top, *lower)[-1].set_xlabel(labels[0])
        figure.align_ylabels()
        return picture_of(figure, "png")  # in an SVG every pixel would be an element


def _half_width(parameter: np.ndarray) -> float:
    """Half the width of a column: short of touching the nearest neighbour, and too narrow to claim a range."""
    values = np.unique(parameter)
    if len(values) == 1:
        return 0.02 * abs(float(values[0])) or 0.02
    return float(min(0.45 * np.diff(values).min(), 0.012 * (values[-1] - values[0])))
