"""Figures of a buoy sweep and of its chosen runs, each with the caption that says what is seen in it."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from ..figures.curves import Curve, Panel
from ..figures.orbit_diagram import orbit_diagram_over
from ..figures.section import section
from ..figures.spectra import SpectrumPanel, spectra
from ..figures.time_series import Panel as History
from ..figures.time_series import time_series
from ..parts.content import Figure, Item, Notice
from ..parts.style import BLUE, SKY, VERMILION
from ..parts.symbols import OMEGA_I, OMEGA_R, OMEGA_THETA, T_I, TAU_0
from ..parts.wording import count, listed, number
from ..sweep.quantities import series
from .runs import PAPER_STEEPNESS, Run, Sweep

_PAPER = {  # figures of the paper at its two steepnesses: tension, r, theta, spectra
    PAPER_STEEPNESS[0]: ("9", "10", "11", "fig. 12"),
    PAPER_STEEPNESS[1]: ("13", "15", "16", "figs. 17 and 18"),
}
PAPER_WINDOW = (40, 20)  # tau_0/T_i and n of eq. (31) in the paper
_LEAST_WINDOW = 5  # wave periods: fewer bins than this below the wave frequency say nothing
# name, its error, label of the curve: the largest exponents in the table
EXPONENTS = (
    ("lyapunov_tangent_bits_per_period", "lyapunov_tangent_error", "tangent dynamics"),
    ("lyapunov_wolf_bits_per_period", "lyapunov_wolf_error", "Wolf, of r"),
)
_SIDES = (  # column, name, label of the axis, of the mark, and symbol of the natural frequency
    ("radius_m", "r", r"$|\Delta\tilde r|$ (m)", r"$\omega_r$", OMEGA_R),
    ("angle_rad", "θ", r"$|\Delta\tilde\theta|$ (rad)", r"$\omega_\theta$", OMEGA_THETA),
)
KA = r"wave steepness $kA$ (–)"


def orbit_figure(sweep: Sweep, drawn: Sequence[Run], missing: Sequence[Run]) -> Figure:
    """Strobed radius over steepness, slack and exponents below; drawn: runs with points, missing: those without."""
    rows = [run.row for run in drawn]
    values, slack = series(rows, "steepness"), series(rows, "slack_fraction")
    stems = [
        Curve(np.full(2, x), np.array([0.0, y]), colour=SKY, width=1.2) for x, y in zip(values, slack, strict=True)
    ]
    top = max(0.1, 1.15 * float(np.nanmax(slack))) if np.isfinite(slack).any() else 1.0
    share = [*stems, Curve(values, slack, "", "", "o", BLUE, size=3.5)]
    below = [Panel(share, y_label="slack fraction (–)", level=0.0, settings={"ylim": (0.0, top)})]
    if sweep.judged:
        looks = zip(EXPONENTS, (("o", BLUE), ("s", VERMILION)), strict=True)
        lines = [
            Curve(values, series(rows, column), label, "", *look, series(rows, error), 3.0)
            for (column, error, label), look in looks
            if np.isfinite(series(rows, column)).any()
        ]
        below.append(Panel(lines, y_label=r"$\sigma$ (bits/$T_i$)", level=0.0))
    points = [run.section[:, 0] for run in drawn]
    gone = [run.steepness for run in missing]
    picture = orbit_diagram_over(values, points, (KA, "strobed $r$ (m)"), below, gone)
    caption = (
        f"Radius at t = k{T_I}, k ≥ {sweep.transient}, over wave steepness; the darker, the more points fall on one "
        "place. Below: share of the time without tension"
        + (", and the largest exponents with one standard error" if sweep.judged else "")
        + (f". Crosses: {count(len(missing), 'run')} without points." if missing else ".")
    )
    return Figure(picture, caption, "Orbit diagram of the strobed radius over wave steepness, slack fraction below.")


def run_figures(sweep: Sweep, run: Run) -> list[Item]:
    """Histories and spectra of one run."""
    trajectory = sweep.trajectory(run)
    return [_histories(run, trajectory), _spectra(sweep, run, trajectory)]


def _histories(run: Run, trajectory) -> Figure:
    columns = trajectory.columns
    low, high = columns["tension_top_low_N"] / 1e3, columns["tension_top_high_N"] / 1e3
    panels = [
        History("top tension (kN)", columns["tension_top_N"] / 1e3, low, high),
        History(r"$r$ (m)", columns["radius_m"]),
        History(r"$\theta$ (rad)", columns["angle_rad"]),
    ]
    tension, radius, angle, _ = _PAPER[_nearer(run.steepness)]
    at = f"kA = {number(run.steepness)}"
    caption = (
        f"Top tension (fig. {tension}), radius (fig. {radius}) and angle (fig. {angle} of the paper{_apart(run)}) "
        f"against t/{T_I} at {at}. From `trajectories/{run['run_key'][:12]}….nc`; the shade behind the tension spans "
        "its extremes between samples."
    )
    alt = f"Tension, radius and angle over {number(run.periods_done)} wave periods at {at}, one below the other."
    return Figure(time_series(columns["time_s"] / trajectory.scene.waves.period_s, panels), caption, alt)


def _spectra(sweep: Sweep, run: Run, trajectory) -> Item:
    from analysis import spectral_peaks, spectrum

    window = spectrum_window(run.periods_done)
    if window is None:
        few = f"{number(run.periods_done, 3)} wave periods are too few: the shortened window needs {2 * _LEAST_WINDOW}."
        return Notice("note", "No spectrum", (few,))
    scene, modes, panels, words = trajectory.scene, sweep.modes, [], []
    wave = 2 * math.pi / scene.waves.period_s
    natural = (modes.radial_radps, modes.pendulum_radps) if modes else (None, None)
    expected = ""
    for (column, name, label, mark, symbol), frequency in zip(_SIDES, natural, strict=True):
        found = spectrum(trajectory.columns[column], scene.sample_step_s(), scene.waves.period_s, *window)
        marks = (*(((frequency, mark),) if frequency else ()), (wave, r"$\omega_i$"))
        panels.append(SpectrumPanel(label, found.angular_frequency_radps[1:], found.amplitude[1:], marks))
        peaks = [number(peak.angular_frequency_radps) for peak in spectral_peaks(found)[:4]]
        words.append(f"{name} peaks at {listed(peaks)} rad/s" if peaks else f"{name} shows no peak")
        expected += f"{symbol} = {number(frequency, 3)}, " if frequency else ""
    start, periods = window
    seen = f"{words[0]}, {words[1]} (largest first; bins are {number(wave / periods, 3)} rad/s wide)"
    caption = (
        f"Spectra of r and θ at kA = {number(run.steepness)} ({_PAPER[_nearer(run.steepness)][-1]} of the "
        f"paper{_apart(run)}), eq. (31) with {TAU_0} = {number(start)} {T_I} and n = {periods}: {seen}. Marks: "
        f"{expected}{OMEGA_I} = {number(wave, 4)} rad/s. From `radius_m` and `angle_rad`; the mean (ω = 0) is left out."
    )
    alt = f"Spectra of radius and angle, linear and logarithmic: {seen}."
    return Figure(spectra(panels, 2.5 * wave), caption, alt)


def spectrum_window(periods_done: float) -> tuple[int, int] | None:
    """(tau_0/T_i, n) of eq. (31): the paper's (40, 20), else the last half of a record; None below 10 periods."""
    whole = math.floor(periods_done + 1e-6)
    if whole >= sum(PAPER_WINDOW):
        return PAPER_WINDOW
    return (whole - whole // 2, whole // 2) if whole // 2 >= _LEAST_WINDOW else None


def section_figure(sweep: Sweep) -> Figure | None:
    """Poincare sections of the chosen runs side by side; None when none of them outlasts the transient."""
    shown = [run for run in sweep.chosen if len(run.section)]
    if not shown:
        return None
    picture = section([(f"kA = {number(run.steepness)}", run.section) for run in shown])
    caption = (
        f"Poincaré sections r, r' at t = k{T_I}, k ≥ {sweep.transient} (fig. 19a of the paper, at kA = 0.13). No axis "
        "spans less than 0.1 m or 0.1 m/s."
    )
    return Figure(picture, caption, "Points of the strobed motion in the plane of radius and radial speed.")


def _nearer(steepness: float) -> float:
    """Which of the paper's two cases a run is compared with."""
    return min(PAPER_STEEPNESS, key=lambda paper: abs(steepness - paper))


def _apart(run: Run) -> str:
    """Where the paper's figure is for another steepness, which one."""
    paper = _nearer(run.steepness)
    return "" if abs(run.steepness - paper) <= 0.02 * paper else f", there at kA = {number(paper)}"
