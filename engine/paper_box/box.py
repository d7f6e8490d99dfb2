"""Eq. (28): the box rule in space and time, and one Newton update of it.

    o k      each box ties its nodes a = k - 1 and b = k at the times i - 1 and i; with nodal quantities
    |  h     g = [M(Y_i) + M(Y_i-1)] (Y_i - Y_i-1)/(2 dt) + [P(Y_i) + P(Y_i-1)]/2,
    o k - 1  (28) divided by 2 dt reads  (Y_b - Y_a)_i + (Y_b - Y_a)_i-1 + h (g_a + g_b) = 0.

As printed, M at a node multiplies the change at that node; only to second order is it (25) times (26). At rest the same
with g = P/2 and without the old values: it must hold before the first step, because the rule does not damp what the old
values leave (it returns with the opposite sign in every step).

The Jacobian is the complex step of g, node by node, exact to rounding; the water is held. The unknowns of node k are
columns k m ... k m + m - 1 (m = 13, or 7 in a plane), the rows 7 (4) of the lower end, the boxes, 6 (3) of the upper
end: a band of 19 below and 18 above the diagonal, factored with partial pivoting.

In the paper: eq. (28) the discrete equations.
"""

from typing import NamedTuple

import numpy as np
from scipy.linalg import LinAlgError, solve_banded

from . import ends
from .line import ABOVE_PLANE, BELOW_PLANE, O2, O3, OMEGA, SPEEDS, Line
from .nodal import P, times_M
from .water import water_at

TINY = 1e-40  # of the complex step, in the scale of each unknown


class Level(NamedTuple):
    """One time level: t (s), Y (13, n), the water (6, n) and P (13, n) there."""

    t: float
    Y: np.ndarray
    water: np.ndarray
    P: np.ndarray


def level_of(line: Line, t: float, Y: np.ndarray, waves: bool = True) -> Level:
    """The time level of the unknowns Y (13, n)."""
    water = water_at(line, t, Y, waves)
    return Level(t, Y, water, P(line, Y, water))


def residual(
    line: Line, Y: np.ndarray, water: np.ndarray, t: float, old: Level | None, force: np.ndarray | None = None
) -> tuple[tuple, tuple]:
    """Residual rows and Jacobian blocks.

    old: the `Level` before, or None at rest with force (3,) on the end. Y (13, n), water (6, n) at time t.
    Returns (below (7,), boxes (13, n - 1), above (6,)), and the derivatives: (7, m), (13, m, n - 1) on the lower and on
    the upper node, (6, m); m active unknowns.
    """
    shifts = np.eye(13)[:, line.active] * (TINY / line.per)[:, None] * 1j
    sizes = (TINY / line.per)[line.active]
    moved = Y[:, None, :] + shifts[:, :, None]
    if old is None:
        g = 0.5 * P(line, moved, water)
        start, change = Y, Y[:, 1:] - Y[:, :-1]
        above = ends.upper_at_rest(line, force, moved[:, :, -1], water[:, -1:])
    else:
        dt = t - old.t
        start = old.Y
        step = moved - start[:, None, :]
        g = times_M(line, moved, step, water) + times_M(line, start[:, None, :], step, old.water)
        g = g / (2 * dt) + 0.5 * (P(line, moved, water) + old.P[:, None, :])
        change = Y[:, 1:] - Y[:, :-1] + start[:, 1:] - start[:, :-1]
        above = ends.upper(line, t, dt, moved[:, :, -1], start[:, -1:], water[:, -1:], old.water[:, -1:])
    below = ends.lower(moved[:, :, 0], start[:, :1])
    value, slope = g.real[:, 0, :], g.imag / sizes[:, None]
    boxes = change + line.h * (value[:, 1:] + value[:, :-1])
    unit = np.eye(13)[:, line.active][:, :, None]
    blocks = line.h * slope[:, :, :-1] - unit, line.h * slope[:, :, 1:] + unit
    rows = below.real[:, 0], boxes, above.real[:, 0]
    return rows, (below.imag / sizes, *blocks, above.imag / sizes)


class Band:
    """Where the entries of the blocks go in the banded matrix of one line."""

    def __init__(self, line):
        self.line = line
        n, m = len(line.h) + 1, len(line.active)
        self.below = list(range(7)) if line.spatial else BELOW_PLANE
        self.above = list(range(6)) if line.spatial else ABOVE_PLANE
        first = len(self.below)
        self.low, self.up = first + m - 1, 2 * m - 1 - first
        self.width = n * m
        row, column, k = np.meshgrid(np.arange(m), np.arange(m), np.arange(n - 1), indexing="ij")
        rows, columns = first + m * k + row, m * k + column
        self.lower_node = self._place(rows, columns)
        self.upper_node = self._place(rows, columns + m)
        row, column = np.meshgrid(np.arange(first), np.arange(m), indexing="ij")
        self.foot = self._place(row, column)
        row, column = np.meshgrid(np.arange(len(self.above)), np.arange(m), indexing="ij")
        self.top = self._place(row + first + m * (n - 1), column + m * (n - 1))
        # rows and columns in the scales of the unknowns: force rows against strains would mislead the pivoting
        self.per = np.tile(line.per[line.active], n)

    def _place(self, rows, columns):
        return (self.up + rows - columns, columns)

    def update(self, rows, blocks, end_per, forces=0):
        """Newton's update (13, n) in the units of Y, and its largest entry in the scales of the scene.

        end_per: inverse scale of the three balances above. forces: with it also the responses (forces, 13, n) of the
        unknowns to a unit of force (N) along each of the first axes, in a list after the update. None if singular.
        """
        line = self.line
        active, scale = line.active, line.per[line.active]
        matrix = np.zeros((self.low + self.up + 1, self.width))
        lower_per = np.array([*line.per[SPEEDS], 1.0, 1.0, *line.per[O2 : O3 + 1]])[self.below]
        upper_per = np.array([end_per] * 3 + [*line.per[OMEGA]])[self.above]
        matrix[self.foot] = blocks[0][self.below] * lower_per[:, None] / scale
        for place, block in ((self.lower_node, blocks[1]), (self.upper_node, blocks[2])):
            matrix[place] = block[active] * (scale[:, None] / scale)[:, :, None]
        matrix[self.top] = blocks[3][self.above] * upper_per[:, None] / scale
        right = np.zeros((self.width, 1 + forces))
        boxes = (rows[1][active] * scale[:, None]).T.ravel()
        right[:, 0] = -np.concatenate([rows[0][self.below] * lower_per, boxes, rows[2][self.above] * upper_per])
        for axis in range(forces):
            right[self.width - len(self.above) + axis, 1 + axis] = end_per
        try:
            scaled = solve_banded((self.low, self.up), matrix, right, overwrite_ab=True, check_finite=False)
        except LinAlgError:
            return None, np.inf
        found = np.zeros((1 + forces, 13, len(line.h) + 1))
        found[:, active] = (scaled / self.per[:, None]).T.reshape(1 + forces, -1, len(active)).transpose(0, 2, 1)
        return found[0] if not forces else found, np.abs(scaled[:, 0]).max()

    def size(self, update):
        """Largest entry of an update (13, n) in the scales of the scene."""
        return np.abs(update * self.line.per[:, None]).max()
