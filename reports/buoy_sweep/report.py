"""The report of `campaigns.buoy_sweep`: what is said, in which order. Everything comes from the campaign's folder."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from analysis.verdicts import LEAST_POINTS

from ..figures.orbit_diagram import orbit_diagram_over
from ..parts.content import Bullets, Figure, Heading, Item, Notice, Report, Text
from ..parts.folder import Folder, read_folder
from ..parts.provenance import provenance_items
from ..parts.symbols import T_I
from ..parts.wording import count, decimals, number, percent
from .answer import short_answer
from .close_up import close_up_items
from .equations import equation_items
from .figures import run_items, section_figure
from .physics import Modes, natural_frequencies
from .plane import plane_items
from .regimes import exponent_curves, judged, regime_items
from .repeats import accuracy_items
from .runs import COLUMNS, Run, chosen_runs, load, read_runs, value
from .sheets import explorer, sheet_items
from .tables import runs_items, scene_items, time_items
from .warnings import warnings


def report(directory: str | Path) -> Report:
    """The content of the report on a buoy sweep's folder. Raises FolderError for a folder that is not one."""
    folder = read_folder(directory, COLUMNS, ("planar_regime",))
    runs = read_runs(folder)
    transient = int(folder.provenance.get("transient") or 0)
    tolerance = float(folder.provenance.get("strobe_tolerance") or 0.005)
    modes = natural_frequencies(folder.scene)
    items = [
        *_question(runs, transient, tolerance, modes),
        *_orbit(runs, transient),
        *_chosen(folder, runs, transient, tolerance, modes),
        *close_up_items(folder.directory),
        *regime_items(folder, runs, transient),
        *plane_items(folder, runs, transient),
        *accuracy_items(folder.directory, "kA"),
        Heading("Warnings"),
        *warnings(runs, folder.scene, modes),
        *runs_items(runs, transient, tolerance),
        *time_items(folder, runs),
        *scene_items(folder, runs, modes),
        Heading("Equations"),
        *equation_items(folder.scene.tether.tension.law),
        *provenance_items(folder),
        *sheet_items(folder, runs, transient, modes),
    ]
    title = folder.scene.title or folder.scene.name
    return Report("Tethered buoy: a sweep of wave steepness", title, tuple(items))


def _question(runs: tuple[Run, ...], transient: int, tolerance: float, modes: Modes | None) -> list[Item]:
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
        Bullets(short_answer(runs, transient, tolerance, modes)),
    ]
    if not judged(runs):
        longest = max((run.periods_done for run in runs), default=0.0)
        remedy = (
            "A sweep with `--set output.tangent_vectors=1` computes exponents and regimes."
            if longest - transient >= LEAST_POINTS
            else f"A verdict takes a run of {transient + LEAST_POINTS} wave periods or more, {LEAST_POINTS} of them "
            f"beyond the transient; the longest here is of {number(longest, 3)}."
        )
        items.append(
            Notice(
                "note",
                "No verdict on regular or chaotic motion",
                (
                    "The column `regime` and the columns of exponents are empty: no Lyapunov exponent was computed, "
                    "and none is needed for what is said above. A strobed motion for which no period was found is "
                    f"just that. {remedy}",
                ),
            )
        )
    return items


def _orbit(runs: tuple[Run, ...], transient: int) -> list[Item]:
    heading = Heading("Orbit diagram")
    drawn = [run for run in runs if run.ok and len(run.section)]
    missing = [run.steepness for run in runs if run not in drawn]
    if not drawn:
        return [heading, Text("No run gave strobed points after the transient, so there is no orbit diagram.")]
    slack = np.array([value(run, "slack_fraction") for run in drawn])
    picture = orbit_diagram_over(
        np.array([run.steepness for run in drawn]),
        [run.section[:, 0] for run in drawn],
        "strobed $r$ (m)",
        slack,
        "slack fraction (–)",
        missing,
        exponent_curves(drawn) if judged(runs) else (),
    )
    points = [len(run.section) for run in drawn]
    spread = max(drawn, key=lambda run: np.ptp(run.section[:, 0]))
    seen = (
        f"{count(len(drawn), 'column')} of up to {max(points)} points; the strobed radius spreads most at kA = "
        f"{number(spread.steepness)}, over {decimals(float(np.ptp(spread.section[:, 0])), 2)} m"
    )
    share = f", and the slack fraction reaches {percent(float(np.nanmax(slack)))}" if np.isfinite(slack).any() else ""
    exponents = ", and the largest exponents with one standard error" if judged(runs) else ""
    left_out = f" Crosses: {count(len(missing), 'run')} without points." if missing else ""
    caption = (
        f"Radius at t = k{T_I}, k ≥ {transient}, over wave steepness; the darker, the more points fall on one place. "
        f"Below: share of the time without tension{exponents}. Seen: {seen}{share}.{left_out} From `radius_m` of every "
        "trajectory, `slack_fraction` of `table.csv`."
    )
    alt = f"Orbit diagram of strobed radius over wave steepness, slack fraction below: {seen}{share}."
    return [heading, explorer(runs, Figure(picture, caption, alt))]


def _chosen(folder: Folder, runs: tuple[Run, ...], transient: int, tolerance: float, modes: Modes | None) -> list[Item]:
    chosen = chosen_runs(runs, tolerance)
    items: list[Item] = [Heading("Chosen runs")]
    if not chosen:
        return [*items, Text("No run left a record of one wave period or more, so there is nothing to draw.")]
    items.append(
        Text(
            "The runs nearest the paper's kA = 0.016 and 0.13, and the first whose strobed motion visits several "
            "points in turn, where there is one."
        )
    )
    for run in chosen:
        items += run_items(run, load(folder, run), tolerance, modes)
    figure = section_figure(chosen, transient, tolerance)
    return [*items, Heading("Poincaré sections", 2), figure] if figure else items
