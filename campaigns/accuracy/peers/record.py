"""Runs of other codes in the engine's record: places of the upper end, strain along the line, and nothing invented.

What a code does not say is nan in every column, so that nobody takes it for a result.
"""

import numpy as np

from engine.trajectory import COLUMNS, Profiles, Trajectory

SAMPLE_S = 0.05  # between the samples of codes that are not asked for those of the scene


def as_trajectory(scene, status, message, time_s, places_m, statistics, strain=None, s_m=None) -> Trajectory:
    """A Trajectory of what another code computed.

    time_s (m,): even samples; places_m (m, 3): upper end from the anchor, z up; strain (m, n) at the nodes s_m (n,),
    kept at the scene's profile times where it asks for profiles. statistics: numbers, wall_s among them.
    """
    x, y, z = np.asarray(places_m, float).reshape(-1, 3).T
    columns = {name: np.full(len(time_s), np.nan) for name in COLUMNS}
    columns |= {"time_s": np.asarray(time_s, float), "x_m": x, "y_m": y, "z_m": z}
    columns["radius_m"] = np.sqrt(x * x + y * y + z * z)
    end_s = float(time_s[-1]) if len(time_s) else 0.0
    lines = None
    if scene.output.profiles and strain is not None:
        every = round((scene.output.profiles_step_s or scene.sample_step_s()) / scene.sample_step_s())
        kept = np.asarray(strain)[::every]
        unknown = np.full_like(kept, np.nan)
        lines = Profiles(columns["time_s"][::every], s_m, unknown, unknown, unknown, kept, unknown, unknown)
    return Trajectory(scene, status, message, columns, {"end_time_s": end_s, **statistics}, lines)


def sampled(scene, duration_s, places_m, wall_s, steps) -> Trajectory:
    """A Trajectory of places (m, 3) every SAMPLE_S seconds; one with samples missing or not finite is no result."""
    sound = len(places_m) == round(duration_s / SAMPLE_S) + 1 and np.isfinite(places_m).all()
    status, message = ("ok", "") if sound else ("not-finite", "places are missing or not finite")
    statistics = {"wall_s": wall_s, "steps": steps}
    return as_trajectory(scene, status, message, SAMPLE_S * np.arange(len(places_m)), places_m, statistics)


def nothing(scene, status: str, message: str, **statistics: float) -> Trajectory:
    """A Trajectory without a sample, of a run that gave none."""
    return as_trajectory(scene, status, message, np.empty(0), np.empty((0, 3)), statistics)
