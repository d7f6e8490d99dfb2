"""Newton's method for one stage: every time integrator, and statics, in two and three dimensions, call this routine.

The size of an update is its largest entry in physical scales (strain, force, speed, angle, curvature); a larger one is
shortened to size one. Positions, and with them the water, are renewed in each iteration but left out of the Jacobian,
except at a waterline and on the bed (`engine.physics.submergence`, `engine.physics.bed`).
"""

import numpy as np

from ..compiled import kernel
from ..dimensions import add_update, eliminate, node_quantities, shape, tidy, update_size
from ..physics.bed import on_the_bed
from ..physics.water import water
from ..simd.select import where
from .status import NEWTON_FAILED, NOT_FINITE, OK, STRAIN_BELOW_MINUS_ONE

QUADRATIC = 2.0  # the update after one of size e is about 0.7 e^2 ... 1.5 e^2 (measured)
PATIENCE = 4  # iterations after which updates must halve; not in small steps and statics, where most > max_newton
GOING_ON = -1


@kernel
def newton(p, tables, stage, tolerance, max_iterations, Y, work):
    """Solve one stage for Y (n, unknowns), in place.

    p, tables: parameters (`engine.record`); stage: Stage; tolerance: of an update in the scales of the scene;
    max_iterations: those allowed; work: Work, whose C_tilde is given; on success its Q and X hold q and places of the
    final Y. Returns (code of `engine.time.status`, iterations).
    """
    best = np.inf
    tidy(p, Y)
    for iteration in range(max_iterations):
        sound, size, least = iterate(p, tables, stage, Y, work)
        code = judge(p, iteration, max_iterations, tolerance, sound, size, least, best)
        if code == OK:
            shape(p, tables, Y, work.Q, work.X)
        if code != GOING_ON:
            return code, iteration + 1
        best = min(best, size)
    return NEWTON_FAILED, max_iterations


@kernel
def assemble(p, tables, stage, Y, work):
    """One Newton update into work.D; returns False where a pivot block is singular. Arguments as for `newton`.

    The order is fixed: places, the water there, forces at the nodes, then elements and both ends in one elimination.
    """
    shape(p, tables, Y, work.Q, work.X)
    water(p, tables, stage.t, stage.in_motion, work.X, work.F, work.sea)
    node_quantities(p, tables, stage, Y, work)
    return eliminate(p, tables, stage, Y, work)


@kernel
def iterate(p, tables, stage, Y, work):
    """One iteration. Returns whether the matrix was regular, the size of the update, and the least strain after it."""
    sound = assemble(p, tables, stage, Y, work)
    size = update_size(p, work.D)
    factor = where(size <= 1.0, 1.0, 1.0 / size)
    least = add_update(p, factor, work.D, Y)
    return sound, on_the_bed(p, tables, stage, Y, work, factor, size), least


@kernel
def judge(p, iteration, max_iterations, tolerance, sound, size, least, best):
    """GOING_ON, OK or why a solve failed, after iteration 0, 1 ... with an update of this size; best: least before."""
    if not sound:
        return NEWTON_FAILED
    if not np.isfinite(size):
        return NOT_FINITE
    if least <= -1.0:
        return STRAIN_BELOW_MINUS_ONE
    if size < tolerance or QUADRATIC * size * size < tolerance:
        return OK
    if iteration >= PATIENCE and size > 0.5 * best and max_iterations <= p.max_newton:
        return NEWTON_FAILED
    return GOING_ON if iteration + 1 < max_iterations else NEWTON_FAILED
