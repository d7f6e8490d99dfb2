"""How the exponent of eq. (33) settles: against time, and its scatter against the number of starts averaged."""

from __future__ import annotations

import numpy as np

from ..parts.content import Picture
from ..parts.style import BLUE, INK, VERMILION
from .curves import Curve, Panel, curves


def oscillator_errors(convergence: np.ndarray, of_start: np.ndarray) -> Picture:
    """Left: running mean (time, mean, standard error) (b, 3) with its band. Right: standard deviation of the mean of k
    starts, from of_start (n,) cut into groups of k, against k, with the law k^-1/2 through k = 1."""
    time, mean, error = convergence.T
    band = (time, mean - 2 * error, mean + 2 * error)
    running = Curve(time, mean, "mean over starts, ± 2 standard errors", colour=BLUE, band=band)
    labels = ("time of each start's average (–)", r"$\lambda_1$ (nats per time)")
    left = Panel([running], *labels, level=float(mean[-1]))
    sizes, scatter, uncertainty = group_scatter(of_start)
    ends = np.array([sizes[0], sizes[-1]])
    found = Curve(sizes, scatter, "", "", "o", INK, 2 * uncertainty, 3.5)
    law = Curve(ends, scatter[0] * ends**-0.5, r"$k^{-1/2}$ from $k = 1$", colour=VERMILION)
    log = "xy" if (scatter > 0).all() else "x"  # starts on one periodic orbit may agree to the last bit
    right = Panel([found, law], r"starts averaged, $k$", "scatter of the mean (nats per time)", log=log)
    return curves([[left, right]], 2.8, "upper right")


def group_scatter(of_start: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Group sizes 1, 2, 4, ... with at least eight groups; scatter of the group means; its own standard error."""
    sizes = [2**i for i in range(20) if len(of_start) // 2**i >= 8] or [1]
    scatter, uncertainty = [], []
    for size in sizes:
        groups = len(of_start) // size
        means = of_start[: groups * size].reshape(groups, size).mean(axis=1)
        scatter.append(means.std(ddof=1))
        uncertainty.append(scatter[-1] / np.sqrt(2.0 * (groups - 1)))
    return np.array(sizes), np.array(scatter), np.array(uncertainty)
