"""One time step of the engine as a map of its state, for those who look at the step itself and not at a run.

    map: (C, K) -> (C', K'),  C the conserved variables (q, V) of every node, K their rates

The step is the one that a run makes (`engine.march`), at the fixed step of the scene. Everything else of a state
(forces, curvatures) follows from C within the step, to Newton's tolerance.
"""

import importlib

import numpy as np

from .guards import OK
from .march import march
from .spatial import lift
from .statics import planar_stretch_vectors


class OneStep:
    """The step of a scene about a state of rest: at first its static equilibrium.

    scene : fixed steps (solver.step_s). Raises ValueError where it has no equilibrium.
    C, K (n, conserved) : the state and its rates, zero.
    """

    def __init__(self, scene):
        driver = importlib.import_module("engine.simulate")
        run = driver._Batch([scene], [scene.sample_step_s()])
        if run.states[0]["status"] != OK:
            raise ValueError("the scene has no static equilibrium about which to step")
        self.run, self.record, self.tables, self.Y = run, run.records[0], run.tables, run.Y[0].copy()
        s = max(int(self.record["stages"]), 2)
        self.trail = np.zeros((1, 3)), np.zeros((1, s, *run.Y[0].shape)), np.zeros((1, s, *run.C[0].shape))
        self._rest()

    def rest_at(self, strain):
        """Take the straight line of another uniform strain, compressed or taut: it rests between its ends as well."""
        self.Y[:, 0] = strain
        self._rest()

    def _rest(self):
        half = self.run.C.shape[2] // 2
        vectors = lift.stretch_vectors if half == 3 else planar_stretch_vectors
        self.C = np.hstack([vectors(self.Y), np.zeros((len(self.Y), half))])
        self.K = np.zeros_like(self.C)

    def __call__(self, C, K):
        """(C', K') one step later; ValueError where the step fails."""
        run = self.run
        state = np.zeros_like(run.states)
        state["steps"], state["samples"] = 1, 1  # not the first step: C is taken as it is
        state["dt"] = self.record["fixed_step"]
        Y, Y_before, C, K = self.Y.copy(), self.Y.copy(), np.array(C), np.array(K)
        samples = np.zeros((2, run.samples.shape[2]))
        march(
            self.record, self.tables, state[0], Y, Y_before, C, K, samples, run.profiles[0], *self.trail,
            int(np.iinfo(np.int64).max),
        )  # fmt: skip
        if state[0]["status"] != OK or state[0]["failures"]:
            raise ValueError(f"the step of {self.record['fixed_step']:g} s about this state fails")
        return C, K
