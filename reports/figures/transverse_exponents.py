"""Exponent of an infinitesimal perturbation across the plane over wave steepness."""

from __future__ import annotations

import numpy as np

from ..parts.content import Picture
from ..parts.style import BLUE, SOFT, picture_of, sheet


def transverse_exponents(steepness: np.ndarray, bits: np.ndarray, errors: np.ndarray) -> Picture:
    """Values with one standard error. Args: kA (p,), bits per wave period (p,), their errors (p,)."""
    with sheet(2.6) as figure:
        axes = figure.subplots()
        axes.axhline(0.0, color=SOFT, linewidth=0.7)
        axes.errorbar(steepness, bits, errors, fmt="o", color=BLUE, markersize=3.0, linewidth=0.8, capsize=2.0)
        axes.set_xlabel("$kA$ (–)")
        axes.set_ylabel("across the plane\n(bits per period)")
        axes.margins(0.04)
        return picture_of(figure, "svg")
