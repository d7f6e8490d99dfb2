"""The snaps of motions: how often a peak is exceeded, and the tension histories beside each other."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ..parts import Picture
from .curves import Curve, Panel, curves


class SnappingMotion(NamedTuple):
    """The tension of one motion and its snaps.

    letter, colour of the motion; letter "" where there is one
    title          of its history
    times          (n,) wave periods from the first that is shown
    low_kN, high_kN (n,) extremes of the tension at the top since the sample before
    peaks_kN       (k,) of its snaps
    waves          wave periods in which there were so many
    """

    letter: str
    title: str
    colour: str
    times: np.ndarray
    low_kN: np.ndarray
    high_kN: np.ndarray
    peaks_kN: np.ndarray
    waves: float


def exceedance(motions: Sequence[SnappingMotion]) -> Picture:
    """Snaps a wave whose peak is larger than a tension, over this tension; one curve a motion."""
    lines = []
    for motion in motions:
        if not len(motion.peaks_kN):
            continue
        across, up = larger_a_wave(motion.peaks_kN, motion.waves)
        lines.append(Curve(across, up, motion.letter, colour=motion.colour, width=1.2))
    largest = max(float(motion.peaks_kN.max(initial=0.0)) for motion in motions)
    limits = {"xlim": (0.0, 1.05 * largest)}
    panel = Panel(lines, "peak of a snap (kN)", "snaps a wave that are larger", log="y", settings=limits)
    return curves([[panel]], 2.6, "lower left")


def larger_a_wave(peaks_kN: np.ndarray, waves: float) -> tuple[np.ndarray, np.ndarray]:
    """The corners of a stair (2 k,) from the largest of k peaks down to 0: tension, and how many a wave are larger.

    To the left of a peak it counts, to the right of it not.
    """
    peaks = np.sort(peaks_kN)[::-1]
    often = np.arange(1, len(peaks) + 1) / waves
    return np.append(np.repeat(peaks, 2)[1:], 0.0), np.repeat(often, 2)


def tension_histories(motions: Sequence[SnappingMotion], static_kN: float) -> Picture:
    """Tension at the top over time, a panel a motion, on one scale; the line is the static tension."""
    lowest = min(float(motion.low_kN.min()) for motion in motions)
    highest = max(float(motion.high_kN.max()) for motion in motions)
    limits, rows = (min(1.05 * lowest, 0.0), 1.05 * highest), []
    for place, motion in enumerate(motions, 1):
        times = np.repeat(motion.times, 2)
        ends = np.column_stack([motion.low_kN, motion.high_kN]).ravel()
        label = "$t/T_i$ (wave periods)" if place == len(motions) else ""
        line = Curve(times, ends, colour=motion.colour, width=0.8)
        rows.append([Panel([line], label, "$T$ (kN)", motion.title, level=static_kN, settings={"ylim": limits})])
    return curves(rows, 0.5 + 1.15 * len(rows), share="x")
