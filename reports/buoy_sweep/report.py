"""The report of `campaigns.buoy_sweep`: what is said, in which order. Everything comes from the campaign's folder."""

from __future__ import annotations

from pathlib import Path

from analysis.verdicts import LEAST_POINTS

from ..parts.content import Heading, Item, Notice, Report, Table, Text, heads
from ..parts.provenance import provenance_items
from ..parts.symbols import T_I
from ..parts.wording import EMPTY, decimals, listed, number
from .answer import answer_items, warnings
from .close_up import close_up_items
from .equations import equation_items
from .figures import orbit_figure, peaks_table, run_figures, section_figure
from .regimes import regime_items
from .runs import Run, Sweep, read_sweep
from .sheets import explorer, sheet_items
from .tables import accuracy_items, plane_items, runs_items, scene_items, time_items


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
        warnings(sweep),
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
            "A buoy near the surface is held to the sea bed by a short elastic tether. When does the tether go slack "
            "and snap as waves become steeper, and does the motion still repeat with the waves? This is section 4.2 of "
            "Tjavaras, Zhu, Liu, Triantafyllou and Yue, “The mechanics of highly-extensible cables”, Journal of Sound "
            "and Vibration 213(4), 1998 (“the paper”), which shows kA = 0.016 and kA = 0.13."
        ),
        Heading("Short answer"),
        *answer_items(sweep),
    ]
    if sweep.judged:
        return items
    said = (
        "No Lyapunov exponent was computed; a strobed motion without a period is just that. Exponents and regimes take "
        f"`--set output.tangent_vectors=1` and {LEAST_POINTS} wave periods or more beyond the transient."
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
    heading = Heading("Chosen runs")
    if not sweep.chosen:
        return [heading, Text("No run left a record of one wave period or more, so there is nothing to draw.")]
    columns = heads("run", ("status", ""), (f"t/{T_I}", ""), ("strobed r", "m"))
    rows = tuple((run.named, run["status"], number(run.periods_done), _strobed(run)) for run in sweep.chosen)
    caption = (
        "The runs nearest the paper's kA = 0.016 and 0.13, and the first whose strobed motion visits several points in "
        f"turn, where there is one: how far they came, and r at t = k{T_I} after the transient."
    )
    items: list[Item] = [heading, Table(columns, rows, caption), peaks_table(sweep)]
    for run in sweep.chosen:
        items += [Heading(run.named, 2), *run_figures(sweep, run)]
    figure = section_figure(sweep)
    return [*items, Heading("Poincaré sections", 2), figure] if figure else items


def _strobed(run: Run) -> str:
    """The points that it visits in turn, else the range of all."""
    if run.visited or not len(run.section):
        return listed(decimals(point, 3) for point in run.visited) if run.visited else EMPTY
    low, high = run.section[:, 0].min(), run.section[:, 0].max()
    return f"{decimals(low, 3)} to {decimals(high, 3)}"
