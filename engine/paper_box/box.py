"""Eq. (28): the box rule in space and time.

    o k      each box ties its nodes a = k - 1 and b = k at the times i - 1 and i; with nodal quantities
    |  h     g = [M(Y_i) + M(Y_i-1)] (Y_i - Y_i-1)/(2 dt) + [P(Y_i) + P(Y_i-1)]/2,
    o k - 1  (28) divided by 2 dt reads  (Y_b - Y_a)_i + (Y_b - Y_a)_i-1 + h (g_a + g_b) = 0.

As printed, M at a node multiplies the change at that node; only to second order is it (25) times (26). At rest the same
with g = P/2 and without the old values: it must hold before the first step, because the rule does not damp what the old
values leave (it returns with the opposite sign in every step).

The Jacobian is the complex step of g, node by node, exact to rounding; the water is held.

In the paper: eq. (28) the discrete equations.
"""

import numpy as np

from . import ends
from .line import Line
from .nodal import Level, P, times_M

TINY = 1e-40  # of the complex step, in the scale of each unknown


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
