"""The tether while it snaps, from the folder `close_up` of a sweep: the run whose tension peaks highest, in motion."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ..figures.tether_animation import Snap, tether_animation, tether_stills
from ..parts.content import Figure, Heading, Item
from ..parts.folder import read_rows
from ..parts.symbols import T_I
from ..parts.wording import decimals, number

_SHOWN_PERIODS = 3.0


def close_up_items(directory: Path) -> list[Item]:
    """Heading and figure; nothing where no run was kept with its tether."""
    from engine.trajectory import Trajectory, TrajectoryError

    folder = directory / "close_up"
    keys = [row["run_key"] for row in read_rows(folder / "table.csv") if row.get("status") == "ok"]
    try:
        trajectory = Trajectory.load(folder / "trajectories" / f"{keys[-1]}.nc") if keys else None
    except (TrajectoryError, OSError):
        return []
    if trajectory is None or (snap := _snap(trajectory)) is None:
        return []
    at, peak = snap.record[0][np.argmax(snap.record[1])], float(snap.record[1].max())
    seen = f"{number(peak, 3)} N at t/{T_I} = {decimals(float(at), 2)}"
    caption = (
        f"Buoy and tether at kA = {number(trajectory.scene.waves.steepness)} in true proportion, at six values of "
        f"t/{T_I} (above each), and the tension at its top, at most {seen}. Thick: parts without tension; "
        "the wave is the linear one. From the profiles in `close_up/trajectories`."
    )
    alt = f"The tether at six moments as the buoy comes back and pulls it taut, with the top tension, at most {seen}."
    figure = Figure(tether_stills(snap), caption, alt, tether_animation(snap))
    return [Heading("The tether as it snaps", 2), figure]


def _snap(trajectory) -> Snap | None:
    """The wave periods about the highest tension, None where the run has no profiles or no whole period."""
    from engine.physics.sea import elevation_m

    lines, scene = trajectory.profiles, trajectory.scene
    time_s, top = trajectory.columns["time_s"], trajectory.columns["tension_top_high_N"]
    period_s, end_s = scene.waves.period_s, float(time_s[-1])
    if lines is None or len(lines.time_s) < 2 or lines.time_s[-1] < period_s:
        return None
    late = time_s >= min(2.0 * period_s, 0.5 * end_s)  # the start from rest is left out where the record goes on
    shown_s = _SHOWN_PERIODS * period_s
    begin = float(time_s[late][np.argmax(top[late])]) - 0.6 * shown_s
    begin = min(max(begin, 0.0), max(end_s - shown_s, 0.0))
    inside, part = ((times >= begin) & (times <= begin + shown_s) for times in (lines.time_s, time_s))
    x, z = lines.x_m[inside], lines.z_m[inside]
    beyond = max(3.0 * scene.buoy.diameter_m, 0.25 * float(z.max()))  # of the rope, on both sides
    across = np.linspace(x.min() - beyond, x.max() + beyond, 80)
    surface = scene.water.depth_m + elevation_m(scene, lines.time_s[inside][:, None], across)
    record = time_s[part] / period_s, top[part]
    times = lines.time_s[inside] / period_s
    return Snap(times, x, z, lines.tension_N[inside], scene.buoy.diameter_m, (across, surface), record)
