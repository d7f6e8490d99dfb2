"""A run of the out-of-plane campaign as one row of numbers: what leaves the plane of the waves, how, and how far.

Lateral motion is |y| of the buoy and, for the rope, the largest |y| of any node. Either has a rate only where it grows
or decays exponentially, and bursts only where it does neither (`analysis.growth`). A planar run has no lateral columns,
but the exponent of an infinitesimal perturbation across its plane (offplane_growth_), unless it released loops.
"""

import numpy as np

from campaigns.buoy_sweep.rows import STATISTICS, across_plane, settled, sound_part

EARLY_PERIODS = 8  # before the first loop at every depth of the campaign: still linear in the push
_BODIES = {"buoy": "y_m", "rope": "offplane_m"}
_LATERAL = (
    "{}_motion",
    "{}_rate_bits_per_period",
    "{}_rate_error",
    "{}_rate_nats_per_period",
    "{}_fit_from_period",
    "{}_fit_to_period",
    "{}_fit_span_nats",
    "{}_bursts",
    "{}_burst_median_m",
    "{}_burst_max_m",
    "{}_first_burst_period",
    "{}_first_burst_m",
    "{}_lateral_max_m",
    "{}_lateral_late_m",
    "{}_share_of_inplane",
    "{}_early_gain_s",
    "{}_reason",
)
COLUMNS = (
    "steepness",
    "depth_m",
    "bending_stiffness_Nm2",
    "nodes",
    "dimensions",
    "seed_mps",
    "seed_direction",
    "profiles",
    "periods",
    "status",
    *(name.format(body) for body in _BODIES for name in _LATERAL),
    "inplane_m",
    "bow_inplane_m",
    "bow_lateral_m",
    "radius_min_m",
    "radius_max_m",
    "angle_min_rad",
    "angle_max_rad",
    "tension_top_min_N",
    "tension_top_max_N",
    "slack_fraction",
    "strobed_period",
    "regime",
    "lyapunov_wolf_bits_per_period",
    "lyapunov_wolf_error",
    "lyapunov_tangent_bits_per_period",
    "lyapunov_tangent_error",
    "offplane_growth_bits_per_period",
    "offplane_growth_error",
    *STATISTICS,
    "run_key",
    "message",
)


def offplane_row(trajectory, transient_periods: int, judged: frozenset = frozenset()) -> dict[str, object]:
    """The columns of `COLUMNS` that a trajectory fills; those left out are unknown.

    trajectory: an engine Trajectory of a buoy in waves along x, run to its end or not. transient_periods: left out of
    in-plane extremes and of the comparison. judged: keys of the scenes that get a regime and exponents.
    {buoy,rope}_lateral_max_m over the whole record, _late_m over its second half; _share_of_inplane: the maximum by
    inplane_m, half the larger of the ranges of the buoy's x and z after the transient; _early_gain_s: the largest
    lateral distance in the first EARLY_PERIODS by the lateral speed of the push.
    bow_inplane_m, bow_lateral_m: largest distance of a node from the straight line between the tether's ends, in the
    plane of the waves and across it (runs with profiles).
    """
    row = {"status": trajectory.status, "message": trajectory.message}
    row |= {name: trajectory.statistics.get(name) for name in STATISTICS}
    columns, scene = sound_part(trajectory.columns), trajectory.scene
    step_s, period_s = scene.sample_step_s(), scene.waves.period_s
    done = (len(columns["time_s"]) - 1) * step_s / period_s
    if done >= transient_periods + 1 - 1e-6:
        after = round(transient_periods * period_s / step_s)
        row |= settled(columns, step_s, period_s, transient_periods)
        row["inplane_m"] = 0.5 * max(float(np.ptp(columns[name][after:])) for name in ("x_m", "z_m"))
        if trajectory.status == "ok" and trajectory.tangent is not None:
            row |= across_plane(trajectory.tangent, transient_periods)
    if scene.motion.dimensions == 3 and done > 0:
        for body, name in _BODIES.items():
            row |= {f"{body}_{key}": entry for key, entry in _lateral(columns[name], scene, row).items()}
    if trajectory.profiles is not None and len(trajectory.profiles.time_s):
        row["bow_inplane_m"], row["bow_lateral_m"] = bows(trajectory.profiles)
    if scene.key() in judged and trajectory.status == "ok" and "inplane_m" in row:
        row |= _regime(trajectory, transient_periods)
    return row


def _lateral(values, scene, row) -> dict[str, object]:
    from analysis import growth_or_bursts

    step_s, period_s, size = scene.sample_step_s(), scene.waves.period_s, np.abs(values)
    found = growth_or_bursts(size, step_s, period_s)
    bits = found.rate.in_bits_per_period(period_s)
    push = abs(scene.start.buoy_velocity_mps[1])
    bursts = found.burst_size
    return {
        "motion": found.kind,
        "reason": found.reason,
        "rate_bits_per_period": bits.value,
        "rate_error": bits.error,
        "rate_nats_per_period": found.rate.value * period_s,
        "fit_from_period": found.begin / period_s,
        "fit_to_period": found.end / period_s,
        "fit_span_nats": found.span_nats,
        "bursts": len(bursts) if found.kind == "bursts" else None,
        "burst_median_m": float(np.median(bursts)) if len(bursts) else None,
        "burst_max_m": float(bursts.max()) if len(bursts) else None,
        "first_burst_period": found.burst_time[0] / period_s if len(bursts) else None,
        "first_burst_m": bursts[0] if len(bursts) else None,
        "lateral_max_m": float(size.max()),
        "lateral_late_m": float(size[len(size) // 2 :].max()),
        "share_of_inplane": float(size.max()) / row["inplane_m"] if row.get("inplane_m") else None,
        "early_gain_s": float(size[: round(EARLY_PERIODS * period_s / step_s) + 1].max()) / push if push else None,
    }


def rope_motion(trajectory, transient_periods: int) -> str | None:
    """What the rope does across the plane, as `offplane_row` names it."""
    return offplane_row(trajectory, transient_periods).get("rope_motion")


def bows(profiles) -> tuple[float, float]:
    """Largest distance of a node from the straight line between the ends of the tether: (in the plane x-z, across it).

    profiles: x_m, y_m, z_m (nt, nn). Across the plane the straight line stands at its share of the buoy's y.
    """
    x, y, z = profiles.x_m, profiles.y_m, profiles.z_m
    top_x, top_z, top_y = x[:, -1:], z[:, -1:], y[:, -1:]
    length = np.maximum(np.hypot(top_x, top_z), 1e-9)
    in_plane = np.abs(x * top_z - z * top_x) / length
    along = np.clip((x * top_x + z * top_z) / length**2, 0.0, 1.0)
    return float(in_plane.max()), float(np.abs(y - along * top_y).max())


def _regime(trajectory, transient_periods: int) -> dict[str, object]:
    from analysis import tangent_lyapunov
    from reports.buoy_sweep.motion import series_verdict

    verdict, wolf = series_verdict(trajectory, transient_periods)
    row = {
        "regime": verdict.regime,
        "lyapunov_wolf_bits_per_period": wolf.value,
        "lyapunov_wolf_error": wolf.error,
    }
    if trajectory.tangent is not None:
        tangent = tangent_lyapunov(trajectory.tangent.growth_nats, transient_periods)[0]
        row |= {"lyapunov_tangent_bits_per_period": tangent.value, "lyapunov_tangent_error": tangent.error}
    return row
