"""What is measured on the run of a breaking line: fronts, shock, speed of the end, recoil, buckling, spread.

Places are distances s from the fixed end in unstretched metres. Every function takes a trajectory or its profiles and
returns numbers in SI units, nan where the run does not show what is asked for.
"""

import math
from collections.abc import Sequence

import numpy as np

from campaigns.breaking_line.theory import Theory
from engine.trajectory import Profiles, Trajectory

SETTLED_S = 0.005  # after the break, until the corner of the force at its end has left the broken end
MARGIN_M = 5.0  # from both ends: fronts are followed between
LEAST_POINTS = 5
FRONT_SHARES = (0.98, 0.95, 0.9, 0.85, 0.8)  # of the static tension: contours that lead to the speed of the front
SLACK_STRAINS = (0.005, 0.01, 0.02, 0.03)  # contours from which the speed of the slack front is extrapolated
STEEPENING = (0.05, 0.4)  # part of the way to a shock's birth over which the steepening is measured
HALF_WIDTH = 8  # nodes to both sides of a contour, for its slope
BUCKLED_RAD = 0.2
COMPARED = 24  # profiles, at most, over which an error is averaged


def contour(profiles: Profiles, values: np.ndarray, level: float) -> np.ndarray:
    """Place nearest the fixed end where `values` (nt, nn) falls through `level` towards the broken end; (nt,)."""
    above = values > level
    falls = above[:, :-1] & ~above[:, 1:]
    places = np.full(len(values), math.nan)
    rows, s = np.flatnonzero(falls.any(axis=1)), profiles.s_m
    k = np.argmax(falls[rows], axis=1)
    a, b = values[rows, k] - level, values[rows, k + 1] - level
    places[rows] = s[k] + (s[k + 1] - s[k]) * a / (a - b)
    return places


def contour_speed(
    profiles: Profiles, values: np.ndarray, level: float, theory: Theory, between: tuple[float, float] | None = None
) -> float:
    """Speed (m/s) of a contour towards the fixed end until something arrives there: least squares line.

    between: places; None: all but MARGIN_M at both ends.
    """
    low, high = between or (MARGIN_M, theory.length_m - MARGIN_M)
    places, times = contour(profiles, values, level), profiles.time_s
    inside = np.isfinite(places) & (places > low) & (places < high) & (times < theory.arrival_s)
    if inside.sum() < LEAST_POINTS:
        return math.nan
    return -float(np.polyfit(times[inside], places[inside], 1)[0])


def front_speed(profiles: Profiles, theory: Theory) -> float:
    """Speed (m/s) of the edge of the wave, before a shock or the far end meets it.

    The edge itself, a kink of second order, is smeared: ln(speed) of contours of FRONT_SHARES, a parabola in the
    strain, is extrapolated to the static strain.
    """
    unshocked_m = theory.start.distance_m if theory.shocked else theory.length_m
    far = min(unshocked_m, theory.length_m - MARGIN_M)
    between = theory.length_m - far, theory.length_m - min(MARGIN_M, 0.1 * far)
    tensions = [share * theory.force_N for share in FRONT_SHARES]
    speeds = [contour_speed(profiles, profiles.tension_N, level, theory, between) for level in tensions]
    return _extrapolated([theory.strain_at(share) for share in FRONT_SHARES], speeds, 2, theory.strain_at(1.0))


def slack_front_speed(profiles: Profiles, theory: Theory) -> float:
    """Speed of the edge of the slack part: ln(speed) of contours of small strain, extrapolated to no tension."""
    speeds = [contour_speed(profiles, profiles.strain, strain, theory) for strain in SLACK_STRAINS]
    return _extrapolated(SLACK_STRAINS, speeds, 1, theory.speeds.slack_strain)


def _extrapolated(strains: Sequence[float], speeds: list[float], degree: int, strain: float) -> float:
    """The speed at another strain: ln(speed) as a polynomial; nan where a speed is not known."""
    if not all(speed > 0.0 for speed in speeds):
        return math.nan
    return float(np.exp(np.polyval(np.polyfit(strains, np.log(speeds), degree), strain)))


def end_speeds(trajectory: Trajectory) -> np.ndarray:
    """Speed (m/s) of the upper end at every sample."""
    columns = trajectory.columns
    return np.hypot(columns["radius_rate_mps"], columns["radius_m"] * columns["angle_rate_radps"])


def settled_end_speed(trajectory: Trajectory) -> tuple[float, float, float]:
    """Median, least and largest speed (m/s) of the broken end from SETTLED_S after the break on."""
    free = trajectory.columns["time_s"] >= trajectory.scene.end.force_decay_s + SETTLED_S
    speeds = end_speeds(trajectory)[free]
    if not len(speeds):
        return math.nan, math.nan, math.nan
    return float(np.median(speeds)), float(speeds.min()), float(speeds.max())


def end_speed_error(trajectory: Trajectory, theory: Theory) -> float:
    """Largest |v - exact v| over the exact speed v of the end, from SETTLED_S after the break on, while it is known."""
    times = trajectory.columns["time_s"]
    rows = np.flatnonzero(
        (times >= trajectory.scene.end.force_decay_s + SETTLED_S) & (times <= theory.motion.valid_until_s)
    )
    rows = rows[:: max(1, len(rows) // COMPARED)]
    exact = [abs(theory.motion.at([theory.length_m], float(time_s))[1][0]) for time_s in times[rows]]
    if not len(rows):
        return math.nan
    return float(np.max(np.abs(end_speeds(trajectory)[rows] / exact - 1.0)))


def strain_overshoot(profiles: Profiles, until_s: float) -> tuple[float, float]:
    """Shares of the static strain: largest strain above it, and largest rise of strain towards the broken end.

    Before a time at which nothing has come to the fixed end; an exact wave that unloads has neither: the strain falls
    towards the broken end, without a ripple before or behind the shock.
    """
    early = profiles.time_s < until_s
    strain, static = profiles.strain[early], profiles.strain[0]
    rise = np.max(strain - np.minimum.accumulate(strain, axis=1))
    return float(max(np.max((strain - static) / static), 0.0)), float(rise / static.max())


def shock_track(profiles: Profiles, theory: Theory) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Times (m,), places (m,) of the run's shock and of the exact one, where a profile shows both.

    The run's is where the strain passes the mean of the exact strains on the two sides.
    """
    exact, ahead, behind = theory.motion.shock.at(profiles.time_s)
    places = np.full(len(exact), math.nan)
    for row in np.flatnonzero(np.isfinite(exact)):
        places[row] = contour(profiles, profiles.strain[row : row + 1], 0.5 * (ahead[row] + behind[row]))[0]
    seen = np.isfinite(places)
    return profiles.time_s[seen], places[seen], exact[seen]


def shock_birth(profiles: Profiles, theory: Theory) -> float:
    """Distance (m) from the broken end at which the strain on the exact shock's first characteristic turns steep.

    In a simple wave 1/|slope| at one strain falls linearly with the way it has gone; the line through the first
    STEEPENING part of the way is followed to zero. The slope is that of a cubic through 2 HALF_WIDTH nodes.
    """
    length, way = float(profiles.s_m[-1]), theory.start.distance_m
    places = contour(profiles, profiles.strain, theory.start.strain)
    gone, widths = [], []
    for row in np.flatnonzero(np.isfinite(places)):
        if STEEPENING[0] * way <= length - places[row] <= STEEPENING[1] * way:
            k = int(np.searchsorted(profiles.s_m, places[row]))
            near = slice(max(k - HALF_WIDTH, 0), k + HALF_WIDTH)
            slope = np.polyfit(profiles.s_m[near] - places[row], profiles.strain[row, near], 3)[2]
            gone.append(length - places[row])
            widths.append(-1.0 / slope)
    if len(gone) < LEAST_POINTS:
        return math.nan
    slope, first = np.polyfit(gone, widths, 1)
    if slope >= 0.0:
        return math.nan
    return float(-first / slope)


def strain_error(profiles: Profiles, theory: Theory) -> float:
    """Mean of |strain - exact strain| over the line and over the second half of the time until something arrives.

    Over many profiles, since the error of a captured shock swings with its place in the element.
    """
    rows = np.flatnonzero((profiles.time_s >= 0.5 * theory.arrival_s) & (profiles.time_s <= theory.arrival_s))
    s, errors = profiles.s_m, []
    for row in rows[:: max(1, len(rows) // COMPARED)]:
        exact = theory.motion.at(s, float(profiles.time_s[row]))[0]
        errors.append(float(np.trapezoid(np.abs(profiles.strain[row] - exact), s)) / float(s[-1]))
    if not errors:
        return math.nan
    return float(np.mean(errors))


def tilts(profiles: Profiles) -> np.ndarray:
    """Angle (rad) of every element against the horizontal, followed along the line from the broken end; (nt, nn - 1).

    A fold that goes round shows angles beyond pi.
    """
    angle = np.arctan2(np.diff(profiles.z_m, axis=1), np.diff(profiles.x_m, axis=1))
    return np.unwrap(angle[:, ::-1], axis=1)[:, ::-1]


def recoil(profiles: Profiles, common_s: float) -> dict[str, float]:
    """How far the line has moved by the end of the run, and by `common_s` where the name says 120ms.

    recoil: way of the broken end towards the fixed one; vertical: largest rise or fall of a node, vertical_beyond: of
    one beyond the quarter at the fixed end, where the line folds; x_min: leftmost point, from the fixed end;
    left_of_fixed_end: unstretched length that has been more than 1 mm left of it; steepest_tilt: largest angle of an
    element against the horizontal; buckled: up to where it exceeds BUCKLED_RAD at the end of the run.
    """
    x, moved = profiles.x_m, np.abs(profiles.z_m - profiles.z_m[0])
    common = int(np.argmin(np.abs(profiles.time_s - common_s)))
    angle = np.abs(tilts(profiles))
    left, steep = np.flatnonzero(x.min(axis=0) < -1e-3), np.flatnonzero(angle[-1] > BUCKLED_RAD)
    return {
        "x_min_m": float(x.min()),
        "left_of_fixed_end_m": float(profiles.s_m[left[-1]]) if len(left) else 0.0,
        "recoil_m": float(x[0, -1] - x[-1, -1]),
        "recoil_120ms_m": float(x[0, -1] - x[common, -1]),
        "vertical_m": float(moved.max()),
        "vertical_beyond_m": float(moved[:, profiles.s_m > 0.25 * profiles.s_m[-1]].max()),
        "steepest_tilt_rad": float(angle.max()),
        "buckled_m": float(profiles.s_m[steep[-1] + 1]) if len(steep) else 0.0,
    }


def spread(trajectory: Trajectory) -> dict[str, float]:
    """How evenly tension and kinetic energy lie along the line when half of the strain energy is left.

    tension_spread: standard deviation of T along s over its mean; kinetic_spread: (int v^2)^2/(L int v^4), the share of
    the line that would hold the kinetic energy at one speed; fast_share, resting_share: shares of the line above nine
    and below one tenth of the settled speed of the end.
    """
    energy, profiles = trajectory.energy, trajectory.profiles
    converted = energy.strain_J < 0.5 * energy.stored_J
    if not converted.any():
        return {}
    time_s = float(energy.time_s[int(np.argmax(converted))])
    row = int(np.argmin(np.abs(profiles.time_s - time_s)))
    T, v, s = profiles.tension_N[row], profiles.speed_mps[row], profiles.s_m
    length, top = float(s[-1]), settled_end_speed(trajectory)[0]

    def over_line(values):
        return float(np.trapezoid(values, s)) / length

    mean = over_line(T)
    return {
        "half_energy_s": time_s,
        "tension_spread": math.sqrt(over_line((T - mean) ** 2)) / mean,
        "kinetic_spread": over_line(v**2) ** 2 / over_line(v**4),
        "fast_share": over_line((v > 0.9 * top) * 1.0),
        "resting_share": over_line((v < 0.1 * top) * 1.0),
    }
