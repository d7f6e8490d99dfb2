"""Basins: in which motion each start of a grid ends, a colour a motion, with its letter where it is widest."""

from collections.abc import Mapping, Sequence

import numpy as np

from ..parts import Picture
from ..parts.style import INK, SHADES, WIDTH_IN, picture_of, sheet

_OPEN = {"unsettled": "x", "failed": "P"}  # marks of starts that belong to no motion


def basin_map(
    places: tuple[np.ndarray, np.ndarray],
    ended: np.ndarray,
    labels: tuple[str, str],
    colours: Mapping[str, str],
    names: Mapping[str, str],
    smallest: tuple[Sequence[float], str] | None,
    width_in: float = WIDTH_IN,
) -> Picture:
    """Starts over the values `places` (p,) and (q,), as cells; one picture.

    ended: (q, p) letters of their motions, or keys of _OPEN. labels: of the axes. colours, names: by letter, what the
    legend says. smallest: end of an arrow from no kick at all, and its text; None for none.
    """
    from matplotlib.colors import ListedColormap
    from matplotlib.patches import Patch
    from matplotlib.patheffects import withStroke

    halo, letters = [withStroke(linewidth=2.0, foreground="white")], list(colours)
    height_in = 0.5 + 0.9 * width_in
    if width_in == WIDTH_IN:
        height_in = 0.5 + 0.62 * width_in
    with sheet(height_in, width_in) as figure:
        axes = figure.subplots()
        axes.grid(False)
        numbers = np.full(ended.shape, -1)
        for number, letter in enumerate(letters):
            numbers[ended == letter] = number
        look = {"cmap": ListedColormap([*colours.values()]), "vmin": -0.5, "vmax": len(letters) - 0.5}
        axes.pcolormesh(_edges(places[0]), _edges(places[1]), np.ma.masked_less(numbers, 0), rasterized=True, **look)
        axes.set_facecolor(SHADES[-1])
        for word, mark in _OPEN.items():
            up, across = np.nonzero(ended == word)
            if len(up):
                size = max(2.0, min(6.0, 160.0 / len(places[0])))
                axes.plot(places[0][across], places[1][up], mark, color=INK, markersize=size, label=word, linestyle="")
        for number, letter in enumerate(letters):
            inside = numbers == number
            if smallest is not None:
                off_the_arrow = inside & _aside(places)
                if off_the_arrow.any():
                    inside = off_the_arrow
            cell = widest(inside)
            if cell is not None:
                place = (places[0][cell[1]], places[1][cell[0]])
                axes.text(*place, letter, ha="center", va="center", fontsize=13, weight="bold", path_effects=halo)
        if smallest is not None:
            end, text = smallest
            begin = (0.0, end[1] if labels[1].startswith("time") else 0.0)
            axes.plot(*begin, "o", color="white", markeredgecolor=INK, markersize=4.5)
            arrow = {"arrowstyle": "-|>", "color": INK, "linewidth": 1.4, "shrinkA": 0.0, "shrinkB": 0.0}
            axes.annotate("", tuple(end), begin, arrowprops=arrow).arrow_patch.set_path_effects(halo)
            _arrow_text(axes, text, begin, end, halo)
        axes.set(xlabel=labels[0], ylabel=labels[1])
        handles = [Patch(facecolor=colours[letter], label=names[letter]) for letter in letters]
        handles += axes.get_legend_handles_labels()[0]
        figure.legend(handles=handles, loc="outside upper left", ncols=max(1, int(width_in / 2.2)))
        return picture_of(figure)


def _arrow_text(axes, text: str, begin: Sequence[float], end: Sequence[float], halo: list) -> None:
    """The text of an arrow beside its head, on the side that the arrow points to."""
    (across, up), (x_offset, y_offset), look = np.subtract(end, begin), (6.0, 3.0), {"ha": "left", "va": "bottom"}
    if across < 0.0:
        x_offset, look["ha"] = -x_offset, "right"
    if up < 0.0:
        y_offset, look["va"] = -y_offset, "top"
    offset = (x_offset, y_offset)
    axes.annotate(text, tuple(end), offset, textcoords="offset points", path_effects=halo, weight="bold", **look)


def _edges(values: np.ndarray) -> np.ndarray:
    half = 0.5 * (values[1] - values[0])
    return np.append(values - half, values[-1] + half)


def _aside(places: tuple[np.ndarray, np.ndarray]) -> np.ndarray:
    """Which cells (q, p) are not near the places of no kick at all."""
    x = places[0] / max(np.abs(places[0]).max(), 1e-9)
    y = places[1] / max(np.abs(places[1]).max(), 1e-9)
    if y.min() >= 0.0:  # a time: without a kick it makes no difference
        y = np.zeros_like(y)
    return np.hypot(x[None, :], y[:, None]) > 0.15


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
