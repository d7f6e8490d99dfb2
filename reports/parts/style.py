"""How every figure looks, and why its bytes repeat: Okabe & Ito's palette safe for all colour vision, white paper.

`sheet` opens a figure under the settings of `templates/report.mplstyle` alone (a reader's own matplotlibrc does not
count); `picture_of` closes it.
"""

import io
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from importlib.resources import files

import matplotlib
import numpy as np
from matplotlib.figure import Figure

from .content import Picture

WIDTH_IN = 6.8  # the text width of the PDF page
DOTS_PER_INCH = 200
MOVING_DOTS_PER_INCH, MOVING_COLOURS, MOST_FRAMES = 90, 64, 48  # of a drawing that moves
MANY_POINTS = 6000  # above this a scatter is smaller and opens faster as pixels

BLUE, VERMILION, GREEN, ORANGE, PURPLE, SKY = "#0072b2", "#d55e00", "#009e73", "#e69f00", "#cc79a7", "#56b4e9"

_FILE = files("reports").joinpath("templates/report.mplstyle")
_SETTINGS = matplotlib.rc_params_from_file(_FILE, use_default_template=False)
INK, SOFT, GRID = _SETTINGS["text.color"], _SETTINGS["axes.edgecolor"], _SETTINGS["grid.color"]
# of the words of the analysis, in every diagram and map; all periods share one
REGIME_COLOURS = {
    "period-": BLUE, "quasi-periodic": GREEN, "chaotic": VERMILION, "transient": PURPLE, "undecided": SOFT,
}  # fmt: skip
MAP_PERIODS = ("#a9d3ee", BLUE, "#00365c")  # of periods 1, 2, and more, on a map
SHADES = ("#f7f1e6", "#eee0c8")  # of ranges that a reader should know of, the later over the earlier


@contextmanager
def sheet(height_in: float, width_in: float | None = None) -> Iterator[Figure]:
    """A blank figure of the given height; what is drawn inside the block has the report's look.

    width_in: of one that says itself where its panels stand; None: of the report's width, laid out by matplotlib.

    The matplotlib settings of the caller are back when the block ends.
    """
    layout = None if width_in else "constrained"
    with matplotlib.rc_context():
        matplotlib.rcdefaults()
        matplotlib.rcParams.update(_SETTINGS)
        yield Figure(figsize=(width_in or WIDTH_IN, height_in), layout=layout)


def picture_of(figure: Figure, kind: str = "svg") -> Picture:
    """The drawing as bytes, free of dates and program names; call it inside the `sheet` block."""
    target = io.BytesIO()
    metadata = {"Date": None, "Creator": None} if kind == "svg" else {"Software": None}
    figure.savefig(target, format=kind, dpi=DOTS_PER_INCH, metadata=metadata)
    return Picture(target.getvalue(), kind)


def kind_for(points: int) -> str:
    """ "svg" for a drawing of few marks, "png" for one of many."""
    return "png" if points > MANY_POINTS else "svg"


def moving_picture(figure: Figure, artists: list, frames: int, show: Callable[[int], None], per_second: int) -> Picture:
    """A GIF of so many frames: `show(k)` changes the `artists`, which alone are drawn again for frame k.

    What stays is drawn once; one layout and one palette for all frames. Of very many frames some are left out, and it
    lasts as long. Call it inside the `sheet` block.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from PIL import Image

    figure.set_dpi(MOVING_DOTS_PER_INCH)
    canvas = FigureCanvasAgg(figure)
    show(0)
    for artist in artists:
        artist.set_animated(True)
    canvas.draw()
    background, images = canvas.copy_from_bbox(figure.bbox), []
    stride = -(-frames // MOST_FRAMES)
    for frame in range(0, frames, stride):
        canvas.restore_region(background)
        show(frame)
        for artist in artists:
            artist.draw(canvas.get_renderer())
        images.append(Image.fromarray(np.array(canvas.buffer_rgba())).convert("RGB"))
    few_images = images[:: max(1, len(images) // 6)]
    sample = np.hstack([np.asarray(image) for image in few_images])
    # not by how often a colour comes: a small red dot would turn brown
    palette = Image.fromarray(sample).quantize(MOVING_COLOURS, Image.Quantize.MAXCOVERAGE)
    first, *rest = (image.quantize(palette=palette, dither=Image.Dither.NONE) for image in images)
    target = io.BytesIO()
    first.save(target, "gif", save_all=True, append_images=rest, duration=round(1000 * stride / per_second), loop=0)
    return Picture(target.getvalue(), "gif")
