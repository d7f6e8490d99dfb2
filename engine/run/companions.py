"""Companions of a finished run: the same run on another grid or in other steps, and what they say of its tensions."""

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

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
# another run of the scene: times the elements, and by how much its tolerance is tighter and its longest step shorter
COARSE, FINE = (0.5, 10, 2), (2, 30, 4)
HINT, HINT_SLACK = 0.015, 0.02  # differences of largest tension and slack fraction in COARSE that call for FINE
NEAR, NEAR_SLACK = 0.05, 0.03  # differences in COARSE up to which FINE may refute a bound that was told
MUCH_COARSER, COARSER_SLACK = 0.08, 0.035  # differences in COARSE that are told where FINE is not run
FINER_DIFFERS, FINER_SLACK = 0.03, 0.04  # differences in FINE that are told
SHRINKS = 0.4  # of the difference in COARSE: errors shrink at least to this in FINE; where they do not, HINT is told
AROUND = 2  # samples before and after the largest tension, in which another run has it
EARLY_WAVES = 5  # of a buoy that are repeated
ROUNDING = 1e-3  # of the weight of the line: a smaller difference of tensions says nothing
SLACK = 0.05  # of the tension at rest: the line is slack


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
        f"the largest tension, {largest_N:.4g} N, holds to {error_N:.2g} N, because it is {other_N:.4g} N in steps "
        "twice as long: shorten solver.step_s"
    )


def other_grids(run: "Run", columns: Columns, told: bool, bounded: bool) -> tuple[str, bool]:
    """A sentence on another largest tension or slack fraction of another grid and tolerance, or nothing; and whether
    both other runs have the same ones, so that no bound which folds put on the largest tension needs telling.

    told: other sentences have said already that tensions are not exact; bounded: some of them say so only because the
    line folds. COARSE is run first. If it differs by a hint, or ends early, FINE is run and decides. FINE also is run

    - of a line without drag across it, because nothing calms its waves across, and COARSE may agree by luck (scene
      19/15 of benchmarks.random_scenes bears 944 N, 949 N in COARSE, 874 N in FINE). There a HINT in FINE is told,
      because errors shrink slowly (31/57: 23.1 N, 20.4 N in COARSE, 23.6 N in FINE, 24.9 N refined);
    - where a bound was told and COARSE is NEAR: if FINE is nearer still, the bound is too wide. (A bound that lost
      ringing puts is no such one, because all three runs may lose it.)

    COARSE alone speaks where other sentences have; where the slack fraction differs, which FINE may meet by luck; and
    of a line without drag across it that is pressed together, because its folds scatter (scene 8/27 bears 2307 to
    2833 N on ten grids and tolerances).

    Of a buoy in waves the first EARLY_WAVES are repeated, and only of its run from rest, because campaigns have
    thousands of others, whose motions they refine (docs/trust.md).
    """
    scene, duration_s = run.scene, run.duration_s
    if run.started is not None or scene.tether.nodes // 2 + 1 < LEAST_NODES:
        return "", False
    if scene.buoy is not None and scene.waves is not None:
        if scene.motion.dimensions == 2 and any(scene.start.buoy_velocity_mps):
            return "", False
        duration_s = min(duration_s, scene.waves.ramp_s + EARLY_WAVES * scene.waves.period_s)
        bounded = False  # of the whole run
    coarse = _differences(run, columns, duration_s, *COARSE)
    if coarse is None:
        coarse_share = math.inf
    else:
        coarse_share = coarse.share
        if coarse.within(HINT, HINT_SLACK) and coarse.share_then <= HINT and run.record["cn"] > 0.0 and not bounded:
            return "", False
        refuted = bounded and coarse.within(NEAR, NEAR_SLACK)
        if (told and not refuted) or coarse.of_slack > COARSER_SLACK:
            return coarse.words(MUCH_COARSER, COARSER_SLACK), False
        if compression_N(run, columns) and coarse_share > FINER_DIFFERS:
            return coarse.words(FINER_DIFFERS, FINER_SLACK), False
    if told and coarse is None:
        return "", False
    fine = _differences(run, columns, duration_s, *FINE)
    if fine is None:
        return "", False
    least = FINER_DIFFERS
    if fine.share > SHRINKS * coarse_share or run.record["cn"] == 0.0:
        least = HINT
    words = fine.words(least, FINER_SLACK)
    return words, coarse is not None and not words and fine.within(HINT, HINT_SLACK)


class _Differences(NamedTuple):
    """Largest tension and slack fraction of a run, and the same on another grid at another tolerance.

    share: difference of the tensions over the first one; share_then: that of the other run's tension when the run has
    its largest one, because two runs may have the same largest tension at two snaps. settings: of the other run, in
    words.
    """

    largest_N: float
    other_N: float
    share: float
    share_then: float
    slack: float
    other_slack: float
    settings: str

    @property
    def of_slack(self) -> float:
        """Difference of the slack fractions."""
        return abs(self.other_slack - self.slack)

    def within(self, share: float, of_slack: float) -> bool:
        """Whether neither tensions nor slack fractions differ by more."""
        return self.share <= share and self.of_slack <= of_slack

    def words(self, least: float, least_slack: float) -> str:
        """A sentence on the largest tension if its share is above the least, and on the slack fraction; or nothing."""
        parts = []
        if self.share > least:
            parts.append(f"the largest tension is {self.other_N:.4g} N in place of {self.largest_N:.4g} N")
        if self.of_slack > least_slack:
            parts.append(f"the line is slack for {self.other_slack:.2g} of the time in place of {self.slack:.2g}")
        if not parts:
            return ""
        return f"{self.settings} {' and '.join(parts)}, so that grid or tolerance decide: refine both"


def _differences(run, columns, duration_s, elements, tighter, shorter):
    """How the run differs, until duration_s, from one with so many times the elements, a tolerance so many times
    tighter and a longest step so many times shorter; None where that one ends early."""
    scene, tether, solver = run.scene, run.scene.tether, run.scene.solver
    damping = tether.damping_critical
    if damping is not None:
        damping *= elements  # a share of that of an element: so the damping of the line stays the same
    nodes, steps = math.ceil(elements * (tether.nodes - 1)) + 1, {}
    settings = f"on {nodes} nodes"
    if run.record["adaptive"]:
        steps = {"rtol": solver.rtol / tighter, "max_step_s": solver.max_step_s / shorter}
        settings += f" at solver.rtol = {steps['rtol']:.1g} and solver.max_step_s = {steps['max_step_s']:.2g}"
    if duration_s < run.duration_s:
        settings += f", in the first {duration_s:.4g} s,"
    other = scene.with_values("tether", nodes=nodes, damping_critical=damping).with_values("solver", **steps)
    other = other.model_copy(update={"output": Output(step_s=scene.output.step_s)})
    other_columns = _columns_of_companion(run, other, duration_s)
    if other_columns is None:
        return None
    count = len(other_columns["time_s"])
    pair = {name: series[:count] for name, series in columns.items()}, other_columns
    largest_N, other_N = (float(series["tension_top_high_N"].max()) for series in pair)
    slack, other_slack = (float(slack_samples(scene, series).mean()) for series in pair)
    peak = int(pair[0]["tension_top_high_N"].argmax())
    then = slice(max(peak - AROUND, 0), peak + AROUND + 1)
    then_N = float(pair[1]["tension_top_high_N"][then].max())
    shares = []
    for tension_N in (other_N, then_N):
        difference_N = abs(tension_N - largest_N)
        if difference_N <= ROUNDING * tether.density_kgpm3 * tether.area_m2 * tether.length_m * scene.gravity_mps2:
            difference_N = 0.0
        shares.append(difference_N / max(abs(largest_N), 1e-300))
    return _Differences(largest_N, other_N, *shares, slack, other_slack, settings)


def _columns_of_companion(run, scene, duration_s):
    """The columns of the same run of another scene, until duration_s; None where it ends early."""
    companion = type(run)(scene, duration_s, run.started)
    companion.finish(lambda simulated_s: None)
    if companion.state["status"] != OK:
        return None
    return columns_of(companion.output.samples[: companion.goal], scene)


def slack_samples(scene: Scene, columns: Columns) -> np.ndarray:
    """Samples in which the top bears at most SLACK of its tension at rest; none where it bears none at rest."""
    rest_N = static_tension_N(scene, columns)
    if not rest_N > 0.0:  # NaN without an equilibrium
        rest_N = -math.inf
    return columns["tension_top_N"] <= SLACK * rest_N


def compression_N(run: "Run", columns: Columns) -> float:
    """Largest compression along a line until its largest tension; 0 where it does not change that tension, because it
    is below PRESSED of it or because drag across the line calms the folds."""
    high_N = columns["tension_top_high_N"]
    peak = int(high_N.argmax())
    pressed_N = -float(columns["tension_min_N"][: peak + 1].min())
    if run.record["cn"] > 0.0 or pressed_N <= PRESSED * high_N[peak]:
        return 0.0
    return pressed_N
