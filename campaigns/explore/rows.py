"""A run of the tethered buoy as one row of numbers: what the engine counted, and what the analysis measures.

A column whose analysis does not apply to a run is empty (None), never 0: a run that ended inside the transient has its
statistics only. Extremes and slack are taken after the transient, the height of the buoy over the whole run.
"""

from dataclasses import replace

import numpy as np

from analysis import detect_period, extremes, slack_fraction, transverse_lyapunov
from analysis.evidence import evidence_text
from analysis.snaps import NEAR_ZERO
from campaigns.explore.grid import STEEPNESS
from campaigns.explore.motions import MOTIONS
from campaigns.explore.multipliers import MULTIPLIERS
from campaigns.judge import periods_of, samples_of
from campaigns.machinery import filled
from engine.run.rest import static_tension_N
from engine.trajectory.columns import across_waves, heading_of, largest_along
from engine.trajectory.excursions import emergence
from engine.views import LONGEST_PERIOD, STROBE_TOLERANCE, snaps_of, strobed_states
from tables import (
    EMERGED,
    LINE_COUNTS,
    MESSAGE,
    PERIODS_RUN,
    PLANE,
    REGIMES,
    RUN_KEY,
    SHEET,
    SOLVER_COUNTS,
    STATUS,
    Column,
    Row,
    counted,
    finite,
)

DIMENSIONS = Column("dimensions", "", "D", "dimensions of the motion: 2, in the plane of the waves, or 3", 0, PLANE)
TRANSIENT = Column(
    "transient_periods", "", "transient", "wave periods at the start that are left out of extremes", 0, REGIMES
)
STROBED = Column("strobed_period", "", "N", "wave periods after which the motion repeats; empty where none is found", 0)
SLACK = Column(
    "slack_fraction", "", "χ",
    "share of the time after the transient with less than 5 % of the static tension at the top", 3,
)  # fmt: skip
# Columns of `settled`, which any run has that outlasts its transient, with or without a verdict.
EXTREMES = (
    Column("radius_min_m", "m", "r_min", "smallest distance of the upper end from the anchor after the transient", 2),
    Column("radius_max_m", "m", "r_max", "largest distance of the upper end from the anchor after the transient", 2),
    Column("angle_min_rad", "rad", "θ_min", "smallest angle of the upper end from the vertical after the transient", 3),
    Column("angle_max_rad", "rad", "θ_max", "largest angle of the upper end from the vertical after the transient", 3),
    Column("tension_top_min_N", "N", "T_min", "smallest tension at the top of the line after the transient", 0),
    Column("tension_top_max_N", "N", "T_max", "largest tension at the top of the line after the transient", 0),
    SLACK,
    Column("compression_fraction", "", "χ_c", "share of the time after the transient with T < 0 at the top", 3, SHEET),
)  # fmt: skip
SNAPS = (
    Column("snaps_per_wave", "", "snaps/T_i", "snaps a wave period after the transient (`analysis/snaps.py`)", 2),
    Column("snap_peak_median_N", "N", "snap_med", "median of the peak tensions of snaps after the transient", 0, SHEET),
    Column("snap_peak_95_N", "N", "snap_95", "peak tension that 5 % of the snaps after the transient exceed", 0, SHEET),
    Column("snap_peak_max_N", "N", "snap_max", "largest peak tension of a snap after the transient", 0, SHEET),
    Column("snap_rise_s", "s", "t_rise", "median time from becoming taut to the peak, after the transient", 2, SHEET),
    Column(
        "snap_speed_max_mps", "m/s", "v_snap",
        "largest speed at which the ends of the line move apart when a snap begins, after the transient", 2, SHEET,
    ),
)  # fmt: skip
ALONG_LINE = (
    Column("tension_anchor_max_N", "N", "T_anchor", "largest tension at the anchor after the transient", 0, SHEET),
    Column("tension_line_max_N", "N", "T_line", "largest tension along the line after the transient", 0, SHEET),
    Column(
        "tension_line_max_s_m", "m", "s_max",
        "unstretched length from the anchor to where the tension along the line is largest", 1, SHEET,
    ),
)  # fmt: skip
START_UP = Column(
    "tension_top_start_N", "N", "T_start", "largest tension at the top before the transient is over", 0, SHEET
)
# Snaps of a motion whose period is not known are counted over a multiple of so many waves, into which periods 2, 3, 4
# and 6 fit.
WHOLE_WAVES = 12
ERROR = Column(
    "tension_top_max_error_N", "N", "± T_max",
    "how far the largest tension holds, by a companion on twice the elements at a quarter of the tolerance, and by how "
    "far it stands above what is usual", 0,
)  # fmt: skip
SLACK_ERROR = Column(
    "slack_fraction_error", "", "± χ", "how far the slack fraction holds, by the same companion and by chance", 3
)
REGIME = Column("regime", "", "regime", "period-N, quasi-periodic, chaotic, transient or undecided", None, REGIMES)
_BITS = "bits/period"
WOLF = (
    Column(
        "lyapunov_wolf_bits_per_period", _BITS, "σ_W", "largest Lyapunov exponent of r, by Wolf's method", 3, REGIMES
    ),
    Column("lyapunov_wolf_error", _BITS, "± σ_W", "standard error of the exponent by Wolf's method", 3),
)
TANGENT = (
    Column(
        "lyapunov_tangent_bits_per_period", _BITS, "σ_t", "largest Lyapunov exponent, from tangent dynamics", 3, REGIMES
    ),
    Column("lyapunov_tangent_error", _BITS, "± σ_t", "standard error of the exponent from tangent dynamics", 3),
)
OFFPLANE = (
    Column(
        "offplane_growth_bits_per_period", _BITS, "σ_y", "growth of an infinitesimal push across the plane", 3, SHEET
    ),
    Column("offplane_growth_error", _BITS, "± σ_y", "standard error of the growth rate across the plane", 3),
)
HEIGHT = Column(
    "max_buoy_height_above_water_m", "m", "height",
    "highest point of the sphere above still water over the whole run; negative if it stays below", 2,
)  # fmt: skip
EMERGENCE = Column(
    EMERGED, "", "emerged",
    "largest share of the sphere's diameter above the linear wave over the whole run: 0 below it, from 1 on in "
    "the air; empty where the water acts on the wetted cap", 2, SHEET,
)  # fmt: skip
OUT_OF_WATER = HEIGHT, EMERGENCE
UTILISATION = Column(
    "utilisation", "", "T_max/MBL",
    "largest tension after the transient, divided by tether.breaking_load_N; empty where the scene has none", 3,
)  # fmt: skip
COLUMNS = (
    STEEPNESS,
    DIMENSIONS,
    *MOTIONS,
    STATUS,
    REGIME,
    Column(
        "regime_tighter", "", "tighter", "regime of a chaotic run repeated at a tenth of the tolerance", None, SHEET
    ),
    Column("regime_reason", "", "reason", "why the run has this regime, in words", None, SHEET),
    Column("evidence", "", "evidence", "tests behind the regime: name, value, threshold, met", None, SHEET),
    PERIODS_RUN,
    TRANSIENT,
    STROBED,
    *EXTREMES,
    *SNAPS,
    *ALONG_LINE,
    START_UP,
    ERROR,
    SLACK_ERROR,
    *WOLF,
    *TANGENT,
    *MULTIPLIERS,
    *OFFPLANE,
    UTILISATION,
    *OUT_OF_WATER,
    *LINE_COUNTS,
    Column(
        "buoy_lateral_max_m",
        "m",
        "buoy |y|",
        "largest distance of the buoy from the plane of the waves after the transient, in 3-D",
        3,
        PLANE,
    ),
    Column(
        "rope_lateral_max_m",
        "m",
        "rope |y|",
        "largest distance of any node from the plane of the waves after the transient, in 3-D",
        3,
        PLANE,
    ),
    Column(
        "planar_loop_releases",
        "",
        "planar loops",
        "loop releases of the run in the plane that this one replaces",
        0,
        PLANE,
    ),
    Column("planar_regime", "", "planar regime", "regime of the run in the plane that this one replaces", None, PLANE),
    Column("planar_radius_min_m", "m", "planar r_min", "smallest radius of the run in the plane", 2, PLANE),
    Column("planar_radius_max_m", "m", "planar r_max", "largest radius of the run in the plane", 2, PLANE),
    *SOLVER_COUNTS,
    RUN_KEY,
    MESSAGE,
)


def buoy_row(trajectory, judgement) -> Row:
    """The columns of `COLUMNS` that are known of a run of the tethered buoy in waves, which may have ended early.

    judgement: of the run (`campaigns.explore.judgement.Judgement`). A record that does not outlast the transient of the
    judgement by a wave period has statistics only. A loop release after the transient makes offplane_growth unknown,
    because a loop has no rate across the plane. `campaigns.explore.space` fills the columns planar_.
    """
    scene, transient_periods = trajectory.scene, judgement.transient
    row, columns = begun_row(trajectory)
    if judgement.orbit is not None:
        row |= judgement.orbit.row()
    measured = after_transient(trajectory, columns, transient_periods)
    if measured:
        if judgement.limit:
            orbit, period = judgement.orbit.run.columns, judgement.verdict.period
            measured |= settled(scene, orbit, 0.0) | snap_columns(scene, orbit, 0.0, period)
            measured[STROBED.name] = period
        row |= {TRANSIENT.name: transient_periods, **measured}
        if transient_periods:
            before = samples_of(scene, transient_periods)
            row[START_UP.name] = float(columns["tension_top_high_N"][:before].max())
        if scene.motion.dimensions == 3:
            first = samples_of(scene, transient_periods)  # after the transient
            distance_m = across_waves(heading_of(scene), columns["x_m"], columns["y_m"])
            row["buoy_lateral_max_m"] = float(np.abs(distance_m[first:]).max())
            row["rope_lateral_max_m"] = float(columns["offplane_m"][first:].max())
    if judgement.verdict is not None:
        row |= regime_of(judgement)
    row[UTILISATION.name] = utilisation(scene, row)
    return row


def begun_row(trajectory) -> tuple[Row, dict]:
    """A row with statistics, buoy height and length of a run in waves; and the `sound_part` of its columns."""
    row, columns = counted(trajectory), sound_part(trajectory.columns)
    row |= out_of_water(trajectory.scene, columns)
    if len(columns["time_s"]):
        row[PERIODS_RUN.name] = periods_of(trajectory.scene, columns)
    return row, columns


def regime_of(judgement) -> Row:
    """The columns of the verdict and of the exponents."""
    verdict, record = judgement.verdict, judgement.record
    evidence, reason = evidence_text(verdict), verdict.reason
    if record is not None:
        tests = tuple(replace(test, name=f"samples alone, {test.name}") for test in record.evidence)
        evidence += f"; {evidence_text(replace(record, evidence=tests))}"
    if judgement.note:
        reason += f"; {judgement.note}"
    words = {"regime_tighter": judgement.tighter, "regime_reason": reason, "evidence": evidence}
    row = {REGIME.name: verdict.regime, **words, **exponents(TANGENT, judgement.tangent)}
    if judgement.wolf is not None:
        row |= exponents(WOLF, judgement.wolf)
    return row


def out_of_water(scene, columns) -> Row:
    """The columns OUT_OF_WATER of a run; {} without buoy, water or samples."""
    if scene.buoy is None or scene.water is None or not len(columns["time_s"]):
        return {}
    top_m = scene.anchor.position_m[2] + float(np.max(columns["z_m"])) + 0.5 * scene.buoy.diameter_m
    return {HEIGHT.name: top_m - scene.water.depth_m, EMERGED: emergence(scene, columns)}


def after_transient(trajectory, columns, transient_periods: int) -> Row:
    """The columns that are measured after the transient: `settled`, strobed period, snaps, growth across the plane.

    columns: the `sound_part` of those of the run. {} where they do not outlast the transient by a wave period.
    """
    scene = trajectory.scene
    period_s = scene.waves.period_s
    if not lasts(columns, scene.sample_step_s(), (transient_periods + 1) * period_s):
        return {}
    transient_s = transient_periods * period_s
    points, scale = strobed_states(trajectory, transient_periods, 0.0, transient_periods, columns)
    period = detect_period(points, LONGEST_PERIOD, STROBE_TOLERANCE, scale).period
    row = settled(scene, columns, transient_s) | {STROBED.name: period}
    return row | snap_columns(scene, columns, transient_s, period) | lateral_growth(trajectory, transient_periods)


def lateral_growth(trajectory, transient_periods: int) -> Row:
    """The columns OFFPLANE; none for a run that ended early or carried no perturbation across the plane."""
    growth = trajectory.tangent
    if trajectory.status != "ok" or growth is None or growth.lateral_nats is None:
        return {}
    carried = np.isfinite(growth.lateral_nats)  # nan in periods before a perturbation was carried
    judged = carried & (np.arange(len(growth.released)) >= transient_periods)
    return exponents(OFFPLANE, transverse_lyapunov(growth.lateral_nats[judged], 0, growth.released[judged]))


def lasts(columns, step_s: float, length_s: float) -> bool:
    """Whether a record is at least so long."""
    return (len(columns["time_s"]) - 1) * step_s >= length_s - 1e-6 * step_s


def utilisation(scene, row: Row) -> float | None:
    """`UTILISATION` by the tension of a row along the line; by that at the top where the row has no other."""
    tension_N = row.get("tension_line_max_N", row.get("tension_top_max_N"))
    if tension_N is None or scene.tether.breaking_load_N is None:
        return None
    return tension_N / scene.tether.breaking_load_N


def exponents(columns: tuple[Column, Column], exponent) -> Row:
    """An Exponent in the two columns of its value and its standard error."""
    return filled(columns, (finite(exponent.value), finite(exponent.error)))


def settled(scene, columns, transient_s: float) -> Row:
    """Extremes and slack after the transient: the columns EXTREMES and ALONG_LINE."""
    step_s = scene.sample_step_s()
    # The tension jumps between samples. Its extremes come from columns that take in every step of the solver.
    radius, angle, low, high = (
        extremes(columns[name], step_s, transient_s)
        for name in ("radius_m", "angle_rad", "tension_top_low_N", "tension_top_high_N")
    )
    # Slack begins above T = 0, because T < 0 alone says little: axial waves in a line that hangs loose make much of it.
    slack_N = max(NEAR_ZERO * static_tension_N(scene, columns), 0.0)
    shares = (
        slack_fraction(columns["tension_top_N"], step_s, threshold_N, transient_s).fraction
        for threshold_N in (slack_N, 0.0)
    )
    ends = radius.minimum, radius.maximum, angle.minimum, angle.maximum, low.minimum, high.maximum
    row = filled(EXTREMES, (*ends, *shares))
    return row | along_line(scene, columns, transient_s)


def snap_columns(scene, columns, transient_s: float, period: int | None = None) -> Row:
    """The columns SNAPS; none for a line that bears no tension at rest.

    Snaps a wave, their median, 95 % and rise are those of the last whole periods of the motion after the transient; the
    largest values are those of all snaps after it. period: of the motion, in waves; None: not known.
    """
    try:
        snaps = snaps_of(scene, columns, transient_s=transient_s)
    except ValueError:
        return {}
    waves, counted_from_s = 0.0, transient_s
    if scene.waves is not None and snaps.watched_s > 0.0:
        waves, cycle = snaps.watched_s / scene.waves.period_s, period or WHOLE_WAVES
        if waves >= cycle:
            waves = (waves + 1e-6) // cycle * cycle
        counted_from_s = columns["time_s"][-1] - columns["time_s"][0] - waves * scene.waves.period_s
    in_whole_periods = snaps.counted_s >= counted_from_s
    row = {}
    if waves:
        row["snaps_per_wave"] = float(in_whole_periods.sum() / waves)
    peaks_N = snaps.peak_N[in_whole_periods]
    if len(peaks_N):
        # The median is a peak that occurs. The mean of the two peaks in the middle would jump from run to run where
        # large and small peaks alternate.
        median_N, high_N = np.quantile(peaks_N, [0.5, 0.95], method="inverted_cdf")
        row["snap_peak_median_N"], row["snap_peak_95_N"] = float(median_N), float(high_N)
        row["snap_peak_max_N"] = float(snaps.peak_N.max())
        row["snap_rise_s"] = float(np.median(snaps.rise_s[in_whole_periods]))
        row["snap_speed_max_mps"] = float(snaps.taut_speed_mps.max())
    return row


def along_line(scene, columns, transient_s: float) -> Row:
    """The columns ALONG_LINE after the transient (`engine.trajectory.columns.largest_along`)."""
    first = int(np.ceil(transient_s / scene.sample_step_s() - 1e-6))
    largest_N, places_m = (values[first:] for values in largest_along(columns, scene.tether.length_m))
    most = int(largest_N.argmax())
    anchor_N = columns["tension_anchor_high_N"][first:].max()
    return filled(ALONG_LINE, (float(anchor_N), float(largest_N[most]), float(places_m[most])))


def sound_part(columns) -> dict[str, np.ndarray]:
    """The columns before the first sample in which one of them is not finite: what a run had before it blew up."""
    arrays = {name: np.asarray(values, dtype=float) for name, values in columns.items()}
    finite_samples = np.all([np.isfinite(values) for values in arrays.values()], axis=0)
    end = int(np.logical_and.accumulate(finite_samples).sum())
    return {name: values[:end] for name, values in arrays.items()}
