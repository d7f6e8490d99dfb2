"""A drawing that moves, as a GIF: what moves is drawn over what stays: a frame does not cost a whole drawing."""

from __future__ import annotations

import io
from collections.abc import Callable

import numpy as np
from matplotlib.figure import Figure

from .content import Picture

_DOTS_PER_INCH, _COLOURS = 100, 64


def moving_picture(figure: Figure, artists: list, frames: int, show: Callable[[int], None], per_second: int) -> Picture:
    """The drawing as a GIF of so many frames: `show(k)` changes the `artists`, which alone are drawn again for frame k.

    One layout and one palette for all frames. Call it inside the `sheet` block.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from PIL import Image

    figure.set_dpi(_DOTS_PER_INCH)
    canvas = FigureCanvasAgg(figure)
    show(0)
    for artist in artists:
        artist.set_animated(True)
    canvas.draw()
    still, images = canvas.copy_from_bbox(figure.bbox), []
    for frame in range(frames):
        canvas.restore_region(still)
        show(frame)
        for artist in artists:
            artist.draw(canvas.get_renderer())
        images.append(Image.fromarray(np.array(canvas.buffer_rgba())).convert("RGB"))
    sample = np.hstack([np.asarray(images[frame]) for frame in range(0, frames, max(1, frames // 6))])
    # not by how often a colour comes: a small red dot would turn brown
    palette = Image.fromarray(sample).quantize(_COLOURS, Image.Quantize.MAXCOVERAGE)
    first, *rest = (image.quantize(palette=palette, dither=Image.Dither.NONE) for image in images)
    target = io.BytesIO()
    first.save(target, "gif", save_all=True, append_images=rest, duration=round(1000 / per_second), loop=0)
    return Picture(target.getvalue(), "gif")
