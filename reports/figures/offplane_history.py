"""Lateral motion over time on a logarithmic axis (the paper's figure 20), over push and depth; shapes of the rope."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..parts.content import Picture
from ..parts.style import BLUE, VERMILION, picture_of, sheet
from .curves import COLOURS, Curve, Panel, curves
from .motion import envelope

_DECADES_BELOW = 1.5  # room for the swings through zero below the least of the envelope


@dataclass(frozen=True)
class History:
    """One run: its label, |y| over t/T_i, the largest |y| of each period, and the in-plane half range."""

    label: str
    periods: np.ndarray
    size: np.ndarray
    envelope_periods: np.ndarray
    envelope: np.ndarray
    inplane_m: float


def lateral_histories(panels: list[tuple[str, list[History]]]) -> Picture:
    """Stacked panels (axis label, runs): every sample thin, the largest value of each period thick; solid for the first
    run, dashed for the second, and the same for the level of its in-plane motion."""
    with sheet(lateral_height_in(len(panels))) as figure:
        fill_lateral_histories(figure, panels)
        return picture_of(figure)


def lateral_height_in(count: int) -> float:
    """The height of so many panels."""
    return 0.7 + 2.3 * count


def fill_lateral_histories(figure, panels: list[tuple[str, list[History]]]) -> list:
    """`lateral_histories` on an open sheet; returns the axes of the panels."""
    rows = figure.subplots(len(panels), 1, sharex=True, squeeze=False)[:, 0]
    for axes, (label, runs) in zip(rows, panels, strict=True):
        for run, colour, dashes in zip(runs, (BLUE, VERMILION), ("-", (0, (4, 1.5))), strict=False):
            some = run.size > 0
            axes.plot(*envelope(run.periods[some], run.size[some]), color=colour, linewidth=0.4, alpha=0.35)
            drawn = run.envelope > 0
            axes.plot(
                run.envelope_periods[drawn], run.envelope[drawn], color=colour, linestyle=dashes, linewidth=1.1,
                label=run.label,
            )  # fmt: skip
            axes.axhline(run.inplane_m, color=colour, linestyle=":", linewidth=1.0)
        axes.set_yscale("log")
        levels = np.concatenate([run.envelope[run.envelope > 0] for run in runs])
        top = np.nanmax([run.inplane_m for run in runs] + [levels.max()])
        axes.set_ylim(levels.min() / 10**_DECADES_BELOW, 4.0 * top)
        axes.set_ylabel(label)
        axes.margins(x=0.01)
    rows[0].plot([], [], ":", color="black", linewidth=1.0, label="in-plane half range of the buoy")
    figure.legend(*rows[0].get_legend_handles_labels(), loc="outside upper center", ncols=3)
    rows[-1].set_xlabel(r"$t/T_i$ (wave periods)")
    rows[-1].locator_params(axis="x", integer=True)
    figure.align_ylabels(rows)
    return list(rows)


def seed_histories(panels: list[tuple[str, str, list[tuple[float, np.ndarray, np.ndarray]]]]) -> Picture:
    """Two columns of panels (title, axis label, curves): each curve is (push, t/T_i, values), darker for less."""
    from matplotlib import colormaps

    pushes = sorted({push for _, _, found in panels for push, _, _ in found})
    shades = {push: colormaps["cividis"](0.9 * k / max(len(pushes) - 1, 1)) for k, push in enumerate(pushes)}
    drawn = []
    for title, label, found in panels:
        lines = [
            Curve(
                periods[values > 0],
                values[values > 0],
                f"push {push:.0e} m/s".replace("e-0", "e-"),
                colour=shades[push],
            )
            for push, periods, values in found
        ]
        drawn.append(Panel(lines, r"$t/T_i$ (wave periods)", label, title, log="y"))
    return curves([drawn[k : k + 2] for k in range(0, len(drawn), 2)], 0.9 + 2.1 * (len(drawn) // 2), "below")


def dependence(panels: list[tuple[str, list[tuple[str, np.ndarray, np.ndarray, np.ndarray]]]], label: str) -> Picture:
    """Panels (title, curves): each curve is (name, depth (p,) in m, lateral distance (p,) in m, decays (p,) bool).

    Filled marks: the motion goes on; open ones: it decays, and the mark is what is left of it.
    """
    drawn = []
    for title, found in panels:
        lines = []
        for (name, depth, size, decays), colour, mark in zip(found, COLOURS, "os^D", strict=False):
            lines.append(Curve(depth, size, colour=colour, width=0.6, alpha=0.6))
            lines.append(Curve(depth[~decays], size[~decays], name, "", mark, colour, size=4.5))
            lines.append(Curve(depth[decays], size[decays], "", "", mark, colour, size=4.5, filled=False))
        drawn.append(Panel(lines, "depth $H$ (m)", label, title, log="y"))
    return curves([drawn], 2.9, "below")


def rope_shapes(moments: list[tuple[str, np.ndarray, np.ndarray, np.ndarray]], kind: str = "svg") -> Picture:
    """Three views: x-z in true proportion, y-z and x-y with y enlarged by its own axis.

    Args: per moment a label and x, y, z (nn,) in m of the nodes, from the anchor to the upper end.
    """
    from matplotlib import colormaps

    shades = [colormaps["viridis"](0.85 * k / max(len(moments) - 1, 1)) for k in range(len(moments))]
    panels = []
    for title, across, up in (("from the side", "x", "z"), ("along x", "y", "z"), ("from above", "x", "y")):
        lines = []
        for (label, *places), shade in zip(moments, shades, strict=True):
            one, other = (places["xyz".index(letter)] for letter in (across, up))
            lines.append(Curve(one, other, label, mark=".", colour=shade, size=2.0, width=0.8))
            lines.append(Curve(one[-1:], other[-1:], line="", mark="o", colour=shade, size=5.0))
        true = {"aspect": "equal", "adjustable": "datalim"} if title == "from the side" else {}
        panels.append(Panel(lines, f"${across}$ (m)", f"${up}$ (m)", title, settings=true, ticks=4))
    return curves([panels], 3.6, "below", kind=kind)
