"""The equilibrium from which a run starts: the engine's planar statics, lifted, then settled in the paper's own rule.

The two discretisations of rest differ by O(h^2). What the box rule in time is given that does not satisfy its own
equations at rest stays for ever and changes sign at every step, so the shape is settled once more.
"""

import math

import numpy as np

from .. import parameters, statics
from ..ends import HELD
from ..guards import OK, STATICS_FAILED
from .ends import end_force, force_and_velocity
from .frame import TO_PAPER, parameters_of, rotation, to_local
from .line import EULER, SPEEDS
from .newton import solve
from .water import positions

MOST = 200  # iterations of one equilibrium: a shape that current turns out of the plane of the guess takes many
PLACE = 1e-9  # m per m of line to which a held end is in its place


def at_rest(scene, line, band, start=None):
    """The state at t = 0 with its velocities: (code, Y (13, n) or None).

    start: (n, 13) equilibrium of the engine in space instead of the planar one: eps, S_n, S_b, velocity in x, y, z,
    Euler parameters from x, y, z, Omega.
    """
    code, guess = (OK, from_space(start)) if start is not None else planar_guess(scene, line)
    if code != OK:
        return code, None
    held = line.record["end"] == HELD
    force = force_and_velocity(line, guess[:, -1])[0] if held else end_force(line)
    code, Y = _in_place(scene, line, band, guess, force) if held else _settled(line, band, guess, force)
    if code != OK:
        return STATICS_FAILED, None
    velocity = np.outer(np.array(scene.start.buoy_velocity_mps)[TO_PAPER], line.s / line.s[-1])
    Y[SPEEDS] = to_local(Y[EULER], velocity)
    return OK, Y


def _settled(line, band, guess, force):
    code, _, level = solve(line, band, guess, 0.0, None, MOST, force=force)
    return code, None if level is None else level.Y


def _in_place(scene, line, band, guess, force):
    """The equilibrium whose upper end is in its place: the force that puts it there, by Powell's hybrid method."""
    from scipy.optimize import root

    target = np.array(scene.end.position_m)[TO_PAPER]
    axes = slice(0, 3 if line.spatial else 2)
    per = float(line.record["per_force"])
    last = [guess]

    def miss(scaled):
        pull = np.zeros(3)
        pull[axes] = scaled / per
        code, Y = _settled(line, band, last[0], pull)
        if code != OK:
            return np.full(scaled.shape, np.inf)
        last[0] = Y
        return (positions(line, Y)[:, -1] - target)[axes]

    with np.errstate(all="ignore"):
        found = root(miss, force[axes] * per, options={"xtol": 1e-13})
        off = miss(found.x)
    ok = np.isfinite(off).all() and np.abs(off).max() <= PLACE * line.s[-1]
    return (OK, last[0]) if ok else (STATICS_FAILED, None)


def planar_guess(scene, line):
    """The engine's equilibrium in the vertical plane of the end's place or force, as (code, Y (13, n))."""
    end = scene.end
    toward = {"held": end.position_m, "free": end.force_N}.get(end.kind) or (0.0, 0.0, 0.0)
    azimuth = math.atan2(toward[1], toward[0]) if toward[1] else 0.0
    flat = (math.hypot(*toward[:2]) if azimuth else toward[0], 0.0, toward[2])
    name = {"held": "position_m", "free": "force_N"}.get(end.kind)
    planar = scene.model_copy(
        update={
            "motion": scene.motion.model_copy(update={"dimensions": 2}),
            "end": end.model_copy(update={name: flat}) if name else end,
            "current": None if azimuth else scene.current,
        }
    )
    tables = []
    record = parameters.record_of(planar, tables)[0]
    Y = statics.first_guess(record, planar, line.h)
    code = statics.settle(record, np.concatenate(tables), Y, np.array([flat[0], flat[2]]))
    return code, lifted(Y, azimuth) if code == OK else None


def lifted(Y, azimuth=0.0):
    """Planar unknowns (n, 6) = eps, S, U, W, phi, kappa as (13, n) at rest, in the plane at `azimuth` from x to y.

    The angle from the vertical is a = pi/2 - phi, so n and Omega_3 change their signs against the planar engine.
    """
    a = math.pi / 2 - Y[:, 4]
    side, out = np.array([0.0, math.cos(azimuth), math.sin(azimuth)]), np.array([0.0, -math.sin(azimuth), math.cos(azimuth)])
    up = np.array([1.0, 0.0, 0.0])
    t = np.outer(up, np.cos(a)) + np.outer(side, np.sin(a))
    n = np.outer(side, np.cos(a)) - np.outer(up, np.sin(a))
    b = np.outer(out, np.ones_like(a))
    found = np.zeros((13, len(Y)))
    found[0], found[1], found[12] = Y[:, 0], -Y[:, 1], -Y[:, 5]
    found[EULER] = parameters_of(np.array([t, n, b]))
    return found


def from_space(Y):
    """The unknowns (n, 13) of the engine in space, Euler parameters and velocities from x, y, z, as (13, n) here."""
    found = np.array(Y, float).T
    C = rotation(found[EULER])[:, TO_PAPER]
    found[EULER] = parameters_of(C)
    found[SPEEDS] = to_local(found[EULER], found[SPEEDS][TO_PAPER])
    return found
