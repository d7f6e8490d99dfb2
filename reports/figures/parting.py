"""How far refined runs of one scene are apart over time: where a motion stops being predictable."""

from __future__ import annotations

import numpy as np

from ..parts.content import Picture
from .curves import Curve, Panel, curves


def parting(time_s: np.ndarray, pairs: list[tuple[str, np.ndarray]], limit_m: float) -> Picture:
    """Largest distance so far, m, of each pair (name, (n,)) over time; limit_m is drawn across."""
    lines = [Curve(time_s, np.maximum(np.maximum.accumulate(apart), 1e-12), name) for name, apart in pairs]
    labels = ("time (s)", "largest difference in $r$ so far (m)")
    panel = Panel(lines, *labels, log="y", level=limit_m, settings={"ylim": (1e-9, None)})
    return curves([[panel]], 2.8, "lower right")
