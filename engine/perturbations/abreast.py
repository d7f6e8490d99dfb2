"""COUNT perturbations of one run, carried through its steps side by side, one in each lane of a vector.

They share the run, and so the matrix of every stage, which is eliminated once in plain numbers. What is carried is of
any length and stays so: the derivative of a map over these steps times COUNT vectors.
"""

from collections import namedtuple

import numpy as np

from ..compiled import kernel
from ..record import BEGIN, KIND, STEP
from ..simd.elementary import copy_into
from ..simd.vector import COUNT, as_lanes, lane_zeros
from ..time.steps import known_part, plan_stage
from .tangent import Base, linearise, tangent_arrays, tangent_stage, water_moves

# COUNT perturbations, COUNT the last axis: C, K (n, 4), conserved variables and rates; work: C_tilde, C_new (n, 4),
# rates Ks (s, n, 4) of the stages of a step, known (n, 3) as in `tangent_stage`
Abreast = namedtuple("Abreast", "C K C_tilde C_new Ks known")


@kernel
def _carry_abreast(p, tables, count, trail, in_lanes):
    """Carry what an Abreast holds through the first `count` steps of a Trail."""
    s, n = trail.Y.shape[1], trail.Y.shape[2]
    (work, water), moving_water = tangent_arrays(p, n), water_moves(p)
    a, w = np.empty(s), np.empty(3)
    perturbed = as_lanes(in_lanes)
    for step in range(count):
        t, dt, euler = trail.T[step, BEGIN], trail.T[step, STEP], trail.T[step, KIND] > 0.0
        copy_into(perturbed.Ks[0], perturbed.K)
        for i in range(s - 1 if euler else 1, s):
            rate, delay = plan_stage(p, tables, i, euler, dt, 0.0, a, w)  # 0.0 and w: of a first guess, not used
            base = Base(t + delay, rate, moving_water, trail.Y[step, i], trail.K[step, i])
            linearise(p, tables, base, work, water)
            known_part(a, 0 if euler else i, perturbed.C, perturbed.Ks, perturbed.C_tilde)
            stage = perturbed.C_tilde, perturbed.C_new, perturbed.Ks[i]
            tangent_stage(p, tables, base, *stage, work, water, perturbed.known)
        copy_into(perturbed.C, perturbed.C_new)
        copy_into(perturbed.K, perturbed.Ks[s - 1])


def carried_through(record, tables, trail, count: int, C: np.ndarray, K: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Perturbations C and their rates K (k, n, 4) after the first `count` steps of a Trail, (k, n, 4) each."""
    s, n = trail.Y.shape[1:3]
    arrays = Abreast(*(lane_zeros(n, 4) for _ in range(4)), lane_zeros(s, n, 4), lane_zeros(n, 3))
    C_end, K_end = np.empty_like(C), np.empty_like(K)
    for first in range(0, len(C), COUNT):
        group = slice(first, min(first + COUNT, len(C)))
        lanes = slice(0, group.stop - first)
        arrays.C[..., lanes] = np.moveaxis(C[group], 0, -1)
        arrays.K[..., lanes] = np.moveaxis(K[group], 0, -1)
        _carry_abreast(record, tables, count, trail, arrays)
        C_end[group] = np.moveaxis(arrays.C[..., lanes], -1, 0)
        K_end[group] = np.moveaxis(arrays.K[..., lanes], -1, 0)
    return C_end, K_end
