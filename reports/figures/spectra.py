"""Amplitude against angular frequency with the expected modes marked by arrows (the paper's figures 12, 17, 18)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..parts.content import Picture
from ..parts.style import INK, SOFT, VERMILION, picture_of, sheet


@dataclass(frozen=True)
class SpectrumPanel:
    """One spectrum: axis label with unit, frequencies (rad/s), amplitudes, and the modes to mark: (rad/s, name)."""

    label: str
    angular_frequency_radps: np.ndarray
    amplitude: np.ndarray
    marks: tuple[tuple[float, str], ...]


def spectra(panels: list[SpectrumPanel], highest_radps: float) -> Picture:
    """Each spectrum twice: on the paper's linear scale, and on a logarithmic one where a continuous floor shows."""
    with sheet(0.6 + 1.4 * len(panels)) as figure:
        grid = figure.subplots(len(panels), 2, sharex=True, squeeze=False)
        for (linear, logarithmic), panel in zip(grid, panels, strict=True):
            shown = panel.angular_frequency_radps <= highest_radps
            omega, amplitude = panel.angular_frequency_radps[shown], panel.amplitude[shown]
            for axes in (linear, logarithmic):
                axes.plot(omega, amplitude, color=INK, linewidth=0.9)
            linear.set_ylabel(panel.label)
            linear.set_ylim(0.0, max(float(amplitude.max()), 1e-12) * 1.32)
            logarithmic.set_yscale("log")
            log_limits(logarithmic, amplitude)
            mark_modes(linear, panel.marks)
            for frequency, _ in panel.marks:
                logarithmic.axvline(frequency, color=SOFT, linewidth=0.8, linestyle=(0, (2, 2)))
        grid[0, 0].set_title("linear")
        grid[0, 1].set_title("logarithmic")
        for axes in grid[-1]:
            axes.set_xlabel(r"$\omega$ (rad/s)")
            axes.set_xlim(0.0, highest_radps)
        return picture_of(figure)


def log_limits(axes, amplitude: np.ndarray) -> None:
    """Four decades at most below the peak; a spectrum of zeros keeps matplotlib's own limits."""
    peak = float(amplitude.max())
    positive = amplitude[amplitude > 0]
    if peak > 0:
        axes.set_ylim(max(peak * 1e-4, float(positive.min()) * 0.5), peak * 3)


def mark_modes(axes, marks: tuple[tuple[float, str], ...]) -> None:
    """Arrows at the top edge with the name of the mode above them, as in the paper."""
    top = axes.get_ylim()[1]
    for frequency, name in marks:
        axes.annotate(
            name,
            xy=(frequency, top * 0.80),
            xytext=(frequency, top * 0.985),
            ha="center",
            va="top",
            fontsize=8,
            color=VERMILION,
            arrowprops={"arrowstyle": "->", "color": VERMILION, "linewidth": 0.9},
        )
