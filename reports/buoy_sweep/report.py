"""The report of `campaigns.buoy_sweep`: what is said, in which order. Everything comes from the campaign's folder."""

import math
from collections.abc import Iterable, Sequence
from pathlib import Path

from analysis.verdicts import LEAST_POINTS

from ..parts.content import Bullets, Heading, Item, Notice, Report, Text
from ..parts.provenance import provenance_items
from ..parts.sections import section_items
from ..parts.wording import T_I, TAU_0, count, decimals, number, percent
from ..sweep.quantities import extremes
from .figures import chosen_table, close_up_items, orbit_figure, regime_items, run_figures, section_figure
from .runs import PAPER_WINDOW, Run, Sweep, read_sweep
from .sheets import explorer, sheet_items
from .tables import accuracy_items, plane_items, runs_items, scene_and_modes, time_items

_EXTREMES = (
    "slack_fraction", "tension_top_max_N", "radius_min_m", "radius_max_m", "loop_releases", "rope_lateral_max_m",
    "buoy_lateral_max_m",
)  # fmt: skip
_OF_THESE = "Least and greatest value in the runs that ended as asked."
_RESOLVED_RAD = 0.5 * math.pi  # turn of one element beyond which a loop is no longer resolved
_NOTHING = "No run failed, no loop was released, the buoy stayed in the water, and every record lasts for eq. (31)."


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
        *scene_and_modes(sweep),
        *section_items("buoy_sweep_solved", law=scene.tether.tension.law),
        *provenance_items(sweep.folder),
        *sheet_items(sweep),
    ]
    return Report("Tethered buoy: a sweep of wave steepness", scene.title or scene.name, tuple(items))


def _question(sweep: Sweep) -> list[Item]:
    columns = sweep.folder.columns
    shown = [columns[name] for name in _EXTREMES if name in columns]
    items: list[Item] = [
        *section_items("buoy_sweep", "Question"),
        Heading("Short answer"),
        Bullets(sweep.folder.answer or short_answer(sweep)),
        *extremes([columns["steepness"]], [run.row for run in sweep.good], shown, _OF_THESE),
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
    items: list[Item] = [heading, chosen_table(sweep)]
    for run in sweep.chosen:
        items += [Heading(run.named, 2), *run_figures(sweep, run)]
    figure = section_figure(sweep)
    return [*items, Heading("Poincaré sections", 2), figure] if figure else items


def short_answer(sweep: Sweep) -> tuple[str, ...]:
    """One statement a line: the sweep, what failed, then each kind of motion with the steepness of its runs."""
    good, runs, share = sweep.good, sweep.runs, percent(sweep.tolerance)
    repeating = [
        (f"Repeats after {count(length, 'wave period')} (period {length})",
         [run for run in good if len(run.visited) == length])
        for length in range(1, sweep.longest + 1)
    ]  # fmt: skip
    kinds = (
        ("Did not end as asked", [run for run in runs if not run.ok]),
        ("Slack (less than 5 % of the static tension) for a part of the time",
         [run for run in good if run["slack_fraction"] > 0]),
        ("Never slack", [run for run in good if run["slack_fraction"] == 0]),
        *repeating,
        (f"A longer period, of points that lie within {share} of the range of r: a swing that dies out",
         [run for run in good if run.period and not run.visited]),
        (f"Repeats after none of 1 to {sweep.longest} periods; what else it is, only a regime says",
         [run for run in good if run.period == 0]),
        ("Too few strobed points to look for a period", [run for run in good if run.period is None]),
        ("Loops were released", [run for run in good if run["loop_releases"] > 0]),
        ("Run in three dimensions", [run for run in good if run.in_space]),
    )  # fmt: skip
    longest = number(_most(runs, "periods_done"))
    first = (
        f"{count(len(runs), 'run')}, {sweep.at(runs)}, the longest over {longest} wave periods. What follows leaves "
        f"out the first {count(sweep.transient, 'period')} and runs that failed."
    )
    lines = [first, *_said(sweep, kinds)]
    pulls = [run["tension_top_max_N"] for run in good if run.known("tension_top_max_N")]
    if pulls and sweep.modes:
        times = number(max(pulls) / sweep.modes.static_tension_N, 3)
        lines.append(f"The largest top tension is {times} times the static one.")
    return tuple(lines)


def warnings(sweep: Sweep) -> Notice:
    """Everything that limits what the sweep may be used for; a plain note when there is nothing."""
    runs, scene = sweep.runs, sweep.folder.scene
    high, out = [run for run in runs if run.above_still_m > 0.0], [run for run in runs if run.out_share > 0.0]
    unread = [run for run in runs if run.fault]
    first = {run["status"]: run for run in reversed(runs) if not run.ok}
    strain = sweep.modes.static_strain if sweep.modes else -1.0
    dry_m = scene.tether.length_m * (1.0 + strain) + 0.5 * scene.buoy.diameter_m - scene.water.depth_m
    failed = [
        (f"{status}; the first after {number(run.periods_done, 3)} periods: {run['message'] or 'no message'}",
         [run for run in runs if run["status"] == status])
        for status, run in first.items()
    ]  # fmt: skip
    kinds = (
        *failed,
        (f"{unread[0].fault if unread else ''} (of the first); figures and strobed values leave such runs out", unread),
        ("loops were released; a rope free to leave the plane does not need it (`--dimensions auto`), see “Out of the "
         "plane”", [run for run in runs if run["loop_releases"] > 0]),
        ("in three dimensions an element turns by more than π/2: its loops are not resolved, add `tether.nodes`",
         [run for run in runs if run.in_space and run["max_turn_rad"] > _RESOLVED_RAD]),
        (f"already at rest the top of the buoy is {decimals(dry_m, 2)} m above still water",
         runs if dry_m > 0.0 else ()),
        (f"the centre of the buoy rises by up to {decimals(_most(high, 'above_still_m'), 2)} m above still water",
         high),
        (f"the whole sphere is above the linear wave, its centre by up to {decimals(_most(out, 'above_wave_m'), 2)} m, "
         f"in up to {percent(_most(out, 'out_share'))} of the samples. There `buoy.submergence` = "
         f"{scene.buoy.submergence} and `waves.above_still_water` = {scene.waves.above_still_water} matter", out),
        (f"shorter than the {sum(PAPER_WINDOW)} wave periods of eq. (31) with {TAU_0} = {PAPER_WINDOW[0]} {T_I} and "
         f"n = {PAPER_WINDOW[1]}: spectra are of the last half of the record, and hold more of the transient",
         [run for run in sweep.good if run.periods_done < sum(PAPER_WINDOW) - 1e-6]),
    )  # fmt: skip
    lines = _said(sweep, kinds)
    if not lines:
        return Notice("note", "Nothing to warn of", (_NOTHING,))
    return Notice("warning", "What limits these runs", lines)


def _most(runs: Sequence[Run], name: str) -> float:
    """The largest value of an attribute of the runs; nan without runs."""
    return max((getattr(run, name) for run in runs), default=math.nan)


def _said(sweep: Sweep, kinds: Iterable[tuple[str, Sequence[Run]]]) -> tuple[str, ...]:
    """One line for every kind of run of which there is one: what is said of it, and where."""
    return tuple(f"{said}: {sweep.at(runs)}." for said, runs in kinds if runs)
