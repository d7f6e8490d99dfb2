"""Static equilibrium of any scene, by the Newton routine of the dynamics.

With cq = 1 and no drag of motion, the velocity of a stage is the displacement from the last iterate; with cv = mu a
share mu of the masses resists it (N/m per kg). mu falls to zero as the iterates settle, so the last solve is the
static problem itself: at first a damped motion towards equilibrium, at last Newton's quadratic convergence.
Waves are left out; a current bends the tether. Held upper ends move to their place in the first iterate.
"""

import math

import numpy as np

from .ends import BUOY, FREE, HELD
from .guards import OK, STATICS_FAILED
from .newton import newton
from .planar import state as planar
from .spatial import lift
from .spatial import state as spatial

SOFTEST, FIRST, STIFFEST = 1e-8, 10.0, 1e9
TOLERANCE = 1e-9
CLOSE, BALANCED = 1e-6, 1e-9  # a line at rest moves less (m), against a resistance less than this share of its load
MOST = 300  # a stiff line on its way to a clamp passes shear far above its load, by one scale an iteration
MOST_TURNS = 4  # a bight that the grid does not resolve keeps a folded node


def settle(record, tables, Y, target_m):
    """Move the guess Y (n, 6 or 13) to static equilibrium, in place; the velocities come back as zero.

    record: parameter record (not changed); target_m: (x, z) or (x, y, z) of a held end. Returns a status code. The
    loop is Python: a score of Newton solves, and nothing more to compile.
    """
    p = record.copy()
    n = int(p["nodes"])
    space = "GI" in p.dtype.names
    X, F, Q, E, D, C_tilde = (spatial if space else planar).work_arrays.py_func(p, n)
    axes = ("end_x", "end_y", "end_z") if space else ("end_x", "end_z")
    velocity = slice(3, 6) if space else slice(2, 4)
    half = 0.5 * tables[p["grid_at"] : p["grid_at"] + n - 1, None]
    mu, turns, settled = FIRST, 0, None
    for _ in range(400):
        C_tilde[:, : len(axes)] = lift.stretch_vectors(Y) if space else planar_stretch_vectors(Y)
        if p["end"] == HELD:
            q = C_tilde[:, : len(axes)]
            for axis, place in zip(axes, target_m - np.sum(half * (q[1:] + q[:-1]), axis=0), strict=True):
                p[axis] = place
        trial = Y.copy()
        code, _ = newton(p, tables, 0.0, 0.0, 1.0, mu, TOLERANCE, MOST, trial, C_tilde, X, F, Q, E, D)
        if settled is not None and (code != OK or (mu == 0.0 and np.abs(trial[:, velocity]).max() > CLOSE)):
            Y[:] = settled  # something is free to turn: with less resistance rounding errors move it
            return OK
        if code != OK:
            mu = 100.0 * max(mu, SOFTEST)
            if mu > STIFFEST:
                return STATICS_FAILED
            continue
        moved = np.abs(trial[:, velocity]).max()
        Y[:] = trial
        Y[:, velocity] = 0.0
        if mu == 0.0 and moved < CLOSE:
            folded = Y[:, 0] < 0.0
            if p["bent"] or not folded.any() or turns == MOST_TURNS:
                return OK
            # without bending compression is no rest: a node turned round carries the same force as tension
            Y[folded, 0] *= -1.0
            if space:
                lift.turn_back(Y, folded)
            else:
                Y[folded, 4] += math.pi
            mu = FIRST
            turns += 1
            continue
        share = mu * moved * float(p["m"]) * 2.0 * np.sum(half) * float(p["per_force"]) / 20.0
        if p["bent"] and 0.0 < mu and moved < CLOSE and share < BALANCED:
            settled = Y.copy()
        mu = 0.0 if mu <= SOFTEST else mu * (0.1 if moved < 1.0 else 0.5)
    return STATICS_FAILED


def planar_stretch_vectors(Y):
    """q (n, 2) of a planar state."""
    return (1 + Y[:, :1]) * np.column_stack([np.cos(Y[:, 4]), np.sin(Y[:, 4])])


def first_guess(record, scene, h):
    """State (n, 6 or 13) from which `settle` starts: loads carried along a line, or an arc where the ends are slack.

    In space it lies in the vertical plane through the held end, or through the force on a free one.
    """
    if "GI" not in record.dtype.names:
        return _in_plane(record, scene, h, (float(record["end_x"]), float(record["end_z"])))
    across = {HELD: scene.end.position_m, FREE: scene.end.force_N}.get(int(record["end"]))
    azimuth = math.atan2(across[1], across[0]) if across and (across[0] or across[1]) else 0.0
    force = (math.hypot(float(record["end_x"]), float(record["end_y"])), float(record["end_z"]))
    return lift.state_in_space(record, h, _in_plane(record, scene, h, force), azimuth)


def _in_plane(record, scene, h, force):
    n = int(record["nodes"])
    s = np.concatenate([[0.0], np.cumsum(h)])
    length = s[-1]
    Y = np.zeros((n, 6))
    if record["end"] == HELD:
        x, y, z = scene.end.position_m
        x = math.hypot(x, y) if y else x
        chord = math.hypot(x, z)
        direction = math.atan2(z, x) if chord > 0 else 0.0
        if chord >= length:
            Y[:, 0] = chord / length - 1
            Y[:, 4] = direction
        else:
            half = _arc(chord / length)
            sag = 1.0 if (record["w0"] >= 0) == (x >= 0) else -1.0  # heavy hangs below the chord, light above
            Y[:, 4] = direction + sag * half * (2 * s / length - 1)
            Y[:, 5] = 2 * sag * half / length
        return Y
    Nx = np.full(n, force[0] if record["end"] == FREE else 0.0)
    Nz = (record["lift"] if record["end"] == BUOY else force[1]) - record["w0"] * (length - s)
    T = np.hypot(Nx, Nz)
    from .scales import strain_at

    Y[:, 0] = [strain_at(load, scene.tether.tension) if load > 0 else 0.0 for load in T]
    angle = np.arctan2(Nz, Nx)
    heaviest = angle[np.argmax(T)] if T.max() > 0 else math.pi / 2
    # where the load changes sign along the line the guess keeps one direction, with compression
    against = np.cos(angle - heaviest) < 0
    Y[:, 0] = np.where(against, 0.0, Y[:, 0])
    Y[:, 4] = np.where(against, heaviest, heaviest + np.angle(np.exp(1j * (angle - heaviest))))
    return Y


def _arc(ratio):
    """Half angle a of a circular arc with chord/length = sin(a)/a = ratio, in (0, pi]."""
    from scipy.optimize import brentq

    return brentq(lambda a: math.sin(a) - ratio * a, 1e-9, math.pi) if ratio > 0 else math.pi
