"""Curves and marks in panels: the drawing that most figures of a report are, given as records of arrays."""

from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke

from ..parts import Picture
from ..parts.style import BLUE, GREEN, ORANGE, PURPLE, SKY, SOFT, VERMILION, picture_of, sheet

COLOURS = (BLUE, VERMILION, GREEN, ORANGE, PURPLE, SKY)

_BINS = 900  # columns of the whole-record view: about two a printed millimetre


class Curve(NamedTuple):
    """One curve: x and y (n,), a name for the legend, and how it looks.

    line, mark: matplotlib's style of the line and of the marks, "" for none. error: standard errors (n,) drawn as bars.
    colour: "" takes the next of COLOURS. filled: whether marks are. pixels: drawn as such also in an SVG, which a
    hundred thousand marks would make unusable. band: x, low and high (m,) of a shade behind it.
    """

    x: np.ndarray
    y: np.ndarray
    name: str = ""
    line: str | tuple = "-"
    mark: str = ""
    colour: str | tuple = ""
    error: np.ndarray | None = None
    size: float = 4.0
    width: float = 0.9
    filled: bool = True
    alpha: float = 1.0
    pixels: bool = False
    band: tuple[np.ndarray, np.ndarray, np.ndarray] | None = None


def dots(x: np.ndarray, y: np.ndarray, mark: str = "o", colour: str | tuple = "", size: float = 4.0, **look) -> Curve:
    """Marks without a line between them; look: further fields of a `Curve`."""
    return Curve(x, y, line="", mark=mark, colour=colour, size=size, **look)


class Panel(NamedTuple):
    """Curves on one pair of axes.

    log: the axes that are logarithmic, "", "x", "y" or "xy". level: a thin horizontal line there. settings: further
    ones of matplotlib's `Axes.set`. ticks: most numbers on the x axis, None as they come. marks: (x, name) of places on
    the x axis. xlim, ylim: ends of the axes, None where the curves decide. beside: "right" or "top" -> factor from the
    axis opposite, label. arrows: (x, y from, y to, colour), upright. texts: (x, y, text, colour). boxes: (left, right,
    low, high, colour, hatch on white or ""). height: against that of other panels.
    """

    curves: Sequence[Curve]
    x_label: str = ""
    y_label: str = ""
    title: str = ""
    log: str = ""
    level: float | None = None
    settings: Mapping[str, object] = {}
    ticks: int | None = None
    xlim: Sequence[float] | None = None
    ylim: Sequence[float | None] | None = None
    marks: Sequence[tuple[float, str]] = ()
    beside: Mapping[str, tuple[float, str]] = {}
    boxes: Sequence[tuple[float, float, float, float, str, str]] = ()
    arrows: Sequence[tuple[float, float, float, str]] = ()
    texts: Sequence[tuple[float, float, str, str]] = ()
    height: float = 1.0


Rows = Sequence[Sequence[Panel]]


def draw(axes, panel: Panel) -> None:
    """Draw a panel on matplotlib's axes, without its legend."""
    if panel.level is not None:
        axes.axhline(panel.level, color=SOFT, linewidth=0.7)
    for number, curve in enumerate(panel.curves):
        look = {
            "color": curve.colour or COLOURS[number % len(COLOURS)],
            "linestyle": curve.line or "none",
            "linewidth": curve.width,
            "marker": curve.mark or None,
            "markersize": curve.size,
            "fillstyle": "full" if curve.filled else "none",
            "alpha": curve.alpha,
            "rasterized": curve.pixels,
            "label": curve.name or "_",
        }
        if curve.filled and curve.mark in ("o", "s", "^", "D", "."):
            look["markeredgewidth"] = 0.0  # marks of many points: an edge would make each of them larger
        if curve.band is not None:
            axes.fill_between(*curve.band, color=SKY, alpha=0.5, linewidth=0)
        if curve.error is None:
            axes.plot(curve.x, curve.y, **look)
        else:
            axes.errorbar(curve.x, curve.y, curve.error, elinewidth=0.8, capsize=1.5, **look)
    for x_low, x_high, y_low, y_high, colour, hatch in panel.boxes:
        face, edge = colour, "white"
        if hatch:
            face, edge = "white", colour
        look = {"facecolor": face, "edgecolor": edge, "hatch": hatch, "linewidth": 0.3, "align": "edge"}
        axes.bar(x_low, y_high - y_low, x_high - x_low, y_low, **look)
    for x, start, end, colour in panel.arrows:
        arrow = {"arrowstyle": "-|>", "color": colour, "linewidth": 1.3, "shrinkA": 0.0, "shrinkB": 0.0}
        axes.annotate("", (x, end), (x, start), arrowprops=arrow)
    for x, y, text, colour in panel.texts:
        size = 7.5 if len(text) == 1 else 6.5
        look = {"ha": "center", "va": "center", "fontsize": size, "fontweight": "bold"}
        axes.text(x, y, text, color=colour, path_effects=[withStroke(linewidth=2.0, foreground="white")], **look)
    for axis in panel.log:
        getattr(axes, f"set_{axis}scale")("log")
    axes.set(xlabel=panel.x_label, ylabel=panel.y_label, title=panel.title)
    if panel.xlim is not None:
        axes.set_xlim(panel.xlim)
    if panel.ylim is not None:
        axes.set_ylim(panel.ylim)
    axes.set(**panel.settings)
    if panel.ticks:
        axes.locator_params(axis="x", nbins=panel.ticks)
    mark(axes, panel.marks)
    for side, (factor, label) in panel.beside.items():
        units = partial(np.multiply, factor), partial(np.multiply, 1.0 / factor)
        if side == "top":
            axes.secondary_xaxis(side, functions=units).set_xlabel(label)
        else:
            axes.secondary_yaxis(side, functions=units).set_ylabel(label)


def mark(axes, marks: Sequence[tuple[float, str]]) -> None:
    """Arrows at the top edge with a name above them, as in the paper's spectra; dashed lines for those without one."""
    arrow = {"arrowstyle": "->", "color": VERMILION, "linewidth": 0.9}
    look = {"ha": "center", "va": "top", "fontsize": 8, "color": VERMILION, "arrowprops": arrow}
    for at, name in marks:
        if name:
            axes.annotate(name, (at, 0.8), (at, 0.985), axes.get_xaxis_transform(), axes.get_xaxis_transform(), **look)
        else:
            axes.axvline(at, color=SOFT, linewidth=0.8, linestyle=(0, (2, 2)))


def curves(
    rows: Rows,
    height_in: float,
    legend: str = "",
    share: str = "",
    kind: str = "svg",
    widths: Sequence[float] | None = None,
) -> Picture:
    """Rows of panels as one picture.

    legend: place inside every panel that has named curves, in matplotlib's words; "below" one for all panels, under
    them, "right" beside them; "" none. share: "x" panels of a column have one x axis, "y" those of a row one y axis,
    "xy" both. widths: of the columns, against each other.
    """
    shared = {"sharex": "col" if "x" in share else "none", "sharey": "row" if "y" in share else "none"}
    handles = {}
    with sheet(height_in) as figure:
        grid = figure.subplots(len(rows), max(map(len, rows)), squeeze=False, width_ratios=widths, **shared)
        for places, panels in zip(grid, rows, strict=True):
            for axes in places[len(panels) :]:
                axes.set_visible(False)
            for axes, panel in zip(places, panels, strict=False):
                draw(axes, panel)
                panel_handles, names = axes.get_legend_handles_labels()
                by_name = dict(zip(names, panel_handles, strict=True))  # the last of those with the same name
                for name, handle in by_name.items():
                    handles.setdefault(name, handle)
                if names and legend not in ("", "below", "right"):
                    axes.legend(loc=legend)
        if legend == "below" and handles:
            figure.legend(handles.values(), handles, loc="outside lower center", ncols=min(len(handles), 4))
        if legend == "right":
            figure.legend(handles.values(), handles, loc="outside right center")
        figure.align_ylabels()
        return picture_of(figure, kind)


def wide_limits(values: np.ndarray, least: float = 1e-9) -> tuple[float, float]:
    """Limits about the finite values, no narrower than `least`: a settled orbit looks like the points it is."""
    low, high = 0.0, 0.0
    finite = values[np.isfinite(values)]
    if len(finite):
        low, high = float(finite.min()), float(finite.max())
    middle, half = 0.5 * (low + high), max(0.56 * (high - low), 0.5 * least, 1e-9 * abs(high))
    return middle - half, middle + half


def with_gaps(lines: np.ndarray) -> np.ndarray:
    """The points (m, n) of m lines, one after the other with nan behind each."""
    return np.pad(lines, ((0, 0), (0, 1)), constant_values=np.nan).ravel()


def cells(figure: Figure, panels: Sequence, wide: int, labels: tuple[str, str], **shared) -> Iterator[tuple]:
    """(axes, panel) of a grid on an open sheet, `wide` a row: the labels of x and y at its edge, the rest hidden."""
    grid = figure.subplots(-(-len(panels) // wide), min(len(panels), wide), squeeze=False, **shared)
    for axes in grid.flat[len(panels) :]:
        axes.set_visible(False)
    for axes in grid[-1]:
        axes.set_xlabel(labels[0])
    for axes in grid[:, 0]:
        axes.set_ylabel(labels[1])
    return zip(grid.flat, panels, strict=False)


def envelope(x: np.ndarray, y: np.ndarray, bins: int = _BINS) -> tuple[np.ndarray, np.ndarray]:
    """A line through the least and greatest y of each of `bins` equal spans: looks like the full line at that width.

    Args: x (n,) increasing, y (n,). Returns x, y of at most 2*bins points; a shorter record comes back as it is.
    Every extreme of y is kept, which simple thinning would lose.
    """
    if len(y) <= 2 * bins:
        return x, y
    indices = set()
    for first, end in pairwise(np.linspace(0, len(y), bins + 1).astype(int)):
        part = y[first:end]
        if np.isfinite(part).any():
            indices.update((first + int(np.nanargmin(part)), first + int(np.nanargmax(part))))
    index = sorted(indices)
    return x[index], y[index]
