"""One step of eq. (28), the box rule in space and time, by Newton's method.

    o k      each box ties its nodes a = k - 1 and b = k at the times i - 1 and i; with nodal quantities
    |  h     g = [M(Y_i) + M(Y_i-1)] (Y_i - Y_i-1)/(2 dt) + [P(Y_i) + P(Y_i-1)]/2,
    o k - 1  (28) divided by 2 dt reads  (Y_b - Y_a)_i + (Y_b - Y_a)_i-1 + h (g_a + g_b) = 0.

As printed, M at a node multiplies the change at that node; only to second order is it (25) times (26). At rest the same
with g = P/2 and without the old values: it must hold before the first step, because the rule does not damp what the old
values leave (it returns with the opposite sign in every step).

The Jacobian is the complex step of g, node by node, exact to rounding; the water is held.

Full step; where the update exceeds one in the scales of the scene it is shortened to one. The water is renewed in each
iteration. The paper has fixed steps and nothing to fall back upon: a step that fails ends the run.

The unknowns of node k are columns k m ... k m + m - 1 (m = 13, or 7 in a plane), the rows 7 (4) of the lower end, the
boxes, 6 (3) of the upper end: a band of 19 below and 18 above the diagonal, factored with partial pivoting. The columns
of a node meet 2 m rows: m of the box below it (or the lower end), m of the box above it (or the upper end).

In the paper: eq. (28) the discrete equations.
"""

import numpy as np
from scipy.linalg import LinAlgError, solve_banded

from ..time.status import NEWTON_FAILED, NOT_FINITE, OK, STRAIN_BELOW_MINUS_ONE, TENSION_FLAT
from . import ends
from .line import ABOVE, BELOW, EPS, OMEGA, Line
from .nodal import Level, P, level_of, times_M, water_at

TOLERANCE = 1e-7  # of the scaled update: what is left does not decay in this rule, so it is left small
TINY = 1e-40  # of the complex step, in the scale of each unknown


def solve(
    line: Line, t: float, old: Level, max_iterations: int, tolerance: float = TOLERANCE, flat: float = 0.0
) -> tuple[int, int, Level | None]:
    """The `Level` at time t that follows `old`.

    flat: the slope f' (N) at and below which the division of row 1 has lost its meaning.
    Returns (code, iterations, Level or None).
    """
    Y = old.Y.copy()
    for iteration in range(1, max_iterations + 1):
        code, updates, size = newton_update(line, Y, water_at(line, t, Y), t, old)
        if code != OK:
            return code, iteration, None
        Y += updates[0] if size <= 1.0 else updates[0] / size
        if Y[EPS].min() <= -1.0:
            return STRAIN_BELOW_MINUS_ONE, iteration, None
        if line.tension(Y[EPS])[1].min() <= flat:
            return TENSION_FLAT, iteration, None
        if size < tolerance:
            return OK, iteration, level_of(line, t, Y)
    return NEWTON_FAILED, max_iterations, None


def newton_update(
    line: Line, Y: np.ndarray, water: np.ndarray, t: float, old: Level | None, force: np.ndarray | None = None, axes=0
) -> tuple[int, np.ndarray | None, float]:
    """One iteration, arguments as of `residual`: (code, update, its largest entry in the scales of the scene).

    The update (1 + axes, 13, n) is in the units of Y; the responses of the unknowns to a unit of force (N) on the upper
    end along each of the first axes follow it.
    """
    with np.errstate(all="ignore"):  # an overflow is caught here, as what is not finite
        rows, blocks = residual(line, Y, water, t, old, force)
    if not all(np.isfinite(part).all() for part in (*rows, *blocks)):
        return NOT_FINITE, None, np.inf
    active = line.active
    below, above = ([row for row, unknown in enumerate(end) if unknown in active] for end in (BELOW, ABOVE))
    n, m, first, last = Y.shape[1], len(active), len(below), len(above)
    # rows and columns in the scales of the unknowns: force rows against strains would mislead the pivoting
    scale, lower_per = line.per[active], line.per[BELOW][below]
    end_per = line.record["per_speed" if old is not None and ends.is_kept(line, t) else "per_force"]
    upper_per = np.array([end_per] * 3 + [*line.per[OMEGA]])[above]
    met = np.zeros((2 * m, m, n))
    met[m - first : m, :, 0] = blocks[0][below] * lower_per[:, None] / scale
    met[m:, :, :-1], met[:m, :, 1:] = (part[active] * (scale[:, None] / scale)[:, :, None] for part in blocks[1:3])
    met[m : m + last, :, -1] = blocks[3][above] * upper_per[:, None] / scale
    band, (row, column) = np.zeros((3 * m - 1, n, m)), np.ogrid[: 2 * m, :m]
    band[m - 1 + row - column, :, column] = met
    right = np.zeros((n * m, 1 + axes))
    boxes = (rows[1][active] * scale[:, None]).T.ravel()
    right[:, 0] = -np.concatenate([rows[0][below] * lower_per, boxes, rows[2][above] * upper_per])
    right[range(-last, axes - last), range(1, 1 + axes)] = end_per
    try:
        shape = first + m - 1, last + m - 1
        scaled = solve_banded(shape, band.reshape(3 * m - 1, -1), right, overwrite_ab=True, check_finite=False)
    except LinAlgError:
        return NEWTON_FAILED, None, np.inf
    updates = np.zeros((1 + axes, 13, n))
    updates[:, active] = (scaled.T.reshape(-1, n, m) / scale).transpose(0, 2, 1)
    size = np.abs(scaled[:, 0]).max()
    return (OK if np.isfinite(size) else NOT_FINITE), updates, size


def residual(
    line: Line, Y: np.ndarray, water: np.ndarray, t: float, old: Level | None, force: np.ndarray | None = None
) -> tuple[tuple, tuple]:
    """Residual rows and Jacobian blocks.

    old: the `Level` before, or None at rest with force (3,) on the end. Y (13, n), water (6, n) at time t.
    Returns (below (7,), boxes (13, n - 1), above (6,)), and the derivatives: (7, m), (13, m, n - 1) on the lower and on
    the upper node, (6, m); m active unknowns.
    """
    unit = np.eye(13)[:, line.active]
    moved = Y[:, None, :] + (unit * (TINY / line.per)[:, None] * 1j)[:, :, None]
    sizes = (TINY / line.per)[line.active]
    change = Y[:, 1:] - Y[:, :-1]
    if old is None:
        start, g = Y, 0.5 * P(line, moved, water)
    else:
        start = old.Y
        step = moved - start[:, None, :]
        g = times_M(line, moved, step, water) + times_M(line, start[:, None, :], step, old.water)
        g = g / (2 * (t - old.t)) + 0.5 * (P(line, moved, water) + old.P[:, None, :])
        change = change + start[:, 1:] - start[:, :-1]
    below = ends.lower(moved[:, :, 0], start[:, :1])
    above = ends.upper(line, t, moved[:, :, -1], water[:, -1:], old, force)
    value, slope = g.real[:, 0, :], g.imag / sizes[:, None]
    boxes = change + line.h * (value[:, 1:] + value[:, :-1])
    blocks = line.h * slope[:, :, :-1] - unit[:, :, None], line.h * slope[:, :, 1:] + unit[:, :, None]
    rows = below.real[:, 0], boxes, above.real[:, 0]
    return rows, (below.imag / sizes, *blocks, above.imag / sizes)
