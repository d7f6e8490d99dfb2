"""Figures of single runs of a buoy sweep, each with the caption that says what is seen in it."""

from __future__ import annotations

import math

import numpy as np

from ..figures.section import section
from ..figures.spectra import SpectrumPanel, spectra
from ..figures.time_series import Panel, time_series
from ..parts.content import Figure, Heading, Item, Notice, Text
from ..parts.symbols import OMEGA_I, OMEGA_R, OMEGA_THETA, T_I, TAU_0
from ..parts.wording import count, decimals, listed, number
from .physics import Modes
from .runs import PAPER_STEEPNESS, Run, orbit_radii, period_length, several_points, value

_PAPER = {  # figures of the paper at its two steepnesses: tension, r, theta, spectra
    PAPER_STEEPNESS[0]: ("9", "10", "11", "fig. 12"),
    PAPER_STEEPNESS[1]: ("13", "15", "16", "figs. 17 and 18"),
}
PAPER_WINDOW = (40, 20)  # tau_0/T_i and n of eq. (31) in the paper
_LEAST_WINDOW = 5  # wave periods: fewer bins than this below the wave frequency say nothing


def run_items(run: Run, trajectory, tolerance: float, modes: Modes | None) -> list[Item]:
    """Heading, a sentence, histories and spectra of one run."""
    end = "ended as asked" if run.ok else f"ended early ({run.row['status']})"
    items: list[Item] = [
        Heading(f"kA = {number(run.steepness)}", 2),
        Text(f"This run {end} after {number(run.periods_done)} wave periods. {_strobed_words(run, tolerance)}"),
        _histories(run, trajectory),
    ]
    return items + _spectra(run, trajectory, modes)


def _strobed_words(run: Run, tolerance: float) -> str:
    length = period_length(run)
    if length == 1 or several_points(run, tolerance):
        radii = listed(decimals(point, 3) for point in orbit_radii(run))
        return f"Strobed at t = k{T_I} it visits {count(length, 'point')}, r = {radii} m."
    if len(run.section):
        low, high = run.section[:, 0].min(), run.section[:, 0].max()
        return f"Strobed at t = k{T_I} its radius lies between {decimals(low, 3)} and {decimals(high, 3)} m."
    return "It is too short for strobed values after the transient."


def _histories(run: Run, trajectory) -> Figure:
    columns, period_s = trajectory.columns, trajectory.scene.waves.period_s
    low, high = columns["tension_top_low_N"] / 1e3, columns["tension_top_high_N"] / 1e3
    picture = time_series(
        columns["time_s"] / period_s,
        [
            Panel("top tension (kN)", columns["tension_top_N"] / 1e3, low, high),
            Panel(r"$r$ (m)", columns["radius_m"]),
            Panel(r"$\theta$ (rad)", columns["angle_rad"]),
        ],
    )
    tension, radius, angle, _ = _PAPER[_nearer(run.steepness)]
    seen = (
        f"tension from {number(1e3 * np.nanmin(low))} to {number(1e3 * np.nanmax(high))} N{_slack_words(run)}, r from "
        f"{_span(columns['radius_m'], 3)} m, θ from {_span(columns['angle_rad'], 3)} rad"
    )
    caption = (
        f"Top tension (fig. {tension}), radius (fig. {radius}) and angle (fig. {angle} of the paper{_apart(run)}) "
        f"against t/{T_I} at kA = {number(run.steepness)}: {seen}. From `trajectories/{run.row['run_key'][:12]}….nc`: "
        "`time_s`, `tension_top_N`, `radius_m`, `angle_rad`; the shade behind the tension spans `tension_top_low_N` "
        "to `tension_top_high_N`, its extremes between samples."
    )
    alt = f"Three stacked curves over {number(run.periods_done)} wave periods at kA {number(run.steepness)}: {seen}."
    return Figure(picture, caption, alt)


def _slack_words(run: Run) -> str:
    share = value(run, "slack_fraction")
    if math.isnan(share):
        return ""
    return f" (slack {number(100 * share, 3)} % of the time after the transient)" if share > 0 else " (never slack)"


def _spectra(run: Run, trajectory, modes: Modes | None) -> list[Item]:
    from analysis import spectral_peaks, spectrum

    window = spectrum_window(run.periods_done)
    if window is None:
        return [
            Notice(
                "note",
                "No spectrum",
                (
                    f"{number(run.periods_done, 3)} wave periods are too few: even the shortened window needs "
                    f"{2 * _LEAST_WINDOW}.",
                ),
            )
        ]
    start, periods = window
    scene, panels, words = trajectory.scene, [], []
    wave = 2 * math.pi / scene.waves.period_s
    natural = (modes.radial_radps, modes.pendulum_radps) if modes else (None, None)
    sides = (
        ("radius_m", "r", r"$|\Delta\tilde r|$ (m)", r"$\omega_r$", natural[0]),
        ("angle_rad", "θ", r"$|\Delta\tilde\theta|$ (rad)", r"$\omega_\theta$", natural[1]),
    )
    for column, name, label, mark, frequency in sides:
        found = spectrum(trajectory.columns[column], scene.sample_step_s(), scene.waves.period_s, start, periods)
        marks = ((frequency, mark),) if frequency else ()
        panels.append(
            SpectrumPanel(
                label, found.angular_frequency_radps[1:], found.amplitude[1:], (*marks, (wave, r"$\omega_i$"))
            )
        )
        peaks = [number(peak.angular_frequency_radps) for peak in spectral_peaks(found)[:4]]
        words.append(f"{name} peaks at {listed(peaks)} rad/s" if peaks else f"{name} shows no peak")
    *_, paper = _PAPER[_nearer(run.steepness)]
    expected = (
        f"{OMEGA_R} = {number(modes.radial_radps, 3)}, {OMEGA_THETA} = {number(modes.pendulum_radps, 3)}, "
        if modes
        else ""
    )
    seen = f"{words[0]}, {words[1]} (largest first; bins are {number(wave / periods, 3)} rad/s wide)"
    caption = (
        f"Spectra of r and θ at kA = {number(run.steepness)} ({paper} of the paper{_apart(run)}), eq. (31) with "
        f"{TAU_0} = {number(start)} {T_I} and n = {periods}: {seen}. Marks: {expected}{OMEGA_I} = {number(wave, 4)} "
        "rad/s. From `radius_m` and `angle_rad`; the mean (ω = 0) is left out."
    )
    return [
        Figure(spectra(panels, 2.5 * wave), caption, f"Spectra of radius and angle, linear and logarithmic: {seen}.")
    ]


def spectrum_window(periods_done: float) -> tuple[int, int] | None:
    """(tau_0/T_i, n) of eq. (31): the paper's (40, 20), else the last half of a record; None below 10 periods."""
    whole = math.floor(periods_done + 1e-6)
    if whole >= sum(PAPER_WINDOW):
        return PAPER_WINDOW
    return (whole - whole // 2, whole // 2) if whole // 2 >= _LEAST_WINDOW else None


def section_figure(runs: tuple[Run, ...], transient: int, tolerance: float) -> Figure | None:
    """Poincare sections of the chosen runs side by side; None when none of them outlasts the transient."""
    panels, words = [], []
    for run in runs:
        points = run.section
        if not len(points):
            continue
        panels.append((f"kA = {number(run.steepness)}", points[:, 0], points[:, 1]))
        shape = f"r from {_span(points[:, 0], 3)} m, r' from {_span(points[:, 1], 3)} m/s"
        length = period_length(run)
        if length == 1 or several_points(run, tolerance):
            shape = f"{count(length, 'point')} visited in turn, {shape}"
        words.append(f"at kA = {number(run.steepness)} {shape}")
    if not panels:
        return None
    caption = (
        f"Poincaré sections r, r' at t = k{T_I}, k ≥ {transient} (fig. 19a of the paper, at kA = 0.13): "
        f"{'; '.join(words)}. From `radius_m` and `radius_rate_mps`. No axis spans less than 0.1 m or 0.1 m/s."
    )
    return Figure(
        section(panels),
        caption,
        f"Points of the strobed motion in the plane of radius and radial speed: {'; '.join(words)}.",
    )


def _nearer(steepness: float) -> float:
    """Which of the paper's two cases a run is compared with."""
    low, high = PAPER_STEEPNESS
    return low if abs(steepness - low) < abs(steepness - high) else high


def _apart(run: Run) -> str:
    """Where the paper's figure is for another steepness, which one."""
    paper = _nearer(run.steepness)
    return "" if abs(run.steepness - paper) <= 0.02 * paper else f", there at kA = {number(paper)}"


def _span(values: np.ndarray, places: int) -> str:
    return f"{decimals(float(np.nanmin(values)), places)} to {decimals(float(np.nanmax(values)), places)}"
