"""Figures of the breaking line: the paper's 2-7, fronts and characteristics, energy, the animation."""

from collections.abc import Sequence

import numpy as np
import xarray
from matplotlib.colors import LinearSegmentedColormap

from engine.animation import moving_picture
from tables import listed, number, percent

from ..figures.curves import Curve, Panel, cells, curves, dots
from ..figures.line_panels import QUANTITIES, SCALED, LinePanel, line_panels, named, seen
from ..parts import Figure, Picture, batched
from ..parts.style import BLUE, GREEN, INK, ORANGE, PURPLE, SKY, SOFT, VERMILION, picture_of, sheet
from .runs import FAST, SLOW, Line, of_kind

INSTANT_S = 0.010
FRAME_S = 0.002  # of the animation
NEAR_M = (-1.0, 4.0)
_WIDTH_IN = 5.6  # of all panels of a row of folds
_FRAMES_PER_SECOND, _STRIP = 10, 6
CURVE_POINTS = 120
WIDE = 4  # panels a row
KINDS = ("strain", "kinetic", "taken out by the end force", "dissipated", "bending")
_COLUMNS = 300  # of the shade
_SHARES = (SKY, BLUE, ORANGE, VERMILION, GREEN)
_MARKS = (("o", BLUE), ("s", VERMILION), ("^", GREEN), ("D", ORANGE))
_SLOW = (("o", SKY), ("s", PURPLE), ("^", "#7ad1b5"), ("D", "#f3cf7a"))


def shown(lines: list[Line], cases: Sequence[str]) -> list[Line]:
    """The cases among these that can be drawn, in their order."""
    drawn = []
    for line in of_kind(lines, "case"):
        if line["case"] in cases and line.trajectory is not None and line.trajectory.profiles:
            drawn.append(line)
    return sorted(drawn, key=lambda line: cases.index(line["case"]))


def paper_figures(lines: list[Line], cases: Sequence[str]) -> list[Figure]:
    """Configurations, tension and velocity along the line of the fast or the slow breaks, every 10 ms."""
    drawn = shown(lines, cases)
    if not drawn:
        return []
    first = 2 if cases == FAST else 5
    return [_figure(drawn, column, figure) for figure, column in enumerate(QUANTITIES, first)]


def _figure(drawn: list[Line], column: str, figure: int) -> Figure:
    panels = []
    for line in drawn:
        profiles = line.trajectory.profiles
        wanted_s = np.arange(0.0, profiles.time_s[-1] + 1e-9, INSTANT_S)
        rows = np.unique(np.searchsorted(profiles.time_s, wanted_s - 1e-9).clip(max=len(profiles.time_s) - 1))
        x = profiles.x_m[rows] if column == "z_m" else profiles.s_m
        curves = (x, getattr(profiles, column)[rows], profiles.time_s[rows])
        panels.append(LinePanel(line["case"], line["force_N"], *curves))
    quantity, in_words = QUANTITIES[column][0], seen(panels, column)
    caption = f"The {quantity} every 10 ms (fig. {figure} of the paper); {SCALED[column]}. Seen: {in_words}."
    return Figure(
        line_panels(panels, column), caption, f"The {quantity}, a curve every 10 ms, one panel a case: {in_words}."
    )


def folds_figure(lines: list[Line]) -> Figure | None:
    """The neighbourhood of the fixed end at the end of every run, in true proportion, two panels a row."""
    drawn = shown(lines, ("1", "1p", "2", "2p", "3", "3p", "4", "4p"))
    if not drawn:
        return None
    fixed = dots(np.zeros(1), np.zeros(1), "o", VERMILION, 3.0)
    panels, low, high = [], np.inf, -np.inf
    for line in drawn:
        profiles = line.trajectory.profiles
        x, z = profiles.x_m[-1], profiles.z_m[-1]
        near = z[x < NEAR_M[1]]
        low, high = min(low, near.min() - 0.05), max(high, near.max() + 0.05)
        title = f"case {line.name}, {1e3 * float(profiles.time_s[-1]):.0f} ms"
        panels.append(Panel([Curve(x, z, width=0.7), fixed], "$x$ (m)", "$z$ (m)", title))
    look = {"xlim": NEAR_M, "ylim": (float(low), float(high)), "settings": {"aspect": "equal"}}
    rows = batched([panel._replace(**look) for panel in panels], 2)
    height = _WIDTH_IN / len(rows[0]) * (high - low) / (NEAR_M[1] - NEAR_M[0])
    caption = (
        "The fixed end (dot) at the end of every run, in true proportion; the table of the cases tells up to which "
        "unstretched length the line is folded."
    )
    picture = curves(rows, 0.4 + len(rows) * (0.45 + height))
    return Figure(picture, caption, "Folds at the fixed end, one panel a case.")


def plane_figure(lines: list[Line], exact: xarray.Dataset) -> Figure:
    """Computed tension over place and time as a shade, exact characteristics as thin lines, shocks as thick dashes."""
    drawn, shocked = shown(lines, (*FAST, *SLOW)), []
    cases, shares = exact["curve_case"].values, exact["share"].values
    shades = LinearSegmentedColormap.from_list("tension", ("#d9b38c", "#ffffff", "#9ecae1", "#2171b5"))
    with sheet(0.7 + 2.35 * -(-len(drawn) // WIDE)) as figure:
        for axes, line in cells(figure, drawn, WIDE, ("$s$ (m)", "$t$ (ms)"), sharex=True):
            profiles = line.trajectory.profiles
            s_m, end_ms = profiles.s_m, 1e3 * profiles.time_s[-1]
            even = np.linspace(s_m[0], s_m[-1], _COLUMNS)
            image = np.array([np.interp(even, s_m, row) for row in profiles.tension_N / line["force_N"]])
            extent = (s_m[0], s_m[-1], 1e3 * profiles.time_s[0], end_ms)
            look = {"cmap": shades, "vmin": -0.5, "vmax": 1.0, "interpolation": "bilinear"}
            image = axes.imshow(image, origin="lower", extent=extent, aspect="auto", **look)
            rows = np.flatnonzero(cases == line["case"])
            for row in rows[~np.isnan(shares[rows])]:
                axes.plot(*_curve(exact, row), color=INK, linewidth=0.6)
            for row in rows[np.isnan(shares[rows])][-1:]:
                axes.plot(*_curve(exact, row), color=VERMILION, linewidth=1.6, linestyle=(0, (3, 1)))
                shocked.append(line.name)
            axes.grid(False)
            axes.set(title=f"case {line.name}", xlim=extent[:2], ylim=(0.0, end_ms))
        figure.colorbar(image, ax=figure.axes, label="$T/F$ (–)", shrink=0.6, aspect=30, pad=0.015)
        picture = picture_of(figure, "png")
    percents = ", ".join(number(100 * share) for share in dict.fromkeys(shares[~np.isnan(shares)]))
    shocks = "No shock forms on these lines."
    if shocked:
        shocks = f"Exact shocks, dashed, in cases {listed(shocked)}."
    caption = (
        "Computed tension over the static one (shade; brown: compression) in the plane of place and time. Thin lines: "
        f"exact characteristics that leave the broken end when its force is {percents} % of the static one, through "
        f"the echo of the fixed end as far as the exact motion is known. {shocks}"
    )
    return Figure(picture, caption, f"Fronts in the plane of place and time with exact lines. {shocks}")


def _curve(exact: xarray.Dataset, row: int) -> tuple[np.ndarray, np.ndarray]:
    """Places in m and times in ms of an exact line, as far as it is known."""
    time_s, place_m = exact["time_s"].values[row], exact["place_m"].values[row]
    known = np.isfinite(time_s)
    return place_m[known], 1e3 * time_s[known]


def speeds_figure(exact: xarray.Dataset) -> Figure:
    """Measured speeds of contours of constant tension against the wave speed sqrt(T'/m)."""
    cases, strain = exact["contour_case"].values, exact["contour_strain"].values
    speed, off = exact["contour_speed_mps"].values, exact["contour_speed_mps"].values / exact["contour_wave_mps"] - 1.0
    lines = [
        Curve(100 * exact["wave_strain"].values, exact["wave_mps"].values, r"$\sqrt{T'/m}$", colour=INK, width=1.0)
    ]
    for case in dict.fromkeys(cases):
        of_case, fast = cases == case, not case.endswith("p")
        marks, size = (_MARKS, 3.5) if fast else (_SLOW, 6)
        look = *marks[(int(case[0]) - 1) % 4], size
        lines.append(dots(100 * strain[of_case], speed[of_case], *look, name=f"case {named(case)}", filled=fast))
    seen = (
        f"{off.size} contours, between {percent(float(off.min()))} and {percent(float(off.max()))} off the wave speed, "
        f"by {percent(float(np.abs(off).mean()))} in the mean"
    )
    caption = (
        "Speed at which contours of tension run towards the fixed end, against √(T′/m) at their strain (curve); open "
        f"marks: slow breaks. Contours that a shock overtakes are left out. Seen: {seen}."
    )
    picture = curves([[Panel(lines, "strain (%)", "speed of the contour (m/s)")]], 2.9, "lower right")
    return Figure(picture, caption, f"Measured contour speeds on the curve of wave speed over strain: {seen}.")


def energy_figure(lines: list[Line]) -> Figure | None:
    """Stacked shares of the stored energy over time."""
    drawn = [line for line in shown(lines, (*FAST, *SLOW)) if line.trajectory.energy is not None]
    if not drawn:
        return None
    labels = ("$t$ (ms)", "share of the stored energy (%)")
    with sheet(0.8 + 1.75 * -(-len(drawn) // WIDE)) as figure:
        for axes, line in cells(figure, drawn, WIDE, labels, sharey=True):
            energy = line.trajectory.energy
            gone = energy.viscous_J + energy.scheme_space_J + energy.scheme_time_J
            parts = np.array([energy.strain_J, energy.kinetic_J, -energy.end_work_J, gone, energy.bending_J])
            thin = slice(None, None, max(1, len(energy.time_s) // CURVE_POINTS))
            time_ms, shares = 1e3 * energy.time_s[thin], 100 * np.maximum(parts[:, thin] / energy.stored_J, 0.0)
            areas = axes.stackplot(time_ms, shares, colors=_SHARES, linewidth=0.6, edgecolor="white")
            axes.set(title=f"case {line.name}", xlim=(0.0, time_ms[-1]), ylim=(0.0, 100.0))
        figure.legend(areas, KINDS, loc="outside upper left", ncols=len(KINDS))
        picture = picture_of(figure)
    caption = (
        "Where the stored energy is and went, over time, from below in the order of the names; the weight, below a "
        "percent, is left out."
    )
    return Figure(picture, caption, "Stacked shares of energy over time, one panel a case.")


def animation_figure(lines: list[Line], case: str) -> Figure | None:
    """The moving picture of one case: its shape, and the tension along the line below; a few shapes for paper."""
    drawn = shown(lines, (case,))
    if not drawn:
        return None
    profiles = drawn[0].trajectory.profiles
    rows = slice(None, None, max(1, round(FRAME_S / float(profiles.time_s[1]))))
    time_s, x, z = profiles.time_s[rows], profiles.x_m[rows], profiles.z_m[rows]
    x_room, z_room = 0.03 * np.ptp(x), 0.1 * np.ptp(z)
    limits = {"xlim": (x.min() - x_room, x.max() + x_room), "ylim": (z.min() - z_room, z.max() + z_room)}
    caption = (
        f"Case {named(case)} in motion, a frame every {number(1e3 * FRAME_S)} ms on the page, six frames on paper. "
        "Heights much enlarged; below on the page: tension along the line."
    )
    alt = f"The line of case {named(case)} after the break: it recoils and folds at the fixed end."
    moving = _animation(time_s, profiles.s_m, x, z, 1e-3 * profiles.tension_N[rows], limits)
    strip = []
    for row in np.linspace(0, len(time_s) - 1, _STRIP).round().astype(int):
        end = dots(x[row, -1:], z[row, -1:], "o", VERMILION, 3.0)
        shape, title = [Curve(x[row], z[row], width=1.0), end], f"{1e3 * time_s[row]:.0f} ms"
        strip.append([Panel(shape, "", "$z$ (m)", title, marks=[(0.0, "")], **limits)])
    strip[-1][0] = strip[-1][0]._replace(x_label="$x$ (m)")
    return Figure(curves(strip, 0.4 + 0.85 * _STRIP, share="x"), caption, alt, moving)


def _animation(time_s, s_m, x_m, z_m, tension_kN, limits) -> Picture:
    """The GIF; times (m,), places (n,), the other arrays (m, n)."""
    with sheet(3.6) as figure:
        shape, tension = figure.subplots(2, 1)
        (curve,) = shape.plot([], [], color=BLUE, linewidth=1.2)
        (end,) = shape.plot([], [], "o", color=VERMILION, markersize=4)
        shape.axvline(0.0, color=SOFT, linewidth=0.7, linestyle=(0, (2, 2)))
        shape.set(xlabel="$x$ (m)", ylabel="$z$ (m)", **limits)
        (pull,) = tension.plot([], [], color=INK, linewidth=1.0)
        ends = min(1.05 * float(tension_kN.min()), -20.0), 1.08 * float(tension_kN.max())
        words = {"xlabel": "$s$ (m), unstretched, from the fixed end", "ylabel": "$T$ (kN)"}
        tension.set(xlim=(s_m[0], s_m[-1]), ylim=ends, **words)
        clock = shape.set_title("t = 0 ms")

        def show(row: int) -> None:
            curve.set_data(x_m[row], z_m[row])
            end.set_data(x_m[row, -1:], z_m[row, -1:])
            pull.set_data(s_m, tension_kN[row])
            clock.set_text(f"t = {1e3 * time_s[row]:.0f} ms")

        artists = [curve, end, pull, clock]
        return Picture(moving_picture(figure, artists, len(time_s), show, _FRAMES_PER_SECOND), "gif")
