"""The section on snaps: at the value with most motions, how often each pulls how hard, and their tensions."""

import numpy as np

from engine.views import snaps_of
from tables import PEAK, Column, number, number_of

from ..figures.snaps import SnappingMotion, exceedance, tension_histories
from ..parts import Figure, Folder, Heading, Items, having
from ..parts.style import BLUE
from .quantities import colours_of, in_order

SHOWN_PERIODS = 12.0  # of the histories: motions of period 2, 3, 4 and 6 are seen to repeat


def snap_items(folder: Folder, key: Column) -> Items:
    """Nothing where no run of the table snaps."""
    rows = [row for row in having(folder.table, status="ok") if number_of(row, "snaps_per_wave") > 0.0]
    motions: dict[float, list] = {}
    for row in in_order(rows, [key.name]):
        motions.setdefault(row[key.name], []).append(row)
    if not motions:
        return []

    def interest(value: float) -> tuple[int, float]:
        return len(motions[value]), max(number_of(row, PEAK) for row in motions[value])

    value = max(motions, key=interest)
    shown, static_N = [], np.nan
    for row in in_order(having(folder.table, status="ok"), []):
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
    motion = SnappingMotion(
        letter=letter,
        title=", ".join(filter(None, words)),
        colour=colour,
        times=times[last] - times[-1],
        low_kN=low,
        high_kN=high,
        peaks_kN=1e-3 * snaps.peak_N,
        waves=waves,
    )
    return motion, snaps.static_N
