"""A buoy sweep as its report sees it: every run's row with what its trajectory adds, read once for all sections."""

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from pathlib import Path

import numpy as np

from analysis import Spectrum, spectrum
from engine import Trajectory
from engine.natural_frequencies import Modes, natural_frequencies
from engine.views import strobed_radius
from tables import PAPER_STEEPNESS, Column, decimals, listed, number, ranges

from ..figures.quantities import colours_of
from ..figures.run_sheet import NOTHING, run_sheet
from ..parts import OMEGA_I, OMEGA_R, Folder, TableRow, having, in_order, read_folder

STEEPNESS = Column("steepness", "", "kA")
PAPER_WINDOW = (40, 20)  # tau_0/T_i and n of eq. (31) in the paper
LEAST_POINTS = 16  # strobed points below which no period is looked for
END_PERIODS = 6.0  # of a record that its sheet shows larger
_MANY, _FINE_BINS = 120, 160  # runs above which sheets are drawn more coarsely: 400 of them stay below 10 MB
_MOST_POINTS = 400  # of a section
_LEAST_WINDOW = 5  # wave periods: fewer bins than this below the wave frequency say nothing
# columns without which there is no report; all others may be of a later version
NEEDED = (
    "dimensions", "status", "regime", "regime_tighter", "regime_reason", "evidence", "strobed_period",
    "radius_min_m", "radius_max_m", "tension_top_max_N", "slack_fraction", "max_turn_rad", "loop_releases",
    "newton_iterations", "wall_s", "run_key", "message",
)  # fmt: skip


@dataclass(frozen=True, eq=False)
class Run(TableRow):
    """One row of the table with what its trajectory adds.

    anchor: the place of its sheet in the report. fault: why the trajectory of a run that should have one could not be
    read, else "". transient: wave periods left out of strobed values and extremes. periods_done: its length. section:
    `strobed`. drawing: of its sheet, "" without a record of one wave period. key: column of what the sweep varies.
    """

    anchor: str = ""
    fault: str = ""
    transient: int = 0
    periods_done: float = 0.0
    section: np.ndarray = field(default_factory=lambda: np.empty((0, 2)))
    drawing: str = ""
    key: Column = STEEPNESS

    @property
    def period(self) -> int | None:
        """Wave periods after which it repeats, 0 where no number fits, None where this is not known."""
        if not self.ok or len(self.section) < LEAST_POINTS:
            return None
        return int(self["strobed_period"]) if self.known("strobed_period") else 0

    @property
    def value(self) -> float:
        """Its value of what the sweep varies."""
        return self[self.key.name]

    @property
    def motion(self) -> str:
        """The letter of its motion, "" in a sweep of one."""
        return self.row.get("motion") or ""

    @property
    def named(self) -> str:
        """ "kA = 0.13", "kA = 0.13, motion B"."""
        if self.motion:
            return f"{self.key.head} = {number(self.value)}, motion {self.motion}"
        return f"{self.key.head} = {number(self.value)}"

    @property
    def in_space(self) -> bool:
        return self["dimensions"] == 3


@dataclass(frozen=True, eq=False)
class Sweep:
    """The folder and all facts that more than one section of the report uses.

    runs: by value, then by motion. between: those between the values of the table, which nobody judged. tolerance:
    of its range, within which a motion repeats. longest: largest number of wave periods tried. modes: natural
    frequencies, None where there are none. key: column of what is varied.
    """

    folder: Folder
    runs: list[Run]
    between: list[Run]
    tolerance: float
    longest: int
    modes: Modes | None
    key: Column = STEEPNESS

    @cached_property
    def good(self) -> list[Run]:
        """The runs that reached their full length."""
        return having(self.runs, status="ok")

    @cached_property
    def judged(self) -> list[Run]:
        """The runs with a regime."""
        return self.runs_with(lambda run: run["regime"])

    @cached_property
    def values(self) -> list[float]:
        """The values of what is varied, each once."""
        return sorted({run.value for run in self.runs})

    @cached_property
    def motions(self) -> dict[str, list[Run]]:
        """The runs of each motion by its letter; {"": all} where there is one motion."""
        motions = {}
        for run in sorted(self.runs, key=lambda run: run.motion):
            motions.setdefault(run.motion, []).append(run)
        return motions

    @cached_property
    def colours(self) -> dict[str, str]:
        """The colour of each motion by its letter; {} where there is one motion."""
        return colours_of(self.runs)

    @cached_property
    def chosen(self) -> list[Run]:
        """The runs whose sheets are printed: nearest the paper's two steepnesses, else the first and the last; and the
        first of several points.
        """
        drawable = self.runs_with(lambda run: run.drawing)
        good = having(drawable, status="ok") or drawable
        chosen = [run for run in good if (run.period or 0) > 1][:1]
        wanted = PAPER_STEEPNESS
        if self.key.name != STEEPNESS.name:
            wanted = [*self.values[:1], *self.values[-1:]]
        for value in wanted:
            nearest = min((run.value for run in good), key=lambda given, value=value: abs(given - value), default=None)
            chosen += [run for run in good if run.value == nearest]
        return chosen

    def runs_with(self, condition: Callable[[Run], object]) -> list[Run]:
        """The runs of the table for which the condition holds."""
        return list(filter(condition, self.runs))

    def at(self, chosen: Iterable[Run]) -> str:
        """ "kA = 0.01 to 0.03 and 0.05": the chosen of the runs, neighbours joined; " (A)" behind those of a motion."""
        places = {}
        for run in sorted(chosen, key=lambda run: run.motion):
            places.setdefault(run.motion, set()).add(run.value)
        parts = []
        for letter, values in places.items():
            text = f"{self.key.head} = {ranges(self.values, np.isin(self.values, list(values)))}"
            if letter:
                text += f" ({letter})"
            parts.append(text)
        return listed(parts)


def read_sweep(directory: Path, key: Column = STEEPNESS) -> Sweep:
    """The facts of a sweep's folder, runs by the column `key`.

    A trajectory that cannot be read leaves a run with a `fault`.
    Raises FolderError for a folder that is no finished sweep.
    """
    folder = read_folder(directory, (key.name, *NEEDED))
    provenance = folder.provenance  # an older one may be silent: then these are the values of `campaigns.judge`
    tolerance = float(provenance.get("strobe_tolerance") or 0.01)
    longest = int(provenance.get("longest_period") or 16)
    modes = natural_frequencies(folder.scene)
    bins = _FINE_BINS if len(folder.table) <= _MANY else _FINE_BINS // 2
    draw = partial(drawing, bins=bins, modes=modes)
    rows = folder.table
    if not colours_of(rows):
        rows = [{**row, "motion": ""} for row in rows]
    runs = []
    for place, row in enumerate(in_order(rows, [key.name]), 1):
        runs.append(_read_run(folder, row, key, f"run-{place}", draw))
    between, part = [], folder.part("between")
    for row in part.completed:
        between.append(_named(_read_run(part, row, key), runs))
    return Sweep(folder, runs, between, tolerance, longest, modes, key)


def _named(run: Run, judged: Sequence[Run]) -> Run:
    """A run between the values of others as one of the motion, of those beside it, whose range of r is nearest its."""
    values = np.array([neighbour.value for neighbour in judged])
    low, high = values[values < run.value].max(initial=-np.inf), values[values > run.value].min(initial=np.inf)
    nearest, least = run, math.inf
    for neighbour in judged:
        if neighbour.value not in (low, high) or not neighbour.ok:
            continue
        distance_m = abs(run["radius_min_m"] - neighbour["radius_min_m"])
        distance_m += abs(run["radius_max_m"] - neighbour["radius_max_m"])
        if nearest is run or distance_m < least:
            nearest, least = neighbour, distance_m
    return replace(run, row={**run.row, "motion": nearest.motion})


def _read_run(folder: Folder, row: dict, key: Column, anchor: str = "", draw: Callable | None = None) -> Run:
    """A row with what its trajectory adds. draw: makes the drawing of its sheet, None for a run that gets none."""
    left_out = row.get("transient_periods", folder.provenance.get("transient"))
    transient = int(left_out) if left_out and math.isfinite(left_out) else 0
    trajectory, fault = folder.trajectory(row)
    if trajectory is None or len(trajectory.columns["time_s"]) < 2:
        return Run(row, anchor, fault, transient, key=key)
    section = strobed_radius(trajectory, transient)
    periods_done = float(trajectory.columns["time_s"][-1]) / trajectory.scene.waves.period_s
    run = Run(row, anchor, fault, transient, periods_done, section, key=key)
    if draw is None or periods_done < 1.0:
        return run
    return replace(run, drawing=draw(run, trajectory))


def drawing(run: Run, trajectory: Trajectory, bins: int, modes: Modes | None) -> str:
    """All that the sheet of a run shows of its trajectory. bins: columns of its histories."""
    columns, period_s = trajectory.columns, trajectory.scene.waves.period_s
    wave, amplitudes, exponent = 2.0 * math.pi / period_s, NOTHING, NOTHING
    spectrum = _spectrum(run, trajectory)
    if spectrum is not None:
        frequency = spectrum.angular_frequency_radps
        part = (frequency > 0.0) & (frequency <= 2.5 * wave)
        amplitudes = frequency[part], spectrum.amplitude[part]
    if trajectory.tangent is not None:
        growth = trajectory.tangent.growth_nats[run.transient :, :1]
        carried = np.empty(0, int)
        if growth.size:
            carried = np.flatnonzero(np.isfinite(growth).all(axis=1))
        if len(carried):  # perturbations may be carried from a later period on
            so_far = np.cumsum(growth[carried, 0]) / np.arange(1, len(carried) + 1) / math.log(2.0)
            exponent = run.transient + 1.0 + carried, so_far
    low, high = columns["tension_top_low_N"] / 1e3, columns["tension_top_high_N"] / 1e3
    radius, angle = columns["radius_m"], columns["angle_rad"]
    histories = (("T (kN)", low, high), ("r (m)", radius, radius), ("θ (rad)", angle, angle))
    marks = [(wave, OMEGA_I)]
    if modes:
        marks.insert(0, (modes.radial_radps, OMEGA_R))
    span = f"r from {decimals(run['radius_min_m'], 2)} to {decimals(run['radius_max_m'], 2)} m"
    seen = (
        f"Tension, radius and angle over {number(run.periods_done)} wave periods at {run.named}, with section, "
        f"spectrum and exponent: {span}, tension up to {number(run['tension_top_max_N'])} N."
    )
    section = run.section[:_MOST_POINTS]
    return run_sheet(
        seen, bins, columns["time_s"] / period_s, histories, END_PERIODS, section, amplitudes, marks, exponent
    )


def _spectrum(run: Run, trajectory: Trajectory) -> Spectrum | None:
    """Eq. (31) of r over `spectrum_window`; None for a record that is too short or not finite."""
    window, values, scene = spectrum_window(run.periods_done), trajectory.columns["radius_m"], trajectory.scene
    if window is None or not np.isfinite(values).all():
        return None
    return spectrum(values, scene.sample_step_s(), scene.waves.period_s, *window)


def spectrum_window(periods_done: float) -> tuple[int, int] | None:
    """(tau_0/T_i, n) of eq. (31): the paper's (40, 20), else the last half of a record; None below 10 periods."""
    periods = math.floor(periods_done + 1e-6)  # whole ones
    if periods >= sum(PAPER_WINDOW):
        return PAPER_WINDOW
    half = periods // 2
    return (periods - half, half) if half >= _LEAST_WINDOW else None
