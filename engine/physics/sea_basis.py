"""A few waves of a sea in a plane, of which all its waves are combinations within the reach of the line.

Wave i contributes f_i(x, z) u_i to a sea, with u_i = e^(i(k_i x_0 + phase_i - omega_i t)) and x_0 the place of the
anchor. Within |x - x_0| <= reach and 0 <= z <= top hundreds of functions f_i are so alike that with real shares T

    f_i = sum over a few waves m of f_m T_mi,      sum over i of f_i u_i = sum over m of f_m (sum over i of T_mi u_i)

to some 1e-13. So 40 waves stand for the 320 of three hours, and for the 64 of half an hour (20 m of line, T_p 5 s).
"""

import math
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from ..scene.models import Scene
from .sea import AMPLITUDE, OMEGA, ROW, SPEED, K, groups_of

LEFT_OVER = 1e-14  # of the largest contribution: what no combination gives
WORTH = 0.75  # share of the waves: more are not few
EIGHT = 8  # waves are taken by eights, so that most seeds of a sea take as many and go in the same lanes
ON_SIDE = 10  # samples


class FewWaves(NamedTuple):
    """The few waves, and where they stand for all: the line reaches at most `wide` (m) from its anchor along x, and at
    most to the height `top` (m).

    groups: as `sea.groups_of` gives all waves. shares: T (few, waves). Both are empty where all waves count.
    """

    groups: np.ndarray
    shares: np.ndarray
    wide: float
    top: float


@lru_cache(maxsize=16)
def few_waves(scene: Scene) -> FewWaves:
    """The few waves of a scene in a plane: within a length of the line from its anchor, and up to a significant height
    above still water.

    Samples go up to twice this height, because Wheeler's stretching takes the field higher up than the line is.
    """
    groups, depth_m, wide = groups_of(scene), scene.water.depth_m, scene.tether.length_m
    height_m = 4.0 * math.sqrt(0.5 * np.sum(groups[:, AMPLITUDE] ** 2))
    rows = groups.transpose(0, 2, 1).reshape(-1, ROW)
    most, chosen = int(WORTH * len(rows)), []
    fewest = 2.0 / math.pi * np.ptp(rows[:, K]) * wide  # of a band of wave numbers within this reach
    if height_m > 0.0 and fewest <= most:
        chosen, shares = combinations(contributions(rows, depth_m, wide, 2.0 * height_m), most)
    if not len(chosen):
        return FewWaves(groups[:0], np.empty((0, len(rows))), wide, 0.0)
    few = rows[chosen].reshape(-1, groups.shape[2], ROW).transpose(0, 2, 1)
    return FewWaves(few, shares, wide, depth_m + height_m)


def contributions(rows: np.ndarray, depth_m: float, reach_m: float, above_m: float) -> np.ndarray:
    """Samples of what every wave contributes to velocity, its rate and the surface: (samples, waves), at most 1.

    They lie on the upper edge of the region of x - i z and on its sides, because an analytic function is largest on the
    edge, down to where waves that decay upwards are taken (`engine.physics.sea_series`).
    """
    k = rows[:, K]
    points = math.ceil(k.max() * reach_m) + 2 * ON_SIDE
    upper = reach_m * np.cos(np.linspace(0.0, math.pi, points)) - 1j * above_m
    down = (above_m + 2.0 * depth_m) * np.linspace(0.0, 1.0, ON_SIDE) ** 2 - above_m
    places = np.concatenate([upper, reach_m + 1j * down, -reach_m + 1j * down])
    field = np.exp(1j * np.outer(places, k))
    samples = []
    for size in (rows[:, SPEED], rows[:, SPEED] * rows[:, OMEGA], rows[:, AMPLITUDE]):
        of_waves = field * size
        samples.append(of_waves / np.abs(of_waves).max())
    together = np.concatenate(samples)
    return np.concatenate([together.real, together.imag])


def combinations(samples: np.ndarray, most: int) -> tuple[np.ndarray, np.ndarray]:
    """Columns of samples (m, n) in rising order, and shares (few, n): samples = samples[:, columns] @ shares.

    Both are empty where more than `most` columns differ. Gram and Schmidt's orthogonal directions, each of the column
    of which most is left; without BLAS, whose rounding depends on its number of threads.
    """
    left, columns, parts = samples.copy(), [], []  # parts: of every column along each direction
    squares = np.sum(left * left, axis=0)
    enough = LEFT_OVER**2 * squares.max()
    while squares.max() > enough or len(columns) % EIGHT:
        column = int(squares.argmax())
        if len(columns) == most or squares[column] == 0.0:
            return np.empty(0, int), np.empty((0, samples.shape[1]))
        direction = left[:, column] / math.sqrt(squares[column])
        parts.append(np.sum(direction[:, None] * left, axis=0))
        left -= direction[:, None] * parts[-1]
        left[:, column] = 0.0  # without rounding, which might be the most that is left
        columns.append(column)
        squares = np.sum(left * left, axis=0)
    shares = np.zeros((len(columns), samples.shape[1]))
    for row in range(len(columns) - 1, -1, -1):  # back substitution
        known = np.sum(parts[row][columns[row + 1 :], None] * shares[row + 1 :], axis=0)
        shares[row] = (parts[row] - known) / parts[row][columns[row]]
    order = np.argsort(columns)
    return np.array(columns)[order], shares[order]
