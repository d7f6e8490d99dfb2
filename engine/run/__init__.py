"""One run: its numbers from the static start to the trajectory; `time.time_loop` or `simd` advances it."""

import math
import time

import numpy as np

from .. import parameters
from .. import record as col
from ..arrays import Motion, Output
from ..parameters.limits import longest_step
from ..parameters.scales import TRANSIT_STEPS, jumps_of, wave_beyond
from ..perturbations.exponents import Followed
from ..physics.strains import tension_at
from ..planar import state as planar
from ..planar.columns import EPS, PHI
from ..scene.models import Scene
from ..spatial import lift
from ..spatial import state as spatial
from ..time import energy
from ..time.folds import FOLD, words_of_folds
from ..time.held_start import held_away, why_not_held
from ..time.ringing import HEARD
from ..time.statics import rest_of, why_no_rest
from ..time.status import ADVICE, OK, OUT_AT_REST, STATICS_FAILED, TURN_UNRESOLVED, WAVES_ON_ELEMENT, WORDS
from ..time.time_loop import march
from ..trajectory import COLUMNS, EnergyBudget, Profiles, Trajectory
from ..trajectory.excursions import message_of
from ..trajectory.final_state import FinalState
from ..trajectory.parts import along_waves, heading_of
from . import trust
from .going_on import taken_over
from .trust import NOTED


class Run:
    """Arrays of one run of a scene over `duration_s`, from rest or from the FinalState of another.

    record, tables: its parameters; state: STATE; motion, output: Motion and Output (`engine.arrays`); trail: what
    follows its perturbations; s: unstretched arc length (m) of the nodes; goal: samples to store; wall_s: time (s) that
    advancing it has taken; began: what was changed for it of the run before, in words.
    """

    def __init__(self, scene: Scene, duration_s: float, start: FinalState | None = None) -> None:
        self.scene, self.duration_s, self.began = scene, duration_s, ""
        if start is not None:
            start, self.began = taken_over(start, scene)
        self.started = start
        self.kind = spatial if scene.motion.dimensions == 3 else planar
        tables = []
        self.record = parameters.record_of(scene, tables)[0]
        self.tables = np.concatenate(tables)
        n = int(self.record["nodes"])
        self.goal, self.profiled = (sample_count(duration_s, self.record[f"{kept}_step"]) for kept in KEPT)
        unknowns, conserved = self.kind.size_of.py_func(None)
        longest = 1.1 * longest_step(scene)[1]  # the last step reaches past the last sample: what it passes is kept too
        rows, profiles = (
            count + math.ceil(longest / self.record[f"{kept}_step"]) if count else 0
            for kept, count in zip(KEPT, (self.goal, self.profiled), strict=True)
        )
        self.output = Output(
            np.zeros((rows, col.SAMPLE_WIDTH)),
            np.zeros((profiles, n, col.PROFILE_WIDTH)),
            np.zeros((self.goal if scene.output.energy else 0, energy.WIDTH)),
            np.zeros(energy.WIDTH - energy.SUMS),
        )
        self.state = np.zeros(1, col.STATE)[0]
        self.trail = Followed(scene, self.record, self.tables, duration_s, start)
        self.s = np.concatenate([[0.0], np.cumsum(col.lengths_of(self.record, self.tables))])
        Y = np.zeros((n, unknowns))
        self.motion = Motion(Y, Y.copy(), np.zeros((n, conserved)), np.zeros((n, conserved)))
        self._start() if start is None else self._go_on(start)
        alphas = tuple(float(self.record[name]) for name in ("alpha_m", "alpha_f", "gamma"))
        self.parts = (  # the arguments of `march` that only some scenes need, else None
            alphas if self.record["method"] == col.ONE_STAGE else None,
            np.empty(n) if self.record["viscous"] else None,
            (self.output.energies, self.output.sums) if scene.output.energy else None,
        )
        self.wall_s = 0.0

    def _start(self) -> None:
        """Begin at t = 0: at rest, with the velocities of the scene."""
        record, state, scene, Y = self.record, self.state, self.scene, self.motion.Y
        target = scene.end.position_m if record["end"] == col.HELD else (0.0, 0.0, 0.0)
        axes = "xyz" if self.kind is spatial else "xz"
        place = np.array([target["xyz".index(axis)] for axis in axes])
        state["status"], Y[:] = rest_of(record, scene, self.tables, place)
        self.why_no_rest = why_no_rest
        if state["status"] == OK and any(scene.start.buoy_displacement_m):
            state["status"], Y[:] = held_away(scene, Y, self.s)
            self.why_no_rest = why_not_held
        for i, axis in enumerate(axes):
            Y[:, len(axes) + i] = record[f"start_{axis}"] * self.s / self.s[-1]
        self.motion.Y_before[:] = Y
        state["low"], state["high"] = np.inf, -np.inf
        self._watch()
        self.turn_at_rest = float(state["max_turn"])
        self.top_at_rest_N = tension_at(float(Y[-1, EPS]), scene.tether.tension)
        if state["status"] == OK and record["bent"] and state["max_turn"] > math.pi:
            state["status"] = TURN_UNRESOLVED
        # a sudden start has rates at t = 0 that are not zero: steps that need none come first, or the order falls to 1
        needs_rates = record["method"] == col.RUNGE_KUTTA or record["alpha_m"] != record["gamma"]
        blow = any(spread_s == 0.0 for _, _, spread_s in jumps_of(scene.end))
        starter = (needs_rates or blow) and not record["at_rest"]
        state["small_steps"] = col.SMALL_STEPS if starter else 0
        first_s = min(1e-3 * scene.solver.max_step_s, record["max_step"])
        if blow:  # in far shorter steps than a wave takes through an element its force would be that of the steps
            first_s = max(first_s, record["release_step"] * TRANSIT_STEPS / (4 * (record["nodes"] - 1)))
        state["dt"] = first_s if record["adaptive"] or starter else record["fixed_step"]

    def _watch(self) -> None:
        """Least strain and largest turn so far, those of the first state; no ringing was missed yet."""
        Y, state, record = self.motion.Y, self.state, self.record
        state["min_strain"] = Y[:, EPS].min()
        undamped = record["method"] == col.ONE_STAGE and record["gamma"] == 0.5  # rates alternate, and say nothing
        state["ringing"] = -1.0 if undamped else 0.0
        state["max_turn"] = lift.turns(Y).max() if self.kind is spatial else np.abs(np.diff(Y[:, PHI])).max()
        state["folded"] = state["t"] if state["max_turn"] > FOLD else np.inf

    def _go_on(self, start: FinalState) -> None:
        """Begin where another run ended."""
        state, record = self.state, self.record
        for part, given in zip(self.motion, (start.Y, start.Y_before, start.C, start.K), strict=True):
            part[:] = given
        for name, number in zip(col.STATE.names, start.numbers, strict=True):
            state[name] = number
        self._watch()
        for kept, stored, of in (("samples", start.samples, "first"), ("profiles", start.profiles, "first_profile")):
            state[of] += state[kept] - len(stored)
            state[kept] = rows = min(len(stored), len(getattr(self.output, kept)))
            if rows:
                getattr(self.output, kept)[:rows] = stored[:rows]
        if record["profile_step"] and not start.profiles.size:  # no profile was kept before
            state["first_profile"] = math.ceil(state["t"] / record["profile_step"])
            end_s = start.time_s + (self.goal - 1) * record["output_step"]
            self.profiled = max(sample_count(end_s, record["profile_step"]) - int(state["first_profile"]), 0)
        if not record["adaptive"]:
            state["dt"] = record["fixed_step"]

    def final_state(self) -> FinalState | None:
        """What a run goes on from; None for one that has not reached its goal, or keeps energies."""
        state = self.state
        if state["status"] != OK or state["samples"] < self.goal or self.scene.output.energy:
            return None
        if (state["first"] + state["samples"]) * self.record["output_step"] <= state["t"]:
            return None  # a step longer than any that was foreseen: what it passed is not known
        samples = self.output.samples[self.goal - 1 : int(state["samples"])]
        profiles = self.output.profiles[max(self.profiled - 1, 0) : int(state["profiles"])]
        numbers = np.array([state[name] for name in col.STATE.names], dtype=float)
        kept = (part.copy() for part in (*self.motion, samples, profiles))
        return FinalState(self.scene, numbers, *kept, *self.trail.state(state))

    def done(self) -> bool:
        """Has it ended, at its goal or before?"""
        return bool(self.state["status"] != OK or self.state["samples"] >= self.goal)

    def fraction(self) -> float:
        """Share of the run that is done."""
        return 1.0 if self.done() else float(self.state["samples"]) / self.goal

    def compile(self) -> None:
        """Compile what `advance` needs, or load it compiled, outside `wall_s`: no step is made."""
        self.advance(-self.goal)
        self.wall_s = 0.0

    def advance(self, chunk: int) -> None:
        """March until `chunk` more samples are stored, or the run ends."""
        began = time.perf_counter()
        until = min(self.goal, self.state["samples"] + chunk)
        while True:
            arrays = self.motion, self.output, self.trail.steps
            march(self.record, self.tables, self.state, *arrays, until, *self.parts)
            self.trail.follow(self.record, self.tables, self.state)
            if self.state["status"] != OK or self.state["samples"] >= until:
                break
        self.wall_s += time.perf_counter() - began

    def trajectory(self) -> Trajectory:
        """The record of the run, up to where it is."""
        state, scene = self.state, self.scene
        status = int(state["status"])
        message = ADVICE[status].format(
            t=state["t"], dt=state["dt"], turn=state["max_turn"], releases=state["releases"]
        )
        if status == STATICS_FAILED:
            message += self.why_no_rest(self.record, scene)
        columns = columns_of(self.output.samples[: min(int(state["samples"]), self.goal)], heading_of(scene))
        if status == OK:
            doubts = [
                self._coarse_at_rest(),
                self._steps_too_long(columns),
                trust.blows(self.record, scene, columns),
                trust.unresolved(self.record, self.tables, scene, columns),
                self._waves_on_element(),
                self._out_at_rest(),
            ]
            if self.record["end"] == col.HELD:
                doubts.append(words_of_folds(scene, state, columns))
            message = "; ".join(filter(None, doubts))
        message = message_of(message, scene, columns, WORDS[status])
        statistics, profiles, tangent = statistics_of(state, self.wall_s), self._profiles(), self.trail.growth(state)
        if state["ringing"] >= 0.0:  # listened to: not by undamped methods
            statistics["unresolved_ringing_N"] = float(columns["unresolved_N"].max(initial=state["ringing"]))
        if self.started is not None:
            for name, number in statistics_of(self.started.state(), 0.0).items():
                statistics[name] -= number if name in COUNTED else 0
        more = profiles, tangent, self._budget(), self.final_state(), self.began
        return Trajectory(scene, WORDS[status], message, columns, statistics, *more)

    def _coarse_at_rest(self) -> str:
        """Says that a line which is bent at rest has another tension at the top on a finer grid, or nothing."""
        scene, nodes = self.scene, FINER * (self.scene.tether.nodes - 1) + 1
        if self.started is not None or self.turn_at_rest < BENT:
            return ""
        finer = Run(scene.model_copy(update={"tether": scene.tether.model_copy(update={"nodes": nodes})}), 1.0)
        given, better = self.top_at_rest_N, finer.top_at_rest_N
        if finer.state["status"] != OK or abs(given - better) <= NOTED * max(abs(given), abs(better)):
            return ""
        return f"at rest the top bears {given:.4g} N on this grid and {better:.4g} N on {nodes} nodes: add tether.nodes"

    def _steps_too_long(self, columns: dict[str, np.ndarray]) -> str:
        """Says what steps twice as long do to the largest tension, of one-stage methods in steps of one length."""
        scene, solver = self.scene, self.scene.solver
        if self.record["method"] != col.ONE_STAGE or solver.courant is not None:
            return ""
        twice = solver.model_copy(update={"step_s": 2 * float(self.record["fixed_step"])})
        longer = Run(scene.model_copy(update={"solver": twice}), self.duration_s, self.started)
        longer.advance(longer.goal)
        largest_N = float(columns["tension_top_high_N"].max())
        other_N = float(longer.output.samples[: longer.goal, col.TOP_HIGH].max())
        error_N = abs(other_N - largest_N) / (1 if solver.integrator == "backward-euler" else 3)  # 2^order - 1
        if longer.state["status"] != OK or error_N <= NOTED * abs(largest_N):
            return ""
        return (
            f"the largest tension, {largest_N:.4g} N, holds to {error_N:.2g} N, because it is {other_N:.4g} N in steps "
            "twice as long: shorten solver.step_s"
        )

    def _waves_on_element(self) -> str:
        """Says what the uppermost element takes for the force of waves that do not reach so far down, or nothing."""
        record = self.record
        length, top_m = float(col.lengths_of(record, self.tables)[-1]), self.output.samples[:1, col.AT_Z].sum()
        top_m += self.scene.anchor.position_m[2]
        force_N = wave_beyond(record, length, float(top_m))
        if force_N <= HEARD * tension_at(1.0 / record["per_strain"], self.scene.tether.tension):
            return ""
        return WAVES_ON_ELEMENT.format(length=length, depth=1.0 / record["k"], force=force_N)

    def _out_at_rest(self) -> str:
        """Says that a buoy without a cap began at rest more than half out of still water, or nothing."""
        record, scene = self.record, self.scene
        moved = self.started is not None or any(scene.start.buoy_displacement_m)
        if scene.buoy is None or not record["wet"] or record["spherical_cap"] or moved:
            return ""
        height_m = scene.anchor.position_m[2] + self.output.samples[0, col.AT_Z] - scene.water.depth_m
        return "" if height_m <= 0.0 else OUT_AT_REST.format(height=height_m)

    def _budget(self) -> EnergyBudget | None:
        if not self.scene.output.energy:
            return None
        found = self.output.energies[: int(self.state["energies"])].T.copy()
        total = found[energy.KINETIC : energy.END_WORK].sum(axis=0)
        found[energy.POWERS] -= total - total[:1]  # less the change of the energies: dissipated by the scheme in time
        return EnergyBudget(*found)

    def _profiles(self) -> Profiles | None:
        if self.scene.output.profiles is False:
            return None
        values = self.output.profiles[: min(int(self.state["profiles"]), self.profiled)]
        times = (int(self.state["first_profile"]) + np.arange(len(values))) * float(self.record["profile_step"])
        return Profiles(times, self.s, *(np.ascontiguousarray(values[:, :, i]) for i in range(col.PROFILE_WIDTH)))


class Idle(Run):
    """Arrays of a run that never begins, not even at rest."""

    def _start(self) -> None:
        self.state["status"] = OK


BENT = 0.5  # turn (rad) in an element at rest below which a finer grid has the same tension within 1 %
FINER = 4  # times the elements, of the line at rest with which a bent one is compared
KEPT = ("output", "profile")  # what is kept evenly in time, as in the names of RECORD
COUNTED = ("steps", "rejected_steps", "newton_iterations", "newton_failures", "loop_releases")
STATISTICS = {  # of a trajectory: the fields of STATE that they come from
    "steps": "steps", "rejected_steps": "rejected", "newton_iterations": "newton", "newton_failures": "failures",
    "loop_releases": "releases", "max_turn_rad": "max_turn", "min_strain": "min_strain", "end_time_s": "t",
}  # fmt: skip


def statistics_of(state: np.void, wall_s: float) -> dict[str, int | float]:
    """What a run has done, and how long (s) that has taken."""
    return {name: state[field].item() for name, field in STATISTICS.items()} | {"wall_s": wall_s}


def sample_count(duration_s: float, step_s: float) -> int:
    """Samples from t = 0 to the end, both included where the rounding of a step is all that is missing; 0 without."""
    return int(duration_s / step_s * (1 + 1e-12) + 1e-9) + 1 if step_s > 0 else 0


def columns_of(samples: np.ndarray, heading: float) -> dict[str, np.ndarray]:
    """Columns of the table, by `engine.trajectory.COLUMNS`, from samples (n, 14) with the columns of `engine.record`.

    The angle from the vertical is taken in the plane of waves that travel along `heading` (rad); `along` is the place,
    `rate` the velocity in the direction of these waves.
    """
    t, x, y, z, u, v, w = samples[:, : col.AT_W + 1].T
    r = np.sqrt(x**2 + y**2 + z**2) if y.any() else np.hypot(x, z)
    along, rate = along_waves(heading, x, y), along_waves(heading, u, v)
    with np.errstate(invalid="ignore", divide="ignore"):
        radius_rate = (x * u + y * v + z * w) / np.where(r > 0, r, np.nan)
        square = along**2 + z**2
        angle_rate = (z * rate - along * w) / np.where(square > 0, square, np.nan)
    angle = np.unwrap(np.arctan2(along, z))
    measured = col.OFFPLANE, col.TOP, col.LEAST, col.TOP_LOW, col.TOP_HIGH, col.RELEASES, col.LOWEST, col.MISSED
    others = (samples[:, at] for at in measured)
    found = t, x, y, z, r, radius_rate, angle, angle_rate, *others
    return {name: np.array(values) for name, values in zip(COLUMNS, found, strict=True)}
