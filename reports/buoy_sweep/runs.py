"""A buoy sweep as its report sees it: every run's row with what its trajectory adds, read once for all sections."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from engine.natural_frequencies import Modes, natural_frequencies

from ..parts.folder import Folder, Row, read_folder
from ..parts.wording import number, ranges

if TYPE_CHECKING:
    from analysis import Spectrum
    from engine import Trajectory

PAPER_STEEPNESS = (0.016, 0.13)  # as in `campaigns.buoy_sweep`, which reports must not import
PAPER_WINDOW = (40, 20)  # tau_0/T_i and n of eq. (31) in the paper
LEAST_POINTS = 16  # strobed points below which no period is looked for
_LEAST_WINDOW = 5  # wave periods: fewer bins than this below the wave frequency say nothing
# columns without which there is no report; all others may be of a later version
NEEDED = (
    "steepness", "dimensions", "status", "regime", "regime_tighter", "regime_reason", "evidence", "strobed_period",
    "radius_min_m", "radius_max_m", "tension_top_max_N", "slack_fraction", "max_turn_rad", "loop_releases",
    "newton_iterations", "wall_s", "run_key", "message",
)  # fmt: skip


@dataclass(frozen=True, eq=False)
class Run(Row):
    """One row of the table with what its trajectory adds.

    anchor: the place of its sheet in the report. fault: why the trajectory of a run that should have one could not be
    read, else "". periods_done: its length. section: `strobed`. period: wave periods after which it repeats, 0 where no
    number fits, None where this is not known. visited: strobed r (m) of the points that it visits in turn. It is () for
    a run without a period, and where these points lie within the tolerance of each other: a pendulum swing that dies
    out slowly comes back to nearly the same place every six wave periods (omega_theta T_i is close to 1 rad), and the
    table then says period 6 of a motion that is about to settle on one point. above_still_m, above_wave_m: highest
    centre of the buoy above still water and above the wave at its place; out_share: share of the samples with the whole
    sphere above that wave; nan without a record.
    """

    anchor: str = ""
    fault: str = ""
    periods_done: float = 0.0
    section: np.ndarray = field(default_factory=lambda: np.empty((0, 2)))
    period: int | None = None
    visited: tuple[float, ...] = ()
    above_still_m: float = math.nan
    above_wave_m: float = math.nan
    out_share: float = math.nan

    @property
    def steepness(self) -> float:
        return self["steepness"]

    @property
    def named(self) -> str:
        """ "kA = 0.13"."""
        return f"kA = {number(self.steepness)}"

    @property
    def in_space(self) -> bool:
        return self["dimensions"] == 3

    @property
    def has_record(self) -> bool:
        """Whether there is enough of a record to draw: one wave period at least."""
        return not self.fault and self.periods_done >= 1.0

    @property
    def planar_releases(self) -> float:
        """Loop releases of the planar run: its own, or those of the run that a run in three dimensions replaces."""
        return self["planar_loop_releases" if self.in_space else "loop_releases"]

    def spectrum(self, trajectory: Trajectory, column: str) -> Spectrum | None:
        """Eq. (31) of a column over `spectrum_window`; None for a record that is too short or not finite."""
        from analysis import spectrum

        window, values, scene = spectrum_window(self.periods_done), trajectory.columns[column], trajectory.scene
        if window is None or not np.isfinite(values).all():
            return None
        return spectrum(values, scene.sample_step_s(), scene.waves.period_s, *window)


@dataclass(frozen=True, eq=False)
class Sweep:
    """The folder and all facts that more than one section of the report uses.

    transient: wave periods left out of strobed values and extremes. tolerance: of its range, within which a motion
    repeats. longest: largest number of wave periods tried. modes: natural frequencies, None where there are none.
    """

    folder: Folder
    runs: tuple[Run, ...]
    transient: int
    tolerance: float
    longest: int
    modes: Modes | None

    @cached_property
    def good(self) -> tuple[Run, ...]:
        """The runs that reached their full length."""
        return tuple(run for run in self.runs if run.ok)

    @cached_property
    def judged(self) -> tuple[Run, ...]:
        """The runs with a regime."""
        return tuple(run for run in self.runs if run["regime"])

    @cached_property
    def chosen(self) -> tuple[Run, ...]:
        """The runs drawn in full: nearest the paper's two steepnesses, then the first that visits several points."""
        drawable = [run for run in self.runs if run.has_record]
        good = [run for run in drawable if run.ok] or drawable
        nearest = [min(good, key=lambda run: abs(run.steepness - kA)) for kA in PAPER_STEEPNESS if good]
        several = [run for run in good if len(run.visited) > 1 and run not in nearest]
        return tuple(sorted(dict.fromkeys([*nearest, *several[:1]]), key=lambda run: run.steepness))

    def at(self, chosen: Iterable[Run]) -> str:
        """ "kA = 0.01 to 0.03 and 0.05": the chosen of the runs, neighbours joined."""
        chosen = set(chosen)
        return f"kA = {ranges([run.steepness for run in self.runs], [run in chosen for run in self.runs])}"

    def trajectory(self, run: Run) -> Trajectory:
        """The trajectory of a run that has a record."""
        return self.folder.trajectory(run.row)[0]


def read_sweep(directory: str | Path) -> Sweep:
    """The facts of a sweep's folder, runs by steepness; a trajectory that cannot be read leaves a run with a `fault`.

    Raises FolderError for a folder that is no finished sweep.
    """
    folder = read_folder(directory, NEEDED)
    told = folder.provenance  # an older one may be silent: then these are the values of `campaigns.judge`
    transient, tolerance = int(told.get("transient") or 0), float(told.get("strobe_tolerance") or 0.01)
    rows = folder.table.sort_values("steepness", kind="stable").to_dict("records")
    runs = tuple(_read_run(folder, row, f"run-{place}", transient, tolerance) for place, row in enumerate(rows, 1))
    longest = int(told.get("longest_period") or 16)
    return Sweep(folder, runs, transient, tolerance, longest, natural_frequencies(folder.scene))


def _read_run(folder: Folder, row: dict, anchor: str, transient: int, tolerance: float) -> Run:
    from engine.physics.sea import elevation_m

    trajectory, fault = folder.trajectory(row)
    if trajectory is None or len(trajectory.columns["time_s"]) < 2:
        return Run(row, anchor, fault)
    columns, scene = trajectory.columns, trajectory.scene
    section = strobed(trajectory, transient)
    period, visited = _period(row, section, tolerance)
    above_still = columns["z_m"] - scene.water.depth_m
    above_wave = above_still - elevation_m(scene, columns["time_s"], columns["x_m"])
    out_share = float(np.mean(above_wave > 0.5 * scene.buoy.diameter_m))
    highest = float(np.nanmax(above_still)), float(np.nanmax(above_wave))
    periods_done = float(columns["time_s"][-1]) / scene.waves.period_s
    return Run(row, anchor, fault, periods_done, section, period, visited, *highest, out_share)


def _period(row: dict, section: np.ndarray, tolerance: float) -> tuple[int | None, tuple[float, ...]]:
    """`period` and `visited` of a Run: the points are means over the last half of the section."""
    if row["status"] != "ok" or len(section) < LEAST_POINTS:
        return None, ()
    if math.isnan(row["strobed_period"]):
        return 0, ()
    length = int(row["strobed_period"])
    rounds = max(len(section) // (2 * length), 1)
    radii = section[-rounds * length :, 0].reshape(-1, length).mean(axis=0)
    apart = length == 1 or np.ptp(radii) > tolerance * (row["radius_max_m"] - row["radius_min_m"])
    return length, tuple(map(float, radii)) if apart else ()


def strobed(trajectory: Trajectory, transient: int) -> np.ndarray:
    """Columns r (m) and r' (m/s) at t = k T_i, k >= transient, (m, 2); empty for a record that ends before.

    They are taken from the trajectory, because table.csv has no strobed values.
    """
    from analysis import poincare_section

    series = {name: trajectory.columns[name] for name in ("radius_m", "radius_rate_mps")}
    step_s, period_s = trajectory.scene.sample_step_s(), trajectory.scene.waves.period_s
    end = int(np.logical_and.accumulate(np.isfinite([*series.values()]).all(axis=0)).sum())  # finite samples
    if (end - 1) * step_s < transient * period_s:
        return np.empty((0, 2))
    sound = {name: values[:end] for name, values in series.items()}
    return poincare_section(sound, step_s, period_s, transient_periods=transient).points


def spectrum_window(periods_done: float) -> tuple[int, int] | None:
    """(tau_0/T_i, n) of eq. (31): the paper's (40, 20), else the last half of a record; None below 10 periods."""
    whole = math.floor(periods_done + 1e-6)
    if whole >= sum(PAPER_WINDOW):
        return PAPER_WINDOW
    return (whole - whole // 2, whole // 2) if whole // 2 >= _LEAST_WINDOW else None
