"""What each family of cases compares: a function (case, runs) -> Outcome, runs in the order of `Case.jobs`."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from campaigns.validation.cases import DATA, Case, period_of
from campaigns.validation.exact import catenary, frequencies
from engine import Trajectory
from engine.physics.sea import rows_of

PHASES, SHIFTS = 1000, 2000  # samples of a period that is averaged; time shifts that are tried
POUND_N = 4.4482216152605
HISTORY_PERIODS_S, HISTORY_RADIUS_M = (1.25, 3.5), 0.2  # of lindahl_history.csv


class Number(NamedTuple):
    """A quantity of a case: ours and theirs in words, what the bar is held against, its unit where there is no bar."""

    ours: str
    theirs: str
    error: float
    unit: str = ""


class Outcome(NamedTuple):
    """numbers: quantity -> Number; curves: (name, x, ours, theirs), arrays of one length; note: what was fitted."""

    numbers: dict[str, Number]
    curves: list[tuple[str, np.ndarray, np.ndarray, np.ndarray]]
    note: str = ""


def table(name: str) -> np.ndarray:
    """The numbers of a file of `data` (rows, columns); its first two lines are words."""
    return np.loadtxt(DATA / name, delimiter=",", skiprows=2)


def rms(difference: np.ndarray) -> float:
    """Root of the mean square."""
    return float(np.sqrt(np.mean(np.square(difference))))


def over_a_period(time_s: np.ndarray, values: np.ndarray, period_s: float, rounds: int) -> np.ndarray:
    """The mean of the last `rounds` whole periods at PHASES even phases; a phase of 0 is a multiple of the period.

    Raises ValueError where there are fewer periods.
    """
    last = int(time_s[-1] / period_s * (1.0 + 1e-9))
    if rounds > last:
        raise ValueError(f"{rounds} periods of {period_s:g} s are asked for, and the record has {last}")
    phase = np.arange(PHASES) / PHASES
    periods = (np.interp((i + phase) * period_s, time_s, values) for i in range(last - rounds, last))
    return np.mean([*periods], axis=0)


def along(steady: np.ndarray, period_s: float, time_s: np.ndarray) -> np.ndarray:
    """A period (PHASES even phases) repeated for ever, at these times (s)."""
    return np.interp(time_s / period_s % 1.0, np.arange(PHASES + 1) / PHASES, np.append(steady, steady[0]))


def shifted(steady: np.ndarray, period_s: float, time_s: np.ndarray, theirs: np.ndarray) -> tuple[np.ndarray, float]:
    """(ours at their times, shift in s): the periodic signal of a period, shifted in time for the least rms."""
    shifts = np.arange(SHIFTS) * (period_s / SHIFTS)
    best = min(shifts, key=lambda shift: rms(along(steady, period_s, time_s + shift) - theirs))
    return along(steady, period_s, time_s + best), float(best)


def span(values: np.ndarray, unit: str) -> str:
    """ "0.10 to 67.30 N"."""
    return f"{values.min():.2f} to {values.max():.2f} {unit}"


def measured_history(case: Case, runs: Sequence[Trajectory]) -> Outcome:
    """Top tension over a period against a measured one, both averaged over periods; rms as a share of their range."""
    run, period_s = runs[0], period_of(runs[0].scene)
    record = table("lindahl_history.csv")
    periods = int(record[-1, 0] / period_s)
    theirs = over_a_period(record[:, 0], record[:, case.options["column"]], period_s, periods)
    steady = over_a_period(run.columns["time_s"], run.columns["tension_top_N"], period_s, case.options["rounds"])
    time_s = np.arange(PHASES) / PHASES * period_s
    ours, shift_s = shifted(steady, period_s, time_s, theirs)
    error = 100.0 * rms(ours - theirs) / float(np.ptp(theirs))
    numbers = {"history, rms": Number(span(ours, "N"), span(theirs, "N"), error)}
    return Outcome(numbers, [("", time_s, ours, theirs)], f"ours shifted by {shift_s:.3f} s")


def measured_maxima(case: Case, runs: Sequence[Trajectory]) -> Outcome:
    """Mean of the maxima of the last periods against measured ones, one a run."""
    rows = {(period, radius): largest for period, radius, largest in table("lindahl_maxima.csv")}
    motions = [run.scene.end.motion for run in runs]
    theirs = np.array([rows[motion.period_s, motion.radius_m] for motion in motions])
    ours = np.empty(len(runs))
    for place, run in enumerate(runs):
        time_s, tension_N = run.columns["time_s"], run.columns["tension_top_high_N"]
        ours[place] = mean_maximum(time_s, tension_N, period_of(run.scene), case.options["rounds"])
    difference, share = ours - theirs, 100.0 * (ours / theirs - 1.0)
    ranges = span(ours, "N"), span(theirs, "N")
    numbers = {
        "maxima, rms": Number(*ranges, rms(difference)),
        "maxima, mean size": Number(*ranges, float(np.abs(share).mean())),
    }
    curves = []
    radii, motion_periods = np.array([(motion.radius_m, motion.period_s) for motion in motions]).T
    for radius in dict.fromkeys(radii):
        of_radius = radii == radius
        curves.append((f"radius {radius:g} m", motion_periods[of_radius], ours[of_radius], theirs[of_radius]))
    time_s, *records = table("lindahl_history.csv").T
    sentences = []
    for period_s, record in zip(HISTORY_PERIODS_S, records, strict=True):
        largest = mean_maximum(time_s, record, period_s, int(time_s[-1] / period_s))
        sentences.append(f"{largest:.1f} for {rows[period_s, HISTORY_RADIUS_M]:.1f} N")
    note = f"ours less theirs: {difference.min():+.1f} to {difference.max():+.1f} N"
    note += f"; the measured histories themselves have {' and '.join(sentences)}"
    return Outcome(numbers, curves, note)


def mean_maximum(time_s: np.ndarray, values: np.ndarray, period_s: float, rounds: int) -> float:
    """Mean over the last `rounds` periods of the largest value of each."""
    back = np.minimum(((time_s[-1] - time_s) / period_s).astype(int), rounds)
    return float(np.mean([values[back == i].max() for i in range(rounds)]))


def computed_history(case: Case, runs: Sequence[Trajectory]) -> Outcome:
    """Top tension of the last period against that of another code, along its record; rms in kN.

    With the option settled_s the outcome has the rms from that time on, too, because a record may not be periodic where
    it begins.
    """
    run, period_s = runs[0], period_of(runs[0].scene)
    rows = table("lowe_langley.csv")
    _, time_s, theirs = rows[rows[:, 0] == case.options["record"]].T
    steady = over_a_period(run.columns["time_s"], 1e-3 * run.columns["tension_top_N"], period_s, 1)
    ours, shift_s = shifted(steady, period_s, time_s, theirs)
    ranges = span(ours, "kN"), span(theirs, "kN")
    numbers = {"tension, rms": Number(*ranges, rms(ours - theirs))}
    since_s = case.options.get("settled_s")
    if since_s:
        later = time_s >= since_s
        numbers[f"from {since_s:g} s on, rms"] = Number(*ranges, rms((ours - theirs)[later]), "kN")
    if run.scene.waves is None:  # a motion with a stated start; of waves the phase is not known
        as_is = along(steady, period_s, time_s)
        numbers["without a shift, rms"] = Number(*ranges, rms(as_is - theirs), "kN")
    return Outcome(numbers, [("", time_s, ours, theirs)], f"ours shifted by {shift_s:.2f} s")


def resting_tension(case: Case, runs: Sequence[Trajectory]) -> Outcome:
    """Top tension at rest against a printed number."""
    tension_kN, right = 1e-3 * float(runs[0].columns["tension_top_N"][0]), case.options["tension_kN"]
    numbers = {"tension at rest": Number(f"{tension_kN:.4g} kN", f"{right:.4g} kN", abs(tension_kN - right))}
    return Outcome(numbers, [])


def elastic_catenary(case: Case, runs: Sequence[Trajectory]) -> Outcome:
    """Shape and tension at rest against the closed form (`campaigns.validation.exact`)."""
    lines, scene = runs[0].profiles, runs[0].scene
    exact = catenary(scene)
    place, tension, s = exact.place(lines.s_m), exact.tension(lines.s_m), lines.s_m
    ours = np.array([lines.x_m[0], lines.z_m[0]])
    off = 100.0 * float(np.linalg.norm(ours - place, axis=0).max()) / scene.tether.length_m
    pull = 100.0 * float(np.abs(lines.tension_N[0] / tension - 1.0).max())
    middle = len(s) // 2
    numbers = {
        "place, largest": Number(in_metres(ours[:, middle]), in_metres(place[:, middle]), off),
        "tension, largest": Number(f"{lines.tension_N[0, -1]:.4f} N", f"{tension[-1]:.4f} N", pull),
    }
    return Outcome(numbers, [("", s, ours[1], place[1])])


def in_metres(place: np.ndarray) -> str:
    """ "1.2345, 0.5000 m"."""
    x, z = place
    return f"{x:.4f}, {z:.4f} m"


def free_motion(case: Case, runs: Sequence[Trajectory]) -> Outcome:
    """Peaks of the spectrum of a line that was plucked at its end, against the modes of the elastic catenary."""
    lines, count = runs[0].profiles, case.options["modes"]
    free = lines.time_s >= case.options["after_s"]
    step_s = float(lines.time_s[1] - lines.time_s[0])
    moved = np.concatenate([lines.x_m[free], lines.z_m[free]], axis=1)
    window = np.hanning(len(moved))[:, None]
    power = (np.abs(np.fft.rfft(window * (moved - moved.mean(axis=0)), axis=0)) ** 2).sum(axis=1)
    at = np.fft.rfftfreq(len(moved), step_s)
    right = frequencies(catenary(runs[0].scene), count)
    peaks = np.array([peak_near(at, power, frequency) for frequency in right])
    error = 100.0 * float(np.abs(peaks / right - 1.0).max())
    ours, theirs = f"{peaks[0]:.4f} to {peaks[-1]:.4f} Hz", f"{right[0]:.4f} to {right[-1]:.4f} Hz"
    numbers = {"frequencies, largest": Number(ours, theirs, error)}
    return Outcome(numbers, [("", np.arange(1.0, count + 1.0), peaks, right)])


def peak_near(at: np.ndarray, power: np.ndarray, frequency: float) -> float:
    """The peak of a spectrum within a tenth of a frequency, by a parabola through the logarithms of three values."""
    near = np.flatnonzero(np.abs(at / frequency - 1.0) < 0.1)
    top = near[np.argmax(power[near])]
    left, middle, right = np.log(power[top - 1 : top + 2])
    return float(at[top] + 0.5 * (left - right) / (left - 2.0 * middle + right) * (at[1] - at[0]))


def breaking_line(case: Case, runs: Sequence[Trajectory]) -> Outcome:
    """Strain along the line against the exact motion by characteristics; mean over line and time."""
    from campaigns.accuracy.rows import strain_error
    from campaigns.breaking_line.theory import theory_of

    lines, shown = runs[0].profiles, case.options["shown_s"]
    at = int(np.argmin(np.abs(lines.time_s - shown)))
    exact = theory_of(runs[0].scene, float(lines.time_s[-1])).motion.at(lines.s_m, float(lines.time_s[at]))[0]
    strain = lines.strain[at]
    ours, theirs = f"{strain.min():.4f} to {strain.max():.4f}", f"{exact.min():.4f} to {exact.max():.4f}"
    numbers = {"strain, mean": Number(ours, theirs, strain_error(runs[0]))}
    return Outcome(numbers, [("", lines.s_m, strain, exact)])


def taut_buoy(case: Case, runs: Sequence[Trajectory]) -> Outcome:
    """Surge and top tension of a taut buoy in a low sea, wave by wave, against its two linear oscillators.

    The sphere of mass M + M_a is driven by (rho V + M_a) dU/dt of a wave at its place, on a spring: across the line
    P/L, its pull over its length, along it EA/l_0. Nothing damps it, and the line has no mass.
    """
    run, scene = runs[0], runs[0].scene
    buoy, tether, depth = scene.buoy, scene.tether, scene.water.depth_m
    displaced = scene.water.density_kgpm3 * np.pi * buoy.diameter_m**3 / 6.0
    moved, driven, height = buoy.mass_kg + buoy.added_mass_kg, displaced + buoy.added_mass_kg, run["z_m"][0]
    k, omega, *_, amplitude = rows_of(scene).T
    drive = driven * amplitude * omega**2 / np.sinh(k * depth)
    along = tether.tension.stiffness_N / tether.length_m
    across = (displaced - buoy.mass_kg) * scene.gravity_mps2 / height
    numbers, curves = {}, []
    for name, column, spring, shape in (
        ("surge", "x_m", across, np.cosh(k * height)),
        ("tension", "tension_top_N", along, along * np.sinh(k * height)),
    ):
        theirs = drive * shape / np.abs(spring - moved * omega**2)
        with_rest_and_ringing = np.append(omega, (0.0, np.sqrt(spring / moved)))
        ours = amplitudes(run["time_s"], run[column], with_rest_and_ringing)[:-2]
        error = 100.0 * rms(ours - theirs) / rms(theirs)
        numbers[f"{name}, rms"] = Number(f"{rms(ours):.4g}", f"{rms(theirs):.4g}", error)
        curves.append((name, omega, ours / amplitude, theirs / amplitude))
    return Outcome(numbers, curves)


def amplitudes(time_s: np.ndarray, values: np.ndarray, omega: np.ndarray) -> np.ndarray:
    """Amplitudes (n,) of oscillations of angular frequencies omega (n,), rad/s, whose sum is nearest to a record."""
    angle = omega * time_s[:, None]
    parts = np.linalg.lstsq(np.hstack([np.cos(angle), np.sin(angle)]), values, rcond=None)[0]
    return np.hypot(*parts.reshape(2, -1))


def peer(case: Case, runs: Sequence[Trajectory]) -> Outcome:
    """Distance of the buoy from its anchor against that of another code; rms as a share of its range."""
    ours, theirs = [run.columns["radius_m"] for run in runs]
    error = 100.0 * rms(ours - theirs) / float(np.ptp(theirs))
    numbers = {"distance, rms": Number(span(ours, "m"), span(theirs, "m"), error)}
    return Outcome(numbers, [("", runs[0].columns["time_s"], ours, theirs)])


def whoi_mine(case: Case, runs: Sequence[Trajectory]) -> Outcome:
    """Shape and tension at rest in a current against the printed table."""
    rows, lines = table("whoi_mine.csv"), runs[0].profiles
    s, x, z = rows[:, :3].T
    pull = POUND_N * rows[:, 5]
    our_x, our_z = np.interp(s, lines.s_m, lines.x_m[0]), np.interp(s, lines.s_m, lines.z_m[0])
    tension = np.interp(s, lines.s_m, lines.tension_N[0])
    off = 1e3 * float(np.hypot(our_x - x, our_z - z).max())
    difference = 100.0 * float(np.abs(tension / pull - 1.0).max())
    numbers = {
        "place, largest": Number(in_metres((our_x[-1], our_z[-1])), in_metres((x[-1], z[-1])), off),
        "tension, largest": Number(span(tension, "N"), span(pull, "N"), difference),
    }
    return Outcome(numbers, [("", s, our_x, x)])
