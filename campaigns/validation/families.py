"""The comparisons with sources: for each family of cases a function (case, runs) -> Outcome, runs as of `Case.jobs`."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from campaigns.validation.cases import DATA, Case, period_of
from campaigns.validation.exact import catenary, frequencies
from engine import Trajectory
from engine.physics.sea import rows_of

PHASES = 1000  # samples of an averaged period
SHIFTS = 2000  # shifts in time that are tried, within a period
POUND_N = 4.4482216152605
HISTORY_PERIODS_S, HISTORY_RADIUS_M = (1.25, 3.5), 0.2  # of lindahl_history.csv


class Number(NamedTuple):
    """A quantity of a case.

    ours, theirs   its value or range, in words
    error          the difference that is held against the bar
    unit           of the error, where there is no bar
    """

    ours: str
    theirs: str
    error: float
    unit: str = ""


class Outcome(NamedTuple):
    """What a case gives: its numbers by quantity, curves (name, x, ours, theirs), and a note on what was fitted."""

    numbers: dict[str, Number]
    curves: list[tuple[str, np.ndarray, np.ndarray, np.ndarray]]
    note: str = ""


def table(name: str) -> np.ndarray:
    """The numbers of a file of `data` (rows, columns), below its two lines of words."""
    return np.loadtxt(DATA / name, delimiter=",", skiprows=2)


def rms(difference: np.ndarray) -> float:
    """Root of the mean square."""
    return float(np.sqrt(np.mean(np.square(difference))))


def rms_percent(ours: np.ndarray, theirs: np.ndarray) -> float:
    """rms of the difference, in % of the range of theirs."""
    return 100.0 * rms(ours - theirs) / float(np.ptp(theirs))


def largest_percent(ours: np.ndarray, theirs: np.ndarray) -> float:
    """Largest difference, in % of theirs."""
    return 100.0 * float(np.abs(ours / theirs - 1.0).max())


def over_a_period(time_s: np.ndarray, values: np.ndarray, period_s: float, rounds: int) -> np.ndarray:
    """The mean of the last `rounds` whole periods at PHASES even phases (PHASES,). Periods are counted from time 0.

    Raises ValueError where the record has fewer periods.
    """
    last = int(time_s[-1] / period_s * (1.0 + 1e-9))
    if rounds > last:
        raise ValueError(f"{rounds} periods of {period_s:g} s are asked for, and the record has {last}")
    phase = np.arange(PHASES) / PHASES
    periods = [np.interp((i + phase) * period_s, time_s, values) for i in range(last - rounds, last)]
    return np.mean(periods, axis=0)


def along(steady: np.ndarray, period_s: float, time_s: np.ndarray) -> np.ndarray:
    """The signal at these times (s) that repeats one period, steady (PHASES,), for ever."""
    return np.interp(time_s / period_s % 1.0, np.arange(PHASES + 1) / PHASES, np.append(steady, steady[0]))


def shifted(steady: np.ndarray, period_s: float, time_s: np.ndarray, theirs: np.ndarray) -> tuple[np.ndarray, float]:
    """The signal of `along` at their times, shifted in time for the least rms of the difference; and the shift (s)."""
    shifts = np.arange(SHIFTS) * (period_s / SHIFTS)
    best = min(shifts, key=lambda shift: rms(along(steady, period_s, time_s + shift) - theirs))
    return along(steady, period_s, time_s + best), float(best)


def span(values: np.ndarray, unit: str) -> str:
    """The range of values in words: "0.10 to 67.30 N"."""
    return f"{values.min():.2f} to {values.max():.2f} {unit}"


def measured_history(case: Case, runs: Sequence[Trajectory]) -> Outcome:
    """Top tension over a period against a measured one, both averaged over periods; rms in % of the measured range."""
    run, period_s = runs[0], period_of(runs[0].scene)
    record = table("lindahl_history.csv")
    periods = int(record[-1, 0] / period_s)
    theirs = over_a_period(record[:, 0], record[:, case.options["column"]], period_s, periods)
    steady = over_a_period(run.columns["time_s"], run.columns["tension_top_N"], period_s, case.options["rounds"])
    time_s = np.arange(PHASES) / PHASES * period_s
    ours, shift_s = shifted(steady, period_s, time_s, theirs)
    numbers = {"history, rms": Number(span(ours, "N"), span(theirs, "N"), rms_percent(ours, theirs))}
    return Outcome(numbers, [("", time_s, ours, theirs)], f"ours shifted by {shift_s:.3f} s")


def measured_maxima(case: Case, runs: Sequence[Trajectory]) -> Outcome:
    """The mean of the largest top tensions of the last periods of each run, against a measured one."""
    measured_N = {(period, radius): largest for period, radius, largest in table("lindahl_maxima.csv")}
    motions = [run.scene.end.motion for run in runs]
    theirs = np.array([measured_N[motion.period_s, motion.radius_m] for motion in motions])
    ours = np.empty(len(runs))
    for place, run in enumerate(runs):
        time_s, tension_N = run.columns["time_s"], run.columns["tension_top_high_N"]
        ours[place] = mean_maximum(time_s, tension_N, period_of(run.scene), case.options["rounds"])
    difference, percent = ours - theirs, 100.0 * (ours / theirs - 1.0)
    ranges = span(ours, "N"), span(theirs, "N")
    numbers = {
        "maxima, rms": Number(*ranges, rms(difference)),
        "maxima, mean size": Number(*ranges, float(np.abs(percent).mean())),
    }
    curves = []
    radii, motion_periods = np.array([(motion.radius_m, motion.period_s) for motion in motions]).T
    for radius in dict.fromkeys(radii):
        of_radius = radii == radius
        curves.append((f"radius {radius:g} m", motion_periods[of_radius], ours[of_radius], theirs[of_radius]))
    time_s, *records = table("lindahl_history.csv").T
    pairs = []
    for period_s, record in zip(HISTORY_PERIODS_S, records, strict=True):
        largest_N = mean_maximum(time_s, record, period_s, int(time_s[-1] / period_s))
        pairs.append(f"{largest_N:.1f} for {measured_N[period_s, HISTORY_RADIUS_M]:.1f} N")
    note = f"ours less theirs: {difference.min():+.1f} to {difference.max():+.1f} N"
    note += f"; the measured histories themselves have {' and '.join(pairs)}"
    return Outcome(numbers, curves, note)


def mean_maximum(time_s: np.ndarray, values: np.ndarray, period_s: float, rounds: int) -> float:
    """Mean over the last `rounds` periods of the largest value of each."""
    periods_before_end = np.minimum(((time_s[-1] - time_s) / period_s).astype(int), rounds)
    return float(np.mean([values[periods_before_end == i].max() for i in range(rounds)]))


def computed_history(case: Case, runs: Sequence[Trajectory]) -> Outcome:
    """Top tension of the last period against that of another code, along the record of that code; rms in kN.

    With the option settled_s there is also the rms from that time on, because a record may begin with a transient.
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
    if run.scene.waves is None:  # the source says when a moved end starts; it does not say the phase of waves
        unshifted = along(steady, period_s, time_s)
        numbers["without a shift, rms"] = Number(*ranges, rms(unshifted - theirs), "kN")
    return Outcome(numbers, [("", time_s, ours, theirs)], f"ours shifted by {shift_s:.2f} s")


def resting_tension(case: Case, runs: Sequence[Trajectory]) -> Outcome:
    """Top tension at rest against a printed number."""
    ours_kN, theirs_kN = 1e-3 * float(runs[0].columns["tension_top_N"][0]), case.options["tension_kN"]
    numbers = {"tension at rest": Number(f"{ours_kN:.4g} kN", f"{theirs_kN:.4g} kN", abs(ours_kN - theirs_kN))}
    return Outcome(numbers, [])


def elastic_catenary(case: Case, runs: Sequence[Trajectory]) -> Outcome:
    """Shape and tension at rest against the closed form (`campaigns.validation.exact`)."""
    profiles, scene = runs[0].profiles, runs[0].scene
    s, exact = profiles.s_m, catenary(scene)
    ours, theirs = np.array([profiles.x_m[0], profiles.z_m[0]]), exact.place(s)
    our_N, their_N = profiles.tension_N[0], exact.tension(s)
    error = 100.0 * float(np.linalg.norm(ours - theirs, axis=0).max()) / scene.tether.length_m
    middle = len(s) // 2
    ends = f"{our_N[-1]:.4f} N", f"{their_N[-1]:.4f} N"
    numbers = {
        "place, largest": Number(in_metres(ours[:, middle]), in_metres(theirs[:, middle]), error),
        "tension, largest": Number(*ends, largest_percent(our_N, their_N)),
    }
    return Outcome(numbers, [("", s, ours[1], theirs[1])])


def in_metres(place: np.ndarray) -> str:
    """x and z of a place (2,) in words: "1.2345, 0.5000 m"."""
    x, z = place
    return f"{x:.4f}, {z:.4f} m"


def free_motion(case: Case, runs: Sequence[Trajectory]) -> Outcome:
    """Peaks of the spectrum of a line that was plucked at its end, against the modes of the elastic catenary."""
    profiles, count = runs[0].profiles, case.options["modes"]
    free = profiles.time_s >= case.options["after_s"]
    step_s = float(profiles.time_s[1] - profiles.time_s[0])
    places = np.concatenate([profiles.x_m[free], profiles.z_m[free]], axis=1)
    window = np.hanning(len(places))[:, None]
    power = (np.abs(np.fft.rfft(window * (places - places.mean(axis=0)), axis=0)) ** 2).sum(axis=1)
    spectrum_Hz = np.fft.rfftfreq(len(places), step_s)
    modes_Hz = frequencies(catenary(runs[0].scene), count)
    peaks_Hz = np.array([peak_near(spectrum_Hz, power, mode_Hz) for mode_Hz in modes_Hz])
    ranges = [f"{first:.4f} to {last:.4f} Hz" for first, *_, last in (peaks_Hz, modes_Hz)]
    numbers = {"frequencies, largest": Number(*ranges, largest_percent(peaks_Hz, modes_Hz))}
    return Outcome(numbers, [("", np.arange(1.0, count + 1.0), peaks_Hz, modes_Hz)])


def peak_near(spectrum_Hz: np.ndarray, power: np.ndarray, frequency_Hz: float) -> float:
    """The frequency (Hz) of the peak of a spectrum within a tenth of a frequency.

    A parabola through the logarithms of three values places it between the frequencies of the spectrum.
    """
    near = np.flatnonzero(np.abs(spectrum_Hz / frequency_Hz - 1.0) < 0.1)
    top = near[np.argmax(power[near])]
    left, middle, right = np.log(power[top - 1 : top + 2])
    steps = 0.5 * (left - right) / (left - 2.0 * middle + right)
    return float(spectrum_Hz[top] + steps * (spectrum_Hz[1] - spectrum_Hz[0]))


def breaking_line(case: Case, runs: Sequence[Trajectory]) -> Outcome:
    """Strain along the line at one time against the exact motion by characteristics; error: mean over line and time."""
    from campaigns.accuracy.rows import strain_error
    from campaigns.breaking_line.theory import theory_of

    profiles = runs[0].profiles
    sample = int(np.argmin(np.abs(profiles.time_s - case.options["shown_s"])))
    motion = theory_of(runs[0].scene, float(profiles.time_s[-1])).motion
    ours, theirs = profiles.strain[sample], motion.at(profiles.s_m, float(profiles.time_s[sample]))[0]
    ranges = [f"{strain.min():.4f} to {strain.max():.4f}" for strain in (ours, theirs)]
    numbers = {"strain, mean": Number(*ranges, strain_error(runs[0]))}
    return Outcome(numbers, [("", profiles.s_m, ours, theirs)])


def taut_buoy(case: Case, runs: Sequence[Trajectory]) -> Outcome:
    """Surge and top tension of a taut buoy in a low sea, wave by wave, against two linear oscillators.

    A wave drives the sphere, of mass M + M_a, with the force (rho V + M_a) dU/dt. The line is a spring: along itself of
    EA/l_0, and across itself of P/L, its tension over its stretched length. Nothing damps the sphere, and the line has
    no mass.
    """
    run, scene = runs[0], runs[0].scene
    buoy, tether, depth = scene.buoy, scene.tether, scene.water.depth_m
    displaced = scene.water.density_kgpm3 * np.pi * buoy.diameter_m**3 / 6.0
    mass, driven_mass = buoy.mass_kg + buoy.added_mass_kg, displaced + buoy.added_mass_kg
    height = run["z_m"][0]
    k, omega, *_, amplitude = rows_of(scene).T
    drive = driven_mass * amplitude * omega**2 / np.sinh(k * depth)
    spring_along = tether.tension.stiffness_N / tether.length_m
    spring_across = (displaced - buoy.mass_kg) * scene.gravity_mps2 / height
    numbers, curves = {}, []
    for name, column, spring, shape in (
        ("surge", "x_m", spring_across, np.cosh(k * height)),
        ("tension", "tension_top_N", spring_along, spring_along * np.sinh(k * height)),
    ):
        theirs = drive * shape / np.abs(spring - mass * omega**2)
        with_rest_and_ringing = np.append(omega, (0.0, np.sqrt(spring / mass)))
        ours = amplitudes(run["time_s"], run[column], with_rest_and_ringing)[:-2]
        error = 100.0 * rms(ours - theirs) / rms(theirs)
        numbers[f"{name}, rms"] = Number(f"{rms(ours):.4g}", f"{rms(theirs):.4g}", error)
        curves.append((name, omega, ours / amplitude, theirs / amplitude))
    return Outcome(numbers, curves)


def amplitudes(time_s: np.ndarray, values: np.ndarray, omega: np.ndarray) -> np.ndarray:
    """Amplitudes (n,) of oscillations with angular frequencies omega (n,), rad/s: the least-squares fit to a record."""
    angle = omega * time_s[:, None]
    parts = np.linalg.lstsq(np.hstack([np.cos(angle), np.sin(angle)]), values, rcond=None)[0]
    return np.hypot(*parts.reshape(2, -1))


def peer(case: Case, runs: Sequence[Trajectory]) -> Outcome:
    """Distance of the buoy from its anchor against that of another code; rms in % of the range of the other code."""
    ours, theirs = [run.columns["radius_m"] for run in runs]
    numbers = {"distance, rms": Number(span(ours, "m"), span(theirs, "m"), rms_percent(ours, theirs))}
    return Outcome(numbers, [("", runs[0].columns["time_s"], ours, theirs)])


def whoi_mine(case: Case, runs: Sequence[Trajectory]) -> Outcome:
    """Shape and tension at rest in a current against the printed table."""
    rows, profiles = table("whoi_mine.csv"), runs[0].profiles
    s, x, z = rows[:, :3].T
    their_N = POUND_N * rows[:, 5]
    profiles_at_rest = profiles.x_m[0], profiles.z_m[0], profiles.tension_N[0]
    our_x, our_z, our_N = [np.interp(s, profiles.s_m, profile) for profile in profiles_at_rest]
    error_mm = 1e3 * float(np.hypot(our_x - x, our_z - z).max())
    numbers = {
        "place, largest": Number(in_metres((our_x[-1], our_z[-1])), in_metres((x[-1], z[-1])), error_mm),
        "tension, largest": Number(span(our_N, "N"), span(their_N, "N"), largest_percent(our_N, their_N)),
    }
    return Outcome(numbers, [("", s, our_x, x)])
