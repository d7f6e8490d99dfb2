"""A grid of cells in the colours of their verdicts: the picture of the first page where a report judges many things."""

from collections import Counter
from collections.abc import Mapping, Sequence
from itertools import chain

from matplotlib.patches import Patch

from tables import count

from ..parts import Figure
from ..parts.style import SOFT, picture_of, sheet


def verdict_grid(groups: Mapping[str, Sequence[str]], colours: Mapping[str, str], what: str, caption: str) -> Figure:
    """A row of cells for each group, a cell for each of its verdicts, with the names of the colours above.

    groups: title -> verdicts; colours: of verdicts, in the order of the names; what: is judged, "case".
    """
    counts, rows = Counter(chain.from_iterable(groups.values())), len(groups)
    with sheet(0.6 + 0.24 * rows) as figure:
        axes = figure.add_subplot()
        for row, verdicts in enumerate(groups.values()):
            cells = [colours.get(verdict, SOFT) for verdict in verdicts]
            axes.bar(range(len(cells)), 0.8, 0.8, row - 0.4, color=cells, align="edge")
        axes.set(ylim=(rows - 0.4, -0.6), yticks=range(rows), yticklabels=list(groups), xticks=[])
        axes.tick_params(axis="y", length=0, labelsize=7.5)
        axes.spines[:].set_visible(False)
        axes.grid(False)
        names = [word for word in colours if word in counts]
        names += sorted(counts.keys() - colours.keys())
        handles = [Patch(color=colours.get(name, SOFT), label=name) for name in names]
        figure.legend(handles=handles, loc="outside upper left", ncols=len(handles))
        picture = picture_of(figure)
    words = ", ".join(f"{number} {verdict}" for verdict, number in counts.most_common())
    return Figure(picture, caption, f"A grid of {count(counts.total(), what)}: {words}.")
