"""Maps over two parameters with cells of any size: a colour a cell, borders as lines, hatches over what limits them."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import NamedTuple

import numpy as np
from matplotlib.patheffects import withStroke

from tables import FAILED, SCREENED

from ..parts import MapPlace, Picture, Row, series
from ..parts.style import INK, SOFT, VERMILION, WIDTH_IN, picture_of, sheet
from .curves import Curve, with_gaps

LINES = {"fold": "-", "flip": "--", "torus": ":"}
HATCHES = "////", "\\\\\\\\"  # of the first and the second of `Page.hatched`
_FINE = 200  # points to a side of the even grid on which a place for a text is looked for
_LEAST = 3.5  # of them that a text is away from the border of its region
_DOT = 0.5  # share of a cell's sides that its dot takes


@dataclass(frozen=True, eq=False)
class Page:
    """The n cells of one map, each over those before it.

    boxes (n, 4): left, right, low and high edge. kinds (n,): lines are drawn between cells that differ in it. source
    (n,): a cell that is screened has a dot in place of a full cell, one that failed a cross alone. hatched: what is
    hatched -> (n,). curves: drawn on it, each in its own line or marks. rows: of the table. number, place: of the page,
    and the value that it stands for, "" for the only one.
    """

    boxes: np.ndarray
    kinds: np.ndarray
    source: np.ndarray
    hatched: Mapping[str, np.ndarray] = field(default_factory=dict)
    curves: Sequence[Curve] = ()
    rows: Sequence[Row] = ()
    number: int = 0
    place: str = ""

    @cached_property
    def laid(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """(edges x (p + 1,), y (q + 1,), which cell is on top between them (q, p), -1 for none).

        Edges nearer to each other than 1e-6 of the map are one.
        """
        edges, places = [], []
        for pair in (self.boxes[:, :2], self.boxes[:, 2:]):
            low, span = pair.min(), np.ptp(pair)
            shares, place = np.unique(np.round((pair - low) / span, 6), return_inverse=True)
            edges.append(low + span * shares)
            places.append(place.reshape(pair.shape))
        top = np.full((len(edges[1]) - 1, len(edges[0]) - 1), -1)
        for cell, (x_low, x_high, y_low, y_high) in enumerate(np.hstack(places)):
            top[y_low:y_high, x_low:x_high] = cell
        return *edges, top

    @cached_property
    def area(self) -> np.ndarray:
        """(n,) share of the map that each cell takes where it is on top."""
        x, y, top = self.laid
        parts = np.outer(np.diff(y), np.diff(x))
        return np.bincount(top[top >= 0], parts[top >= 0], len(self.boxes)) / parts.sum()

    def column(self, name: str) -> np.ndarray:
        """A number of each cell (n,), nan where it has none."""
        return series(self.rows, name)

    def on_top(self, source: str) -> np.ndarray:
        """(n,) which cells are of that source and not covered by others."""
        return (self.area > 0.0) & (self.source == source)

    def share(self, chosen: np.ndarray) -> float:
        """Of the map."""
        return float(self.area[chosen].sum())


class Map(NamedTuple):
    """One quantity of the cells of a page: colours (n,), "" for none, with a scale (colours, norm, ticks) or a legend.

    texts (n,): written where neighbours of one kind have most room. star: a cell to be marked. limited: whether it is
    hatched.
    """

    page: Page
    title: str
    colours: np.ndarray
    scale: tuple | None = None
    texts: np.ndarray | None = None
    star: int | None = None
    limited: bool = True


def regime_maps(
    shown: Sequence[Map],
    labels: tuple[str, str],
    legend: Sequence[tuple[str, str]],
    marks: tuple[Sequence[float], Sequence[float]],
    wide: int,
    width_in: float = WIDTH_IN,
    kind: str = "svg",
) -> tuple[Picture, tuple[MapPlace, ...]]:
    """Maps over the same two parameters, `wide` a row; (picture, the place of each on it).

    labels: of the axes. legend: (colour, or "dot", "cross", "star", "mark", a line or a hatch; its text). marks: values
    on x and on y with a small triangle at the edge.
    """
    from matplotlib.cm import ScalarMappable

    rows, entries = -(-len(shown) // wide), max(1, int(width_in / 2.2))  # of maps; entries of the legend in a row
    height_in = rows * (0.35 + 0.6 * width_in / wide**0.9) + 0.22 * -(-len(legend) // entries) + 0.2
    with sheet(height_in, width_in) as figure:
        grid = figure.subplots(rows, wide, squeeze=False, sharex=True, sharey=True)
        for axes in grid.flat[len(shown) :]:
            axes.set_visible(False)
        for axes, regime_map in zip(grid.flat, shown, strict=False):
            _drawn(axes, regime_map, marks)
            if regime_map.scale is not None:
                colours, norm, ticks = regime_map.scale
                bar = figure.colorbar(ScalarMappable(norm, colours), ax=axes, ticks=ticks, pad=0.02, aspect=24)
                bar.outline.set_linewidth(0.4)
                bar.ax.minorticks_off()
        for axes in grid.flat[max(len(shown) - wide, 0) : len(shown)]:
            axes.set_xlabel(labels[0])
            axes.tick_params(labelbottom=True)
        for axes in grid[:, 0]:
            axes.set_ylabel(labels[1])
        if legend:
            handles = [_handle(look, text) for look, text in legend]
            side = "upper" if width_in == WIDTH_IN else "lower"
            figure.legend(handles=handles, loc=f"outside {side} left", ncols=entries, handlelength=1.4)
        picture = picture_of(figure, kind)
        places = tuple(map(_place, grid.flat, shown))
    return picture, places


def _place(axes, regime_map: Map) -> MapPlace:
    x, y, width, height = axes.get_position().bounds
    ends = (*axes.get_xlim(), *axes.get_ylim())
    return MapPlace((x, 1.0 - y - height, width, height), ends, regime_map.page.number)


def _drawn(axes, regime_map: Map, marks) -> None:
    from matplotlib.collections import PolyCollection
    from matplotlib.colors import to_rgba
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path

    page = regime_map.page
    dots = page.source == SCREENED
    x, y, top = page.laid
    shown, known = np.unique(top[top >= 0]), regime_map.colours != ""
    colours = np.array([to_rgba(colour or "white") for colour in regime_map.colours])
    filled = (known & ~dots)[top] & (top >= 0)
    axes.pcolormesh(x, y, np.where(filled[..., None], colours[top], 0.0), rasterized=True)
    small = shown[(known & dots)[shown]]
    corners = _corners(page.boxes[small], _DOT)
    axes.add_collection(PolyCollection(corners, facecolors=colours[small], linewidths=0, rasterized=True))
    hatched_cells = page.hatched.values() if regime_map.limited else ()
    for hatch, hatched in zip(HATCHES, hatched_cells, strict=False):
        boxes = _runs(x, y, hatched[top] & (top >= 0))
        parts = [Path(outline, closed=True) for outline in _corners(boxes, 1.0)]
        if parts:
            look = {"facecolor": "none", "edgecolor": INK, "hatch": hatch, "linewidth": 0.0, "hatch_linewidth": 0.35}
            axes.add_patch(PathPatch(Path.make_compound_path(*parts), **look))
    kinds = np.where(top >= 0, np.unique(page.kinds, return_inverse=True)[1][top], -1)
    axes.plot(*_borders(x, y, kinds), color=INK, linewidth=0.8, solid_capstyle="projecting")
    lost = shown[page.source[shown] == FAILED]
    middles = page.boxes[lost].reshape(-1, 2, 2).mean(axis=2)
    axes.plot(*middles.T, "x", color=VERMILION, markersize=3.5, markeredgewidth=0.9)
    _written(axes, regime_map, x, y, top)
    axes.set(xlim=x[[0, -1]], ylim=y[[0, -1]], title=regime_map.title)
    axes.locator_params(nbins=6)
    axes.grid(False)
    for value in marks[0]:
        if x[0] <= value <= x[-1]:
            axes.plot(value, y[0], "^", **_MARK)
    for value in marks[1]:
        if y[0] <= value <= y[-1]:
            axes.plot(x[0], value, ">", **_MARK)


_CURVE = {"color": "white", "linewidth": 1.3, "markersize": 4.0, "markeredgecolor": INK}
_CURVE["path_effects"] = [withStroke(linewidth=2.6, foreground=INK)]
_MARK = {"color": "white", "markeredgecolor": INK, "markersize": 5.5, "markeredgewidth": 0.9, "clip_on": False}
_STAR = {"marker": "*", "color": "white", "markeredgecolor": INK, "markersize": 10.0, "markeredgewidth": 0.9}


def _written(axes, regime_map: Map, x: np.ndarray, y: np.ndarray, top: np.ndarray) -> None:
    """On a map with texts the curves, and the texts of regions where they have room; the star."""
    from scipy.ndimage import label

    halo = {"path_effects": [withStroke(linewidth=2.0, foreground="white")], "weight": "bold"}
    if regime_map.texts is not None:
        for curve in regime_map.page.curves:
            axes.plot(curve.x, curve.y, curve.mark or curve.line, **_CURVE)
        even_x, even_y = _middles(x), _middles(y)
        rows, columns = np.searchsorted(y, even_y) - 1, np.searchsorted(x, even_x) - 1
        even = top[np.ix_(rows, columns)]
        for text in sorted(set(regime_map.texts) - {""}):
            regions, count = label((regime_map.texts == text)[even] & (even >= 0))
            for region in range(1, count + 1):
                place = widest(regions == region, _LEAST)
                if place is not None:
                    row, column = place
                    axes.text(even_x[column], even_y[row], text, ha="center", va="center", fontsize=9, **halo)
    if regime_map.star is not None:
        axes.plot(*regime_map.page.boxes[regime_map.star].reshape(2, 2).mean(axis=1), linestyle="", zorder=5, **_STAR)


def _middles(edges: np.ndarray) -> np.ndarray:
    """The middles of `_FINE` equal spans between the first and the last edge."""
    return np.linspace(edges[0], edges[-1], 2 * _FINE + 1)[1::2]


def _handle(look: str, text: str):
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    marks = {
        "dot": {"marker": "s", "color": SOFT, "markersize": 3.0},
        "cross": {"marker": "x", "color": VERMILION, "markersize": 4.5},
        "star": _STAR | {"markersize": 8.0},
        "mark": {"marker": "^"} | _MARK,
    }
    if look in marks:
        return Line2D([], [], linestyle="", label=text, **marks[look])
    if look in LINES.values():
        return Line2D([], [], linestyle=look, label=text, **_CURVE)
    if look in HATCHES:
        return Patch(facecolor="white", edgecolor=INK, hatch=2 * look, linewidth=0.4, hatch_linewidth=0.35, label=text)
    return Patch(facecolor=look, edgecolor=INK, linewidth=0.4, label=text)


def _corners(boxes: np.ndarray, share: float) -> np.ndarray:
    """(m, 5, 2) outlines of boxes (m, 4), of that share of their sides."""
    middle, half = boxes.reshape(-1, 2, 2).mean(axis=2), 0.5 * share * np.diff(boxes.reshape(-1, 2, 2), axis=2)[..., 0]
    round_once = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1), (-1, -1)])
    return middle[:, None, :] + round_once * half[:, None, :]


def _runs(x: np.ndarray, y: np.ndarray, chosen: np.ndarray) -> np.ndarray:
    """Boxes (m, 4) that cover the chosen places of a raster: neighbours of a row are one."""
    steps = np.diff(np.pad(chosen, ((0, 0), (1, 1))).astype(int), axis=1)
    (row, start), (_, end) = np.nonzero(steps == 1), np.nonzero(steps == -1)
    return np.column_stack([x[start], x[end], y[row], y[row + 1]])


def _borders(x: np.ndarray, y: np.ndarray, kinds: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(x, y) of the lines between neighbours of a raster that differ, nan behind each."""
    level, upright = _runs(x, y, _differ(kinds)), _runs(y, x, _differ(kinds.T))
    across = np.concatenate([level[:, :2], upright[:, [2, 2]]])
    up = np.concatenate([level[:, [2, 2]], upright[:, :2]])
    return with_gaps(across), with_gaps(up)


def _differ(kinds: np.ndarray) -> np.ndarray:
    """Which places of a raster differ from that of the row before."""
    return np.vstack([np.zeros((1, kinds.shape[1]), bool), kinds[1:] != kinds[:-1]])


def widest(inside: np.ndarray, least: float = 0.0) -> tuple[int, int] | None:
    """The cell that is farthest from all outside; None where none is as far as `least` cells."""
    from scipy.ndimage import distance_transform_edt

    if not inside.any():
        return None
    far = distance_transform_edt(np.pad(inside, 1))[1:-1, 1:-1]
    up, across = np.indices(inside.shape)
    aside = np.hypot(up / inside.shape[0] - 0.5, across / inside.shape[1] - 0.5)  # of equals the one in the middle
    cell = np.unravel_index(int(np.argmax(far - 0.1 * aside)), far.shape)
    return tuple(map(int, cell)) if far[cell] >= least else None
