"""One Newton update solves J D = -residual, with both from eq. (28) as it is printed.

The residual is the box rule of the equations of the paper at nodes, in vectors, with no entry of appendix A, and of the
conditions at the ends; J is its complex step. The water is frozen, as it is in the scheme's own Jacobian.

The momentum (12), moments (16), compatibility (19) and beta_s, with Morison's force (23)-(24) (the fluid pushes with +)
in component rates, solved for dY/ds; states Y (13, n) of the unknowns (22) with any |beta|, real or complex. Axis 1 of
the paper's fixed axes is up.
"""

import numpy as np
import pytest

from engine.paper_box.line import PLANE, SPACE, line_of
from engine.paper_box.newton import newton_update
from engine.paper_box.nodal import Level, P
from tests.engine.box_equations import LAWS, buoy_of, tension, water_on_line, wet_weight
from tests.engine.lines import free, held, line
from tests.engine.rotations import conjugate, product

TO_XYZ, FROM_XYZ = [1, 2, 0], [2, 0, 1]  # x, y, z from the paper's axes, and back
TANGENT = np.array([1.0, 0.0, 0.0])
SLOPE_STEP = 1e-40


def scene_of(law="linear", dimensions=3, **overrides):
    return line(
        {"motion.dimensions": dimensions, "solver.scheme": "paper-box"}, overrides, tension=LAWS[law], nodes=5,
        diameter_m=0.05, bending_stiffness_Nm2=24.0, torsion_stiffness_Nm2=9.0,
    )  # fmt: skip


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


DT, STEP = 0.01, 1e-30
ACROSS = [i for i in SPACE if i not in PLANE]
ENDS = {  # in space, in a plane
    "buoy": ({}, {}),
    "held": (held(3.0, 1.0, 18.0), held(3.0, 18.0)),
    "free": ({"end": {"kind": "free", "force_N": [300.0, -200.0, 900.0]}, "buoy": None}, free(300.0, 900.0)),
}


def printed_28(scene, h, Y, water, Y_old, water_old):
    """All residuals (13 n,): lower end, boxes of (28) over 2 dt, upper end. Y (13, n)."""
    rate = (Y - Y_old) / DT
    g = -0.5 * (space_derivatives(scene, Y, rate, water) + space_derivatives(scene, Y_old, rate, water_old))
    boxes = np.diff(Y) + np.diff(Y_old) + h * (g[:, 1:] + g[:, :-1])
    b, a = Y[6:10, 0], Y_old[6:10, 0]
    below = [*Y[3:6, 0], b @ b - 1, -a[1] * b[0] + a[0] * b[1] + a[3] * b[2] - a[2] * b[3], *Y[11:13, 0]]
    above = upper_end(scene, DT, Y[:, -1:], Y_old[:, -1:], water[:, -1:], water_old[:, -1:])
    return np.concatenate([below, boxes.T.ravel(), above, Y[10:13, -1]])


def rows_of_plane(n):
    """Equations that a motion in the plane leaves: of 7 below, of each box, of 6 above."""
    boxes = (7 + 13 * k + i for k in range(n - 1) for i in PLANE)
    return [0, 1, 3, 6, *boxes, *(7 + 13 * (n - 1) + i for i in (0, 1, 5))]


@pytest.mark.parametrize("dimensions", [3, 2])
@pytest.mark.parametrize("end", ENDS)
@pytest.mark.parametrize("law", LAWS)
def test_update_solves_the_printed_equations(law, end, dimensions):
    scene = scene_of(law, dimensions, **{"tether.grid_stretching": 1.0, **ENDS[end][3 - dimensions]})
    paper_line = line_of(scene)
    n = scene.tether.nodes
    (Y, water), (Y_old, water_old) = states(1, n), states(2, n)
    Y_old = Y + 0.05 * (Y_old - Y)
    active, keep = (SPACE, range(13 * n)) if dimensions == 3 else (PLANE, rows_of_plane(n))
    if dimensions == 2:
        Y[ACROSS] = Y_old[ACROSS] = 0.0
        water[[2, 5]] = water_old[[2, 5]] = 0.0

    def residual(Y):
        return printed_28(scene, paper_line.h, Y, water, Y_old, water_old)[list(keep)]

    columns = []
    for k in range(n):
        for i in active:
            moved = Y.astype(complex)
            moved[i, k] += 1j * STEP
            columns.append(residual(moved).imag / STEP)
    J, r = np.array(columns).T, residual(Y).real
    before = Level(1.0, Y_old, water_old, P(paper_line, Y_old, water_old))
    code, computed, _ = newton_update(paper_line, Y, water, 1.0 + DT, before)
    assert code == 0
    update, exact = computed[0].T[:, active].ravel(), np.linalg.solve(J, -r)
    size = np.abs(exact.reshape(n, -1)).max(0)
    assert np.all(np.abs((update - exact).reshape(n, -1)) <= 1e-6 * size)
    assert np.all(np.abs(J @ update + r) <= 1e-6 * (np.abs(J) @ np.abs(exact) + np.abs(r)))
