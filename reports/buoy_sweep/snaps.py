"""The section on snaps: at the value with most motions, how often each pulls how hard, and their tensions."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from engine.views import snaps_of
from tables import PEAK, Column, number, number_of

from ..figures.curves import Curve, Panel, curves
from ..figures.quantities import colours_of
from ..parts import Figure, Folder, Heading, Items, Picture, in_order
from ..parts.style import BLUE

SHOWN_PERIODS = 12.0  # of the histories: motions of period 2, 3, 4 and 6 are seen to repeat


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


def snap_items(folder: Folder, key: Column) -> Items:
    """Nothing where no run of the table snaps."""
    motions: dict[float, list] = {}
    for row in in_order(folder.completed, [key.name]):
        if number_of(row, "snaps_per_wave") > 0.0:
            motions.setdefault(row[key.name], []).append(row)
    if not motions:
        return []

    def interest(value: float) -> tuple[int, float]:
        return len(motions[value]), max(number_of(row, PEAK) for row in motions[value])

    value = max(motions, key=interest)
    shown, static_N = [], np.nan
    for row in in_order(folder.completed, []):
        if row[key.name] != value:
            continue
        motion = _motion_of(folder, row)
        if motion is not None:
            drawn, static_N = motion
            shown.append(drawn)
    if not any(len(motion.peaks_kN) for motion in shown):
        return []
    place = f"{key.head} = {number(value)} {key.unit}".strip()
    definition = (
        "A snap: the tension, without axial ringing, falls to 5 % of its static value "
        f"({number(1e-3 * static_N, 3)} kN) or less, and then rises to the static value or above it."
    )
    often = (
        f"How many snaps a wave have a larger peak, for each motion at {place}, after the transient. {definition} "
        "From `trajectories`."
    )
    beside = f"Tension at the top in the last {SHOWN_PERIODS:g} wave periods of each motion at {place}, on one scale. "
    return [
        Heading("Snaps"),
        Figure(exceedance(shown), often, f"Curves of snaps a wave over their peak tension at {place}."),
        Figure(
            tension_histories(shown, 1e-3 * static_N),
            f"{beside}Thin line: the static tension.",
            f"Tension histories of {len(shown)} motions at {place}.",
        ),
    ]


def _motion_of(folder: Folder, row: dict) -> tuple[SnappingMotion, float] | None:
    """The history and the snaps of a run with its static tension (N); None where its file or its snaps are missing."""
    trajectory, _ = folder.trajectory(row)
    if trajectory is None or trajectory.scene.waves is None:
        return None
    columns, period_s = trajectory.columns, trajectory.scene.waves.period_s
    transient_s = number_of(row, "transient_periods") * period_s
    try:
        snaps = snaps_of(trajectory.scene, columns, transient_s=transient_s)
    except ValueError:
        return None
    letter = row.get("motion") or ""
    colour = colours_of(folder.table).get(letter, BLUE)
    times = columns["time_s"] / period_s
    last = times >= times[-1] - SHOWN_PERIODS
    words = []
    if letter:
        words.append(f"motion {letter}")
    words.append(row.get("regime") or "")
    per_wave, waves = number_of(row, "snaps_per_wave"), snaps.watched_s / period_s
    if per_wave > 0.0:
        waves = len(snaps) / per_wave
    words.append(f"{number(per_wave, 3)} snaps a wave")
    low, high = (1e-3 * columns[f"tension_top_{end}_N"][last] for end in ("low", "high"))
    title, shown = ", ".join(filter(None, words)), times[last] - times[-1]
    return SnappingMotion(letter, title, colour, shown, low, high, 1e-3 * snaps.peak_N, waves), snaps.static_N


def exceedance(motions: Sequence[SnappingMotion]) -> Picture:
    """Snaps a wave whose peak is larger than a tension, over this tension; one curve a motion."""
    lines = []
    for motion in motions:
        if not len(motion.peaks_kN):
            continue
        across, up = larger_a_wave(motion.peaks_kN, motion.waves)
        lines.append(Curve(across, up, motion.letter, colour=motion.colour, width=1.2))
    largest = max(float(motion.peaks_kN.max(initial=0.0)) for motion in motions)
    panel = Panel(lines, "peak of a snap (kN)", "snaps a wave that are larger", log="y", xlim=(0.0, 1.05 * largest))
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
        rows.append([Panel([line], label, "$T$ (kN)", motion.title, level=static_kN, ylim=limits)])
    return curves(rows, 0.5 + 1.15 * len(rows), share="x")
