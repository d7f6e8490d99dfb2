"""The report of `campaigns.buoy_sweep`: what is said, in which order. Everything comes from the campaign's folder."""

from __future__ import annotations

from pathlib import Path

from analysis.verdicts import LEAST_POINTS

from ..parts.content import Heading, Item, Notice, Report, Text
from ..parts.provenance import provenance_items
from ..parts.symbols import T_I
from ..parts.wording import count, decimals, listed, number
from .answer import answer_items
from .close_up import close_up_items
from .equations import equation_items
from .figures import orbit_figure, run_figures, section_figure
from .regimes import regime_items
from .repeats import accuracy_items
from .runs import Run, Sweep, read_sweep
from .sheets import explorer, sheet_items
from .tables import plane_items, runs_items, scene_items, time_items
from .warnings import warnings


def report(directory: str | Path) -> Report:
    """The content of the report on a buoy sweep's folder. Raises FolderError for a folder that is not one."""
    sweep = read_sweep(directory)
    scene = sweep.folder.scene
    items = [
        *_question(sweep),
        *_orbit(sweep),
        *_chosen(sweep),
        *close_up_items(sweep.folder.directory),
        *regime_items(sweep),
        *plane_items(sweep),
        *accuracy_items(sweep.folder.directory),
        Heading("Warnings"),
        *warnings(sweep),
        *runs_items(sweep),
        *time_items(sweep),
        *scene_items(sweep),
        Heading("Equations"),
        *equation_items(scene.tether.tension.law),
        *provenance_items(sweep.folder),
        *sheet_items(sweep),
    ]
    return Report("Tethered buoy: a sweep of wave steepness", scene.title or scene.name, tuple(items))


def _question(sweep: Sweep) -> list[Item]:
    items: list[Item] = [
        Heading("Question"),
        Text(
            "A buoy near the surface is held to the sea bed by a short elastic tether. How does it move as regular "
            "waves become steeper: when does the tether go slack and snap, and does the motion still repeat with the "
            "waves? This is the problem of section 4.2 of Tjavaras, Zhu, Liu, Triantafyllou and Yue, “The mechanics "
            "of highly-extensible cables”, Journal of Sound and Vibration 213(4), 1998 (“the paper”), which shows kA "
            "= 0.016 and kA = 0.13."
        ),
        Heading("Short answer"),
        *answer_items(sweep),
    ]
    if sweep.judged:
        return items
    longest, needed = max(run.periods_done for run in sweep.runs), sweep.transient + LEAST_POINTS
    remedy = (
        "A sweep with `--set output.tangent_vectors=1` computes exponents and regimes."
        if longest >= needed
        else f"A verdict takes a run of {needed} wave periods or more, {LEAST_POINTS} of them beyond the transient; "
        f"the longest here is of {number(longest, 3)}."
    )
    said = (
        "The column `regime` and the columns of exponents are empty: no Lyapunov exponent was computed, and none is "
        f"needed for what is said above. A strobed motion for which no period was found is just that. {remedy}"
    )
    return [*items, Notice("note", "No verdict on regular or chaotic motion", (said,))]


def _orbit(sweep: Sweep) -> list[Item]:
    heading = Heading("Orbit diagram")
    drawn = [run for run in sweep.good if len(run.section)]
    if not drawn:
        return [heading, Text("No run gave strobed points after the transient, so there is no orbit diagram.")]
    missing = [run for run in sweep.runs if run not in drawn]
    return [heading, explorer(sweep, orbit_figure(sweep, drawn, missing))]


def _chosen(sweep: Sweep) -> list[Item]:
    items: list[Item] = [Heading("Chosen runs")]
    if not sweep.chosen:
        return [*items, Text("No run left a record of one wave period or more, so there is nothing to draw.")]
    items.append(
        Text(
            "The runs nearest the paper's kA = 0.016 and 0.13, and the first whose strobed motion visits several "
            "points in turn, where there is one."
        )
    )
    for run in sweep.chosen:
        end = "ended as asked" if run.ok else f"ended early ({run['status']})"
        words = f"This run {end} after {number(run.periods_done)} wave periods. {_strobed(run)}"
        items += [Heading(f"kA = {number(run.steepness)}", 2), Text(words), *run_figures(sweep, run)]
    figure = section_figure(sweep)
    return [*items, Heading("Poincaré sections", 2), figure] if figure else items


def _strobed(run: Run) -> str:
    if run.visited:
        radii = listed(decimals(point, 3) for point in run.visited)
        return f"Strobed at t = k{T_I} it visits {count(len(run.visited), 'point')}, r = {radii} m."
    if len(run.section):
        low, high = run.section[:, 0].min(), run.section[:, 0].max()
        return f"Strobed at t = k{T_I} its radius lies between {decimals(low, 3)} and {decimals(high, 3)} m."
    return "It is too short for strobed values after the transient."
