"""The box equations in space written out in plain NumPy from their statements, for tests that must not trust a kernel.

The elimination in `spatial.elimination` is never looked at here: every equation of its head is a row of `residual`,
the rotation between nodes comes from 3 x 3 matrices, and O1 is an unknown of every node. Complex arguments pass
through, so that a complex step differentiates to rounding. The scene's part (laws, grid) is that of the planar module.
"""

import math

import numpy as np

from engine.parameters import record_of
from engine.spatial.elimination import sweep
from engine.spatial.elimination_unbent import sweep_unbent
from engine.spatial.node import WIDTH, node_quantities, shape
from engine.spatial.rows import WIDTH as SWEEP_WIDTH
from engine.spatial.upper import CLAMP
from tests.engine.box_equations import elements, tension


def kernel_update(scene, cq, cv, in_motion, Y, C_tilde, F, t=0.0):
    """The engine's Newton update (n, 12) at a state, with the water F (n, 6) frozen."""
    tables = []
    p = record_of(scene, tables)[0]
    tables = np.concatenate(tables)
    n = len(Y)
    Q, X, E, D = np.zeros((n, WIDTH)), np.zeros((n, 3)), np.zeros((n, SWEEP_WIDTH)), np.zeros((n, 12))
    shape(p, tables, Y, Q, X)
    node_quantities(p, tables, cq, cv, in_motion, Y, C_tilde, F, Q)
    solve = sweep if scene.tether.bending_stiffness_Nm2 > 0 else sweep_unbent
    assert solve(p, tables, t, cq, cv, in_motion, Y, C_tilde, X, F, Q, E, D)
    return D


def frames(beta):
    """Rows t, n, b (m, 3, 3) of Euler parameters (m, 4): C of eq. (6), as 1 + 2 b0 [b] + 2 [b]^2 transposed."""
    vectors = np.asarray(beta)[:, 1:]
    cross = np.zeros((len(vectors), 3, 3), vectors.dtype)
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        cross[:, i, j], cross[:, j, i] = -vectors[:, k], vectors[:, k]
    R = np.eye(3) + 2 * beta[:, :1, None] * cross + 2 * cross @ cross
    return R.transpose(0, 2, 1)


def turns(beta):
    """Rotation vectors (m - 1, 3) from each frame to the next in their own axes, |psi| < pi, by the matrices alone."""
    A = frames(beta)
    R = np.einsum("kia,kja->kij", A[:-1], A[1:])  # of frame a to frame b, in axes of a
    axis = 0.5 * np.stack([R[:, 2, 1] - R[:, 1, 2], R[:, 0, 2] - R[:, 2, 0], R[:, 1, 0] - R[:, 0, 1]], 1)
    sine, cosine = np.sqrt(np.sum(axis**2, 1)), 0.5 * (np.trace(R, axis1=1, axis2=2) - 1)
    angle = np.arcsin(sine)
    angle = np.where(cosine.real < 0, math.pi - angle, angle)
    return (angle / sine)[:, None] * axis


def stretched(x):
    """|x| x for vectors (m, 3)."""
    return np.sqrt(np.sum(x * x, 1))[:, None] * x


def residual(scene, cq, cv, in_motion, Y, C_tilde, F, twist=0.0):
    """All equations as one vector: 12 n of them with bending (the roll of the first frame among them), 6 n without.

    Y (n, 13) = eps, Sn, Sb, V, beta, O;  C_tilde (n, 6) = q~, V~;  F (n, 6) water velocity and acceleration.
    """
    tether, end = scene.tether, scene.end
    EI, GI = tether.bending_stiffness_Nm2, tether.torsion_stiffness_Nm2
    eps, S, V, turn = Y[:, 0], Y[:, 1:3], Y[:, 3:6], Y[:, 10:13]
    if EI == 0:
        S = np.zeros_like(S)
    lam = (1 + eps)[:, None]
    A = frames(Y[:, 6:10])
    t, n, b = A[:, 0], A[:, 1], A[:, 2]
    q_t = cq * (lam * t - C_tilde[:, :3])
    V_t = cv * (V - C_tilde[:, 3:])
    N = tension(tether.tension, eps)[:, None] * t + S[:, :1] * n + S[:, 1:] * b
    rho = scene.water.density_kgpm3 if scene.water is not None else 0.0
    g, d = scene.gravity_mps2, tether.diameter_m
    G = tether.density_kgpm3 * tether.area_m2 * V_t
    G = G + np.array([0, 0, (tether.density_kgpm3 - rho) * tether.area_m2 * g])
    displaced = rho * math.pi * d**2 / 4
    added = tether.added_mass * displaced

    def along(x):
        return np.sum(x * t, 1)[:, None] * t

    v = in_motion * V - F[:, :3]
    vt = np.sum(v * t, 1)
    G = G + 0.5 * rho * math.pi * d * tether.drag_tangential * np.sqrt(lam) * (np.sign(vt.real) * vt**2)[:, None] * t
    if rho:
        G = G + 0.5 * rho * d * tether.drag_normal * np.sqrt(lam) * stretched(v - along(v))
    w = added * V_t - (displaced + added) * F[:, 3:]
    G = G + w - along(w)
    e = elements(scene)[:, None] / 2
    parts = [
        V[0],
        V[1:] - V[:-1] - e * (q_t[1:] + q_t[:-1]),
        N[1:] - N[:-1] - e * (G[1:] + G[:-1]),
        _upper_end(scene, cv, in_motion, N[-1], V[-1], C_tilde[-1, 3:], F[-1]),
    ]
    if EI == 0:
        return np.concatenate([part.ravel() for part in parts])
    # M_s + o x M + (1+eps)^3 t x N = 0 in axes that turn with o = (0, O2, O3), M = (GI O1, EI O2, EI O3)
    moment, o = turn * [GI, EI, EI], turn * [0, 1, 1]
    load = np.cross(o, moment) + lam**3 * np.cross([1.0, 0, 0], np.concatenate([0 * S[:, :1], S], 1))
    parts += [
        turns(Y[:, 6:10]) - e * (o[1:] + o[:-1]),
        moment[1:] - moment[:-1] + e * (load[1:] + load[:-1]),
        _clamp_or_hinge(scene.anchor, scene, turn[0], A[0], 2 * e[0, 0], 1.0),
        _clamp_or_hinge(end, scene, turn[-1], A[-1], 2 * e[-1, 0], -1.0),
    ]
    if scene.anchor.rotation == end.rotation == "clamped":
        parts.append(np.array([roll(Y, scene) + turn[-1, 0] * tether.length_m - twist]))
    else:
        parts.append(turn[-1:, 0])
    return np.concatenate([part.ravel() for part in parts])


def direction(clamp, scene):
    """Unit vector of a clamp: its own, or towards a held end."""
    vector = np.array(clamp.direction or scene.end.position_m, float)
    return vector / np.linalg.norm(vector)


def _clamp_or_hinge(clamp, scene, turn, frame, h, sign):
    """No moment, or a spring of stiffness EI CLAMP/h that turns t into the direction d: O = sign k (0, d.b, -d.n)."""
    if clamp.rotation == "pinned":
        return turn[1:]
    d = direction(clamp, scene)
    return turn[1:] - sign * CLAMP / h * np.array([frame[2] @ d, -(frame[1] @ d)])


def roll(Y, scene):
    """Angle, in (-2 pi, 2 pi), about the tangent from the first frame, carried to the upper clamp by way of the chord,
    to the last one; two frames that look alike may differ by 2 pi."""
    chord = np.array(scene.end.position_m) / np.linalg.norm(scene.end.position_m)
    carried = Y[:1, 6:10]
    for u, v in ((direction(scene.anchor, scene), chord), (chord, direction(scene.end, scene))):
        shortest = np.append(1 + u @ v, np.cross(u, v))
        carried = product((shortest / np.linalg.norm(shortest))[None], carried)
    r = product(carried * [1, -1, -1, -1], Y[-1:, 6:10])[0]
    return 2 * np.arctan(r[1] / r[0]) + (math.copysign(2 * math.pi, r[1].real) if r[0].real < 0 else 0.0)


def _upper_end(scene, cv, in_motion, N, V, V_tilde, F):
    end, buoy = scene.end, scene.buoy
    if end.kind == "held":
        return V
    if end.kind == "free":
        return N - np.array(end.force_N)
    rho = scene.water.density_kgpm3 if scene.water is not None else 0.0
    volume = math.pi * buoy.diameter_m**3 / 6
    added = buoy.added_mass_kg if rho else 0.0
    v = (in_motion * V - F[:3])[None]
    drag = 0.5 * rho * buoy.drag * math.pi * buoy.diameter_m**2 / 4 * stretched(v)[0] if rho else 0.0
    lift = (rho * volume - buoy.mass_kg) * scene.gravity_mps2
    inertia = (buoy.mass_kg + added) * cv * (V - V_tilde)
    return N + inertia + drag - (rho * volume + added) * F[3:] - np.array([0, 0, lift])


def product(a, b):
    """Quaternion product (m, 4)."""
    scalar = a[:, :1] * b[:, :1] - np.sum(a[:, 1:] * b[:, 1:], 1, keepdims=True)
    vector = a[:, :1] * b[:, 1:] + b[:, :1] * a[:, 1:] + np.cross(a[:, 1:], b[:, 1:])
    return np.concatenate([scalar, vector], 1)


def moved(Y, D):
    """State Y (n, 13) moved by a small update D (n, 12), to first order in D: beta o (1, theta/2)."""
    half = np.concatenate([np.ones((len(D), 1)), 0.5 * D[:, 6:9]], 1)
    return np.concatenate([Y[:, :6] + D[:, :6], product(Y[:, 6:10], half), Y[:, 10:] + D[:, 9:]], 1)


def unknowns(scene):
    """Columns of D that are unknown."""
    return list(range(12)) if scene.tether.bending_stiffness_Nm2 > 0 else [0, 3, 4, 5, 7, 8]


def equations(scene, stage, Y, D, C_tilde, F, twist=0.0):
    """Residual at Y moved by D; with bending one row more, that the first frame does not roll: theta1 = 0 there."""
    r = residual(scene, *stage, moved(Y, D), C_tilde, F, twist)
    return np.append(r, D[0, 6]) if scene.tether.bending_stiffness_Nm2 > 0 else r


def jacobian(scene, stage, Y, C_tilde, F):
    """d equations / d D at D = 0, by complex step; unknowns node by node."""
    columns = []
    for k in range(len(Y)):
        for i in unknowns(scene):
            D = np.zeros((len(Y), 12), complex)
            D[k, i] = 1e-30j
            columns.append(equations(scene, stage, Y, D, C_tilde, F).imag / 1e-30)
    return np.array(columns).T
