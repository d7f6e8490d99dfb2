"""The tables of a buoy sweep: the runs, what is out of the plane, their cost, the scene."""

from collections.abc import Sequence

import numpy as np

from tables import EMPTY, PLANE, REGIMES, RUNS, decimals, listed, number, of_kicks, percent, ranges

from ..figures.quantities import over_key
from ..parts import (
    LONGEST_CELL,
    OMEGA_I,
    OMEGA_R,
    OMEGA_THETA,
    T_S,
    Figure,
    Heading,
    Items,
    Table,
    Text,
    batched,
    heads,
    link,
    plain,
    scene_items,
    series,
    shown_on,
    table_of,
)
from .runs import Run, Sweep

_MOST = 21  # columns of one table
_ON_SHEETS = (  # alone, because the table of motions or a figure has them too
    "share_low", "share_high", "found_by", "periods", "transient_periods", "angle_min_rad", "angle_max_rad",
    "max_turn_rad",
)  # fmt: skip
# What `campaigns.out_of_plane` finds, and tests/reports/test_regimes.py holds it to.
COMPARED = (
    "`campaigns.out_of_plane` compares planar runs that release loops with runs in three dimensions, at kA = 0.13 and "
    "H = 21.0, 21.6 and 22.0 m, over 200 wave periods. Range of r, section, exponent and regime of the buoy agree; its "
    "path in time after the first loops, and the shape of the rope in a loop, do not."
)


def sweep_table(sweep: Sweep, names: Sequence[str], runs: Sequence[Run], caption: str) -> Table:
    """A table of runs: their value, a link to the sheet of the run, their motion and the columns of these names.

    A period of 0 reads "none". Columns without an entry in any of the runs are left out.
    """
    columns, key = sweep.folder.columns, sweep.key.name
    filled = shown_on(columns, runs)
    shown = [name for name in dict.fromkeys((key, "motion", *names)) if name in filled]
    own_cells = {
        key: lambda run: link(number(run.value), run.anchor),
        "share": of_kicks,
        "strobed_period": _period,
    }
    return table_of(columns, shown, runs, caption, own_cells)


def _period(run: Run) -> str:
    """The wave periods after which a run repeats, "none" where no number fits, a dash where this is not known."""
    return EMPTY if run.period is None else str(run.period or "none")


def runs_items(sweep: Sweep) -> Items:
    """All rows of table.csv in the columns a reader asks for first."""
    columns = sweep.folder.columns
    names = shown_on(columns, sweep.runs, RUNS, REGIMES, longest=LONGEST_CELL)
    names = [name for name in names if name not in (sweep.key.name, "motion", *_ON_SHEETS)]
    if len(sweep.good) == len(sweep.runs):
        names.remove("status")
    if sweep.runs_with(lambda run: run.in_space):
        names.insert(0, "dimensions")
    caption = (
        f"Every run of `table.csv`. A motion repeats after N wave periods if it does to {percent(sweep.tolerance)} of "
        f"its range, N ≤ {sweep.longest}; “none” where no N does. A dash: not known. On the page "
        f"{sweep.key.head} leads to the sheet of the run."
    )
    return [Heading("Table of runs"), [sweep_table(sweep, part, sweep.runs, caption) for part in batched(names, _MOST)]]


def plane_items(sweep: Sweep) -> Items:
    """What is known of motion across the plane of the waves, or nothing."""
    growth_name, error_name = "offplane_growth_bits_per_period", "offplane_growth_error"
    columns = sweep.folder.columns
    shown = sweep.runs_with(lambda run: run.in_space or run["loop_releases"] > 0)
    across = sweep.runs_with(lambda run: run.known(growth_name) and run.known(error_name))
    if not shown and not across:
        return
    provenance = sweep.folder.provenance
    dimensions = provenance.get("dimensions")
    words = (
        f"Made with `--dimensions {dimensions}`: 2 is the plane of the waves, 3 all directions, auto 3 "
        "where the run in the plane released loops."
    )
    push = provenance.get("push_mps")
    if push:
        words += f" At t = 0 the buoy got {number(push)} m/s across the waves; else it would stay in the plane."
    yield Heading("Out of the plane")
    yield Text(words)
    if across:
        growth, error = columns[growth_name], columns[error_name]
        picture = over_key(across, columns[sweep.key.name], [((growth, error),)], sweep.colours)
        caption = (
            "Exponent of an infinitesimal perturbation across the plane, with one standard error, in planar runs that "
            f"released no loop: below zero the planar motion is stable. From `{growth.name}` and `{error.name}`."
        )
        yield Figure(picture, caption, "Exponent across the plane, with standard errors.")
    if shown:
        caption = (
            "Runs in three dimensions (D = 3) and planar runs with loop releases (D = 2). Columns called planar are of "
            "the planar run that a run in three dimensions replaces; the regime of D = 3 is that of the samples alone."
        )
        names = []
        for name, column in columns.items():
            if column.page == PLANE:  # a column of the planar run stands behind the same one of the run in space
                names += [name.removeprefix("planar_"), name]
        yield Text(COMPARED)
        yield sweep_table(sweep, names, shown, caption)


def cost_figure(sweep: Sweep) -> Figure | None:
    """Time and Newton iterations of each run; None where no run tells its time."""
    columns = sweep.folder.columns
    rows = sweep.runs_with(lambda run: run.periods_done)
    periods = sum(run.periods_done for run in rows)
    wall_s = series(rows, "wall_s")
    if not np.isfinite(wall_s).any():
        return None
    total_s, newton = float(np.nansum(wall_s)), float(np.nansum(series(rows, "newton_iterations")))
    costs = (
        f"{decimals(total_s, 1)} s in all, {number(1e3 * total_s / periods, 3)} ms and {number(newton / periods, 3)} "
        f"Newton iterations a wave period, {number(1e6 * total_s / max(newton, 1.0), 3)} µs an iteration"
    )
    caption = f"Cost of each run: {costs}. Crosses: runs that ended early. From `table.csv`."
    alt = f"Wall time and Newton iterations of each run over {plain(sweep.key.head)}: {costs}."
    shown = [((columns["wall_s"], None),), ((columns["newton_iterations"], None),)]
    return Figure(over_key(rows, columns[sweep.key.name], shown, sweep.colours), caption, alt)


def scene_and_modes(sweep: Sweep) -> Items:
    """Every parameter with its source, and the closed forms that follow."""
    modes = sweep.modes
    varied = {"waves.steepness": ranges(sweep.values, [True] * len(sweep.values))}
    if sweep.runs_with(lambda run: run.in_space):
        dimensions = np.unique(series(sweep.runs, "dimensions"))
        varied["motion.dimensions"] = listed(map(number, dimensions))
        push = sweep.folder.provenance.get("push_mps")
        if push:
            varied["start.buoy_velocity_mps"] = f"{number(push)} across the waves in three dimensions"
    yield scene_items(sweep.folder.scene, "tethered_buoy", varied)
    if modes:
        rows = (
            ("static tension", T_S, number(modes.static_tension_N), "N"),
            ("static strain", "", number(modes.static_strain, 3), EMPTY),
            ("radial frequency", OMEGA_R, number(modes.radial_radps), "rad/s"),
            ("pendulum frequency", OMEGA_THETA, number(modes.pendulum_radps), "rad/s"),
            ("wave frequency", OMEGA_I, number(modes.wave_radps), "rad/s"),
        )
        columns = heads("quantity", "symbol", ("value", ""), ("unit", ""))
        yield Table(columns, rows, "What follows from the scene in closed form.", small=False)
