"""Lyapunov exponents: convergence of an estimate over the record (the paper's figure 14)."""

from __future__ import annotations

import numpy as np

from ..parts.content import Picture
from ..parts.style import BLUE, SOFT, VERMILION, picture_of, sheet


def convergence(curves: list[tuple[str, np.ndarray, np.ndarray]]) -> Picture:
    """Exponent found so far against the time used. Args: per curve a label, t/T_i (m,), bits per period (m,)."""
    with sheet(2.8) as figure:
        axes = figure.subplots()
        axes.axhline(0.0, color=SOFT, linewidth=0.7)
        for (label, periods, bits), colour, dashes in zip(curves, (BLUE, VERMILION), ("-", "--"), strict=False):
            axes.plot(periods, bits, dashes, color=colour, linewidth=1.2, label=label)
        settled_limits(axes, [bits for _, _, bits in curves])
        axes.set_xlabel(r"$t/T_i$ (wave periods)")
        axes.set_ylabel(r"$\sigma_m$ (bits per period)")
        axes.legend()
        return picture_of(figure, "svg")


def settled_limits(axes, curves: list[np.ndarray]) -> None:
    """An axis that shows 0 and what the curves do after their first tenth, in which they jump about."""
    settled = np.concatenate([bits[len(bits) // 10 :] for bits in curves if len(bits)])
    if settled.size:
        low, high = min(settled.min(), 0.0), max(settled.max(), 0.0)
        margin = 0.15 * max(high - low, 0.02)
        axes.set_ylim(low - margin, high + margin)
