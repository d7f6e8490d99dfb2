"""The tables of a buoy sweep: the runs, what is out of the plane, their cost, the scene."""

from __future__ import annotations

import math

import numpy as np

from ..parts.columns import Name, table_of
from ..parts.content import Figure, Heading, Item, Text
from ..parts.provenance import scene_table, timing_table
from ..parts.symbols import OMEGA_I, OMEGA_R, OMEGA_THETA, T_S
from ..parts.wording import EMPTY, decimals, listed, number, percent
from ..sweep.quantities import Measured, over_key, series
from .runs import Run, Sweep, linked

_RUNS = (
    "radius_min_m", "radius_max_m", "angle_min_rad", "angle_max_rad", "tension_top_min_N", "tension_top_max_N",
    "slack_fraction", "max_turn_rad", "loop_releases", "steps", "rejected_steps", "newton_iterations", "wall_s",
)  # fmt: skip
_ACROSS = ("offplane_growth_bits_per_period", "offplane_growth_error")
_PLANE = (
    "steepness", "dimensions", "planar_loop_releases", "loop_releases", "rope_lateral_max_m", "buoy_lateral_max_m",
    "max_turn_rad", "radius_min_m", "radius_max_m", "planar_radius_min_m", "planar_radius_max_m", "regime",
    "planar_regime",
)  # fmt: skip
_COST = ("wall_s", "newton_iterations")
_MODES = {
    "2": "Every run was made in the plane of the waves.",
    "3": "Every run was made in three dimensions (`--dimensions 3`).",
    "auto": "Every value was run in the plane of the waves first; where that run released loops, the row is of a run "
    "in three dimensions (`--dimensions auto`).",
}
# What `campaigns.out_of_plane` finds, and tests/reports/test_plane_or_space.py holds it to.
COMPARED = (
    "`campaigns.out_of_plane` compares such runs with runs in three dimensions at kA = 0.13 and depths of 21.0, 21.6 "
    "and 22.0 m, over 200 wave periods: range of r, section, exponent and regime of the buoy are the same within what "
    "one record leaves open, so for these the planar run is good enough. The path of the buoy in time after the first "
    "loops, and the shape of the rope in a loop, are not."
)


def sweep_table(sweep: Sweep, names: tuple[Name, ...], runs: tuple[Run, ...], caption: str):
    """A table of runs, the steepness a link to the sheet of the run; a period of 0 reads "none"."""
    by_row = {id(run.row): run for run in runs}
    own = {
        "steepness": lambda row: linked(by_row[id(row)]),
        "strobed_period": lambda row: _period(by_row[id(row)]),
    }
    return table_of(sweep.columns, names, [run.row for run in runs], caption, own)


def _period(run: Run) -> str:
    return EMPTY if run.period is None else str(run.period or "none")


def runs_items(sweep: Sweep) -> list[Item]:
    """All rows of table.csv in the columns a reader asks for first."""
    space = ("dimensions",) if any(run.in_space for run in sweep.runs) else ()
    caption = (
        f"Every run of `table.csv`. A motion repeats after N wave periods if it does to {percent(sweep.tolerance)} of "
        f"its range, N ≤ {sweep.longest}; “none” where no N does. The transient are the first {sweep.transient} wave "
        "periods. A dash: not known. On the page kA leads to the sheet of the run."
    )
    names = ("steepness", *space, "status", "strobed_period", *_RUNS)
    return [Heading("Table of runs"), sweep_table(sweep, names, sweep.runs, caption)]


def plane_items(sweep: Sweep) -> list[Item]:
    """What is known of motion across the plane of the waves, or nothing."""
    shown = tuple(run for run in sweep.runs if run.in_space or run.planar_releases > 0)
    across = tuple(run for run in sweep.runs if all(math.isfinite(run[name]) for name in _ACROSS))
    if not shown and not across:
        return []
    told = sweep.folder.provenance
    words = [_MODES.get(str(told.get("dimensions")), "")]
    if push := told.get("push_mps"):
        words.append(
            "Without a push the motion would stay exactly in the plane: as the scene has no velocity across the waves, "
            f"the buoy was given {number(push)} m/s there at t = 0 (`push_mps` in `provenance.json`)."
        )
    items: list[Item] = [Heading("Out of the plane"), Text(" ".join(filter(None, words)))]
    if across:
        items += _across(sweep, across)
    if any(not run.in_space for run in shown):
        items.append(Text(f"Planar runs with loop releases are marked 2 under D. {COMPARED}"))
    caption = (
        "Runs in three dimensions (D = 3) and planar runs with loop releases (D = 2). The columns called planar are of "
        "the planar run that a run in three dimensions replaces; the regime of D = 3 is that of the samples alone."
    )
    return [*items, sweep_table(sweep, _PLANE, shown, caption)] if shown else items


def _across(sweep: Sweep, across: tuple[Run, ...]) -> list[Item]:
    """Words and figure on the exponents across the plane; `across`: the runs that have one."""
    bits, errors = (series([run.row for run in across], name) for name in _ACROSS)
    kinds = (
        ("decays", bits < -2.0 * errors),
        ("grows", bits > 2.0 * errors),
        ("does neither by two standard errors", abs(bits) <= 2.0 * errors),
    )
    found = [
        f"it {word} at {sweep.at([run for run, one in zip(across, chosen, strict=True) if one], across)}"
        for word, chosen in kinds
        if chosen.any()
    ]
    words = (
        "Planar runs that released no loop carry an infinitesimal perturbation across their plane "
        f"(`output.lateral_growth`): {'; '.join(found)}."
    )
    columns = sweep.columns
    shown = Measured(columns[_ACROSS[0]].unit, ((columns[_ACROSS[0]], columns[_ACROSS[1]]),))
    picture = over_key([run.row for run in across], columns["steepness"], [shown])
    seen = f"from {decimals(float(bits.min()), 3)} to {decimals(float(bits.max()), 3)} bits per wave period"
    caption = (
        "Exponent of an infinitesimal perturbation across the plane, with one standard error: below zero the planar "
        f"motion is stable. Seen: {seen}. From `{_ACROSS[0]}` and `{_ACROSS[1]}` of `table.csv`."
    )
    return [Text(words), Figure(picture, caption, f"Exponent across the plane over wave steepness: {seen}.")]


def time_items(sweep: Sweep) -> list[Item]:
    """What each run cost, and the time split of the campaign."""
    rows = [run.row for run in sweep.runs if run.has_record]
    items: list[Item] = []
    if np.isfinite(wall := series(rows, "wall_s")).any():
        shown = [Measured(sweep.columns[name].unit, ((sweep.columns[name], None),)) for name in _COST]
        done = sum(run.periods_done for run in sweep.runs if run.has_record)
        newton = np.nansum(series(rows, "newton_iterations"))
        seen = (
            f"{decimals(float(np.nansum(wall)), 1)} s in all runs together, {number(1e3 * np.nansum(wall) / done, 3)} "
            f"ms and {number(newton / done, 3)} Newton iterations per wave period, "
            f"{number(1e6 * np.nansum(wall) / max(newton, 1.0), 3)} µs per Newton iteration on average"
        )
        caption = f"Cost of each run: {seen}. Crosses: runs that ended early. From `table.csv`."
        alt = f"Wall time and Newton iterations of each run over wave steepness: {seen}."
        items.append(Figure(over_key(rows, sweep.columns["steepness"], shown), caption, alt))
    items += [table] if (table := timing_table(sweep.folder)) else []
    nothing = Text("Neither `table.csv` nor `provenance.json` holds times.")
    return [Heading("Run times"), *(items or [nothing])]


def scene_items(sweep: Sweep) -> list[Item]:
    """Every parameter with its source, and the closed forms that follow."""
    values, modes = sorted({run.steepness for run in sweep.runs}), sweep.modes
    span = number(values[0]) if len(values) == 1 else f"{number(values[0])} to {number(values[-1])}"
    varied = {"waves.steepness": span}
    if any(run.in_space for run in sweep.runs):
        varied["motion.dimensions"] = listed(sorted({"3" if run.in_space else "2" for run in sweep.runs}))
        if push := sweep.folder.provenance.get("push_mps"):
            varied["start.buoy_velocity_mps"] = f"{number(push)} across the waves in three dimensions"
    caption = "The scene as run, from `scene.toml`; defaults are those of the scene `tethered_buoy`."
    items: list[Item] = [Heading("Scene"), scene_table(sweep.folder.scene, "tethered_buoy", varied, caption)]
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
