"""What becomes of a state on another grid and in space; and the states between two.

Another grid, and the way between two states, is linear in strain, direction, velocity, curvature and shear; the
conserved variables q = (1 + eps) t follow. On another grid all directions turn a little, so that the upper end is where
it was. The way linear in q was tried: q is shorter between two directions than at either, and that compresses slack
lines (on twice the nodes the first tension was 2 to 14 kN; it is 0.07 kN this way, and was 2 N before).
"""

import math
from dataclasses import replace

import numpy as np

from .. import parameters
from ..planar import columns as col
from ..record import RELEASES
from ..scene.models import Scene
from ..spatial import columns as spatial_col
from ..spatial import lift
from ..trajectory.final_state import NONE, FinalState

SAME = 1e-12  # shares of the length of a line that are one place
TURNS, MOST_TURN = 20, 0.1  # of the directions, to bring the upper end to its place; rad in one of them
STRAIGHT = 1e-4  # ratio of the least to the largest lever of these turns at which a line is straight


def places_along(scene: Scene) -> np.ndarray:
    """Shares (n,) of the length of the line at which its nodes are, 0 to 1."""
    tether = scene.tether
    s = np.cumsum(parameters.grid(1.0, tether.nodes, tether.grid_stretching, tether.grid_refined))
    return np.append(0.0, s / s[-1])


def same_grid(first: Scene, second: Scene) -> bool:
    """Whether the nodes of two scenes are at the same shares of the length."""
    if first.tether.nodes != second.tether.nodes:
        return False
    return bool(np.abs(places_along(first) - places_along(second)).max() <= SAME)


def between(a: FinalState, b: FinalState, share: float) -> FinalState:
    """The state at a share of the way from `a` (0) to `b` (1), in the scene of `a`: to bisect the edge of two motions.

    Both are of one grid, of as many dimensions and of one time; their last steps may end apart: the time of the state
    goes along. Directions take the way without the turns by 2 pi that loop releases leave. Samples of before are mixed
    too; perturbations begin anew. Goes on by small steps. Raises ValueError for states that do not fit.
    """
    if a.Y.shape != b.Y.shape or not same_grid(a.scene, b.scene):
        raise ValueError("between: two states of one grid and of as many dimensions are needed")
    if a.time_s != b.time_s:
        raise ValueError(
            f"between: given states at {a.time_s:g} and {b.time_s:g} s; allowed: of one time, or at_zero()"
        )
    target = b.Y.copy()
    if a.Y.shape[1] == 6:
        turn = np.unwrap(b.Y[:, col.PHI] - a.Y[:, col.PHI])
        target[:, col.PHI] = a.Y[:, col.PHI] + turn - 2.0 * math.pi * np.rint(turn.mean() / (2.0 * math.pi))
    else:
        target[np.sum(a.Y[:, lift.BETA] * b.Y[:, lift.BETA], axis=1) < 0.0, lift.BETA] *= -1.0
    longer = max(a.samples, b.samples, key=len)  # the last steps may have passed unlike many samples
    first, second = (np.concatenate([state.samples, longer[len(state.samples) :]]) for state in (a, b))

    def mixed(of_a, of_b):
        return (1.0 - share) * of_a + share * of_b

    numbers_a, numbers_b = a.state(), b.state()
    numbers = {name: float(mixed(numbers_a[name], numbers_b[name])) for name in ("t", "low", "high", "foot")}
    numbers["first"] = numbers_a["first"] + numbers_a["samples"] - len(a.samples)
    numbers["samples"] = len(longer)
    samples = mixed(first, second)
    samples[:, RELEASES] = numbers_a["releases"]
    state = replace(a.with_numbers(**numbers), samples=samples, K=mixed(a.K, b.K), profiles=NONE)
    return _with_unknowns(state, mixed(a.Y, target)).restarted()


def on_grid_of(scene: Scene, state: FinalState) -> FinalState:
    """The state with the nodes of another scene."""
    old, new = places_along(state.scene), places_along(scene)
    Y = state.Y.copy()
    if Y.shape[1] == 13:  # neighbours on one side of the sphere of Euler parameters
        one_side = np.sum(Y[1:, lift.BETA] * Y[:-1, lift.BETA], axis=1) >= 0.0
        Y[1:, lift.BETA] *= np.cumprod(np.where(one_side, 1.0, -1.0))[:, None]
    place = _place_of(Y, old)
    Y, K = (np.stack([np.interp(new, old, column) for column in values.T], axis=1) for values in (Y, state.K))
    return _with_unknowns(replace(state, K=K, profiles=NONE), _reaching(Y, new, place))


def in_space(state: FinalState, scene: Scene) -> FinalState:
    """A planar state in the plane of x and z of a scene in space, on its own grid."""
    record = parameters.numbers_of(scene)[0]
    h = np.diff(places_along(state.scene)) * scene.tether.length_m
    Y, K = lift.state_in_space(record, h, state.Y, 0.0), np.zeros((len(state.K), 6))
    Y[:, [spatial_col.V, spatial_col.V + 2]] = state.Y[:, col.VX : col.PHI]
    K[:, [0, 2, 3, 5]] = state.K
    return _with_unknowns(replace(state, K=K), Y)


def _place_of(Y: np.ndarray, shares: np.ndarray) -> np.ndarray:
    """Place (2 or 3,) of the upper end, in lengths of the line."""
    return np.trapezoid(lift.stretch_vectors(Y), shares, axis=0)


def _reaching(Y: np.ndarray, shares: np.ndarray, place: np.ndarray) -> np.ndarray:
    """The unknowns with all directions turned so that the upper end is at `place`, by the least turns: theta = q x l.

    sum w theta x q = sum w (q.q I - q q^T) l is the way that is missing; a straight line cannot go on along itself.
    """
    Y, weights = Y.copy(), np.gradient(shares)
    weights[[0, -1]] *= 0.5
    for _ in range(TURNS):
        missing = place - _place_of(Y, shares)
        if np.abs(missing).max() < SAME:
            break
        q, way = lift.stretch_vectors(Y), missing
        plane = Y.shape[1] == 6
        if plane:
            q, way = np.insert(q, 1, 0.0, axis=1), np.insert(missing, 1, 0.0)
        levers = weights @ np.sum(q * q, axis=1) * np.eye(3) - (weights[:, None] * q).T @ q
        theta = np.cross(q, np.linalg.pinv(levers, STRAIGHT, hermitian=True) @ way)
        theta *= min(1.0, MOST_TURN / max(np.abs(theta).max(), SAME))
        if plane:
            Y[:, col.PHI] -= theta[:, 1]
        else:
            turn = np.insert(0.5 * theta, 0, 1.0, axis=1)
            Y[:, lift.BETA] = lift.product(turn / np.linalg.norm(turn, axis=1, keepdims=True), Y[:, lift.BETA])
    return Y


def _with_unknowns(state: FinalState, Y: np.ndarray) -> FinalState:
    """The state with these unknowns (n, 6 or 13), and the conserved variables that follow from them."""
    if Y.shape[1] == 13:
        Y[:, lift.BETA] /= np.linalg.norm(Y[:, lift.BETA], axis=1, keepdims=True)
    q = lift.stretch_vectors(Y)
    axes = q.shape[1]
    C = np.concatenate([q, Y[:, axes : 2 * axes]], axis=1)  # the velocity has the same columns in Y and in C
    return replace(state, Y=Y, Y_before=Y.copy(), C=C, vectors=NONE, lateral=NONE, growth=NONE)
