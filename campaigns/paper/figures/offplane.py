"""Data of figure 20: motion across the plane of the waves after a push of 1e-5 m/s, of the buoy and of the rope."""

import numpy as np

from campaigns.figure_data import Array
from campaigns.paper.figures.plans import Parts, Plan
from campaigns.paper.measures import LARGE, SMALL

DISPLACEMENT = {"buoy": "y_m", "rope": "offplane_m"}  # column of a trajectory
WAVES = {"small": SMALL, "large": LARGE}  # in the order of the paper's key


def offplane_histories(parts: Parts) -> Plan:
    """Figure 20."""
    part = parts.part("out_of_plane")
    base = dict(part.provenance["base"])
    runs, found = {}, []
    for name, steepness in WAVES.items():
        label = f"kA = {steepness:g} with a push across the waves"
        row, trajectory, one = parts.run(part, label, **{**base, "steepness": steepness})
        runs[name] = (row, trajectory)
        found.append(one)
    return Plan("Motion across the plane of the waves", tuple(found), lambda: _histories(runs))


def envelope(trajectory, body: str) -> tuple[np.ndarray, np.ndarray]:
    """Largest lateral distance in each wave period: (t/T_i (m,), m (m,))."""
    from analysis import envelope_of

    period_s = trajectory.scene.waves.period_s
    values = np.abs(trajectory.columns[DISPLACEMENT[body]])
    time, size = envelope_of(values[np.isfinite(values)], trajectory.scene.sample_step_s(), period_s)
    return time / period_s, size


def _histories(runs: dict) -> dict[str, Array]:
    arrays: dict[str, Array] = {}
    for name, (row, trajectory) in runs.items():
        columns, period_s, kA = trajectory.columns, trajectory.scene.waves.period_s, f"kA = {WAVES[name]:g}"
        along = (f"{name}_time_s",)
        arrays[along[0]] = (along, columns["time_s"], "s", "time")
        for body, column in DISPLACEMENT.items():
            size = np.abs(columns[column])
            arrays[f"{name}_{body}_m"] = (along, size, "m", f"distance from the plane, {body}, {kA}")
            periods, most = envelope(trajectory, body)
            of_envelope = (f"{name}_periods",)
            arrays[of_envelope[0]] = (of_envelope, periods, "1", "time in wave periods")
            about = f"largest distance from the plane in each wave period, {body}, {kA}"
            arrays[f"{name}_{body}_envelope_m"] = (of_envelope, most, "m", about)
        arrays[f"{name}_inplane_m"] = ((), row["inplane_m"], "m", f"half the range of the buoy in the plane, {kA}")
        arrays["wave_period_s"] = ((), period_s, "s", "wave period T_i")
        arrays["static_radius_m"] = ((), columns["radius_m"][0], "m", "static distance r_0 of the buoy from the anchor")
        arrays["push_mps"] = ((), row["seed_mps"], "m s-1", "velocity across the waves at t = 0")
    return arrays
