"""A run of the tethered buoy as one row of numbers: what the engine counted, and what the analysis measures.

A column whose analysis does not apply to a run stays empty (None), never 0: a run that ended inside the transient has
its statistics and nothing more. Extremes and slack are taken after the transient, the emergence over the whole run.
"""

from dataclasses import replace

import numpy as np

from analysis.evidence import evidence_text
from analysis.looks import CLOSE, next_look
from campaigns.columns import (
    LINE_COUNTS,
    MESSAGE,
    PERIODS_RUN,
    RUN_KEY,
    SOLVER_COUNTS,
    STATUS,
    Column,
    counted,
    names,
    number,
)
from campaigns.explore.approach import judged_by_orbit
from campaigns.explore.motions import MOTIONS
from campaigns.explore.multipliers import MULTIPLIERS, orbit_row
from campaigns.judge import LEAST_JUDGED, OPEN, motion_of, record_regime, tangent_of
from engine.at_rest import static_tension_N
from engine.views import LONGEST_PERIOD, STROBE_TOLERANCE, carried, carries_tangents, state_of

STEEPNESS = Column("steepness", "", "kA", "wave steepness: wave number times amplitude", 3)
DIMENSIONS = Column("dimensions", "", "D", "dimensions of the motion: 2, in the plane of the waves, or 3", 0)
TRANSIENT = Column("transient_periods", "", "transient", "wave periods at the start that are left out of extremes", 0)
STROBED = Column("strobed_period", "", "N", "wave periods after which the motion repeats; empty where none is found", 0)
SLACK = Column(
    "slack_fraction", "", "χ",
    "share of the time after the transient with less than 5 % of the static tension at the top", 3,
)  # fmt: skip
# What is measured after the transient (`settled`) of any line, with or without a verdict.
EXTREMES = (
    Column("radius_min_m", "m", "r_min", "smallest distance of the upper end from the anchor after the transient", 2),
    Column("radius_max_m", "m", "r_max", "largest distance of the upper end from the anchor after the transient", 2),
    Column("angle_min_rad", "rad", "θ_min", "smallest angle of the upper end from the vertical after the transient", 3),
    Column("angle_max_rad", "rad", "θ_max", "largest angle of the upper end from the vertical after the transient", 3),
    Column("tension_top_min_N", "N", "T_min", "smallest tension at the top of the line after the transient", 0),
    Column("tension_top_max_N", "N", "T_max", "largest tension at the top of the line after the transient", 0),
    SLACK,
    Column("compression_fraction", "", "χ_c", "share of the time after the transient with T < 0 at the top", 3),
)  # fmt: skip
ERROR = Column(
    "tension_top_max_error_N", "N", "± T_max",
    "how far the largest tension holds, by a companion on twice the elements at a quarter of the tolerance, and by how "
    "far it stands above what is usual", 0,
)  # fmt: skip
SLACK_ERROR = Column(
    "slack_fraction_error", "", "± χ", "how far the slack fraction holds, by the same companion and by chance", 3
)
NEAR_ZERO = 0.05  # of the static tension: what the paper calls near zero; below it the line is slack
REGIME = Column("regime", symbol="regime", meaning="period-N, quasi-periodic, chaotic, transient or undecided")
_BITS = "bits/period"
WOLF = (
    Column("lyapunov_wolf_bits_per_period", _BITS, "σ_W", "largest Lyapunov exponent of r, by Wolf's method", 3),
    Column("lyapunov_wolf_error", _BITS, "± σ_W", "standard error of the exponent by Wolf's method", 3),
)
TANGENT = (
    Column("lyapunov_tangent_bits_per_period", _BITS, "σ_t", "largest Lyapunov exponent, from tangent dynamics", 3),
    Column("lyapunov_tangent_error", _BITS, "± σ_t", "standard error of the exponent from tangent dynamics", 3),
)
OFFPLANE = (
    Column("offplane_growth_bits_per_period", _BITS, "σ_y", "growth of an infinitesimal push across the plane", 3),
    Column("offplane_growth_error", _BITS, "± σ_y", "standard error of the growth rate across the plane", 3),
)
HEIGHT = Column(
    "max_buoy_height_above_water_m", "m", "height",
    "highest point of the sphere above still water over the whole run; negative if it stays below", 2,
)  # fmt: skip
COLUMNS = (
    STEEPNESS,
    DIMENSIONS,
    *MOTIONS,
    STATUS,
    REGIME,
    Column("regime_tighter", symbol="tighter", meaning="regime of a chaotic run repeated at a tenth of the tolerance"),
    Column("regime_reason", symbol="reason", meaning="why the run has this regime, in words"),
    Column("evidence", symbol="evidence", meaning="tests behind the regime: name, value, threshold, met"),
    PERIODS_RUN,
    TRANSIENT,
    STROBED,
    *EXTREMES,
    ERROR,
    SLACK_ERROR,
    *WOLF,
    *TANGENT,
    *MULTIPLIERS,
    *OFFPLANE,
    HEIGHT,
    *LINE_COUNTS,
    Column("buoy_lateral_max_m", "m", "buoy |y|", "largest |y| of the buoy after the transient, in 3-D", 3),
    Column("rope_lateral_max_m", "m", "rope |y|", "largest |y| of any node after the transient, in 3-D", 3),
    Column(
        "planar_loop_releases", "", "planar loops", "loop releases of the run in the plane that this one replaces", 0
    ),
    Column("planar_regime", symbol="planar regime", meaning="regime of the run in the plane that this one replaces"),
    Column("planar_radius_min_m", "m", "planar r_min", "smallest radius of the run in the plane", 2),
    Column("planar_radius_max_m", "m", "planar r_max", "largest radius of the run in the plane", 2),
    *SOLVER_COUNTS,
    RUN_KEY,
    MESSAGE,
)


def buoy_row(trajectory, transient_periods: int | None, checks=None, full: int | None = None) -> dict[str, object]:
    """The columns of `COLUMNS` that a trajectory of the tethered buoy fills; those left out are unknown.

    trajectory: an engine Trajectory of a scene with waves and a buoy, run to its end or not.
    transient_periods: wave periods left out; a record that does not outlast them by one has statistics only. None:
    those that the verdict has found; a periodic motion then has the multipliers of its orbit, and one that only comes
    nearer to its orbit has the extremes and the slack of the orbit.
    checks: how it went on at a tighter tolerance (`campaigns.judge.motion_of`), for a run that is chaotic.
    full: wave periods after which a run ends undecided, where Wolf's exponent and the tests for records of unknown
    origin are asked for too; the verdict does not rest on them. None: they are not made.
    A run gets a verdict (`campaigns.judge`) if it reached its end and lasts for two looks; in three dimensions, where
    no perturbations are carried, for 40 periods. A loop release after the transient leaves offplane_growth unknown,
    because across the plane a loop has no rate of its own. `campaigns.explore.space` fills the columns planar_.
    """
    row, columns, scene = counted(trajectory), sound_part(trajectory.columns), trajectory.scene
    row[HEIGHT.name] = height_m(scene, columns)
    step_s, period_s = scene.sample_step_s(), scene.waves.period_s
    periods = (len(columns["time_s"]) - 1) * step_s / period_s
    if periods >= 0.0:
        row["periods"] = periods
    verdict, wolf = judged(trajectory, periods, transient_periods, checks)
    orbit, ahead = "", None
    if transient_periods is None:
        if verdict is not None and verdict.regime in (*OPEN, "quasi-periodic"):
            verdict, ahead = judged_by_orbit(trajectory, verdict)
        if ahead is not None:
            row |= ahead.row()[0]
        elif verdict is not None and verdict.period and trajectory.final_state is not None:
            multipliers, orbit = orbit_row(trajectory, verdict.period)
            row |= multipliers
            loose = any(test.name == CLOSE and not test.passed for test in verdict.evidence)
            if loose and not multipliers:
                reason = f"{verdict.reason}; neither perturbations nor multipliers confirm it"
                verdict = replace(verdict, regime="undecided", reason=reason)
        transient_periods = 0 if verdict is None else verdict.transient
    if measured := after_transient(trajectory, columns, transient_periods):
        if ahead is not None:
            measured |= settled(scene, ahead.run.columns, 0.0) | {STROBED.name: verdict.period}
        row |= {"transient_periods": transient_periods, **measured}
        if scene.motion.dimensions == 3:
            first = round(transient_periods * period_s / step_s)  # sample after the transient
            row["buoy_lateral_max_m"] = float(np.abs(columns["y_m"][first:]).max())
            row["rope_lateral_max_m"] = float(columns["offplane_m"][first:].max())
    if verdict is not None:
        evidence, tangent, tighter = [verdict], tangent_of(trajectory, transient_periods), _tighter(verdict)
        goes_on = verdict.regime in OPEN or (verdict.regime == "chaotic" and tighter is None)
        if full is not None and wolf is None and (periods > full - 0.5 or not goes_on):
            record, wolf = record_regime(trajectory, transient_periods, tangent)
            alone = tuple(replace(test, name=f"samples alone, {test.name}") for test in record.evidence)
            evidence.append(replace(record, evidence=alone))
        row |= {
            "regime": verdict.regime,
            "regime_tighter": tighter,
            "regime_reason": f"{verdict.reason}; {orbit}" if orbit else verdict.reason,
            "evidence": "; ".join(map(evidence_text, evidence)),
            **exponents(TANGENT, tangent),
            **(exponents(WOLF, wolf) if wolf is not None else {}),
        }
    return row


def height_m(scene, columns) -> float | None:
    """How high the sphere of a run has risen above still water; None without either, or without a record."""
    if scene.buoy is None or scene.water is None or not len(columns["time_s"]):
        return None
    top_m = scene.anchor.position_m[2] + float(np.max(columns["z_m"])) + 0.5 * scene.buoy.diameter_m
    return top_m - scene.water.depth_m


def judged(trajectory, periods: float, transient_periods: int | None, checks=None):
    """The Verdict on a run, and where its samples alone were judged Wolf's exponent; None where there is none."""
    scene, enough = trajectory.scene, periods - (transient_periods or 0)
    if trajectory.status != "ok":
        return None, None
    if carries_tangents(scene):
        asked = transient_periods is None or (carried(trajectory) and periods >= next_look(next_look()))
        return (motion_of(trajectory, checks) if asked else None), None
    if scene.motion.dimensions == 3 and enough >= LEAST_JUDGED:
        return record_regime(trajectory, transient_periods or 0)
    return None, None


def _tighter(verdict):
    """What a motion is where it went on at a tighter tolerance; None where it did not."""
    passed = next((test.passed for test in verdict.evidence if test.name == "tighter tolerance"), None)
    return None if passed is None else verdict.regime


def after_transient(trajectory, columns, transient_periods: int) -> dict[str, object]:
    """What follows the transient, by column: extremes, slack, strobed period, growth across the plane.

    columns: the `sound_part` of its record; {} where that does not outlast the transient by a wave period.
    """
    from analysis import detect_period, poincare_section, transverse_lyapunov

    step_s, period_s = trajectory.scene.sample_step_s(), trajectory.scene.waves.period_s
    if not lasts(columns, step_s, (transient_periods + 1) * period_s):
        return {}
    row = settled(trajectory.scene, columns, transient_periods * period_s)
    # Its state once a period has to repeat. Only the period goes into the table: the report strobes the radius again.
    coordinates, scale = state_of(columns, step_s, period_s, transient_periods)
    section = poincare_section(coordinates, step_s, period_s, transient_periods=transient_periods)
    row["strobed_period"] = detect_period(section.points, LONGEST_PERIOD, STROBE_TOLERANCE, scale).period
    growth = trajectory.tangent
    if trajectory.status == "ok" and growth is not None and growth.lateral_nats is not None:
        # nan: periods before perturbations were carried
        told = np.isfinite(growth.lateral_nats) & (np.arange(len(growth.released)) >= transient_periods)
        found = transverse_lyapunov(growth.lateral_nats[told], 0, growth.released[told])
        row |= exponents(OFFPLANE, found)
    return row


def lasts(columns, step_s: float, length_s: float) -> bool:
    """Whether a record is of that length at least."""
    return (len(columns["time_s"]) - 1) * step_s >= length_s - 1e-6 * step_s


def exponents(columns: tuple[Column, Column], found) -> dict[str, object]:
    """An Exponent in the two columns of its value and its standard error."""
    return dict(zip(names(columns), (number(found.value), number(found.error)), strict=True))


def settled(scene, columns, transient_s: float) -> dict[str, object]:
    """Extremes and slack of what follows the transient, by column of the table (`EXTREMES`)."""
    from analysis import extremes, slack_fraction

    step_s = scene.sample_step_s()
    # Tension snaps between samples: its extremes come from the columns that saw every step of the solver.
    radius, angle, low, high = (
        extremes(columns[name], step_s, transient_s)
        for name in ("radius_m", "angle_rad", "tension_top_low_N", "tension_top_high_N")
    )
    # T < 0 alone says little: much of it is noise of axial waves in a line that hangs loose.
    tension, static_N = columns["tension_top_N"], static_tension_N(scene, columns)
    shares = (
        slack_fraction(tension, step_s, threshold_N, transient_s).fraction
        for threshold_N in (max(NEAR_ZERO * static_N, 0.0), 0.0)
    )
    ends = radius.minimum, radius.maximum, angle.minimum, angle.maximum, low.minimum, high.maximum
    return dict(zip(names(EXTREMES), (*ends, *shares), strict=True))


def sound_part(columns) -> dict[str, np.ndarray]:
    """The columns up to the first sample that is not finite in all: a run that blew up keeps what it had before."""
    arrays = {name: np.asarray(values, dtype=float) for name, values in columns.items()}
    sound = np.all([np.isfinite(values) for values in arrays.values()], axis=0)
    end = len(sound) if sound.all() else int(np.argmin(sound))
    return {name: values[:end] for name, values in arrays.items()}
