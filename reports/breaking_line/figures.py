"""Figures of the breaking line: the paper's 2-7, fronts and characteristics, energy, the animation."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from campaigns.breaking_line.measures import contour, speed_of
from campaigns.breaking_line.theory.of_scene import Theory, theory_of

from ..figures.energy_shares import EnergyPanel, energy_shares
from ..figures.front_plane import FrontPanel, front_plane
from ..figures.front_speeds import front_speeds
from ..figures.line_animation import line_animation, line_strip
from ..figures.line_panels import LinePanel, folds, line_panels, paired_limits
from ..parts.content import Figure, Picture
from ..parts.wording import decimals, listed, number, percent
from .runs import FAST, SLOW, Line, find, named

INSTANT_S = 0.010
FRAME_S = 0.002  # of the animation
SHARES = (0.99, 0.9, 0.7, 0.5, 0.3, 0.1, 0.01)
NEAR_M = (-1.0, 4.0)
CURVE_POINTS = 120
LETTERS = "abcd"
_NUMBERS = {"fast": ("2", "3", "4"), "slow": ("5", "6", "7")}


def shown(lines: tuple[Line, ...], cases: Sequence[str]) -> list[Line]:
    """The cases among these that can be drawn."""
    found = (find(lines, case) for case in cases)
    return [line for line in found if line is not None and line.trajectory is not None and line.trajectory.profiles]


def paper_figures(lines: tuple[Line, ...], speed: str) -> list[Figure]:
    """Configurations, tension and velocity along the line of the fast or the slow breaks."""
    drawn = shown(lines, FAST if speed == "fast" else SLOW)
    if not drawn:
        return []
    configurations, tension, velocity = _NUMBERS[speed]
    return [
        _configurations(drawn, configurations),
        _along(drawn, "tension_N", 1e-3, "$T$ (kN)", f"Tension along the line (fig. {tension} of the paper)", "kN"),
        _along(drawn, "speed_mps", 1.0, "speed (m/s)", f"Speed along the line (fig. {velocity} of the paper)", "m/s"),
    ]


def instants(profiles) -> np.ndarray:
    """Indices of the profiles every 10 ms."""
    wanted = np.arange(0.0, profiles.time_s[-1] + 1e-9, INSTANT_S)
    return np.unique(np.searchsorted(profiles.time_s, wanted - 1e-9).clip(max=len(profiles.time_s) - 1))


def _title(letter: str, line: Line) -> str:
    return f"({letter}) case {line.name}: {1e-3 * line.value('force_N'):.0f} kN"


def _configurations(drawn: list[Line], figure: str) -> Figure:
    panels, words, low, high = [], [], 0.0, 0.0
    for letter, line in zip(LETTERS, drawn, strict=False):
        profiles = line.trajectory.profiles
        rows = instants(profiles)
        x, z = profiles.x_m[rows], profiles.z_m[rows]
        panels.append(LinePanel(_title(letter, line), x, z, profiles.time_s[rows]))
        low, high = min(low, float(z.min())), max(high, float(z.max()))
        words.append(
            f"case {line.name}: the end recoils {decimals(line.value('recoil_m'), 1)} m in "
            f"{number(1e3 * float(profiles.time_s[-1]))} ms, x ≥ {decimals(line.value('x_min_m'), 2)} m"
        )
    room = 0.06 * (high - low)
    picture = line_panels(panels, "$x$ (m)", "$z$ (m)", [(low - room, high + room)] * len(panels), centre=True)
    caption = (
        f"Configurations every 10 ms (fig. {figure} of the paper), heights much enlarged, the same in all panels. "
        f"Seen: {'; '.join(words)}. From `x_m` and `z_m` of the profiles."
    )
    return Figure(picture, caption, f"Shapes of the line every 10 ms, one panel a case: {'; '.join(words)}.")


def _along(drawn: list[Line], column: str, unit: float, label: str, what: str, printed: str) -> Figure:
    panels, words, spans = [], [], []
    for letter, line in zip(LETTERS, drawn, strict=False):
        profiles = line.trajectory.profiles
        rows = instants(profiles)
        values = unit * getattr(profiles, column)[rows]
        panels.append(LinePanel(_title(letter, line), profiles.s_m, values, profiles.time_s[rows]))
        spans.append((float(values.min()), float(values.max())))
        words.append(f"case {line.name} {number(spans[-1][0], 3)} to {number(spans[-1][1], 4)} {printed}")
    limits = paired_limits([line.case for line in drawn], panels)
    picture = line_panels(panels, "$s$ (m)", label, limits, centre=False)
    caption = (
        f"{what}, over the unstretched length s from the fixed end, every 10 ms; cases 1 and 2, and 3 and 4, have one "
        f"scale each. Seen: {'; '.join(words)}. From `{column}` of the profiles."
    )
    return Figure(picture, caption, f"{what}, curves every 10 ms, one panel a case: {'; '.join(words)}.")


def folds_figure(lines: tuple[Line, ...]) -> Figure | None:
    """The neighbourhood of the fixed end at the end of every run, in true proportion."""
    panels, words = [], []
    order = [case for pair in zip(FAST, SLOW, strict=True) for case in pair]
    for line in shown(lines, order):
        profiles = line.trajectory.profiles
        time_s = profiles.time_s[-1:]
        title = f"case {line.name}, {1e3 * float(time_s[0]):.0f} ms"
        panels.append(LinePanel(title, profiles.x_m[-1], profiles.z_m[-1], time_s))
        words.append(f"{decimals(line.value('buckled_m'), 2)} m (case {line.name})")
    if not panels:
        return None
    near = [panel.y[panel.x < NEAR_M[1]] for panel in panels]
    low, high = min(float(z.min()) for z in near) - 0.05, max(float(z.max()) for z in near) + 0.05
    caption = (
        "The fixed end (dot) at the end of every run, in true proportion. Unstretched length up to where the line is "
        f"steeper than 0.2 rad: {listed(words)}. From `x_m` and `z_m` of the profiles."
    )
    alt = f"Folds at the fixed end, one panel a case: {listed(words)}."
    return Figure(folds(panels, NEAR_M, (low, high)), caption, alt)


def plane_figure(lines: tuple[Line, ...]) -> Figure | None:
    """Computed tension over place and time with the exact characteristics."""
    panels, words = [], []
    for line in shown(lines, (*FAST, *SLOW)):
        profiles, theory = line.trajectory.profiles, _theory(line)
        lines_drawn, shock = [], None
        if theory is not None:
            lines_drawn = [theory.falling(share) for share in (*SHARES, 0.0)]
            path = theory.motion.shock
            if theory.shocked and len(path.time_s):
                shock = (path.time_s, path.place_m)
                words.append(f"case {line.name}, born {decimals(theory.start.distance_m, 1)} m from the broken end")
        force = line.value("force_N")
        panels.append(
            FrontPanel(
                f"case {line.name}", profiles.time_s, profiles.s_m, profiles.tension_N / force, lines_drawn, shock
            )
        )
    if not panels:
        return None
    shocks = f"Exact shocks, dashed: {'; '.join(words)}." if words else "No shock forms on the line in these cases."
    caption = (
        "Computed tension over the static one (shade; brown: compression) in the plane of place and time. Thin lines: "
        f"exact characteristics that leave the broken end when its force is {_percents(SHARES)} and 0 % of the static "
        f"one, through the echo of the fixed end as far as the exact motion is known. {shocks} From `tension_N` of the "
        "profiles."
    )
    return Figure(front_plane(panels), caption, f"Fronts in the plane of place and time with exact lines. {shocks}")


def _percents(shares: tuple[float, ...]) -> str:
    return ", ".join(number(100 * share) for share in shares)


def _theory(line: Line) -> Theory | None:
    return theory_of(line.trajectory.scene, float(line.trajectory.columns["time_s"][-1]))


def speeds_figure(lines: tuple[Line, ...]) -> Figure | None:
    """Measured speeds of contours against the wave speed; the contours that a shock eats are left out."""
    measured, off = [], []
    theory = None
    for line in shown(lines, (*FAST, *SLOW)):
        profiles, theory = line.trajectory.profiles, _theory(line)
        if theory is None:
            return None
        length, found = theory.length_m, []
        for share in SHARES:
            if theory.swallowed(share):
                continue
            places = contour(profiles, profiles.tension_N, share * theory.force_N)
            speed = speed_of(profiles.time_s, places, 5.0, length - 5.0, theory.arrival_s)
            if math.isfinite(speed):
                strain = theory.strain_at(share)
                found.append((strain, speed))
                off.append(speed / float(theory.wave_speed(strain)) - 1.0)
        measured.append((line.name, *np.array(found).reshape(-1, 2).T))
    if not off or theory is None:
        return None
    top = max(float(at.max()) for _, at, _ in measured if len(at))
    strain = np.linspace(0.0, 1.08 * top, 200)
    seen = (
        f"{len(off)} contours, between {percent(min(off))} and {percent(max(off))} off the wave speed, by "
        f"{percent(float(np.mean(np.abs(off))))} in the mean"
    )
    caption = (
        f"Speed at which contours of {_percents(SHARES)} % of the static tension run towards the fixed end, against "
        f"√(T′/m) at their strain (curve); open marks: slow breaks. Contours that a shock overtakes are left out. "
        f"Seen: {seen}. From `tension_N` of the profiles, between 5 m from either end and until the front arrives."
    )
    alt = f"Measured contour speeds on the curve of wave speed over strain: {seen}."
    return Figure(front_speeds(strain, theory.wave_speed(strain), measured), caption, alt)


def energy_figure(lines: tuple[Line, ...]) -> Figure | None:
    """Shares of the stored energy over time."""
    panels, words = [], []
    for line in shown(lines, (*FAST, *SLOW)):
        energy = line.trajectory.energy
        if energy is None:
            continue
        gone = energy.viscous_J + energy.scheme_space_J + energy.scheme_time_J
        shares = np.array([energy.strain_J, energy.kinetic_J, -energy.end_work_J, gone, energy.bending_J])
        thin = slice(None, None, max(1, len(energy.time_s) // CURVE_POINTS))
        panels.append(EnergyPanel(f"case {line.name}", energy.time_s[thin], shares[:, thin] / energy.stored_J))
        words.append(f"{line.name} {percent(line.share('kinetic_largest_J'))}")
    if not panels:
        return None
    caption = (
        "Where the stored energy is and went, over time, from below in the order of the names; the weight, below a "
        f"percent, is left out. Largest kinetic energy, case by case: {listed(words)}. From the "
        "energies of the trajectories."
    )
    alt = f"Stacked shares of energy over time; largest kinetic: {listed(words)}."
    return Figure(energy_shares(panels), caption, alt)


def animation_figure(lines: tuple[Line, ...], case: str) -> Figure | None:
    """The moving picture of one case."""
    drawn = shown(lines, (case,))
    if not drawn:
        return None
    profiles = drawn[0].trajectory.profiles
    step = max(1, round(FRAME_S / float(profiles.time_s[1])))
    rows = slice(None, None, step)
    time_s, x, z, T = (
        profiles.time_s[rows], profiles.x_m[rows], profiles.z_m[rows], profiles.tension_N[rows]
    )  # fmt: skip
    strip: Picture = line_strip(time_s, x, z)
    seen = (
        f"the end recoils by {decimals(drawn[0].value('recoil_m'), 1)} m while the line folds at the fixed end and "
        f"passes it by {decimals(-drawn[0].value('x_min_m'), 2)} m"
    )
    caption = (
        f"Case {named(case)} in motion, a frame every {number(1e3 * FRAME_S)} ms on the page, six frames on paper: "
        f"{seen}. Heights much enlarged; below on the page: tension along the line. From the profiles."
    )
    moving = line_animation(time_s, profiles.s_m, x, z, T)
    return Figure(strip, caption, f"The line of case {named(case)} after the break: {seen}.", moving)
