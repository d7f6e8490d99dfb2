"""The box equations in space written out in plain NumPy, with Euler parameters.

Unknowns of a node, Z (n, 12): eps, S_n, S_b | V (3) | a rotation vector theta of the frame (t, n, b), in its own axes,
away from the plane frame of angle phi | Omega (3). The rotation across a box is
2 log(beta_a* o beta_b) = e (Omega_a + Omega_b).
Axes: x along the waves, y across, z up; in the plane t = (cos phi, 0, sin phi), n = (-sin phi, 0, cos phi), b = -y.
Everything takes complex arguments, so that a complex step differentiates it to rounding.
"""

import math

import numpy as np

from tests.engine.box_equations import elements, square, tension

WIDTH = 12


def product(a, b):
    """Quaternion product, scalar first, rows (m, 4)."""
    w = a[:, :1] * b[:, :1] - np.sum(a[:, 1:] * b[:, 1:], 1, keepdims=True)
    return np.hstack([w, a[:, :1] * b[:, 1:] + b[:, :1] * a[:, 1:] + np.cross(a[:, 1:], b[:, 1:])])


def even(series, plain, x2):
    """A function of x^2: its power series near zero, where the plain form has 0/0."""
    small = np.abs(x2) < 1e-8
    x = np.sqrt(np.where(small, 1.0, x2))
    return np.where(small, sum(c * x2**i for i, c in enumerate(series)), plain(x))


def exponential(theta):
    """Euler parameters of rotation vectors (m, 3)."""
    quarter = np.sum(theta * theta, 1, keepdims=True) / 4
    half_sinc = 0.5 * even((1, -1 / 6), lambda x: np.sin(x) / x, quarter)
    return np.hstack([even((1, -1 / 2), np.cos, quarter), half_sinc * theta])


def logarithm(beta):
    """Rotation vectors of Euler parameters with beta_0 > 0."""
    ratio = beta[:, 1:] / beta[:, :1]
    return 2 * ratio * even((1, -1 / 3), lambda x: np.arctan(x) / x, np.sum(ratio * ratio, 1, keepdims=True))


def frame(phi):
    """Euler parameters of the plane frame: columns t, n, b of its matrix."""
    b = np.zeros((len(phi), 4), dtype=phi.dtype)
    # (x, y, z) -> (t, n, b): a quarter turn about x takes y to z, then -phi about y turns x towards z
    b[:, 0], b[:, 2] = np.cos(phi / 2), -np.sin(phi / 2)
    quarter = np.zeros_like(b)
    quarter[:, 0] = quarter[:, 1] = math.sqrt(0.5)
    return product(b, quarter)


def rotate(beta, v):
    """Vectors of the frame in fixed axes."""
    w, u = beta[:, :1], beta[:, 1:]
    stretch, along = w * w - np.sum(u * u, 1, keepdims=True), np.sum(u * v, 1, keepdims=True)
    return stretch * v + 2 * (along * u + w * np.cross(u, v))


def residual(scene, GI, rate, phi, Z, C_tilde, F):
    """All 12 n equations of a stage as one vector.

    phi (n,), Z (n, 12): state;  C_tilde (n, 6) = q~, V~;  F (n, 6): water velocity and acceleration;  GI: N m2.
    """
    tether, EI = scene.tether, scene.tether.bending_stiffness_Nm2
    eps, Sn, Sb = Z[:, 0], Z[:, 1], Z[:, 2]
    V, theta, Omega = Z[:, 3:6], Z[:, 6:9], Z[:, 9:]
    beta = product(frame(phi), exponential(theta))
    t, n, b = (rotate(beta, np.tile(axis, (len(Z), 1))) for axis in np.eye(3))
    lam = 1 + eps
    q_t = rate * (lam[:, None] * t - C_tilde[:, :3])
    V_t = rate * (V - C_tilde[:, 3:])
    N = tension(tether.tension, eps)[:, None] * t + Sn[:, None] * n + Sb[:, None] * b
    rho = scene.water.density_kgpm3 if scene.water is not None else 0.0
    d = tether.diameter_m
    displaced = rho * math.pi * d**2 / 4
    added = tether.added_mass * displaced
    weight = (tether.density_kgpm3 - rho) * tether.area_m2 * scene.gravity_mps2
    v = V - F[:, :3]
    along = np.sum(v * t, 1)
    across = v - along[:, None] * t
    inertia = added * V_t - (displaced + added) * F[:, 3:]
    G = tether.density_kgpm3 * tether.area_m2 * V_t + np.array([0, 0, weight])
    G = G + inertia - np.sum(inertia * t, 1)[:, None] * t
    G = G + (0.5 * rho * math.pi * d * tether.drag_tangential * np.sqrt(lam) * square(along))[:, None] * t
    speed = np.sqrt(np.sum(across * across, 1) + 1e-300)
    G = G + (0.5 * rho * d * tether.drag_normal * np.sqrt(lam) * speed)[:, None] * across
    e = elements(scene)[:, None] / 2
    opposite = beta * np.array([1, -1, -1, -1])
    turned = logarithm(product(opposite[:-1], beta[1:]))
    bending = np.stack(
        [
            np.zeros_like(eps),
            -((EI - GI) * Omega[:, 0] * Omega[:, 2] + lam**3 * Sb),
            (EI - GI) * Omega[:, 0] * Omega[:, 1] + lam**3 * Sn,
        ],
        1,
    )
    parts = [
        *(V[0], Omega[0, 1:], theta[0, :1]),
        V[1:] - V[:-1] - e * (q_t[1:] + q_t[:-1]),
        N[1:] - N[:-1] - e * (G[1:] + G[:-1]),
        turned - e * (Omega[1:] + Omega[:-1]),
        np.array([GI, EI, EI]) * (Omega[1:] - Omega[:-1]) + e * (bending[1:] + bending[:-1]),
        *(upper_end(scene, rate, N[-1], V[-1], C_tilde[-1, 3:], F[-1]), Omega[-1]),
    ]
    return np.concatenate([part.ravel() for part in parts])


def upper_end(scene, rate, N, V, V_tilde, F):
    """Three conditions of a buoy (30), a held or a free end."""
    end, buoy = scene.end, scene.buoy
    if end.kind == "held":
        return V
    if end.kind == "free":
        return N - np.array(end.force_N)
    rho = scene.water.density_kgpm3 if scene.water is not None else 0.0
    volume = math.pi * buoy.diameter_m**3 / 6
    added = buoy.added_mass_kg if rho else 0.0
    v = V - F[:3]
    drag = 0.5 * rho * buoy.drag * math.pi * buoy.diameter_m**2 / 4 * np.sqrt(np.sum(v * v)) * v
    lift = (rho * volume - buoy.mass_kg) * scene.gravity_mps2
    load = (rho * volume + added) * F[3:] + np.array([0, 0, lift])
    return N + (buoy.mass_kg + added) * rate * (V - V_tilde) + drag - load


def response(scene, GI, rate, phi, Z, C_tilde, F, dC_tilde):
    """(q, V) (n, 6) of the linearised stage about the state for a change dC_tilde (n, 6), by complex step."""
    n = len(Z)
    J = np.empty((n * WIDTH, n * WIDTH))
    for j in range(n * WIDTH):
        W = Z.astype(complex)
        W[j // WIDTH, j % WIDTH] += 1e-30j
        J[:, j] = residual(scene, GI, rate, phi, W, C_tilde, F).imag / 1e-30
    change = residual(scene, GI, rate, phi, Z.astype(complex), C_tilde + 1e-30j * dC_tilde, F).imag / 1e-30
    D = np.linalg.solve(J, -change).reshape(n, WIDTH)
    W = Z + 1e-30j * D
    t = rotate(product(frame(phi), exponential(W[:, 6:9])), np.tile([1.0, 0.0, 0.0], (n, 1)))
    return np.hstack([((1 + W[:, :1]) * t).imag, W[:, 3:6].imag]) / 1e-30
