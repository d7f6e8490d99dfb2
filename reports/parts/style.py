"""The look of every figure: white paper, and the colours of Okabe & Ito, which colour-blind readers can tell apart.

`sheet` opens a figure with the settings of `templates/report.mplstyle` alone; the matplotlibrc of the user has no
effect. `picture_of` turns the figure into bytes. The same data give the same bytes on every machine, because the
settings are fixed and the bytes have no date.
"""

import io
from collections.abc import Iterator
from contextlib import contextmanager
from importlib.resources import files

import matplotlib
from matplotlib.figure import Figure

from engine.animation import BLUE, ORANGE, SKY, VERMILION  # noqa: F401  the other colours of every figure
from tables import PERIODIC

from .content import Picture

WIDTH_IN = 6.8  # the text width of the PDF page
DOTS_PER_INCH = 200
MOST_VECTOR_POINTS = 6000  # a scatter of more points is smaller, and opens faster, as pixels

GREEN, PURPLE, PLUM, BROWN = "#009e73", "#cc79a7", "#9b3d73", "#7a5200"

_FILE = files("reports").joinpath("templates/report.mplstyle")
_SETTINGS = matplotlib.rc_params_from_file(_FILE, use_default_template=False)
INK, SOFT, GRID = _SETTINGS["text.color"], _SETTINGS["axes.edgecolor"], _SETTINGS["grid.color"]
# colours of the kinds of regimes (`kind_of`), in every diagram and map
REGIME_COLOURS = {
    PERIODIC: BLUE, "quasi-periodic": GREEN, "chaotic": VERMILION, "transient": PURPLE, "undecided": SOFT,
}  # fmt: skip
MAP_PERIODS = ("#a9d3ee", BLUE, "#00365c")  # colours of period 1, period 2, and longer periods on a map
SHADES = ("#f7f1e6", "#eee0c8")  # colours of ranges on an axis; the second is drawn over the first


@contextmanager
def sheet(height_in: float, width_in: float = WIDTH_IN, layout: str | None = "constrained") -> Iterator[Figure]:
    """A blank figure; everything drawn inside the block has the look of the report.

    layout: how matplotlib places the panels; None: the caller places them. When the block ends, the matplotlib settings
    of the caller are back.
    """
    with matplotlib.rc_context():
        matplotlib.rcdefaults()
        matplotlib.rcParams.update(_SETTINGS)
        yield Figure(figsize=(width_in, height_in), layout=layout)


def picture_of(figure: Figure, kind: str = "svg") -> Picture:
    """The figure as bytes, without date and program name; call it inside the `sheet` block."""
    target = io.BytesIO()
    metadata = {"Date": None, "Creator": None} if kind == "svg" else {"Software": None}
    figure.savefig(target, format=kind, dpi=DOTS_PER_INCH, metadata=metadata)
    return Picture(target.getvalue(), kind)


def kind_of(regime: str) -> str:
    """The regime, one for all periods."""
    return PERIODIC if regime.startswith(PERIODIC) else regime


def kind_for(points: int) -> str:
    """The format of a figure with so many points: "svg" up to MOST_VECTOR_POINTS, then "png"."""
    return "png" if points > MOST_VECTOR_POINTS else "svg"
