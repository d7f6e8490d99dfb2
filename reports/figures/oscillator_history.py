"""Displacement of eq. (33) against time with its slack spans shaded."""

from __future__ import annotations

import numpy as np

from ..parts.content import Picture
from ..parts.style import INK, SKY, SOFT, picture_of, sheet


def oscillator_history(periods: np.ndarray, displacement: np.ndarray, velocity: np.ndarray) -> Picture:
    """Histories over t/T (m,): displacement and velocity (m,); shaded where the tether is slack."""
    with sheet(2.9) as figure:
        for axes, values, label in zip(
            figure.subplots(2, 1, sharex=True),
            (displacement, velocity),
            (r"$\gamma$ (–)", r"$\dot\gamma$ (–)"),
            strict=True,
        ):
            axes.fill_between(
                periods, 0, 1, where=displacement < 0, transform=axes.get_xaxis_transform(), color=SKY, alpha=0.25,
                linewidth=0,
            )  # fmt: skip
            axes.plot(periods, values, color=INK)
            axes.axhline(0.0, color=SOFT, linewidth=0.7)
            axes.set_ylabel(label)
            axes.set_xlim(periods[0], periods[-1])
        axes.set_xlabel(r"$t/T$ (forcing periods)")
        figure.align_ylabels()
        return picture_of(figure)
