"""The planar box equations written out in plain NumPy from their statements, for tests that must not trust a kernel.

Everything takes complex arguments, so that a complex step differentiates it to rounding: |x| is sign(Re x) x.
Statements: THEORY.md, sections 3-5, and the heads of planar/elimination.py, planar/node.py, engine/physics/ends.py.
"""

import math

import numpy as np
from scipy.interpolate import PchipInterpolator

from engine.parameters import record_of
from engine.planar.elimination import WIDTH as SWEEP_WIDTH
from engine.planar.elimination import sweep_bent
from engine.planar.elimination_unbent import sweep_unbent
from engine.planar.node import WIDTH, node_quantities, shape


def kernel_update(scene, cq, cv, in_motion, Y, C_tilde, F, viscosity=None):
    """The engine's Newton update (n, 6) at a state, with the water F (n, 4) and the viscosity (n, 2) frozen."""
    tables = []
    p = record_of(scene, tables)[0]
    tables = np.concatenate(tables)
    n = len(Y)
    Q, X, E, D = np.zeros((n, WIDTH)), np.zeros((n, 2)), np.zeros((n, SWEEP_WIDTH)), np.zeros((n, 6))
    if viscosity is not None:
        Q[:, -2:] = viscosity
    shape(p, tables, Y, Q, X)
    node_quantities(p, tables, cq, cv, in_motion, Y, C_tilde, F, Q)
    sweep = sweep_bent if scene.tether.bending_stiffness_Nm2 > 0 else sweep_unbent
    assert sweep(p, tables, 0.0, cq, cv, in_motion, Y, C_tilde, X, F, Q, E, D)
    return D


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
    knots = np.asarray(law.strain)
    inside = np.clip(eps.real, knots[0], knots[-1])
    at = np.clip(np.searchsorted(knots, inside, side="right") - 1, 0, len(knots) - 2)
    outside = eps.real != inside
    d = np.where(outside, inside, eps) - knots[at]
    value = sum(pieces.c[i, at] * d ** (3 - i) for i in range(4))
    return np.where(outside, value + pieces.derivative()(inside) * (eps - inside), value)


def square(x):
    """|x| x."""
    return np.sign(x.real) * x * x


def residual(scene, cq, cv, in_motion, Y, C_tilde, F, viscosity=None):
    """All equations as one vector: 6 n of them with bending; without, 4 n.

    Y (n, 6) = eps, S, U, W, phi, kappa;  C_tilde (n, 4) = q~, V~;  F (n, 4) water velocity and acceleration;
    viscosity (n, 2) = B, L of T_v = B |e_t| e_t + L e_t, e_t = cq (1 + eps - |q~|) in motion.
    """
    tether = scene.tether
    bent = tether.bending_stiffness_Nm2 > 0
    eps, S, U, W, phi, kappa = Y.T
    if not bent:
        S = kappa = np.zeros_like(eps)
    lam = 1 + eps
    t = np.stack([np.cos(phi), np.sin(phi)], 1)
    n = np.stack([-np.sin(phi), np.cos(phi)], 1)
    V = np.stack([U, W], 1)
    q_t = cq * (lam[:, None] * t - C_tilde[:, :2])
    V_t = cv * (V - C_tilde[:, 2:])
    T = tension(tether.tension, eps)
    if viscosity is not None:
        e_t = in_motion * cq * (lam - np.hypot(*C_tilde[:, :2].T))
        T = T + viscosity[:, 0] * square(e_t) + viscosity[:, 1] * e_t
    N = T[:, None] * t + S[:, None] * n
    rho = scene.water.density_kgpm3 if scene.water is not None else 0.0
    g = scene.gravity_mps2
    weight = (tether.density_kgpm3 - rho) * tether.area_m2 * g
    G = tether.density_kgpm3 * tether.area_m2 * V_t + np.array([0, weight])
    d = tether.diameter_m
    displaced = rho * math.pi * d**2 / 4
    added = tether.added_mass * displaced
    v = in_motion * V - F[:, :2]
    along, across = np.sum(v * t, 1), np.sum(v * n, 1)
    a = 0.5 * rho * math.pi * d * tether.drag_tangential * np.sqrt(lam) * square(along)
    b = 0.5 * rho * d * tether.drag_normal * np.sqrt(lam) * square(across)
    b = b + added * np.sum(n * V_t, 1) - (displaced + added) * np.sum(n * F[:, 2:], 1)
    G = G + a[:, None] * t + b[:, None] * n
    e = elements(scene)[:, None] / 2
    parts = [
        V[0],
        V[1:] - V[:-1] - e * (q_t[1:] + q_t[:-1]),
        N[1:] - N[:-1] - e * (G[1:] + G[:-1]),
        _upper_end(scene, cv, in_motion, N[-1], V[-1], C_tilde[-1, 2:], F[-1]),
    ]
    curvature = phi[1:] - phi[:-1] - e[:, 0] * (kappa[1:] + kappa[:-1])
    if bent:
        M = lam**3 * S
        moment = tether.bending_stiffness_Nm2 * (kappa[1:] - kappa[:-1]) + e[:, 0] * (M[1:] + M[:-1])
        parts += [kappa[:1], curvature, moment, kappa[-1:]]
    return np.concatenate([part.ravel() for part in parts])


def _upper_end(scene, cv, in_motion, N, V, V_tilde, F):
    end, buoy = scene.end, scene.buoy
    if end.kind == "held":
        return V  # position: the last node does not move
    if end.kind == "free":
        return N - np.array([end.force_N[0], end.force_N[2]])
    rho = scene.water.density_kgpm3 if scene.water is not None else 0.0
    volume = math.pi * buoy.diameter_m**3 / 6
    added = buoy.added_mass_kg if rho else 0.0
    v = in_motion * V - F[:2]
    drag = 0.5 * rho * buoy.drag * math.pi * buoy.diameter_m**2 / 4 * np.sqrt(np.sum(v * v)) * v
    lift = (rho * volume - buoy.mass_kg) * scene.gravity_mps2
    return N + (buoy.mass_kg + added) * cv * (V - V_tilde) + drag - (rho * volume + added) * F[2:] - np.array([0, lift])


def unknowns(scene):
    """Columns of Y that are unknown."""
    return [0, 1, 2, 3, 4, 5] if scene.tether.bending_stiffness_Nm2 > 0 else [0, 2, 3, 4]


def jacobian(scene, cq, cv, in_motion, Y, C_tilde, F, viscosity=None):
    """d residual / d Y[:, unknowns], by complex step; unknowns node by node."""
    columns = []
    for k in range(len(Y)):
        for i in unknowns(scene):
            Z = Y.astype(complex)
            Z[k, i] += 1e-30j
            columns.append(residual(scene, cq, cv, in_motion, Z, C_tilde, F, viscosity).imag / 1e-30)
    return np.array(columns).T
