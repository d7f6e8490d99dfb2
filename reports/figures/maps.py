"""Maps over two parameters: a number by its shade, a word by its colour; crosses where there is nothing."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from tables import Column

from ..parts import Picture, Row, series
from ..parts.style import BLUE, GRID, ORANGE, REGIME_COLOURS, SKY, VERMILION, picture_of, sheet
from .curves import cells

_OTHERS = (BLUE, SKY, ORANGE, "#004c77", "#8fd3c1", "#f0e442", GRID)


class Map(NamedTuple):
    """One quantity of the rows of a table: numbers, nan for none, or words, "" for none.

    label: of the scale of numbers; name: as a caption says it.
    """

    label: str
    name: str
    values: Sequence


def maps(keys: Sequence[Column], rows: Sequence[Row], shown: Sequence[Map]) -> Picture:
    """Maps over the same two keys, two a row; the values stand evenly, with their numbers on the axes."""
    from matplotlib.colors import ListedColormap
    from matplotlib.patches import Patch

    x, across = np.unique(series(rows, keys[0].name), return_inverse=True)
    y, up = np.unique(series(rows, keys[1].name), return_inverse=True)
    with sheet(0.4 + 2.4 * ((len(shown) + 1) // 2)) as figure:
        for axes, shown_map in cells(figure, shown, 2, ("", "")):
            values = np.array(shown_map.values)
            grid = np.full((len(y), len(x)), np.zeros((), values.dtype))  # of words: of empty ones
            look = {"origin": "lower", "aspect": "auto"}
            if values.dtype.kind == "U":
                grid[up, across] = values
                known = grid != ""
                names, free_colours = np.unique(grid[known]), iter(_OTHERS * grid.size)
                handles = []
                for name in names:
                    handles.append(Patch(facecolor=REGIME_COLOURS.get(name) or next(free_colours), label=name))
                colours = ListedColormap([handle.get_facecolor() for handle in handles])
                look |= {"cmap": colours, "vmin": -0.5, "vmax": len(names) - 0.5}
                axes.imshow(np.ma.array(np.searchsorted(names, grid), mask=~known), **look)
                axes.legend(handles=handles, loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=3, borderaxespad=0.0)
            else:
                grid[:] = np.nan
                grid[up, across] = values
                known = np.isfinite(grid)
                image = axes.imshow(np.ma.masked_invalid(grid), cmap="cividis", **look)
                figure.colorbar(image, ax=axes, label=shown_map.label, shrink=0.9)
            nowhere_up, nowhere_across = np.nonzero(~known)
            axes.plot(nowhere_across, nowhere_up, "x", color=VERMILION, markersize=5)
            axes.grid(False)
            for axis, values, key in zip((axes.xaxis, axes.yaxis), (x, y), keys, strict=True):
                ticks = np.unique(np.linspace(0, len(values) - 1, min(len(values), 6)).round().astype(int))
                axis.set_ticks(ticks, [f"{values[k]:.4g}" for k in ticks])
                axis.set_label_text(key.label)
        return picture_of(figure)
