"""Lyapunov exponents: convergence of an estimate over the record (the paper's figure 14)."""

from __future__ import annotations

import numpy as np

from ..parts.content import Picture
from .curves import Curve, Panel, curves


def convergence(found: list[tuple[str, np.ndarray, np.ndarray]]) -> Picture:
    """Exponent found so far against the time used. Args: per curve a label, t/T_i (m,), bits per period (m,)."""
    looks = zip(found, ("-", "--"), strict=False)
    lines = [Curve(periods, bits, label, dash, width=1.2) for (label, periods, bits), dash in looks]
    labels = (r"$t/T_i$ (wave periods)", r"$\sigma_m$ (bits per period)")
    limits = settled([bits for _, _, bits in found])
    return curves([[Panel(lines, *labels, level=0.0, settings={"ylim": limits})]], 2.8, "best")


def settled(found: list[np.ndarray]) -> tuple[float, float]:
    """Limits of an axis that shows 0 and what the curves do after their first tenth, in which they jump about."""
    late = np.concatenate([*(bits[len(bits) // 10 :] for bits in found), np.zeros(1)])
    margin = 0.15 * max(float(np.ptp(late)), 0.02)
    return float(late.min()) - margin, float(late.max()) + margin
