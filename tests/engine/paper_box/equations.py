"""The equations of the paper at nodes, in vectors, with no entry of appendix A: what the scheme must be equal to.

The momentum (12), moments (16), compatibility (19) and beta_s, with Morison's force (23)-(24) (the fluid pushes with +)
in component rates, solved for dY/ds; states Y (13, n) of the unknowns (22) with any |beta|, real or complex. Axis 1 of
the paper's fixed axes is up.
"""

import numpy as np

from engine import load_scene
from tests.engine.box_equations import LAWS, buoy_of, tension, water_on_line, wet_weight
from tests.engine.rotations import conjugate, product

TO_XYZ, FROM_XYZ = [1, 2, 0], [2, 0, 1]  # x, y, z from the paper's axes, and back
TANGENT = np.array([1.0, 0.0, 0.0])
SLOPE_STEP = 1e-40


def scene_of(law="linear", dimensions=3, **overrides):
    return load_scene(
        "tethered_buoy",
        {
            "motion.dimensions": dimensions,
            "solver.scheme": "paper-box",
            "tether.tension": LAWS[law],
            "tether.nodes": 5,
            "tether.diameter_m": 0.05,
            "tether.bending_stiffness_Nm2": 24.0,
            "tether.torsion_stiffness_Nm2": 9.0,
            **overrides,
        },
    )


def states(seed, n, unit=True):
    """Y (13, n) with strain of both signs, shear, motion, bends and twist, and water (6, n)."""
    rng = np.random.default_rng(seed)
    Y = np.empty((13, n))
    Y[0] = rng.uniform(-0.15, 0.25, n)
    Y[1:3] = rng.normal(0, 300, (2, n))
    Y[3:6] = rng.normal(0, 2, (3, n))
    Y[6:10] = rng.normal(0, 1, (4, n))
    if unit:
        Y[6:10] /= np.linalg.norm(Y[6:10], axis=0)
    Y[10:13] = rng.normal(0, 1, (3, n))
    return Y, rng.normal(0, 1.5, (6, n))


def slope(law, eps):
    """f' at complex strains: exact to rounding, its imaginary part by differences."""

    def real(strain):
        return tension(law, strain + 1j * SLOPE_STEP).imag / SLOPE_STEP

    return real(eps.real) + 1j * eps.imag * (real(eps.real + 1e-5) - real(eps.real - 1e-5)) / 2e-5


def scalar(vectors):
    """Quaternions (n, 4) of vectors (n, 3)."""
    return np.insert(vectors, 0, 0.0, axis=1)


def turned(a, vectors, b):
    """Vector part of a* o G o b, (n, 3): C G where a and b are the Euler parameters (n, 4) of a frame."""
    return product(product(conjugate(a), scalar(vectors)), b)[:, 1:]


def in_fixed_axes(Y, local):
    """C' g, (3, n), of local components g (3, n)."""
    beta = conjugate(Y[6:10].T)
    return turned(beta, local.T, beta).T


def space_derivatives(scene, Y, rate, water):
    """dY/ds (13, n) of states Y with dY/dt = rate, (13, n), in water (6, n): velocity and local acceleration."""
    tether = scene.tether
    eps, V, beta, Omega = Y[0], Y[3:6].T, Y[6:10].T, Y[10:13].T
    T = np.stack([tension(tether.tension, eps + 0j), Y[1], Y[2]], 1)
    V_t, beta_t, lam = rate[3:6].T, rate[6:10].T, (1 + eps)[:, None]
    omega = 2 * product(conjugate(beta), beta_t)[:, 1:]
    U, U_t = turned(beta, water[:3].T, beta), turned(beta, water[3:].T, beta)
    U_t = U_t + turned(beta_t, water[:3].T, beta) + turned(beta, water[:3].T, beta_t)  # component rates, as in (24)
    drag, push = water_on_line(scene, lam, TANGENT, V - U, V_t, U_t)
    weight = turned(beta, -np.tile(wet_weight(scene)[FROM_XYZ], (len(eps), 1)), beta)
    m = tether.density_kgpm3 * tether.area_m2
    T_s = m * (V_t + np.cross(omega, V)) - np.cross(Omega, T) - drag - push - weight
    T_s[:, 0] /= slope(tether.tension, eps)
    V_s = rate[0][:, None] * TANGENT + lam * np.cross(omega, TANGENT) - np.cross(Omega, V)
    beta_s = product(beta, scalar(Omega)) / 2
    stiffness = np.array([tether.torsion_stiffness_Nm2, *2 * [tether.bending_stiffness_Nm2]])
    M_s = -np.cross(Omega, stiffness * Omega) - lam**3 * np.cross(TANGENT, T)
    return np.concatenate([T_s, V_s, beta_s, M_s / stiffness], 1).T


def upper_end(scene, dt, Y, Y_old, water, water_old):
    """Equations (3,) of the upper end after a step of dt from Y_old (13, 1) to Y, in the paper's axes."""
    N, V = _force_and_velocity(scene, Y)
    if scene.end.kind == "held":
        return V
    if scene.end.kind == "free":
        return N - np.array(scene.end.force_N)[FROM_XYZ]
    mass, lift, drag, load = buoy_of(scene)
    N_old, V_old = _force_and_velocity(scene, Y_old)

    def balance(N, V, U):
        return N - (lift + drag((V - U[:3])[TO_XYZ]) + load(U[3:][TO_XYZ]))[FROM_XYZ]

    return mass * (V - V_old) / dt + 0.5 * (balance(N, V, water[:, 0]) + balance(N_old, V_old, water_old[:, 0]))


def _force_and_velocity(scene, Y):
    """N and V, (3,) each, of the last node in the paper's axes."""
    T = tension(scene.tether.tension, Y[0] + 0j)
    return (in_fixed_axes(Y, local)[:, 0] for local in (np.array([T, Y[1], Y[2]]), Y[3:6]))
