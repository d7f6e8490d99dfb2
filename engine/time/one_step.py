"""One time step of the engine as a map of its state, for those who look at the step itself and not at a run.

    map: (C, K) -> (C', K'),  C the conserved variables (q, V) of every node, K their rates

The step is the one that a run makes (`time.time_loop`), at the fixed step of the scene. Everything else of a state
(forces, curvatures) follows from C within the step, to Newton's tolerance.
"""

import numpy as np

from ..planar.columns import EPS  # in space the same column
from ..run import Run
from ..spatial import lift
from .status import OK


class OneStep:
    """The step of a scene about a state of rest: its static equilibrium, or a straight line of uniform strain.

    scene : fixed steps (solver.step_s), and an output.step_s that is no longer: the run ends at the first sample.
    strain : None, or that of a straight line, compressed or taut: it rests between its ends as well.
    Raises ValueError where it has no equilibrium.
    C, K (n, conserved) : the state and its rates, zero.
    """

    def __init__(self, scene, strain=None):
        self.run = Run(scene, scene.solver.step_s)
        if self.run.state["status"] != OK:
            raise ValueError("the scene has no static equilibrium about which to step")
        self.step_s, self.Y = scene.solver.step_s, self.run.motion.Y.copy()
        self.begin = self.run.state.copy()
        # not the first step, for which C would be computed, nor the first sample, which is at the start
        self.begin["steps"], self.begin["samples"], self.begin["dt"] = 1, 1, self.step_s
        self.begin["small_steps"] = 0
        if strain is not None:
            self.Y[:, EPS] = strain
        q = lift.stretch_vectors(self.Y)
        self.C = np.hstack([q, np.zeros_like(q)])
        self.K = np.zeros_like(self.C)

    def __call__(self, C, K):
        """(C', K') one step later; ValueError where the step fails."""
        run = self.run
        run.state = self.begin.copy()
        for part, given in zip(run.motion, (self.Y, self.Y, C, K), strict=True):
            part[:] = given
        run.advance(1)
        state = run.state
        if state["status"] != OK or state["failures"] or state["steps"] != 2:
            raise ValueError(f"the step of {self.step_s:g} s about this state fails")
        return run.motion.C.copy(), run.motion.K.copy()
