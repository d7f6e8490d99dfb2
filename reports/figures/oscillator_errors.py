"""How the exponent of eq. (33) settles: against time, and its scatter against the number of starts averaged."""

from __future__ import annotations

import numpy as np

from ..parts.content import Picture
from ..parts.style import BLUE, INK, SKY, SOFT, VERMILION, picture_of, sheet


def oscillator_errors(convergence: np.ndarray, of_start: np.ndarray) -> Picture:
    """Left: running mean (time, mean, standard error) (b, 3) with its band. Right: standard deviation of the mean of k
    starts, from of_start (n,) cut into groups of k, against k, with the law k^-1/2 through k = 1."""
    with sheet(2.8) as figure:
        left, right = figure.subplots(1, 2)
        time, mean, error = convergence.T
        left.fill_between(time, mean - 2 * error, mean + 2 * error, color=SKY, alpha=0.4, linewidth=0)
        left.plot(time, mean, color=BLUE, label="mean over starts, ± 2 standard errors")
        left.axhline(mean[-1], color=SOFT, linewidth=0.7)
        left.set_xlabel("time of each start's average (–)")
        left.set_ylabel(r"$\lambda_1$ (nats per time)")
        left.legend(loc="upper right")
        sizes, scatter, uncertainty = group_scatter(of_start)
        right.errorbar(sizes, scatter, 2 * uncertainty, fmt="o", color=INK, markersize=3.5, linewidth=0.8)
        law = np.array([sizes[0], sizes[-1]])
        right.plot(law, scatter[0] * law**-0.5, color=VERMILION, label=r"$k^{-1/2}$ from $k = 1$")
        right.set_xscale("log")
        if (scatter > 0).all():  # starts on one periodic orbit may agree to the last bit
            right.set_yscale("log")
        right.set_xlabel(r"starts averaged, $k$")
        right.set_ylabel("scatter of the mean (nats per time)")
        right.legend(loc="upper right")
        return picture_of(figure)


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
