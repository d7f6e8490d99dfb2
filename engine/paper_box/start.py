"""The equilibrium from which a run starts: the engine's planar statics, lifted, then settled in the paper's own rule.

The two discretisations of rest differ by O(h^2). What the box rule in time is given that does not satisfy its own
equations at rest stays for ever and changes sign at every step, so the shape is settled once more. A current across
the plane of the planar statics comes on in shares.
"""

import math

import numpy as np

from .. import parameters
from ..planar import columns as col
from ..record import HELD
from ..scene.models import Scene
from ..time import statics
from ..time.status import NEWTON_FAILED, OK, STATICS_FAILED
from .ends import end_force, force_and_velocity
from .line import EPS, EULER, O3, S_N, SPEEDS, TO_PAPER, Line, to_local
from .newton import TOLERANCE, newton_update
from .nodal import positions, water_at

MOST = 100  # iterations of one equilibrium
SHARES = 16  # of the current, where the whole of it does not settle at once
TINY = 1e-30


def at_rest(scene: Scene, line: Line) -> tuple[int, np.ndarray | None]:
    """The state at t = 0 with its velocities: (code, Y (13, n) or None)."""
    code, guess = planar_guess(scene, line)
    if code != OK:
        return code, None
    target, force = None, end_force(line)
    if line.record["end"] == HELD:
        target = np.array(scene.end.position_m)[TO_PAPER]
        force = force_and_velocity(line, guess[:, -1])[0]
    code, Y, _ = settled(line, guess, force, target)
    if code != OK:
        Y = guess
        for share in np.linspace(0.0, 1.0, SHARES + 1):
            code, Y, force = settled(line, Y, force, target, share)
            if code != OK:
                return STATICS_FAILED, None
    velocity = np.outer(np.array(scene.start.buoy_velocity_mps)[TO_PAPER], line.s / line.s[-1])
    Y[SPEEDS] = to_local(Y[EULER], velocity)
    return OK, Y


def settled(
    line: Line, guess: np.ndarray, force: np.ndarray, target: np.ndarray | None, share: float = 1.0
) -> tuple[int, np.ndarray, np.ndarray]:
    """Equilibrium near `guess` under a share of the current: (code, Y (13, n), force on the end (3,)).

    target: place (3,) of a held end, paper's axes. The force that keeps it there is then found along with the shape:
    Newton's update of the shape is affine in the force, and the place of the end linear in the update.
    """
    Y, force = guess.copy(), np.array(force, float)
    axes = 0 if target is None else 3 if line.spatial else 2
    for _ in range(MOST):
        water = share * water_at(line, 0.0, Y, waves=False)
        code, updates, size = newton_update(line, Y, water, 0.0, None, force, axes)
        if code != OK:
            break
        update, pull = updates[0], np.zeros(3)
        if axes:
            reach = [positions(line, Y + 1j * TINY * part)[:axes, -1].imag / TINY for part in updates]
            missing = (target - positions(line, Y)[:, -1])[:axes] - reach[0]
            pull[:axes] = np.linalg.lstsq(np.array(reach[1:]).T, missing)[0]
            update = updates[0] + np.tensordot(pull[:axes], updates[1:], 1)
            size = np.abs(update * line.per[:, None]).max()
        factor = min(1.0, 1.0 / size)
        Y += factor * update
        force += factor * pull
        if Y[EPS].min() <= -1.0:
            break
        if size < TOLERANCE:
            return OK, Y, force
    return NEWTON_FAILED, guess, force


def planar_guess(scene: Scene, line: Line) -> tuple[int, np.ndarray | None]:
    """The engine's equilibrium in the vertical plane of the end's place or force, as (code, Y (13, n))."""
    name = {"held": "position_m", "free": "force_N"}.get(scene.end.kind)
    x, y, z = (getattr(scene.end, name) if name else None) or (0.0, 0.0, 0.0)
    azimuth = math.atan2(y, x) if y else 0.0
    flat = (math.hypot(x, y) if azimuth else x, 0.0, z)
    planar = scene.with_values("motion", dimensions=2)
    if name:
        planar = planar.with_values("end", **{name: flat})
    if azimuth:
        planar = planar.model_copy(update={"current": None})
    record, tables = parameters.numbers_of(planar)
    code, Y = statics.static_equilibrium(record, planar, tables)
    return code, lifted(Y, azimuth) if code == OK else None


def lifted(Y: np.ndarray, azimuth: float = 0.0) -> np.ndarray:
    """Planar unknowns (n, 6) = eps, S, U, W, phi, kappa as (13, n) at rest, in the plane at `azimuth` from x to y.

    The angle from the vertical is a = pi/2 - phi, so n and Omega_3 change their signs against the planar engine.
    """
    state = np.zeros((13, len(Y)))
    state[EPS], state[S_N], state[O3] = Y[:, col.EPS], -Y[:, col.SHEAR], -Y[:, col.KAPPA]
    half = 0.5 * (math.pi / 2 - Y[:, col.PHI])
    up, side = np.cos(half), np.sin(half)
    cos, sin = math.cos(0.5 * azimuth), math.sin(0.5 * azimuth)
    state[EULER] = cos * up, sin * up, -sin * side, cos * side  # the turn by a, then the azimuth about axis 1
    return state
