"""One run: its arrays from the start to the trajectory; `march` advances it, or the lanes of `engine.run.batch`.

A run begins at rest (`rest`), with the velocities of its scene, or where another run ended (`start`).
"""

import math
import time
from collections.abc import Callable

import numpy as np

from .. import record as col
from ..arrays import Motion, Output
from ..parameters import numbers_of
from ..parameters.limits import MOST_SAMPLES, longest_step
from ..parameters.scales import TRANSIT_STEPS, jumps_of
from ..perturbations.exponents import Followed
from ..planar import state as planar
from ..planar.columns import EPS
from ..scene.models import Scene
from ..spatial import state as spatial
from ..time import energy
from ..time.folds import FOLD
from ..time.status import ADVICE, OK, WORDS
from ..time.time_loop import march
from ..trajectory import EnergyBudget, Profiles, Trajectory
from ..trajectory.columns import EXTREMES, Columns, columns_of, sample_count, statistics_of
from ..trajectory.excursions import named_end, with_excursions
from ..trajectory.final_state import FinalState
from .rest import Rest, largest_turn, rest_of
from .start import taken_over
from .trust import bent_at_clamp, doubts_of

CONTROLLED = "solver.rtol or solver.max_step_s"  # keys of steps that are controlled
CALL_S = 0.1  # length of a call of machine code; Ctrl-C has an effect only between two calls


class Run:
    """Arrays of one run of a scene over `duration_s`, from rest or from the FinalState of another.

    record, tables   its parameters
    state            STATE
    motion, output   Motion and Output (`engine.arrays`)
    parts            the arguments of `march` that only some scenes need, else None
    trail            what follows its perturbations
    s                unstretched arc length (m) of the nodes
    goal, profiled   samples and profiles to store
    started, began   the state that it goes on from, or None; what was changed for it, in words
    rest             the rest that it begins in, or None
    wall_s           time (s) that advancing it has taken
    """

    def __init__(self, scene: Scene, duration_s: float, start: FinalState | None = None) -> None:
        self.scene, self.duration_s = scene, duration_s
        self.started, self.began = taken_over(start, scene)
        self.record, self.tables = numbers_of(scene)
        self.s = col.arc_lengths(self.record, self.tables)
        self.kind = spatial if scene.motion.dimensions == 3 else planar
        n, (unknowns, conserved) = len(self.s), col.WIDTHS[scene.motion.dimensions]
        self.goal = sample_count(duration_s, self.record["output_step"])
        self.profiled = sample_count(duration_s, self.record["profile_step"])
        self.output = Output(
            np.zeros((self._rows(self.goal, "output_step"), col.SAMPLE_WIDTH)),
            np.zeros((self._rows(self.profiled, "profile_step"), n, col.PROFILE_WIDTH)),
            np.zeros((self.goal if scene.output.energy else 0, energy.WIDTH)),
            np.zeros(energy.WIDTH - energy.SUMS),
        )
        self.state = np.zeros(1, col.STATE)[0]
        self.trail = Followed(scene, self.record, self.tables, duration_s, self.started)
        Y, C = np.zeros((n, unknowns)), np.zeros((n, conserved))
        self.motion = Motion(Y, Y.copy(), C, C.copy())
        self.rest: Rest | None = None
        if self.started is None:
            self._begin_at_rest()
        else:
            self._go_on(self.started)
        self.parts = (
            True if self.record["method"] == col.ONE_STAGE else None,
            np.empty(n) if self.record["viscous"] else None,
            (self.output.energies, self.output.sums) if scene.output.energy else None,
        )
        self.wall_s = 0.0

    def _rows(self, count: int, step: str) -> int:
        """Rows for samples: the last time step reaches past the last sample, and what it passes is kept too."""
        if not count:
            return 0
        return count + math.ceil(1.1 * longest_step(self.scene)[1] / self.record[step])

    def _begin_at_rest(self) -> None:
        """Begin at t = 0: at rest, with the velocities of the scene."""
        record, state, Y = self.record, self.state, self.motion.Y
        self.rest = rest_of(self.scene)
        state["status"], Y[:] = self.rest.status, self.rest.Y
        axes = "xyz" if self.kind is spatial else "xz"
        for i, axis in enumerate(axes):
            Y[:, len(axes) + i] = record[f"start_{axis}"] * self.s / self.s[-1]
        self.motion.Y_before[:] = Y
        state["low"], state["high"], state["foot"] = np.inf, -np.inf, -np.inf
        self._watch()
        # a sudden start has rates at t = 0 that are not zero: steps that need none come first, or the order falls to 1
        needs_rates = record["method"] == col.RUNGE_KUTTA or record["alpha_m"] != record["gamma"]
        blow = any(spread_s == 0.0 for _, _, spread_s in jumps_of(self.scene.end))
        starter = (needs_rates or blow) and not record["at_rest"]
        state["small_steps"] = col.SMALL_STEPS if starter else 0
        first_s = min(1e-3 * self.scene.solver.max_step_s, record["max_step"])
        if blow:  # in far shorter steps than a wave takes through an element its force would be that of the steps
            first_s = max(first_s, record["release_step"] * TRANSIT_STEPS / (4 * (record["nodes"] - 1)))
        state["dt"] = first_s if record["adaptive"] or starter else record["fixed_step"]

    def _watch(self) -> None:
        """Least strain and largest turn so far, those of the first state; no ringing was missed yet."""
        Y, state, record = self.motion.Y, self.state, self.record
        state["min_strain"] = Y[:, EPS].min()
        undamped = record["method"] == col.ONE_STAGE and record["gamma"] == 0.5  # rates alternate, and say nothing
        state["ringing"] = -1.0 if undamped else 0.0
        state["max_turn"] = largest_turn(Y)
        state["folded"] = state["t"] if state["max_turn"] > FOLD else np.inf

    def _go_on(self, start: FinalState) -> None:
        """Begin where another run ended."""
        self.state, record = start.state(), self.record
        state = self.state
        for part, values in zip(self.motion, (start.Y, start.Y_before, start.C, start.K), strict=True):
            part[:] = values
        self._watch()
        for name, stored, first in (("samples", start.samples, "first"), ("profiles", start.profiles, "first_profile")):
            rows = getattr(self.output, name)
            count = min(len(stored), len(rows))
            state[first] += state[name] - len(stored)
            state[name] = count
            if count:
                rows[:count] = stored[:count]
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
        numbers = np.array(state.item(), dtype=float)
        arrays = [part.copy() for part in (*self.motion, samples, profiles)]
        return FinalState(self.scene, numbers, *arrays, *self.trail.state(state))

    def done(self) -> bool:
        """Has it ended, at its goal or before?"""
        return bool(self.state["status"] != OK or self.state["samples"] >= self.goal)

    def fraction(self) -> float:
        """Share of the run that is done."""
        return 1.0 if self.done() else float(self.state["samples"]) / self.goal

    def compile(self) -> None:
        """Compile what `advance` needs, or load it compiled, outside `wall_s`: no step is made."""
        wall_s = self.wall_s
        self.advance(-self.goal)
        self.wall_s = wall_s

    def finish(self, progress: Callable[[float], None]) -> None:
        """March to the end; progress: callable(seconds simulated), called now and then."""
        self.compile()
        chunk, earlier_s = 1, self.wall_s
        while not self.done():
            self.advance(chunk)
            call_s, earlier_s = self.wall_s - earlier_s, self.wall_s
            chunk = max(1, min(MOST_SAMPLES, int(chunk * min(2.0, CALL_S / max(call_s, 1e-9)))))
            progress(self.fraction() * self.duration_s)

    def advance(self, chunk: int) -> None:
        """March until `chunk` more samples are stored, or the run ends."""
        began_s = time.perf_counter()
        until = min(self.goal, self.state["samples"] + chunk)
        while True:
            arrays = self.motion, self.output, self.trail.steps
            march(self.record, self.tables, self.state, *arrays, until, *self.parts)
            self.trail.follow(self.record, self.tables, self.state)
            if self.state["status"] != OK or self.state["samples"] >= until:
                break
        self.wall_s += time.perf_counter() - began_s

    def trajectory(self) -> Trajectory:
        """The record of the run, up to where it is."""
        state, scene = self.state, self.scene
        status = int(state["status"])
        columns = columns_of(self.output.samples[: min(int(state["samples"]), self.goal)], scene)
        message = doubts_of(self, columns) if status == OK else self._reason()
        message, excursions = with_excursions(message, scene, columns, WORDS[status])
        word = named_end(WORDS[status], scene, columns)
        return Trajectory(
            scene,
            word,
            message,
            columns,
            self._statistics(columns),
            profiles=self._profiles(),
            tangent=self.trail.growth(state),
            energy=self._budget(),
            final_state=self.final_state(),
            began=self.began,
            excursions=excursions,
        )

    def _reason(self) -> str:
        """Why the run ended early."""
        steps = CONTROLLED if self.record["adaptive"] else longest_step(self.scene)[0]
        message = advice(self.state, steps)
        if self.rest is not None:
            message += self.rest.fault
        return "; ".join(filter(None, (message, bent_at_clamp(self))))

    def _statistics(self, columns: Columns) -> dict[str, int | float]:
        """What this run has done, without the runs that it went on from."""
        statistics = statistics_of(self.state, self.wall_s)
        if self.state["ringing"] >= 0.0:  # listened to: not by undamped methods
            statistics["unresolved_ringing_N"] = float(columns["unresolved_N"].max(initial=self.state["ringing"]))
        if self.started is not None:
            for name, earlier in statistics_of(self.started.state(), 0.0).items():
                if name not in EXTREMES:
                    statistics[name] -= earlier
        return statistics

    def _budget(self) -> EnergyBudget | None:
        if not self.scene.output.energy:
            return None
        rows = self.output.energies[: int(self.state["energies"])].T.copy()
        total = rows[energy.KINETIC : energy.END_WORK].sum(axis=0)
        rows[energy.POWERS] -= total - total[:1]  # less the change of the energies: dissipated by the scheme in time
        return EnergyBudget(*rows)

    def _profiles(self) -> Profiles | None:
        if self.scene.output.profiles is False:
            return None
        values = self.output.profiles[: min(int(self.state["profiles"]), self.profiled)]
        times = (int(self.state["first_profile"]) + np.arange(len(values))) * float(self.record["profile_step"])
        return Profiles(times, self.s, *(np.ascontiguousarray(values[:, :, i]) for i in range(col.PROFILE_WIDTH)))


class Idle(Run):
    """Arrays of a run that never begins, not even at rest."""

    def _begin_at_rest(self) -> None:
        self.state["status"] = OK


def advice(state: np.void, steps: str = CONTROLLED) -> str:
    """What the status of a STATE means, "event: what to do"; the reason of a failure of statics is still to come.

    steps: the keys that shorten the steps.
    """
    return ADVICE[int(state["status"])].format(
        t=state["t"], dt=state["dt"], steps=steps, turn=state["max_turn"], releases=state["releases"]
    )
