"""A run of the out-of-plane campaign as one row of numbers: what leaves the plane of the waves, how, and how far.

Lateral motion is |y| of the buoy and, for the rope, the largest |y| of any node. Either has a rate only where it grows
or decays exponentially, and bursts only where it does neither (`analysis.growth`). A planar run has no lateral columns,
but the exponent of an infinitesimal perturbation across its plane (offplane_growth_), unless it released loops.
"""

from itertools import chain

import numpy as np

from campaigns.explore.rows import (
    ALONG_LINE,
    DIMENSIONS,
    EXTREMES,
    OFFPLANE,
    REGIME,
    SNAPS,
    STEEPNESS,
    STROBED,
    TANGENT,
    WOLF,
    after_transient,
    exponents,
    sound_part,
)
from campaigns.judge import record_regime, samples_of, tangent_of
from tables import (
    BODIES,
    DEPTH,
    MESSAGE,
    PAIRS,
    PERIODS_RUN,
    PLANE,
    RUN_KEY,
    RUNS,
    SHEET,
    STATISTICS,
    STATUS,
    STIFFNESS,
    Column,
    Columns,
    Row,
    counted,
    of_words,
    on,
)

EARLY_PERIODS = 8  # before the first loop at every depth of the campaign: still linear in the push
RISE_PERIODS = 4  # after its least value, within which lateral distance has risen to the first burst


def _lateral_columns(body: str) -> Columns:
    """What is measured of the distance from the plane of the waves of the buoy or of the rope."""
    rate = "growth rate of the {body}'s lateral distance where it grows or decays exponentially{}".format
    measures = (
        (
            "motion",
            "",
            "motion",
            "growth, decay, bursts ...: how the lateral distance of the {body} behaves",
            None,
            PLANE,
        ),
        ("rate_bits_per_period", "bits/period", "rate", rate("", body=body), 3, PLANE),
        ("rate_error", "bits/period", "± rate", "standard error of the growth rate of the {body}", 3, PLANE),
        ("rate_nats_per_period", "nats/period", "rate", rate(", in nats", body=body), 3, PLANE),
        (
            "fit_from_period",
            "periods",
            "from",
            "begin of the window in which the rate of the {body} was fitted",
            1,
            PLANE,
        ),
        ("fit_to_period", "periods", "to", "end of the window in which the rate of the {body} was fitted", 1, PLANE),
        (
            "fit_span_nats",
            "nats",
            "span",
            "growth of the {body}'s lateral distance over the window of the fit",
            1,
            PLANE,
        ),
        ("bursts", "", "bursts", "bursts of the {body} away from the plane", 0, PLANE),
        ("burst_median_m", "m", "median", "median size of the bursts of the {body}", 3, PLANE),
        ("burst_max_m", "m", "largest", "size of the largest burst of the {body}", 3, PLANE),
        ("first_burst_period", "periods", "first at", "time of the first burst of the {body}", 1, PLANE),
        ("first_burst_m", "m", "first", "size of the first burst of the {body}", 3, SHEET),
        (
            "rise_nats",
            "nats",
            "rise",
            "growth of the {body}'s distance from its least to the rope's first burst",
            1,
            SHEET,
        ),
        (
            "rise_periods",
            "periods",
            "rise in",
            "wave periods that this growth of the {body}'s distance takes",
            1,
            SHEET,
        ),
        ("lateral_max_m", "m", "max |y|", "largest lateral distance of the {body} over the whole run", 2, PLANE),
        (
            "lateral_late_m",
            "m",
            "late |y|",
            "largest lateral distance of the {body} in the second half of the run",
            3,
            SHEET,
        ),
        ("share_of_inplane", "", "of in-plane", "lateral_max_m of the {body} divided by inplane_m", 3, PLANE),
        (
            "early_gain_s",
            "s",
            "|y|/push",
            f"largest |y| in {EARLY_PERIODS} periods of the {{body}} by the push",
            3,
            SHEET,
        ),
        ("reason", "", "reason", "why the lateral motion of the {body} is called so, in words", None, SHEET),
    )
    columns = []
    for name, unit, symbol, meaning, digits, page in measures:
        columns.append(Column(f"{body}_{name}", unit, f"{body} {symbol}", meaning.format(body=body), digits, page))
    return tuple(columns)


COLUMNS = (
    STEEPNESS,
    DEPTH,
    STIFFNESS,
    Column("nodes", "", "nodes", "nodes of the line", 0),
    DIMENSIONS,
    Column("seed_mps", "m/s", "push", "speed of the buoy at t = 0 that lets the motion leave the plane", 3),
    of_words("seed_direction", "direction of the push; empty for a planar run", "direction"),
    Column("profiles", "", "profiles", "1 where the shape of the line was kept, else 0", 0, SHEET),
    *on(RUNS, PERIODS_RUN),
    STATUS,
    *chain.from_iterable(map(_lateral_columns, BODIES)),
    Column("inplane_m", "m", "in-plane", "half the larger range of the buoy's x and z after the transient", 2, SHEET),
    Column(
        "bow_inplane_m", "m", "bow", "largest distance of a node from the chord of the line, in the plane", 2, SHEET
    ),
    Column(
        "bow_lateral_m",
        "m",
        "bow |y|",
        "largest distance of a node from the chord of the line, across the plane",
        3,
        SHEET,
    ),
    *on(PAIRS, *EXTREMES),
    *on(SHEET, *SNAPS, *ALONG_LINE),
    *on(SHEET, STROBED),
    *on(PAIRS, REGIME, *WOLF, *TANGENT),
    *OFFPLANE,
    *STATISTICS,
    RUN_KEY,
    MESSAGE,
)


def offplane_row(trajectory, transient_periods: int, judged: frozenset = frozenset()) -> Row:
    """The columns of `COLUMNS` that a trajectory fills; those left out are unknown.

    trajectory: an engine Trajectory of a buoy in waves along x, run to its end or not. transient_periods: left out of
    in-plane extremes and of the comparison. judged: keys of the scenes that get a regime and exponents.
    """
    row, columns, scene = counted(trajectory), sound_part(trajectory.columns), trajectory.scene
    measured = after_transient(trajectory, columns, transient_periods)
    if measured:
        first = samples_of(scene, transient_periods)
        row |= measured
        row["inplane_m"] = 0.5 * max(float(np.ptp(columns["x_m"][first:])), float(np.ptp(columns["z_m"][first:])))
    if scene.motion.dimensions == 3 and len(columns["time_s"]) > 1:
        for body, name in BODIES.items():
            for measure, value in _lateral(columns[name], scene, row).items():
                row[f"{body}_{measure}"] = value
        first_burst = row.get("rope_first_burst_period")
        if first_burst is not None:
            for body, name in BODIES.items():
                rise = _rise(columns[name], scene, first_burst)
                row[f"{body}_rise_nats"], row[f"{body}_rise_periods"] = rise
    if trajectory.profiles is not None and len(trajectory.profiles.time_s):
        row["bow_inplane_m"], row["bow_lateral_m"] = bows(trajectory.profiles)
    if scene.key() in judged and trajectory.status == "ok" and "inplane_m" in row:
        verdict, wolf = record_regime(trajectory, transient_periods)
        tangent = tangent_of(trajectory, transient_periods)
        row |= {"regime": verdict.regime, **exponents(WOLF, wolf), **exponents(TANGENT, tangent)}
    return row


def _lateral(values, scene, row) -> Row:
    from analysis import growth_or_bursts

    step_s, period_s, size = scene.sample_step_s(), scene.waves.period_s, np.abs(values)
    growth = growth_or_bursts(size, step_s, period_s)
    bits = growth.rate.in_bits_per_period(period_s)
    push = abs(scene.start.buoy_velocity_mps[1])
    bursts = growth.burst_size
    largest_m = float(size.max())
    row_of_body = {
        "motion": growth.kind,
        "reason": growth.reason,
        "rate_bits_per_period": bits.value,
        "rate_error": bits.error,
        "rate_nats_per_period": growth.rate.value * period_s,
        "fit_from_period": growth.begin / period_s,
        "fit_to_period": growth.end / period_s,
        "fit_span_nats": growth.span_nats,
        "lateral_max_m": largest_m,
        "lateral_late_m": float(size[len(size) // 2 :].max()),
    }
    if growth.kind == "bursts":
        row_of_body["bursts"] = len(bursts)
    if len(bursts):
        row_of_body |= {
            "burst_median_m": float(np.median(bursts)),
            "burst_max_m": float(bursts.max()),
            "first_burst_period": growth.burst_time[0] / period_s,
            "first_burst_m": bursts[0],
        }
    if row.get("inplane_m"):
        row_of_body["share_of_inplane"] = largest_m / row["inplane_m"]
    if push:
        early = size[: round(EARLY_PERIODS * period_s / step_s) + 1]
        row_of_body["early_gain_s"] = float(early.max()) / push
    return row_of_body


def _rise(values, scene, first_burst: float) -> tuple[float, float]:
    """How lateral distance comes to the rope's first burst (t/T_i), by its largest in each period: nats, periods."""
    from analysis import envelope_of

    time_s, size = envelope_of(np.abs(values), scene.sample_step_s(), scene.waves.period_s)
    periods = time_s / scene.waves.period_s
    least = int(np.argmin(np.where(periods < first_burst, size, np.inf)))
    highest = least + int(np.argmax(size[least : least + RISE_PERIODS + 1]))
    return float(np.log(size[highest] / size[least])), float(periods[highest] - periods[least])


def bows(profiles) -> tuple[float, float]:
    """Largest distance of a node from the straight line between the ends of the tether: (in the plane x-z, across it).

    profiles: x_m, y_m, z_m (nt, nn). Across the plane the straight line stands at its share of the buoy's y.
    """
    x, y, z = profiles.x_m, profiles.y_m, profiles.z_m
    top_x, top_z, top_y = x[:, -1:], z[:, -1:], y[:, -1:]
    length = np.maximum(np.hypot(top_x, top_z), 1e-9)
    in_plane = np.abs(x * top_z - z * top_x) / length
    share = np.clip((x * top_x + z * top_z) / length**2, 0.0, 1.0)
    return float(in_plane.max()), float(np.abs(y - share * top_y).max())
