"""Figures of a buoy sweep and of its chosen runs, and the tables beside them, each with its caption."""

import math
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from analysis import read_evidence

from ..figures.animations import Snap, tether_animation, tether_stills
from ..figures.curves import Curve, Panel, curves
from ..figures.motion import section, settled, spectra, time_series
from ..figures.orbit_diagram import orbit_diagram_over
from ..parts.content import Figure, Heading, Item, Table, Text, heads
from ..parts.folder import read_rows
from ..parts.wording import EMPTY, T_I, TAU_0, count, decimals, listed, number, printed
from ..sweep.quantities import panels_over, series
from .runs import PAPER_STEEPNESS, Run, Sweep, spectrum_window
from .tables import sweep_table

# the largest exponents in the table, each with its standard error
EXPONENTS = (
    ("lyapunov_tangent_bits_per_period", "lyapunov_tangent_error"),
    ("lyapunov_wolf_bits_per_period", "lyapunov_wolf_error"),
)
_SIDES = (  # column, label of the axis and of the mark of the natural frequency, its name in `Modes`
    ("radius_m", r"$|\Delta\tilde r|$ (m)", r"$\omega_r$", "radial_radps"),
    ("angle_rad", r"$|\Delta\tilde\theta|$ (rad)", r"$\omega_\theta$", "pendulum_radps"),
)
_PEAKS = 4  # of a spectrum that a table tells
_SHOWN_PERIODS = 3.0  # of the tether as it snaps
_DEFINED = (
    "A motion is called chaotic only if its largest exponent is positive by two errors, the 0-1 test exceeds 0.9, and "
    "a nonlinear forecast beats 95 % of surrogates, in the whole record and in both halves, and if the run at a tenth "
    "of the tolerance is chaotic too (`regime_tighter`). A chaotic transient longer than the record is not told from "
    "chaos. What fulfils no definition is undecided."
)


def orbit_figure(sweep: Sweep, drawn: Sequence[Run], missing: Sequence[Run]) -> Figure:
    """Strobed radius over steepness, slack and exponents below; drawn: runs with points, missing: those without."""
    rows, columns, steepness = [run.row for run in drawn], sweep.folder.columns, sweep.folder.columns["steepness"]
    below = [((columns["slack_fraction"], None),)]
    if known := [pair for pair in EXPONENTS if np.isfinite(series(rows, pair[0])).any()]:
        below.append(tuple((columns[value], columns[error]) for value, error in known))
    radii, crosses = [run.section[:, 0] for run in drawn], [run.steepness for run in missing]
    labels = steepness.label, "strobed $r$ (m)"
    panels = [replace(panel, x_label="") for panel in panels_over(rows, steepness, below)]  # one label, below all
    picture = orbit_diagram_over(series(rows, "steepness"), radii, labels, panels, crosses)
    caption = (
        f"Radius at t = k{T_I}, k ≥ {sweep.transient}, over wave steepness; the darker, the more points fall on one "
        "place. Below: share χ of the time with less than 5 % of the static tension, and the largest exponents, where "
        "they are known, from the tangent dynamics and by Wolf's method. Crosses: "
        f"{count(len(missing), 'run')} without points."
    )
    return Figure(picture, caption, "Orbit diagram of the strobed radius over wave steepness, slack fraction below.")


def run_figures(sweep: Sweep, run: Run) -> list[Item]:
    """Histories and spectra of one run; without spectra where its record is too short."""
    trajectory = sweep.trajectory(run)
    columns, scene = trajectory.columns, trajectory.scene
    low, high = columns["tension_top_low_N"] / 1e3, columns["tension_top_high_N"] / 1e3
    histories = {
        "top tension (kN)": (columns["tension_top_N"] / 1e3, low, high),
        r"$r$ (m)": (columns["radius_m"],),
        r"$\theta$ (rad)": (columns["angle_rad"],),
    }
    caption = (
        f"Top tension, radius and angle against t/{T_I} at {run.named} (figs. 9 to 11 of the paper at kA = 0.016; 13, "
        "15 and 16 at 0.13). The shade behind the tension spans its extremes between samples. From "
        f"`trajectories/{run['run_key'][:12]}….nc`."
    )
    alt = f"Tension, radius and angle over {number(run.periods_done)} wave periods at {run.named}."
    items: list[Item] = [Figure(time_series(columns["time_s"] / scene.waves.period_s, histories), caption, alt)]
    wave, found = 2 * math.pi / scene.waves.period_s, []
    for column, label, mark, mode in _SIDES:
        if one := run.spectrum(trajectory, column):
            natural = ((getattr(sweep.modes, mode), mark),) if sweep.modes else ()
            marks = (*natural, (wave, r"$\omega_i$"))
            found.append((label, one.angular_frequency_radps[1:], one.amplitude[1:], marks))
    if found:
        caption = (
            f"Spectra of r and θ at {run.named} by eq. (31) (fig. 12 of the paper at kA = 0.016; 17 and 18 at 0.13), "
            "linear and logarithmic, without the mean. Arrows: the natural frequencies and that of the wave."
        )
        alt = f"Spectra of radius and angle at {run.named}, linear and logarithmic."
        items.append(Figure(spectra(found, 2.5 * wave), caption, alt))
    return items


def chosen_table(sweep: Sweep) -> Table:
    """The chosen runs: how far they came, their strobed r, the window of eq. (31) and the largest peaks of spectra."""
    from analysis import spectral_peaks

    rows = []
    for run in sweep.chosen:
        trajectory, cells = sweep.trajectory(run), []
        for column, *_ in _SIDES:
            found = run.spectrum(trajectory, column)
            peaks = spectral_peaks(found)[:_PEAKS] if found else []
            cells.append(listed(number(peak.angular_frequency_radps) for peak in peaks) if peaks else EMPTY)
        window = spectrum_window(run.periods_done) or (None, None)
        rows.append((run.named, run["status"], number(run.periods_done), _strobed(run), *map(number, window), *cells))
    numbers = ("status", f"t/{T_I}", "strobed r (m)", f"{TAU_0}/{T_I}", "n", "peaks of r", "peaks of θ")
    caption = (
        "The runs nearest the paper's kA = 0.016 and 0.13, and the first whose strobed motion visits several points in "
        f"turn, where there is one: how far they came, r at t = k{T_I} after the transient, and the largest peaks of "
        f"the spectra in rad/s, the largest first; bins are 2π/(n {T_I}) wide."
    )
    return Table(heads("run", *((name, "") for name in numbers)), tuple(rows), caption, small=True)


def _strobed(run: Run) -> str:
    """The points that it visits in turn, else the range of all."""
    if run.visited or not len(run.section):
        return listed(decimals(point, 3) for point in run.visited) if run.visited else EMPTY
    low, high = run.section[:, 0].min(), run.section[:, 0].max()
    return f"{decimals(low, 3)} to {decimals(high, 3)}"


def section_figure(sweep: Sweep) -> Figure | None:
    """Poincare sections of the chosen runs side by side; None when none of them outlasts the transient."""
    shown = [run for run in sweep.chosen if len(run.section)]
    if not shown:
        return None
    caption = (
        f"Poincaré sections r, r' at t = k{T_I}, k ≥ {sweep.transient} (fig. 19a of the paper, at kA = 0.13). No axis "
        "spans less than 0.1 m or 0.1 m/s."
    )
    alt = "Points of the strobed motion in the plane of radius and radial speed."
    return Figure(section([(run.named, run.section) for run in shown]), caption, alt)


def close_up_items(directory: Path) -> list[Item]:
    """Heading and figure; nothing where no run was kept with its tether."""
    from engine.trajectory import Trajectory, TrajectoryError

    folder = directory / "close_up"
    keys = [row["run_key"] for row in read_rows(folder / "table.csv") if row.get("status") == "ok"]
    try:
        trajectory = Trajectory.load(folder / "trajectories" / f"{keys[-1]}.nc") if keys else None
    except (TrajectoryError, OSError):
        return []
    if trajectory is None or (snap := _snap(trajectory)) is None:
        return []
    at, peak = snap.record[0][np.argmax(snap.record[1])], float(snap.record[1].max())
    seen = f"{number(peak, 3)} N at t/{T_I} = {decimals(float(at), 2)}"
    caption = (
        f"Buoy and tether at kA = {number(trajectory.scene.waves.steepness)} in true proportion, at six values of "
        f"t/{T_I} (above each), and the tension at its top, at most {seen}. Thick: parts without tension; "
        "the wave is the linear one. From the profiles in `close_up/trajectories`."
    )
    alt = f"The tether at six moments as the buoy comes back and pulls it taut, with the top tension, at most {seen}."
    figure = Figure(tether_stills(snap), caption, alt, tether_animation(snap))
    return [Heading("The tether as it snaps", 2), figure]


def _snap(trajectory) -> Snap | None:
    """The wave periods about the highest tension, None where the run has no profiles or no whole period."""
    from engine.physics.sea import elevation_m

    lines, scene = trajectory.profiles, trajectory.scene
    time_s, top = trajectory.columns["time_s"], trajectory.columns["tension_top_high_N"]
    period_s, end_s = scene.waves.period_s, float(time_s[-1])
    if lines is None or len(lines.time_s) < 2 or lines.time_s[-1] < period_s:
        return None
    late = time_s >= min(2.0 * period_s, 0.5 * end_s)  # the start from rest is left out where the record goes on
    shown_s = _SHOWN_PERIODS * period_s
    begin = float(time_s[late][np.argmax(top[late])]) - 0.6 * shown_s
    begin = min(max(begin, 0.0), max(end_s - shown_s, 0.0))
    inside, part = ((times >= begin) & (times <= begin + shown_s) for times in (lines.time_s, time_s))
    x, z = lines.x_m[inside], lines.z_m[inside]
    beyond = max(3.0 * scene.buoy.diameter_m, 0.25 * float(z.max()))  # of the rope, on both sides
    across = np.linspace(x.min() - beyond, x.max() + beyond, 80)
    surface = scene.water.depth_m + elevation_m(scene, lines.time_s[inside][:, None], across)
    record = time_s[part] / period_s, top[part]
    times = lines.time_s[inside] / period_s
    return Snap(times, x, z, lines.tension_N[inside], scene.buoy.diameter_m, (across, surface), record)


def regime_items(sweep: Sweep) -> list[Item]:
    """The section, or nothing where no run has a regime."""
    if not sweep.judged:
        return []
    caption = f"Regime and largest exponent with one standard error, after the first {sweep.transient} wave periods."
    names = ("steepness", "regime", *EXPONENTS)
    table = sweep_table(sweep, names, sweep.judged, caption)
    items: list[Item] = [Heading("Exponents and regimes"), Text(_DEFINED), table]
    nearest = [(min(sweep.judged, key=lambda run: abs(run.steepness - kA)), kA) for kA in PAPER_STEEPNESS]
    shown = list(dict.fromkeys(run for run, kA in nearest if abs(run.steepness - kA) <= 0.01))
    for run in shown:
        heading = Heading(f"Why {run.named} is called {run['regime']}", 2)
        items += [heading, found] if (found := evidence_table(run)) else []
    return items + _convergence(sweep, shown)


def evidence_table(run: Run) -> Table | None:
    """The tests behind the regime, as the row has them (`analysis.evidence_text`)."""
    tests = read_evidence(run["evidence"])
    if not tests:
        return None
    columns = heads("test", ("value", ""), ("threshold", ""), ("met", ""))
    reason = printed(run["regime_reason"].strip()) or "no reason told"
    caption = f"Evidence at {run.named}, in the order of the tests: {reason}."
    rows = tuple((name, *(cell.replace("-", "−") for cell in cells)) for name, *cells in tests)
    return Table(columns, rows, caption, small=True)


def _convergence(sweep: Sweep, shown: list[Run]) -> list[Item]:
    """Exponent found so far against the time used, by Wolf's method; nothing where it found none."""
    from analysis import wolf_lyapunov

    lines = []
    for run, dash in zip((run for run in shown if run.has_record), ("-", "--"), strict=False):
        trajectory = sweep.trajectory(run)
        step_s, period_s = trajectory.scene.sample_step_s(), trajectory.scene.waves.period_s
        after = round(sweep.transient * period_s / step_s)
        wolf = wolf_lyapunov(trajectory.columns["radius_m"][after:], step_s)
        if wolf.found and "run" in wolf.details:
            one = wolf.details["run"]
            bits = one.convergence * period_s / math.log(2.0)
            lines.append(Curve(one.time_s / period_s, bits, run.named, dash, width=1.2))
    if not lines:
        return []
    labels = (r"$t/T_i$ (wave periods)", r"$\sigma_m$ (bits per period)")
    limits = {"ylim": settled([line.y for line in lines])}
    picture = curves([[Panel(lines, *labels, level=0.0, settings=limits)]], 2.8, "best")
    ends = "; ".join(f"{decimals(float(line.y[-1]), 3)} at {line.name}" for line in lines)
    caption = (
        "Largest exponent of r(t) by the method of Wolf et al. against the length of the record used (fig. 14 of the "
        f"paper; one of the settings of the plateau). At the end: {ends} bits per wave period. From `radius_m`."
    )
    alt = f"Convergence of Wolf's exponent over the record: {ends} at the end."
    return [Heading("Convergence of Wolf's exponent", 2), Figure(picture, caption, alt)]
