"""Where a run is after its last step: what the next one goes on from, to the last bit.

The last step of a run ends at or past its last sample. The state is that at the end of the step, and what lies between
the two, samples, profiles and growth of a period that has not ended, is kept with it for the run that goes on.
"""

import hashlib
import json
from dataclasses import dataclass, fields

import numpy as np

from .record import STATE

PREFIX = "final_"


def physics_of(scene) -> str:
    """Hash of all of a scene but its solver and its output: where it is the same, rates go on as they are."""
    text = json.dumps(scene.model_dump(mode="json", exclude={"solver", "output"}), sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()


@dataclass(frozen=True, eq=False)
class FinalState:
    """State of the kernels; n nodes, k perturbations in the plane.

    physics                  `physics_of` the scene
    numbers (f,)             fields of STATE, in its order
    Y, Y_before              unknowns (n, 6 or 13) of the accepted state and of the one before
    C, K                     its conserved variables and their rates (n, 4 or 6)
    samples (m, 13)          rows of the output from the last sample of the run on
    profiles (m', n, 6)      the same of the profiles
    vectors (2, k, n, 4)     perturbations and their rates
    lateral (2, n, 2)        the perturbation across the plane and its rates
    growth (p, k + 2)        nats of the periods that have not ended: of the k, and across; loop released
    """

    physics: str
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
        return float(self.samples[0, 0])

    def state(self) -> np.void:
        """The numbers as a STATE."""
        state = np.zeros(1, STATE)[0]
        for name, number in zip(STATE.names, self.numbers, strict=True):
            state[name] = number
        return state

    def variables(self) -> list[tuple]:
        """The variables of a file (`engine.netcdf`); what is empty is left out."""
        found = []
        for field in fields(self)[1:]:
            values = getattr(self, field.name)
            if values.size:
                name = PREFIX + field.name
                dimensions = tuple(f"{name}_{axis}" for axis in range(values.ndim))
                found.append((name, dimensions, values, "1", "state after the last step, see engine.final_state"))
        return found


def state_of_file(scene, arrays: dict[str, np.ndarray]) -> FinalState | None:
    """The state among the arrays of a file of that scene, or None."""
    if PREFIX + "Y" not in arrays:
        return None
    found = (arrays.get(PREFIX + field.name, np.empty(0)) for field in fields(FinalState)[1:])
    return FinalState(physics_of(scene), *found)
