"""The rope seen from the side and along the waves, at a few moments round its largest lateral excursion."""

from __future__ import annotations

import numpy as np

from ..parts.content import Picture
from .curves import Curve, Panel, curves


def rope_shapes(moments: list[tuple[str, np.ndarray, np.ndarray, np.ndarray]], kind: str = "svg") -> Picture:
    """Three views: x-z in true proportion, y-z and x-y with y enlarged by its own axis.

    Args: per moment a label and x, y, z (nn,) in m of the nodes, from the anchor to the upper end.
    """
    from matplotlib import colormaps

    shades = [colormaps["viridis"](0.85 * k / max(len(moments) - 1, 1)) for k in range(len(moments))]
    panels = []
    for title, across, up in (("from the side", "x", "z"), ("along x", "y", "z"), ("from above", "x", "y")):
        lines = []
        for (label, *places), shade in zip(moments, shades, strict=True):
            one, other = (places["xyz".index(letter)] for letter in (across, up))
            lines.append(Curve(one, other, label, mark=".", colour=shade, size=2.0, width=0.8))
            lines.append(Curve(one[-1:], other[-1:], line="", mark="o", colour=shade, size=5.0))
        true = {"aspect": "equal", "adjustable": "datalim"} if title == "from the side" else {}
        panels.append(Panel(lines, f"${across}$ (m)", f"${up}$ (m)", title, settings=true, ticks=4))
    return curves([panels], 3.6, "below", kind=kind)
