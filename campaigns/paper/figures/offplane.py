"""Data of figure 20: motion across the plane of the waves after a push of 1e-5 m/s, of the buoy and of the rope."""

import numpy as np

from campaigns.figure_data import Array
from campaigns.paper.measures import LARGE, SMALL
from campaigns.paper.part_folders import Parts, Plan

DISPLACEMENT = {"buoy": "y_m", "rope": "offplane_m"}  # column of a trajectory
WAVES = {"small": SMALL, "large": LARGE}  # in the order of the paper's key


def offplane_histories(parts: Parts) -> Plan:
    """Figure 20."""
    part, runs = parts.part("out_of_plane"), {}
    for name, kA in WAVES.items():
        wanted = {**part.provenance["base"], "steepness": kA}
        runs[name] = parts.run(part, f"kA = {kA:g} with a push across the waves", **wanted)
    sources = tuple(found for *_, found in runs.values())
    return Plan("Motion across the plane of the waves", sources, lambda: _histories(runs))


def _histories(runs: dict) -> dict[str, Array]:
    from analysis import envelope_of

    arrays: dict[str, Array] = {}
    for name, (row, trajectory, _) in runs.items():
        scene, columns, kA = trajectory.scene, trajectory.columns, f"kA = {WAVES[name]:g}"
        period_s, along, of_envelope = scene.waves.period_s, (f"{name}_time_s",), (f"{name}_periods",)
        arrays[along[0]] = (along, columns["time_s"], "s", "time")
        for body, column in DISPLACEMENT.items():
            size = np.abs(columns[column])
            arrays[f"{name}_{body}_m"] = (along, size, "m", f"distance from the plane, {body}, {kA}")
            time, most = envelope_of(size[np.isfinite(size)], scene.sample_step_s(), period_s)
            arrays[of_envelope[0]] = (of_envelope, time / period_s, "1", "time in wave periods")
            about = f"largest distance from the plane in each wave period, {body}, {kA}"
            arrays[f"{name}_{body}_envelope_m"] = (of_envelope, most, "m", about)
        arrays[f"{name}_inplane_m"] = ((), row["inplane_m"], "m", f"half the range of the buoy in the plane, {kA}")
        arrays["wave_period_s"] = ((), period_s, "s", "wave period T_i")
        arrays["static_radius_m"] = ((), columns["radius_m"][0], "m", "static distance r_0 of the buoy from the anchor")
        arrays["push_mps"] = ((), row["seed_mps"], "m s-1", "velocity across the waves at t = 0")
    return arrays
