"""Companions of a finished run: the same run on another grid or in other steps, and what they say of its tensions."""

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ..digits import digits
from ..record import ONE_STAGE
from ..scene.models import Output, Scene
from ..time.status import OK
from ..trajectory.columns import Columns, columns_of
from .rest import static_tension_N

if TYPE_CHECKING:
    from . import Run

NOTED = 0.05  # share of the largest tension: a smaller error is not told
PRESSED = 0.1  # share of the largest tension: compression below it does not change the largest tension
LEAST_NODES = 3  # of a grid with half the elements
SAMPLES_AROUND_PEAK = 2  # before and after the largest tension, in which another run has it
EARLY_WAVES = 5  # of a buoy that are repeated
ROUNDING = 1e-3  # of the weight of the line: a smaller difference of tensions says nothing
SLACK = 0.05  # of the tension at rest: the line is slack
THRESHOLDS, USUAL = (SLACK / 2, SLACK, 2 * SLACK), 1  # for which slack fractions are compared; SLACK among them
FRACTION_DEPENDS = 0.06  # change of the slack fraction from threshold to threshold; a larger one calls for FINE
UNCOMPARED = "no other grid brings this run to its end, so that nothing is known of its errors"


class _Grid(NamedTuple):
    """Another run of the scene: times the elements, and by how much its tolerance and longest step are smaller."""

    elements: float
    tighter: float
    shorter: float


class _Limits(NamedTuple):
    """Differences of two runs, tensions over the largest of the first run.

    tension: of the largest tensions; slack: of slack fractions for any threshold; at_peak: of the tensions at the time
    of the first run's largest, because two runs may have the same largest tension at two snaps.
    """

    tension: float
    slack: float
    at_peak: float = math.inf


COARSE, FINE = _Grid(0.5, 10, 2), _Grid(2, 30, 4)
HINT = _Limits(0.015, 0.02, at_peak=0.015)  # in COARSE: it calls for FINE; in FINE: told without drag
NEAR = _Limits(0.05, 0.05)  # in COARSE: FINE may refute a bound that was told
COARSE_DIFFERS = _Limits(0.08, 0.035)  # is told where FINE is not run
FINE_DIFFERS = _Limits(0.03, 0.04)  # is told
# A larger difference in COARSE is told whatever FINE says. A third of that of tensions is an error of second order.
MUCH = _Limits(3 * NOTED, 0.055)
SHRINKS = 0.4  # of the difference in COARSE: errors shrink at least to this in FINE; where they do not, HINT is told


def steps_too_long(run: "Run", columns: Columns) -> str:
    """Says what steps twice as long do to the largest tension, of one-stage methods in steps of one length."""
    solver = run.scene.solver
    if run.record["method"] != ONE_STAGE or solver.courant is not None:
        return ""
    twice = run.scene.with_values("solver", step_s=2 * float(run.record["fixed_step"]))
    longer = _columns_of_companion(run, twice, run.duration_s)
    if longer is None:
        return ""
    largest_N, other_N = (float(series["tension_top_high_N"].max()) for series in (columns, longer))
    error_N = abs(other_N - largest_N) / (1 if solver.integrator == "backward-euler" else 3)  # 2^order - 1
    if error_N <= NOTED * abs(largest_N):
        return ""
    return (
        f"the largest tension, {digits(largest_N, 4)} N, holds to {digits(error_N, 2)} N, because it is "
        f"{digits(other_N, 4)} N in steps twice as long: shorten solver.step_s"
    )


class OtherGrids(NamedTuple):
    """What other grids and tolerances say of a run: a sentence or nothing, and whether both have its numbers.

    Where both have them, no bound which folds put on the largest tension needs telling.
    """

    words: str = ""
    agree: bool = False


def other_grids(run: "Run", columns: Columns, doubted: bool, bounded: bool) -> OtherGrids:
    """Compares largest tension and slack fractions with those of two other grids and tolerances.

    doubted: other sentences have said already that tensions are not exact; bounded: some have put bounds on them, which
    a comparison may refute. COARSE is run first. If it differs by a hint, or ends early, FINE is run and decides. FINE
    also is run

    - of a line without drag across it, because nothing calms its waves across, and COARSE may agree by luck (scene
      19/15 of benchmarks.random_scenes bears 944 N, 949 N in COARSE, 874 N in FINE);
    - of a line that is pressed together before its largest tension, for the same reason (50/85 bears 3752 N, 3734 N in
      COARSE, 4061 N in FINE, 4132 N refined);
    - where the slack fraction depends on its threshold, likewise (37/59 is slack for .24 of the time, .24 in
      COARSE, .30 in FINE, .31 refined; for .16 and .35 with half and twice the threshold);
    - where nothing but bounds was told, COARSE is NEAR, and drag acts across the line: if FINE is nearer still, the
      bounds are too wide.

    Where FINE ends early COARSE decides.
    """
    duration_s = _compared_s(run)
    if duration_s == 0.0:
        return OtherGrids()
    coarse = _differences(run, columns, duration_s, COARSE)
    if coarse is None and (doubted or bounded):
        return OtherGrids()
    undragged = run.record["cn"] == 0.0
    refutable = False
    if coarse is not None:
        bounds_alone = bounded and not doubted and duration_s == run.duration_s
        refutable = bounds_alone and not undragged and coarse.within(NEAR)
        if coarse.within(HINT):
            by_luck = undragged or _pressed_N(columns) > 0.0 or _depends_on_threshold(run.scene, columns)
            if not (by_luck or refutable):
                return OtherGrids()
        told = (doubted or bounded) and not refutable
        limits = _limits_of_coarse(coarse, told, undragged)
        if limits is not None:
            return OtherGrids(coarse.words(limits))
    fine = _differences(run, columns, duration_s, FINE)
    if fine is None and coarse is None:
        return OtherGrids(UNCOMPARED)
    if fine is None:
        return OtherGrids(coarse.words(COARSE_DIFFERS))
    words = fine.words(_limits_of_fine(fine, coarse, undragged))
    return OtherGrids(words, agree=refutable and not words and fine.within(HINT))


def _compared_s(run):
    """Until when runs are compared (s); 0 where they are not.

    Of a buoy in waves the first EARLY_WAVES are repeated, and only of its run from rest, because campaigns have
    thousands of others, whose motions they refine (docs/trust.md).
    """
    scene = run.scene
    if run.started is not None or scene.tether.nodes // 2 + 1 < LEAST_NODES:
        return 0.0
    if scene.buoy is None or scene.waves is None:
        return run.duration_s
    if scene.motion.dimensions == 2 and any(scene.start.buoy_velocity_mps):
        return 0.0
    return min(run.duration_s, scene.waves.ramp_s + EARLY_WAVES * scene.waves.period_s)


def _limits_of_coarse(coarse, told, undragged):
    """What COARSE has to differ by to be told, where it decides alone; None where FINE decides.

    It decides alone

    - where other sentences have said that tensions are not exact;
    - where it differs MUCH, or where the slack fraction for the usual threshold differs by more than COARSE_DIFFERS
      allows, because FINE may agree by luck (scene 41/29 of benchmarks.random_scenes bears 1733 N, 2863 N in COARSE,
      1754 N in FINE, 1897 N refined);
    - of a line without drag across it, because its folds and waves scatter (8/27 bears 2307 to 2833 N on ten grids and
      tolerances; 62/98 bears 175.1 N, 157.1 N in COARSE, 173.2 N in FINE, 185.9 N refined).
    """
    usual_change = abs(coarse.other_slack[USUAL] - coarse.slack[USUAL])
    if told or not coarse.within(MUCH) or usual_change > COARSE_DIFFERS.slack:
        return COARSE_DIFFERS
    if undragged and coarse.tension > FINE_DIFFERS.tension:
        return FINE_DIFFERS
    return None


def _limits_of_fine(fine, coarse, undragged):
    """What FINE has to differ by to be told: a HINT is enough where errors do not shrink as they should.

    Without drag across the line they shrink slowly (31/57: 23.1 N, 20.4 N in COARSE, 23.6 N in FINE, 24.9 N refined).
    Then the slack fraction, or another snap that is the largest, may show it before the largest tension does (61/81:
    134.1 N, slack for .056 of the time; in FINE 134.9 N and .025; refined 141.7 N).
    """
    if undragged:
        return HINT
    if coarse is None or fine.tension <= SHRINKS * coarse.tension:
        return FINE_DIFFERS
    return _Limits(HINT.tension, FINE_DIFFERS.slack)


def _depends_on_threshold(scene, columns):
    """Whether the slack fraction changes by more than FRACTION_DEPENDS with a larger or smaller threshold."""
    return np.abs(np.diff(_slack_fractions(scene, columns))).max() > FRACTION_DEPENDS


class _Differences(NamedTuple):
    """Largest tension and slack fractions of a run, and the same on another grid at another tolerance.

    tension: difference of the largest tensions over the first one. at_peak_N: largest tension of the other run when the
    run has its largest one; at_peak: its difference, over the same. slack, other_slack (3,): for THRESHOLDS.
    settings: of the other run, in words.
    """

    largest_N: float
    other_N: float
    tension: float
    at_peak_N: float
    at_peak: float
    slack: np.ndarray
    other_slack: np.ndarray
    settings: str

    @property
    def slack_change(self) -> float:
        """Largest difference of the slack fractions."""
        return float(np.abs(self.other_slack - self.slack).max())

    def within(self, limits: _Limits) -> bool:
        """Whether neither tensions nor slack fractions differ by more."""
        tensions = self.tension <= limits.tension and self.at_peak <= limits.at_peak
        return tensions and self.slack_change <= limits.slack

    def words(self, limits: _Limits) -> str:
        """A sentence on the largest tension and on the slack fraction, each if it differs by more; or nothing."""
        parts, largest = [], digits(self.largest_N, 4)
        if self.tension > limits.tension:
            parts.append(f"the largest tension is {digits(self.other_N, 4)} N in place of {largest} N")
        elif self.at_peak > limits.at_peak:
            parts.append(f"the top bears {digits(self.at_peak_N, 4)} N where this run bears its largest {largest} N")
        if self.slack_change > limits.slack:
            most = int(np.abs(self.other_slack - self.slack).argmax())
            threshold, slack, other_slack = THRESHOLDS[most], self.slack[most], self.other_slack[most]
            parts.append(
                f"the top bears at most {100 * threshold:g} % of its tension at rest for {other_slack:.2g} of the time "
                f"in place of {slack:.2g}"
            )
        if not parts:
            return ""
        return f"{self.settings} {' and '.join(parts)}, so that grid or tolerance decide: refine both"


def _differences(run, columns, duration_s, grid):
    """How the run differs until duration_s from one on another grid; None where that one ends early."""
    scene = run.scene
    other, settings = _on_grid(run, grid)
    if duration_s < run.duration_s:
        settings += f", in the first {digits(duration_s, 4)} s,"
    other_columns = _columns_of_companion(run, other, duration_s)
    if other_columns is None:
        return None
    columns = {name: series[: len(other_columns["time_s"])] for name, series in columns.items()}
    high_N, other_high_N = columns["tension_top_high_N"], other_columns["tension_top_high_N"]
    peak = int(high_N.argmax())
    around = slice(max(peak - SAMPLES_AROUND_PEAK, 0), peak + SAMPLES_AROUND_PEAK + 1)
    largest_N, other_N, at_peak_N = float(high_N[peak]), float(other_high_N.max()), float(other_high_N[around].max())
    return _Differences(
        largest_N,
        other_N,
        tension=_relative(scene, other_N, largest_N),
        at_peak_N=at_peak_N,
        at_peak=_relative(scene, at_peak_N, largest_N),
        slack=_slack_fractions(scene, columns),
        other_slack=_slack_fractions(scene, other_columns),
        settings=settings,
    )


def _on_grid(run, grid):
    """The scene of a run on another grid with smaller steps; and these settings in words."""
    scene, tether, solver = run.scene, run.scene.tether, run.scene.solver
    damping = tether.damping_critical
    if damping is not None:
        damping *= grid.elements  # a share of that of an element: so the damping of the line stays the same
    nodes, steps = math.ceil(grid.elements * (tether.nodes - 1)) + 1, {}
    settings = f"on {nodes} nodes"
    if run.record["adaptive"]:
        steps = {"rtol": solver.rtol / grid.tighter, "max_step_s": solver.max_step_s / grid.shorter}
        settings += f" at solver.rtol = {steps['rtol']:.1g} and solver.max_step_s = {steps['max_step_s']:.2g}"
    other = scene.with_values("tether", nodes=nodes, damping_critical=damping).with_values("solver", **steps)
    return other.model_copy(update={"output": Output(step_s=scene.output.step_s)}), settings


def _relative(scene, tension_N, largest_N):
    """Difference of two tensions over the second one; 0 where it is rounding."""
    tether, difference_N = scene.tether, abs(tension_N - largest_N)
    if difference_N <= ROUNDING * tether.density_kgpm3 * tether.area_m2 * tether.length_m * scene.gravity_mps2:
        return 0.0
    return difference_N / max(abs(largest_N), 1e-300)


def _columns_of_companion(run, scene, duration_s):
    """The columns of the same run of another scene, until duration_s; None where it ends early."""
    companion = type(run)(scene, duration_s, run.started)
    companion.finish(lambda simulated_s: None)
    if companion.state["status"] != OK:
        return None
    return columns_of(companion.output.samples[: companion.goal], scene)


def slack_samples(scene: Scene, columns: Columns, share: float = SLACK) -> np.ndarray:
    """Samples in which the top bears at most this share of its tension at rest; none where it bears none at rest."""
    rest_N = static_tension_N(scene, columns)
    if not rest_N > 0.0:  # NaN without an equilibrium
        rest_N = -math.inf
    return columns["tension_top_N"] <= share * rest_N


def _slack_fractions(scene, columns):
    """Slack fractions for THRESHOLDS."""
    return np.array([slack_samples(scene, columns, share).mean() for share in THRESHOLDS])


def compression_N(run: "Run", columns: Columns) -> float:
    """Largest compression along a line until its largest tension; 0 where it does not change that tension, because it
    is below PRESSED of it or because drag across the line calms the folds."""
    return 0.0 if run.record["cn"] > 0.0 else _pressed_N(columns)


def _pressed_N(columns):
    """Largest compression along a line until its largest tension; 0 where it is below PRESSED of that tension."""
    high_N = columns["tension_top_high_N"]
    peak = int(high_N.argmax())
    pressed_N = -float(columns["tension_min_N"][: peak + 1].min())
    return pressed_N if pressed_N > PRESSED * high_N[peak] else 0.0
