"""What becomes of a state in another scene: on another grid, in space, under other waves; and states between two.

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

NO_CHANGE = ("name", "title", "start")  # of the motion, once it goes on
SAME = 1e-12  # shares of the length of a line that are one place
TURNS, MOST_TURN = 20, 0.1  # of the directions, to bring the upper end to its place; rad in one of them
STRAIGHT = 1e-4  # ratio of the least to the largest lever of these turns at which a line is straight


def taken_over(state: FinalState, scene: Scene) -> tuple[FinalState, str]:
    """The state from which a run of `scene` goes on, and in words what was changed for it; "" where nothing was.

    Changes of `solver` and `output` leave the rates as they are; after any other the run goes on by small steps. The
    clock starts at 0 where the period of the waves or the step of the output is another. `fault_of` tells what cannot
    be taken over.
    """
    begin_s, changed = state.time_s, changes(state.scene, scene)
    said = [f"{key} {_word(old)} -> {_word(new)}" for key, old, new in changed]
    moved = any(not key.startswith(("solver.", "output.")) for key, _, _ in changed)
    if any(key in ("output.step_s", "waves.period_s") for key, _, _ in changed):
        said.append("the clock starts at 0")
        state = state.ended_at_zero() if state.scene.sample_step_s() != scene.sample_step_s() else state.at_zero()
    if state.profile_step_s != replace(state, scene=scene).profile_step_s:
        state = replace(state, profiles=NONE)
    if state.Y.shape[1] == 6 and scene.motion.dimensions == 3:
        state = _in_space(state, scene)
    shares = places_along(state.scene), places_along(scene)
    if len(shares[0]) != len(shares[1]) or np.abs(shares[0] - shares[1]).max() > SAME:
        state = _on_grid(state, *shares)
        said.append("the state is interpolated")
    state = replace(state, scene=scene)
    words = f"went on at t = {begin_s:.6g} s; changed: {', '.join(said)}" if said else ""
    return state.restarted() if moved else state, words


def fault_of(state: FinalState, scene: Scene) -> str:
    """Why a run of `scene` cannot go on from the state, as the end of a sentence; empty where it can."""
    fault, given = state.fault(), state.scene
    if scene.solver.scheme == "paper-box" or scene.output.energy:
        return "a scene with solver.scheme = 'paper-box' or output.energy, which can only start from rest"
    if fault:
        return fault
    if scene.motion.dimensions < given.motion.dimensions:
        return "a state in 3 dimensions for a scene in 2: what lies across the plane would be lost"
    for key in ("kind", "position_m"):
        old, new = getattr(given.end, key), getattr(scene.end, key)
        if old != new:
            return f"a state of a line with end.{key} = {old!r} for a scene with {new!r}: the end is another"
    return ""


def changes(before: Scene, after: Scene) -> list[tuple[str, object, object]]:
    """Key, old and new value of what is not the same; of `output` only the step, and nothing of `start`."""
    old, new = (_flat(one.model_dump(mode="json", exclude={*NO_CHANGE, "output"})) for one in (before, after))
    differ = [key for key in old | new if old.get(key) != new.get(key)]
    steps = before.sample_step_s(), after.sample_step_s()
    found = [(key, old.get(key), new.get(key)) for key in differ]
    return found if "waves.period_s" in differ or steps[0] == steps[1] else [*found, ("output.step_s", *steps)]


def _word(value: object) -> str:
    text = "none" if value is None else f"{value:.6g}" if isinstance(value, float) else str(value)
    return text if len(text) <= 40 else "another list"


def _flat(values: dict, above: str = "") -> dict[str, object]:
    """Values by dotted key; absent ones left out."""
    found = {}
    for name, value in values.items():
        found |= _flat(value, f"{above}{name}.") if isinstance(value, dict) else {above + name: value}
    return {key: value for key, value in found.items() if value is not None}


def places_along(scene: Scene) -> np.ndarray:
    """Shares (n,) of the length of the line at which its nodes are, 0 to 1."""
    tether = scene.tether
    s = np.cumsum(parameters.grid(1.0, tether.nodes, tether.grid_stretching, tether.grid_refined))
    return np.concatenate([[0.0], s / s[-1]])


def between(a: FinalState, b: FinalState, share: float) -> FinalState:
    """The state at a share of the way from `a` (0) to `b` (1), in the scene of `a`: to bisect the edge of two motions.

    Both are of one grid, of as many dimensions and of one time; their last steps may end apart: the time of the state
    goes along. Directions take the way without the turns by 2 pi that loop releases leave. Samples of before are mixed
    too; perturbations begin anew. Goes on by small steps. Raises ValueError for states that do not fit.
    """
    if a.Y.shape != b.Y.shape or np.abs(places_along(a.scene) - places_along(b.scene)).max() > SAME:
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
    longer = max(a, b, key=lambda one: len(one.samples)).samples  # the last steps may have passed unlike many samples
    first, second = (np.concatenate([one.samples, longer[len(one.samples) :]]) for one in (a, b))

    def mixed(one, other):
        return (1.0 - share) * one + share * other

    of_a, of_b = a.state(), b.state()
    numbers = {name: float(mixed(of_a[name], of_b[name])) for name in ("t", "low", "high")}
    number = of_a["first"] + of_a["samples"] - len(a.samples)
    found = a.with_numbers(**numbers, first=number, samples=len(longer))
    arrays = {"samples": mixed(first, second), "K": mixed(a.K, b.K), "profiles": NONE}
    arrays["samples"][:, RELEASES] = of_a["releases"]
    return _with_unknowns(replace(found, **arrays), mixed(a.Y, target)).restarted()


def _on_grid(state: FinalState, old: np.ndarray, new: np.ndarray) -> FinalState:
    """The state with nodes at other shares of the length."""
    Y = state.Y.copy()
    if Y.shape[1] == 13:  # neighbours on one side of the sphere of Euler parameters
        together = np.sum(Y[1:, lift.BETA] * Y[:-1, lift.BETA], axis=1) >= 0.0
        Y[1:, lift.BETA] *= np.cumprod(np.where(together, 1.0, -1.0))[:, None]
    place = _place_of(Y, old)
    Y, K = (np.stack([np.interp(new, old, column) for column in values.T], axis=1) for values in (Y, state.K))
    return _with_unknowns(replace(state, K=K, profiles=NONE), _reaching(Y, new, place))


def _in_space(state: FinalState, scene: Scene) -> FinalState:
    """A planar state in the plane of x and z, on its own grid."""
    record = parameters.record_of(scene, [])[0]
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
        if plane := Y.shape[1] == 6:
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
    velocity = slice(col.VX, col.PHI)
    if Y.shape[1] == 13:
        velocity = slice(spatial_col.V, spatial_col.BETA)
        Y[:, lift.BETA] /= np.linalg.norm(Y[:, lift.BETA], axis=1, keepdims=True)
    C = np.concatenate([lift.stretch_vectors(Y), Y[:, velocity]], axis=1)
    return replace(state, Y=Y, Y_before=Y.copy(), C=C, vectors=NONE, lateral=NONE, growth=NONE)
