"""Orbit diagram of eq. (33), both exponents and the slack share under it on the same axis."""

from __future__ import annotations

import numpy as np

from ..parts.content import Picture
from ..parts.style import BLUE, SOFT, VERMILION
from .curves import Curve, Panel
from .orbit_diagram import orbit_diagram_over


def oscillator_diagram(values, strobed, exponents, errors, slack, label: str, marks) -> Picture:
    """Density of strobed displacement, exponents, slack.

    Args: `values` (p,); `strobed` (p, m); `exponents` (p, n, 2) and `errors` (p, n) of lambda_1, nats per time;
    `slack` (p, n); `label` of the parameter's axis; `marks` (value, text) drawn as vertical lines.
    """
    first, second = exponents[..., 0], exponents[..., 1]
    across = np.broadcast_to(values[:, None], first.shape)
    positive = first - 2.0 * errors > 0.0

    def dots(x: np.ndarray, y: np.ndarray, name: str, colour: str, size: float) -> Curve:
        return Curve(x.ravel(), y.ravel(), name, "", "o", colour, size=size)

    lines = [
        dots(across, second, r"$\lambda_2$", SOFT, 1.0),
        dots(across[~positive], first[~positive], r"$\lambda_1$", BLUE, 1.3),
        dots(across[positive], first[positive], r"$\lambda_1$, above 0 by two errors", VERMILION, 1.3),
    ]
    share = Panel([dots(across, slack, "", BLUE, 1.0)], y_label="slack share\n(–)", settings={"ylim": (-0.03, 1.03)})
    below = [Panel(lines, y_label="exponents\n(nats per time)", level=0.0), share]
    inside = [(at, text) for at, text in marks if values[0] <= at <= values[-1]]
    points = [column[np.isfinite(column)] for column in strobed]
    return orbit_diagram_over(values, points, (label, r"strobed $\gamma$ (–)"), below, marks=inside, rows=320)
