"""The tables of a buoy sweep: the runs, their cost, the scene."""

from __future__ import annotations

import math

import numpy as np

from ..figures.run_times import run_times
from ..parts.content import Column, Figure, Heading, Item, Table, Text
from ..parts.folder import Folder
from ..parts.provenance import timing_table
from ..parts.scene_table import scene_table
from ..parts.symbols import OMEGA_I, OMEGA_R, OMEGA_THETA, T_S
from ..parts.wording import EMPTY, decimals, listed, number, percent
from .motion import LONGEST_PERIOD
from .physics import Modes
from .runs import Run, linked, period_length, value


def runs_items(runs: tuple[Run, ...], transient: int, tolerance: float) -> list[Item]:
    """All rows of table.csv in the columns a reader asks for first."""
    columns = [
        ("r min", "m", "radius_min_m", 2),
        ("r max", "m", "radius_max_m", 2),
        ("θ min", "rad", "angle_min_rad", 3),
        ("θ max", "rad", "angle_max_rad", 3),
        ("T min", "N", "tension_top_min_N", 0),
        ("T max", "N", "tension_top_max_N", 0),
        ("slack", "–", "slack_fraction", 3),
        ("turn", "rad", "max_turn_rad", 2),
        ("loops", "", "loop_releases", 0),
        ("steps", "", "steps", 0),
        ("rejected", "", "rejected_steps", 0),
        ("Newton", "", "newton_iterations", 0),
        ("wall", "s", "wall_s", 2),
    ]
    space = any(run.in_space for run in runs)
    heads = (
        Column("kA"),
        *([Column("D")] if space else []),
        Column("status", align="left"),
        Column("N"),
        *(Column(title, unit) for title, unit, *_ in columns),
    )
    rows = tuple(
        (
            linked(run),
            *(["3" if run.in_space else "2"] if space else []),
            run.row["status"],
            _period_cell(run),
            *(decimals(value(run, column), places) for *_, column, places in columns),
        )
        for run in runs
    )
    caption = (
        "Every run of `table.csv`. N (`strobed_period`): the buoy's motion repeats after N wave periods to "
        f"{percent(tolerance)} of its range, N ≤ {LONGEST_PERIOD}; “none” where no N does. T: tension at the top. "
        f"slack: share of the time without tension. N, r, θ, T and slack leave out the first {transient} wave "
        "periods. turn: largest turn of the tether within one element. loops: loop releases. A dash: not known. On the "
        "page kA leads to the sheet of the run." + (" D: dimensions of the motion." if space else "")
    )
    return [Heading("Table of runs"), Table(heads, rows, caption, small=True)]


def _period_cell(run: Run) -> str:
    length = period_length(run)
    return EMPTY if length is None else str(length or "none")


def time_items(folder: Folder, runs: tuple[Run, ...]) -> list[Item]:
    """What each run cost, and the time split of the campaign."""
    items: list[Item] = [Heading("Run times")]
    timed = [run for run in runs if run.has_record and not math.isnan(value(run, "wall_s"))]
    if timed:
        wall = np.array([value(run, "wall_s") for run in timed])
        newton = np.array([value(run, "newton_iterations") for run in timed])
        done = np.array([run.periods_done for run in timed])
        seen = (
            f"{decimals(float(wall.sum()), 1)} s in all runs together, {number(1e3 * wall.sum() / done.sum(), 3)} ms "
            f"and {number(newton.sum() / done.sum(), 3)} Newton iterations per wave period, "
            f"{number(1e6 * wall.sum() / max(newton.sum(), 1.0), 3)} µs per Newton iteration on average"
        )
        picture = run_times(
            np.array([run.steepness for run in timed]), wall, newton / done, np.array([not run.ok for run in timed])
        )
        items.append(
            Figure(
                picture,
                f"Cost of each run: {seen}. From `wall_s` and `newton_iterations` of `table.csv`.",
                f"Wall time and Newton iterations of each run over wave steepness: {seen}.",
            )
        )
    table = timing_table(folder)
    items += [table] if table else []
    return items if len(items) > 1 else [*items, Text("Neither `table.csv` nor `provenance.json` holds times.")]


def scene_items(folder: Folder, runs: tuple[Run, ...], modes: Modes | None) -> list[Item]:
    """Every parameter with its source, and the closed forms that follow."""
    values = sorted({run.steepness for run in runs})
    span = number(values[0]) if len(values) == 1 else f"{number(values[0])} to {number(values[-1])}"
    varied = {"waves.steepness": span}
    if any(run.in_space for run in runs):
        varied["motion.dimensions"] = listed(sorted({"3" if run.in_space else "2" for run in runs}))
        if push := folder.provenance.get("push_mps"):
            varied["start.buoy_velocity_mps"] = f"{number(push)} across the waves in three dimensions"
    table = scene_table(
        folder.scene,
        "tethered_buoy",
        varied,
        "The scene as run, from `scene.toml`; defaults are those of the scene `tethered_buoy`.",
    )
    items: list[Item] = [Heading("Scene"), table]
    if modes:
        items.append(
            Text(
                f"From it follow the static tension {T_S} = {number(modes.static_tension_N)} N at strain "
                f"{number(modes.static_strain, 3)}, the radial frequency {OMEGA_R} = {number(modes.radial_radps)} "
                f"rad/s, the pendulum frequency {OMEGA_THETA} = {number(modes.pendulum_radps)} rad/s, and the wave "
                f"frequency {OMEGA_I} = {number(modes.wave_radps)} rad/s."
            )
        )
    return items
