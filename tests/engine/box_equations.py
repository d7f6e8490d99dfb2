"""The box equations written out in plain NumPy from their statements, for tests that must not trust a kernel.

They are those in space; in a plane x-z the same equations are asked of a state whose n lies in it, and the rows across
the plane, which say nothing then, are left out. The elimination is never looked at here: the rotation between nodes
comes from 3 x 3 matrices, and O1 is an unknown of every node. Everything takes complex arguments, so that a complex
step differentiates it to rounding: |x| is sign(Re x) x. Statements: THEORY.md, sections 3 to 6.
"""

import math

import numpy as np
from scipy.interpolate import PchipInterpolator

from engine.spatial.upper import CLAMP
from tests.engine.rotations import conjugate, frames, product, shortest

STEP = 1e-30
LAWS = {  # of tension, as a scene has them
    "linear": {"law": "linear", "stiffness_N": 5e4},
    "tanh": {"law": "tanh", "p": [2.0e4, 5.0, 0.3, -5.0e3, 1.0e4]},
    "tabulated": {"law": "tabulated", "strain": [-0.2, 0.0, 0.1, 0.3], "tension_N": [-500.0, 0.0, 3e3, 2e4]},
}


def elements(scene):
    """Element lengths: s = L/2 (1 + tanh(b (2 xi - 1))/tanh b) at even xi, or even s."""
    tether = scene.tether
    xi = np.linspace(0, 1, tether.nodes)
    b = tether.grid_stretching
    return tether.length_m * np.diff(xi if b == 0 else 0.5 * (1 + np.tanh(b * (2 * xi - 1)) / np.tanh(b)))


def tension(law, eps):
    """T(eps), N, for the three laws."""
    if law.law == "linear":
        return law.stiffness_N * eps
    if law.law == "tanh":
        p1, p2, p3, p4, p5 = law.p
        return p1 * np.tanh(p2 * eps + p3) + p4 + p5 * eps
    pieces = PchipInterpolator(law.strain, law.tension_N)
    at = np.clip(eps.real, law.strain[0], law.strain[-1])
    return pieces(at) + pieces.derivative()(at) * (eps - at)  # a complex step, or the way along an end tangent


def stretched(x):
    """|x| x for vectors (m, 3)."""
    return np.sqrt(np.sum(x * x, 1))[:, None] * x


def along(x, t):
    """The part of vectors x (m, 3) along the unit vectors t."""
    return np.sum(x * t, 1)[:, None] * t


def share_across(tether, v):
    """Share of the normal drag coefficient left at the velocities v (m, 3): the law of docs/scenes.md."""
    law = tether.drag
    if law is None:
        return 1.0
    Re = np.sqrt(np.sum(v * v, 1))[:, None] * tether.diameter_m / law.viscosity_m2ps
    x = (Re / law.critical) ** 4
    return 1 - law.drop * x / (1 + x)


def water_on_line(scene, lam, t, v, V_t, A):
    """Drag and fluid inertia (m, 3) per length of line (N/m): lam (m, 1) = 1 + eps, v = V - U, accelerations V_t, A."""
    tether, rho = scene.tether, scene.water.density_kgpm3 if scene.water is not None else 0.0
    if not rho:
        return 0 * V_t, 0 * V_t
    d = tether.diameter_m
    displaced = rho * math.pi * d**2 / 4
    added = tether.added_mass * displaced
    vt = np.sum(v * t, 1)
    friction = math.pi * tether.drag_tangential * (np.sign(vt.real) * vt**2)[:, None] * t
    across = v - along(v, t)
    normal = tether.drag_normal * share_across(tether, across) * stretched(across)
    drag = -0.5 * rho * d * np.sqrt(lam) * (friction + normal)
    push = (displaced + added) * A - added * V_t
    return drag, push - along(push, t)


def wet_weight(scene):
    """Weight in water of a metre of line (N/m), upwards negative: the vector (0, 0, w0)."""
    tether, rho = scene.tether, scene.water.density_kgpm3 if scene.water is not None else 0.0
    return np.array([0, 0, (tether.density_kgpm3 - rho) * tether.area_m2 * scene.gravity_mps2])


def buoy_of(scene):
    """Inertia (kg) of the buoy with its added mass, its net lift (3,), and functions of v = V - U and of A (3,): drag
    and wave load (3,)."""
    buoy, rho = scene.buoy, scene.water.density_kgpm3 if scene.water is not None else 0.0
    volume = math.pi * buoy.diameter_m**3 / 6
    added = buoy.added_mass_kg if rho else 0.0
    area = math.pi * buoy.diameter_m**2 / 4
    lift = np.array([0, 0, (rho * volume - buoy.mass_kg) * scene.gravity_mps2])

    def drag(v):
        return -0.5 * rho * buoy.drag * area * stretched(v[None])[0] if rho else 0 * v

    return buoy.mass_kg + added, lift, drag, lambda A: (rho * volume + added) * A


def lifted(Y):
    """State (n, 13) of one in the plane (n, 6): t = (cos phi, 0, sin phi), n = (-sin phi, 0, cos phi)."""
    out = np.zeros((len(Y), 13), Y.dtype)
    out[:, [0, 1, 3, 5, 12]] = Y[:, [0, 1, 2, 3, 5]]
    upright = np.zeros((len(Y), 4), Y.dtype)
    upright[:, 0], upright[:, 2] = np.cos(Y[:, 4] / 2), -np.sin(Y[:, 4] / 2)
    quarter = np.tile([math.sqrt(0.5), math.sqrt(0.5), 0.0, 0.0], (len(Y), 1))  # about x, from y to z
    out[:, 6:10] = product(upright, quarter)
    return out


def across(pairs):
    """Pairs of planar vectors (m, 4) as pairs in space (m, 6)."""
    return np.insert(pairs, [1, 3], 0.0, axis=1)


def turns(beta):
    """Rotation vectors (m - 1, 3) from each frame to the next in their own axes, |psi| < pi, by the matrices alone."""
    A = frames(beta)
    R = np.einsum("kia,kja->kij", A[:-1], A[1:])  # of frame a to frame b, in axes of a
    axis = 0.5 * np.stack([R[:, 2, 1] - R[:, 1, 2], R[:, 0, 2] - R[:, 2, 0], R[:, 1, 0] - R[:, 0, 1]], 1)
    sine, cosine = np.sqrt(np.sum(axis**2, 1)), 0.5 * (np.trace(R, axis1=1, axis2=2) - 1)
    angle = np.arcsin(sine)
    angle = np.where(cosine.real < 0, math.pi - angle, angle)
    straight = sine == 0
    return np.where(straight, 1.0, angle / np.where(straight, 1.0, sine))[:, None] * axis


def residual(scene, cq, cv, in_motion, Y, C_tilde, F, viscosity=None, twist=0.0):
    """All equations of a stage as one vector: 6 n in a plane and 12 n - 1 in space; without bending 4 n and 6 n.

    Y (n, 6) or (n, 13) = eps, Sn, Sb, V, beta, O;  C_tilde = q~, V~;  F: water velocity and acceleration;
    viscosity (n, 2) = B, L of T_v = B |e_t| e_t + L e_t, e_t = cq (1 + eps - |q~|) in motion.
    """
    tether, end, plane = scene.tether, scene.end, scene.motion.dimensions == 2
    if plane:
        Y, C_tilde, F = lifted(Y), across(C_tilde), across(F)
    EI, GI = tether.bending_stiffness_Nm2, tether.torsion_stiffness_Nm2
    eps, S, V, turn = Y[:, 0], Y[:, 1:3], Y[:, 3:6], Y[:, 10:13]
    if EI == 0:
        S = np.zeros_like(S)
    lam = (1 + eps)[:, None]
    A = frames(Y[:, 6:10])
    t, n, b = A[:, 0], A[:, 1], A[:, 2]
    q_t = cq * (lam * t - C_tilde[:, :3])
    V_t = cv * (V - C_tilde[:, 3:])
    T = tension(tether.tension, eps)
    if viscosity is not None:
        e_t = in_motion * cq * (1 + eps - np.linalg.norm(C_tilde[:, :3], axis=1))
        T = T + viscosity[:, 0] * np.sign(e_t.real) * e_t**2 + viscosity[:, 1] * e_t
    N = T[:, None] * t + S[:, :1] * n + S[:, 1:] * b
    drag, push = water_on_line(scene, lam, t, in_motion * V - F[:, :3], V_t, F[:, 3:])
    G = tether.density_kgpm3 * tether.area_m2 * V_t + wet_weight(scene) - drag - push
    e = elements(scene)[:, None] / 2
    parts = [
        V[0],
        V[1:] - V[:-1] - e * (q_t[1:] + q_t[:-1]),
        N[1:] - N[:-1] - e * (G[1:] + G[:-1]),
        _upper_end(scene, in_motion, N[-1], V[-1], V_t[-1], F[-1]),
    ]
    if plane:
        parts = [part[..., [0, 2]] for part in parts]
    if EI == 0:
        return np.concatenate([part.ravel() for part in parts])
    # M_s + o x M + (1+eps)^3 t x N = 0 in axes that turn with o = (0, O2, O3), M = (GI O1, EI O2, EI O3)
    moment, o = turn * [GI, EI, EI], turn * [0, 1, 1]
    load = np.cross(o, moment) + lam**3 * np.cross([1.0, 0, 0], np.concatenate([0 * S[:, :1], S], 1))
    rotations = [
        turns(Y[:, 6:10]) - e * (o[1:] + o[:-1]),
        moment[1:] - moment[:-1] + e * (load[1:] + load[:-1]),
        _clamp_or_hinge(scene.anchor, scene, turn[0], A[0], 2 * e[0, 0], 1.0),
        _clamp_or_hinge(end, scene, turn[-1], A[-1], 2 * e[-1, 0], -1.0),
    ]
    if plane:
        return np.concatenate([part.ravel() for part in (*parts, *(part[..., -1] for part in rotations))])
    twisted = scene.anchor.rotation == end.rotation == "clamped"
    last = roll(Y, scene) + turn[-1, 0] * tether.length_m - twist if twisted else turn[-1, 0]
    return np.concatenate([*(part.ravel() for part in (*parts, *rotations)), [last]])


def _upper_end(scene, in_motion, N, V, V_t, F):
    if scene.end.kind == "held":
        return V  # position: the last node does not move
    if scene.end.kind == "free":
        return N - np.array(scene.end.force_N)
    mass, lift, drag, load = buoy_of(scene)
    return N + mass * V_t - lift - drag(in_motion * V - F[:3]) - load(F[3:])


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
    moved = Y[:1, 6:10]
    for u, v in ((direction(scene.anchor, scene), chord), (chord, direction(scene.end, scene))):
        moved = product(shortest(u, v), moved)
    r = product(conjugate(moved), Y[-1:, 6:10])[0]
    return 2 * np.arctan(r[1] / r[0]) + (math.copysign(2 * math.pi, r[1].real) if r[0].real < 0 else 0.0)


def moved(Y, D):
    """State Y moved by a small update D (n, 6) or (n, 12), to first order in D: beta o (1, theta/2)."""
    if Y.shape[1] == 6:
        return Y + D
    half = np.concatenate([np.ones((len(D), 1)), 0.5 * D[:, 6:9]], 1)
    return np.concatenate([Y[:, :6] + D[:, :6], product(Y[:, 6:10], half), Y[:, 10:] + D[:, 9:]], 1)


def change_of(Y, D):
    """Change (n, 4) in a plane or (n, 6) in space of (q, V) under a small update D of a state Y."""
    Z = moved(Y.astype(complex), 1j * STEP * D)
    Z = lifted(Z) if Y.shape[1] == 6 else Z
    change = np.hstack([(1 + Z[:, :1]) * frames(Z[:, 6:10])[:, 0], Z[:, 3:6]]).imag / STEP
    return change[:, [0, 2, 3, 5]] if Y.shape[1] == 6 else change


def unknowns(scene):
    """Columns of D that are unknown."""
    bent = scene.tether.bending_stiffness_Nm2 > 0
    if scene.motion.dimensions == 2:
        return [0, 1, 2, 3, 4, 5] if bent else [0, 2, 3, 4]
    return list(range(12)) if bent else [0, 3, 4, 5, 7, 8]


def equations(scene, stage, Y, D, C_tilde, F, **settings):
    """Residual at Y moved by D, stage = (cq, cv, in_motion); in space with bending one row more: theta1 of the first
    frame is zero, it does not roll."""
    r = residual(scene, *stage, moved(Y, D), C_tilde, F, **settings)
    return np.append(r, D[0, 6]) if D.shape[1] == 12 and scene.tether.bending_stiffness_Nm2 > 0 else r


def jacobian(scene, stage, Y, C_tilde, F, **settings):
    """d equations / d D at D = 0, by complex step; unknowns node by node."""
    columns = []
    for k in range(len(Y)):
        for i in unknowns(scene):
            D = np.zeros((len(Y), 6 if scene.motion.dimensions == 2 else 12), complex)
            D[k, i] = 1j * STEP
            columns.append(equations(scene, stage, Y, D, C_tilde, F, **settings).imag / STEP)
    return np.array(columns).T


def response(scene, rate, Y, C_tilde, F, dC_tilde):
    """Change (n, 6) of (q, V) in space of a linearised stage for a change dC_tilde (n, 6) of C~."""
    stage = rate, rate, 1.0
    change = equations(scene, stage, Y, np.zeros((len(Y), 12)), C_tilde + 1j * STEP * dC_tilde, F).imag / STEP
    return change_of(Y, np.linalg.solve(jacobian(scene, stage, Y, C_tilde, F), -change).reshape(len(Y), -1))


def state_of(rng, scene, turns):
    """A state with every term of the equations at work: strain of both signs, shear, motion, water; torsion where both
    ends are clamped. turns: phi (n,) of a state in the plane, or Euler parameters (n, 4). Returns Y, C~ and F; they
    solve nothing."""
    n, bent = scene.tether.nodes, scene.tether.bending_stiffness_Nm2 > 0
    strain, V = rng.uniform(-0.15, 0.35, n), rng.normal(0, 2, (n, 3))
    shear, curvature = rng.normal(0, 300, (n, 2)) * bent, rng.normal(0, 1, (n, 2)) * bent
    if turns.ndim == 1:
        V = V[:, [0, 2]]
        Y = np.column_stack([strain, shear[:, 0], V, turns, curvature[:, 0]])
        t = np.column_stack([np.cos(turns), np.sin(turns)])
    else:
        Y = np.column_stack([strain, shear, V, turns, np.zeros(n), curvature])
        t = frames(turns)[:, 0]
        if scene.anchor.rotation == scene.end.rotation == "clamped":
            # 0.3 rad more than the twist: Euler parameters know the rest of a whole number of double turns only
            Y[:, 10] = (scene.end.twist_rad + 0.3 - roll(Y, scene)) / scene.tether.length_m
    C_tilde = np.concatenate([(1 + strain[:, None]) * t, V], 1)
    C_tilde += rng.normal(0, 0.02, C_tilde.shape)
    return Y, C_tilde, rng.normal(0, 1.5, C_tilde.shape) * (scene.water is not None)
