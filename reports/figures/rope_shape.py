"""The rope seen from the side and along the waves, at a few moments round its largest lateral excursion."""

from __future__ import annotations

import numpy as np

from ..parts.content import Picture
from ..parts.style import picture_of, sheet


def rope_shapes(moments: list[tuple[str, np.ndarray, np.ndarray, np.ndarray]]) -> Picture:
    """Three views: x-z and y-z with y enlarged by its own axis, and x-y from above.

    Args: per moment a label and x, y, z (nn,) in m of the nodes, from the anchor to the buoy.
    """
    from matplotlib import colormaps

    with sheet(3.6) as figure:
        side, front, above = figure.subplots(1, 3)
        colours = colormaps["viridis"]
        for number, (label, x, y, z) in enumerate(moments):
            colour = colours(0.85 * number / max(len(moments) - 1, 1))
            for axes, across, up in ((side, x, z), (front, y, z), (above, x, y)):
                axes.plot(across, up, ".-", color=colour, linewidth=0.8, markersize=2.0, label=label)
                axes.plot(across[-1:], up[-1:], "o", color=colour, markersize=5)
        side.set_aspect("equal", adjustable="datalim")
        for axes, title, names in (
            (side, "from the side", ("$x$ (m)", "$z$ (m)")),
            (front, "along the waves", ("$y$ (m)", "$z$ (m)")),
            (above, "from above", ("$x$ (m)", "$y$ (m)")),
        ):
            axes.set_title(title)
            axes.set_xlabel(names[0])
            axes.set_ylabel(names[1])
            axes.locator_params(axis="x", nbins=4)
        handles, labels = side.get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside lower center", ncols=len(labels))
        return picture_of(figure)
