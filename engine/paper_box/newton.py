"""Newton's method for one step of eq. (28).

Full step; where the update exceeds one in the scales of the scene it is shortened to one. The water is renewed in each
iteration. The paper has fixed steps and nothing to fall back upon: a step that fails ends the run.
"""

import numpy as np

from ..time.status import NEWTON_FAILED, NOT_FINITE, OK, STRAIN_BELOW_MINUS_ONE, TENSION_FLAT
from . import ends
from .box import Band, Level, level_of, residual
from .law import tension_law
from .line import Line
from .water import water_at

TOLERANCE = 1e-7  # of the scaled update: what is left does not decay in this rule, so it is left small


def solve(
    line: Line, band: Band, t: float, old: Level, most: int, tolerance: float = TOLERANCE, flat: float = 0.0
) -> tuple[int, int, Level | None]:
    """The `Level` at time t that follows `old`.

    flat: the slope f' (N) at and below which the division of row 1 has lost its meaning.
    Returns (code, iterations, Level or None).
    """
    Y = old.Y.copy()
    end_per = ends.force_per(line, t)
    for iteration in range(1, most + 1):
        water = water_at(line, t, Y)
        code, found, size = newton_update(line, band, Y, water, t, old, end_per)
        if code != OK:
            return code, iteration, None
        Y += found if size <= 1.0 else found / size
        if Y[0].min() <= -1.0:
            return STRAIN_BELOW_MINUS_ONE, iteration, None
        if tension_law(line.record, line.tables, Y[0])[1].min() <= flat:
            return TENSION_FLAT, iteration, None
        if size < tolerance:
            return OK, iteration, level_of(line, t, Y)
    return NEWTON_FAILED, most, None


def newton_update(line, band, Y, water, t, old, end_per, force=None, forces=0):
    """(code, update, its size) of one iteration; the arguments are those of `box.residual` and `Band.update`."""
    with np.errstate(all="ignore"):  # an overflow is caught here, as what is not finite
        rows, blocks = residual(line, Y, water, t, old, force)
        if not all(np.isfinite(part).all() for part in (*rows, *blocks)):
            return NOT_FINITE, None, np.inf
        found, size = band.update(rows, blocks, end_per, forces)
    if found is None:
        return NEWTON_FAILED, None, np.inf
    return (OK if np.isfinite(size) else NOT_FINITE), found, size
