"""The tether while it snaps, from the folder `close_up` of a sweep: the run whose tension peaks highest, in motion."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ..figures.tether_animation import Snap, still_rows, tether_animation, tether_stills
from ..parts.content import Figure, Heading, Item
from ..parts.folder import read_rows
from ..parts.symbols import T_I
from ..parts.wording import decimals, number

_SHOWN_PERIODS = 3.0


def close_up_items(directory: Path) -> list[Item]:
    """Heading and figure; nothing where no run was kept with its tether."""
    trajectory = _kept(directory / "close_up" / "trajectories")
    if trajectory is None or (snap := _snap(trajectory)) is None:
        return []
    rows = still_rows(snap)
    steepness = number(trajectory.scene.waves.steepness)
    seen = _seen(snap)
    caption = (
        f"Buoy and tether at kA = {steepness} in true proportion, at six values of t/{T_I} (above each), and the "
        f"tension at the top of the tether: {seen}. Thick: parts without tension; the wave is the linear one. From the "
        "profiles in `close_up/trajectories`."
    )
    alt = f"The tether at six moments as the buoy comes back and pulls it taut, with the top tension: {seen}."
    figure = Figure(tether_stills(snap, rows), caption, alt, tether_animation(snap))
    return [Heading("The tether as it snaps", 2), figure]


def _kept(folder: Path):
    """The newest trajectory of the folder's table, None without a sound one."""
    from engine.trajectory import Trajectory, TrajectoryError

    keys = [row["run_key"] for row in read_rows(folder.parent / "table.csv") if row.get("status") == "ok"]
    try:
        return Trajectory.load(folder / f"{keys[-1]}.nc") if keys else None
    except (TrajectoryError, OSError):
        return None


def _snap(trajectory) -> Snap | None:
    """The wave periods about the highest tension, None where the run has no profiles or no whole period."""
    from engine.physics.sea import elevation_m

    lines, columns, scene = trajectory.profiles, trajectory.columns, trajectory.scene
    period_s = scene.waves.period_s
    if lines is None or len(lines.time_s) < 2 or lines.time_s[-1] < period_s:
        return None
    time_s, top = columns["time_s"], columns["tension_top_high_N"]
    # the start from rest is left out where the record goes on
    late = time_s >= min(2.0 * period_s, 0.5 * time_s[-1])
    peak_s = float(time_s[late][np.argmax(top[late])])
    begin = min(max(peak_s - 0.6 * _SHOWN_PERIODS * period_s, 0.0), max(time_s[-1] - _SHOWN_PERIODS * period_s, 0.0))
    inside = (lines.time_s >= begin) & (lines.time_s <= begin + _SHOWN_PERIODS * period_s)
    part = (time_s >= begin) & (time_s <= begin + _SHOWN_PERIODS * period_s)
    x, z = lines.x_m[inside], lines.z_m[inside]
    beyond = max(3.0 * scene.buoy.diameter_m, 0.25 * float(z.max()))  # of the rope, on both sides
    across = np.linspace(x.min() - beyond, x.max() + beyond, 80)
    surface = scene.water.depth_m + elevation_m(scene, lines.time_s[inside][:, None], across)
    return Snap(
        lines.time_s[inside] / period_s, x, z, lines.tension_N[inside], scene.buoy.diameter_m, (across, surface),
        (time_s[part] / period_s, top[part]),
    )  # fmt: skip


def _seen(snap: Snap) -> str:
    slack = float(np.mean((snap.tension_N <= 0.0).any(axis=1)))
    at, peak = snap.record[0][np.argmax(snap.record[1])], float(snap.record[1].max())
    return (
        f"some part of the tether is without tension in {number(100 * slack, 2)} % of the frames, then it snaps to "
        f"{number(peak, 3)} N at t/{T_I} = {decimals(float(at), 2)}"
    )
