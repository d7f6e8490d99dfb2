"""Where a run is after its last step: what the next one goes on from, to the last bit.

The last step of a run ends at or past its last sample. The state is that at the end of the step, and what lies between
the two, samples, profiles and growth of a period that has not ended, is kept with it for the run that goes on. What
another scene makes of a state is in `engine.run.start`.
"""

import hashlib
from dataclasses import dataclass, fields, replace

import numpy as np

from ..record import RELEASES, SAMPLE_WIDTH, SMALL_STEPS, STATE, TIME, WIDTHS
from ..scene.models import Scene
from .netcdf import NamedArrays

PREFIX = "final_"
NONE = np.empty(0)
# fields of STATE: of one part
COUNTED = ("first", "samples", "first_profile", "profiles", "max_turn", "min_strain", "ringing", "folded")


@dataclass(frozen=True, eq=False)
class FinalState:
    """State of the kernels; n nodes, k perturbations in the plane.

    scene                    of the run
    numbers (f,)             fields of STATE, in its order
    Y, Y_before              unknowns (n, 6 or 13) of the accepted state and of the one before
    C, K                     its conserved variables and their rates (n, 4 or 6)
    samples (m, 14)          rows of the output from the last sample of the run on
    profiles (m', n, 6)      the same of the profiles
    vectors (2, k, n, 4)     perturbations and their rates
    lateral (2, n, 2)        the perturbation across the plane and its rates
    growth (p, k + 2)        nats of the periods that have not ended: of the k, and across; loop released
    """

    scene: Scene
    numbers: np.ndarray
    Y: np.ndarray
    Y_before: np.ndarray
    C: np.ndarray
    K: np.ndarray
    samples: np.ndarray
    profiles: np.ndarray
    vectors: np.ndarray
    lateral: np.ndarray
    growth: np.ndarray

    @property
    def time_s(self) -> float:
        """Time of the last sample of the run: the first of the one that goes on."""
        return float(self.samples[0, TIME] if len(self.samples) else self.state()["t"])

    def state(self) -> np.void:
        """The numbers as a STATE."""
        return np.array([tuple(self.numbers)], STATE)[0]

    def with_numbers(self, **changes: float) -> "FinalState":
        """The state with other values of some fields of STATE."""
        numbers = dict(zip(STATE.names, self.numbers, strict=True)) | changes
        return replace(self, numbers=np.array([*numbers.values()]))

    def restarted(self) -> "FinalState":
        """The state as after a sudden change: it goes on by small steps that need no rates and no state before."""
        shortest = min(float(self.state()["dt"]), 1e-3 * self.scene.solver.max_step_s)
        return self.with_numbers(small_steps=SMALL_STEPS, turned=0, dt_before=0.0, dt=shortest)

    def at_zero(self, with_samples: bool = True) -> "FinalState":
        """The same state with its clock at 0, where its last sample is: for a run with a clock of its own.

        with_samples: False: the clock is at 0 at the end of the last step, and the sample there belongs to the next
        run. Waves, ramps and whatever else a scene prescribes in time begin anew; the phase of regular waves stays
        where `time_s` is a whole number of their periods. Loops are counted from 0. Perturbations stay, their growth
        in the period that has not ended is dropped. Goes on by small steps.
        """
        state, samples, profiles = self.state(), NONE, NONE
        if with_samples:
            begin_s, samples = self.time_s, self.samples.copy()
            samples[:, TIME] = np.arange(len(samples)) * self.scene.sample_step_s()
            samples[:, RELEASES] -= self.samples[0, RELEASES]
            numbers = {"releases": state["releases"] - self.samples[0, RELEASES]}
            first_profile = state["first_profile"] + state["profiles"] - len(self.profiles)
            first_profile_s = first_profile * self.scene.profile_step_s()
            if abs(first_profile_s - begin_s) < 1e-9 * self.scene.sample_step_s():
                profiles = self.profiles
        else:
            begin_s = float(state["t"])
            numbers = {"releases": 0, "low": np.inf, "high": -np.inf, "foot": -np.inf}
        for name in ("t", "window_end", "corner"):
            numbers[name] = state[name] - begin_s
        counts = {"samples": len(samples), "profiles": len(profiles), "first": 0, "first_profile": 0}
        moved = self.with_numbers(**numbers, **counts)
        return replace(moved, samples=samples, profiles=profiles, growth=np.zeros_like(self.growth)).restarted()

    def digest(self) -> str:
        """SHA-256 (hex) of its content, its scene included: equal states, equal digests, on any machine.

        In however many parts a run came there, its digest is one: COUNTED of each part are left out.
        """
        content = hashlib.sha256(self.scene.key().encode())
        for name, values in self.with_numbers(**dict.fromkeys(COUNTED, 0.0))._arrays():
            content.update(f"{name}{values.shape}".encode())
            content.update(np.ascontiguousarray(values, dtype="<f8").tobytes())
        return content.hexdigest()

    def fault(self) -> str:
        """Why no run can go on from it, as the end of a sentence; empty where one can."""
        nodes = self.scene.tether.nodes
        unknowns, conserved = ((nodes, width) for width in WIDTHS[self.scene.motion.dimensions])
        rows = max(self.samples.shape[0], 1) if self.samples.ndim else 1
        shapes = {"numbers": (len(STATE.names),), "samples": (rows, SAMPLE_WIDTH), "Y": unknowns, "Y_before": unknowns}
        for name, shape in (shapes | {"C": conserved, "K": conserved}).items():
            values = getattr(self, name)
            if values.shape != shape:
                return f"a state with {name} of shape {values.shape} and not {shape}: of another version of the engine"
            if np.isnan(values).any() or (name != "numbers" and not np.isfinite(values).all()):
                return f"a state with a value that is not a finite number, among its {name}"
        return ""

    def variables(self) -> list[tuple]:
        """The variables of a file (`engine.trajectory.netcdf`); what is empty is left out."""
        variables = []
        for field, values in self._arrays():
            name = PREFIX + field
            dimensions = tuple(f"{name}_{axis}" for axis in range(values.ndim))
            variables.append((name, dimensions, values, "1", "state after the last step, see engine.FinalState"))
        return variables

    def _arrays(self) -> list[tuple[str, np.ndarray]]:
        """Name and values of what is not empty."""
        arrays = ((field.name, getattr(self, field.name)) for field in fields(self)[1:])
        return [(name, values) for name, values in arrays if values.size]


def state_of_file(scene: Scene, arrays: NamedArrays) -> FinalState | None:
    """The state among the arrays of a file of that scene, or None."""
    if PREFIX + "Y" not in arrays:
        return None
    return FinalState(scene, *(arrays.get(PREFIX + field.name, NONE) for field in fields(FinalState)[1:]))
