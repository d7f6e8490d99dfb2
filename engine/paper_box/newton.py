"""Newton's method for one step of eq. (28), or for the equilibrium from which the steps start.

Full step; where the update exceeds one in the scales of the scene it is shortened to one. The water is renewed in each
iteration. The paper has fixed steps and nothing to fall back upon: a step that fails ends the run.
"""

import numpy as np

from ..guards import NEWTON_FAILED, NOT_FINITE, OK, STRAIN_BELOW_MINUS_ONE, TENSION_FLAT
from . import ends
from .box import Level, level_of, residual
from .law import tension_law
from .water import water_at

TOLERANCE = 1e-7  # of the scaled update: what is left does not decay in this rule, so it is left small


def solve(line, band, Y, t, old, most, tolerance=TOLERANCE, flat=0.0, force=None):
    """The unknowns at time t, from the guess Y (13, n).

    old: the level before, or None for an equilibrium under `force` (waves left out). flat: the slope f' (N) at and
    below which the division of row 1 has lost its meaning. Returns (code, iterations, Level or None).
    """
    Y = Y.copy()
    for iteration in range(1, most + 1):
        water = water_at(line, t, Y, waves=old is not None)
        with np.errstate(all="ignore"):  # an overflow is caught below, as what is not finite
            rows, blocks = residual(line, Y, water, t, old, force)
        if not all(np.isfinite(part).all() for part in (*rows, *blocks)):
            return NOT_FINITE, iteration, None
        update, size = band.update(rows, blocks, ends.force_per(line, t) if old is not None else line.record["per_force"])
        if update is None:
            return NEWTON_FAILED, iteration, None
        if not np.isfinite(size):
            return NOT_FINITE, iteration, None
        Y += update if size <= 1.0 else update / size
        if Y[0].min() <= -1.0:
            return STRAIN_BELOW_MINUS_ONE, iteration, None
        if tension_law(line.record, line.tables, Y[0])[1].min() <= flat:
            return TENSION_FLAT, iteration, None
        if size < tolerance:
            return OK, iteration, level_of(line, t, Y, waves=old is not None)
    return NEWTON_FAILED, most, None


__all__ = ["Level", "solve"]
