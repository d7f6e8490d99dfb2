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
from .planar import node, sweep
from .planar.newton import newton

SOFTEST, FIRST, STIFFEST = 1e-8, 10.0, 1e9
TOLERANCE = 1e-9
MOST = 60
MOST_TURNS = 4  # a bight that the grid does not resolve keeps a folded node


def settle(record, tables, Y, target_m):
    """Move the guess Y (n, 6) to static equilibrium, in place; the velocities come back as zero.

    record: parameter record (not changed); target_m: (x, z) of a held end. Returns a status code. The loop is
    Python: a score of Newton solves, and nothing more to compile.
    """
    p = record.copy()
    n = int(p["nodes"])
    X, F, Q = np.zeros((n, 2)), np.zeros((n, 4)), np.zeros((n, node.WIDTH))
    E, D, C_tilde = np.zeros((n, sweep.WIDTH)), np.zeros((n, 6)), np.zeros((n, 4))
    half = 0.5 * tables[p["grid_at"] : p["grid_at"] + n - 1, None]
    mu, turns = FIRST, 0
    for _ in range(400):
        C_tilde[:, 0] = (1 + Y[:, 0]) * np.cos(Y[:, 4])
        C_tilde[:, 1] = (1 + Y[:, 0]) * np.sin(Y[:, 4])
        if p["end"] == HELD:
            p["end_x"], p["end_z"] = target_m - np.sum(half * (C_tilde[1:, :2] + C_tilde[:-1, :2]), axis=0)
        trial = Y.copy()
        code, _ = newton(p, tables, 0.0, 0.0, 1.0, mu, TOLERANCE, MOST, trial, C_tilde, X, F, Q, E, D)
        if code != OK:
            mu = 100.0 * max(mu, SOFTEST)
            if mu > STIFFEST:
                return STATICS_FAILED
            continue
        moved = np.abs(trial[:, 2:4]).max()
        Y[:] = trial
        Y[:, 2:4] = 0.0
        if mu == 0.0 and moved < 1e-6:
            folded = Y[:, 0] < 0.0
            if p["bent"] or not folded.any() or turns == MOST_TURNS:
                return OK
            # without bending compression is no rest: a node turned round carries the same force as tension
            Y[folded, 0] *= -1.0
            Y[folded, 4] += math.pi
            mu = FIRST
            turns += 1
            continue
        mu = 0.0 if mu <= SOFTEST else mu * (0.1 if moved < 1.0 else 0.5)
    return STATICS_FAILED


def first_guess(record, scene, h):
    """Shape (n, 6) from which `settle` starts: loads carried along a line, or an arc where the ends are slack."""
    n = int(record["nodes"])
    s = np.concatenate([[0.0], np.cumsum(h)])
    length = s[-1]
    Y = np.zeros((n, 6))
    if record["end"] == HELD:
        x, z = scene.end.position_m[0], scene.end.position_m[2]
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
    Nx = np.full(n, record["end_x"] if record["end"] == FREE else 0.0)
    Nz = (record["lift"] if record["end"] == BUOY else record["end_z"]) - record["w0"] * (length - s)
    T = np.hypot(Nx, Nz)
    from .parameters import strain_at

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
