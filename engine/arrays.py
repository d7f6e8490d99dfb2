"""The arrays that kernels hand to each other, as named tuples. n nodes; unknowns 6 or 13, conserved variables 4 or 6.

Columns are named in `engine.planar.columns`, `engine.spatial.columns` and, for what both have, `engine.record`.
"""

from typing import NamedTuple

import numpy as np


class Stage(NamedTuple):
    """Which equations Newton's method solves: those of one stage of a time step, or of statics.

    t (s): when the water is taken; in_motion: 1.0, or 0.0 in statics (a float: Numba would compile True and False
    apart); cq, cv (1/s): rates are q_t = cq (q - q~) and V_t = cv (V - V~), with C~ = (q~, V~) in `Work`.
    """

    t: float
    in_motion: float
    cq: float
    cv: float


class Work(NamedTuple):
    """Arrays of one Newton solve, n rows each.

    X: places (m); F: velocity and acceleration of the water; Q: nodal quantities; E: eliminated boxes;
    D: Newton's update of the unknowns; C_tilde: known part of the conserved variables (see `Stage`).
    """

    X: np.ndarray
    F: np.ndarray
    Q: np.ndarray
    E: np.ndarray
    D: np.ndarray
    C_tilde: np.ndarray


class Motion(NamedTuple):
    """An accepted state: unknowns Y (n, unknowns), those of the step before, conserved C (n, conserved), rates K."""

    Y: np.ndarray
    Y_before: np.ndarray
    C: np.ndarray
    K: np.ndarray


class Step(NamedTuple):
    """A step to try: from t (s) by dt (s), dt_before (s) after the state before (0: there is none); small: 1 for a step
    of backward Euler in the place of a Runge-Kutta method."""

    t: float
    dt: float
    dt_before: float
    small: bool


class Trial(NamedTuple):
    """What a trial step finds: Y (s, n, unknowns) and K (s, n, conserved) of its s stages, of which the last is the new
    state; C (n, conserved): conserved variables of that state."""

    Y: np.ndarray
    K: np.ndarray
    C: np.ndarray


class Output(NamedTuple):
    """What a run keeps: samples (m, 12), profiles (m', n, 6), energies (m'', 9) and their running sums (5,)."""

    samples: np.ndarray
    profiles: np.ndarray
    energies: np.ndarray
    sums: np.ndarray


class Trail(NamedTuple):
    """Accepted steps, for perturbations: T (l, 3), begin, length and kind; Y and K (l, s, n, .): stages and rates."""

    T: np.ndarray
    Y: np.ndarray
    K: np.ndarray
