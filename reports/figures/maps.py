"""Maps over two parameters: a number by its shade, a word by its colour; crosses where there is nothing."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ..parts import Picture
from ..parts.style import BLUE, GRID, ORANGE, REGIME_COLOURS, SKY, VERMILION, picture_of, sheet
from .curves import cells

_OTHERS = (BLUE, SKY, ORANGE, "#004c77", "#8fd3c1", "#f0e442", GRID)


class Map(NamedTuple):
    """One quantity over x (p,) and y (q,): `cells` (q, p) of numbers, nan for none, or of words, "" for none.

    label: of the scale of numbers; name: as a caption says it.
    """

    label: str
    name: str
    cells: np.ndarray


def maps(places: tuple[np.ndarray, np.ndarray], labels: tuple[str, str], shown: Sequence[Map]) -> Picture:
    """Maps over the same two parameters, two a row; the values stand evenly, with their numbers on the axes."""
    from matplotlib.colors import BoundaryNorm, ListedColormap
    from matplotlib.patches import Patch

    rows = (len(shown) + 1) // 2
    with sheet(0.4 + 2.4 * rows) as figure:
        for axes, shown_map in cells(figure, shown, 2, ("", "")):
            words = shown_map.cells.dtype.kind in "UO"
            known = shown_map.cells != "" if words else np.isfinite(shown_map.cells)
            if words:
                names = sorted(set(map(str, shown_map.cells[known])))
                free_colours = iter(_OTHERS * (1 + len(names) // len(_OTHERS)))
                numbers, colours, handles = np.full(shown_map.cells.shape, -1), [], []
                for place, name in enumerate(names):
                    colour = REGIME_COLOURS.get(name) or next(free_colours)
                    numbers[shown_map.cells == name] = place
                    colours.append(colour)
                    handles.append(Patch(facecolor=colour, label=name))
                norm = BoundaryNorm(np.arange(len(names) + 1) - 0.5, max(len(names), 1))
                look = {"cmap": ListedColormap(colours), "norm": norm}
                axes.imshow(np.ma.masked_less(numbers, 0), origin="lower", aspect="auto", **look)
                axes.legend(handles=handles, loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=3, borderaxespad=0.0)
            else:
                image = axes.imshow(
                    np.ma.masked_invalid(shown_map.cells), origin="lower", aspect="auto", cmap="cividis"
                )
                figure.colorbar(image, ax=axes, label=shown_map.label, shrink=0.9)
            down, across = np.nonzero(~known)
            axes.plot(across, down, "x", color=VERMILION, markersize=5)
            axes.grid(False)
            for axis, values, label in zip((axes.xaxis, axes.yaxis), places, labels, strict=True):
                ticks = np.unique(np.linspace(0, len(values) - 1, min(len(values), 6)).round().astype(int))
                axis.set_ticks(ticks, [f"{values[k]:.4g}" for k in ticks])
                axis.set_label_text(label)
        return picture_of(figure)
