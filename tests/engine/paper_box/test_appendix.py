"""Eqs. (36), (37) and (40) of appendix A, and (6), as printed, against the equations that they abbreviate.

The print is copied from the scan, in the paper's letters, keyed by row; (34), (35), (38) and (39) are missing there.
Where it is wrong is told by CORRECTIONS and `THEORY.md`. States are random, with any |beta|: entries that
agree there are the same polynomials. That the engine solves these equations is the law of `test_newton_update`.
"""

from types import SimpleNamespace

import numpy as np

from engine.paper_box.line import line_of, roll, rotation, to_local
from engine.paper_box.nodal import times_M
from tests.engine.paper_box.test_newton_update import scene_of, space_derivatives, states, turned

ROUNDING = 1e-12  # of the largest entry of the row
STEP = 1e-30


def M_36(y):
    """Column of beta_0, as printed."""
    return {
        1: -2 * y.m * (y.v * y.b3 - y.w * y.b2) / y.df,
        2: -2 * (y.R * (y.b3 * y.Uc - y.b0 * y.Vc - y.b1 * y.Wc) + y.m * (y.w * y.b1 - y.u * y.b3)),
        3: 2 * (y.R * (y.b2 * y.Uc - y.b1 * y.Vc + y.b0 * y.Wc) + y.m * (y.v * y.b1 - y.u * y.b2)),
        5: 2 * (1 + y.eps) * y.b3,
        6: -2 * (1 + y.eps) * y.b2,
    }


def M_37(y):
    """Column of beta_1, as printed."""
    return {
        1: 2 * y.m * (y.w * y.b3 + y.v * y.b2) / y.df,
        2: 2 * (y.R * (y.b2 * y.Uc - y.b1 * y.Vc + y.b0 * y.Wc) - y.m * (y.u * y.b2 - y.w * y.b0)),
        3: 2 * (y.R * (y.b3 * y.Uc - y.b0 * y.Vc - y.b1 * y.Wc) - y.m * (y.v * y.b0 + y.u * y.b3)),
        5: -2 * (1 + y.eps) * y.b2,
        6: -2 * (1 + y.eps) * y.b3,
    }


def P_40(y):
    """Rows of P, as printed. y.u_c, y.v_c, y.w_c: water in the local frame."""
    normal = np.sqrt((y.v - y.v_c) ** 2 + (y.w - y.w_c) ** 2) * np.sqrt(1 + y.eps)
    return {
        1: y.S_b * y.O2 / y.df
        - y.S_b * y.O3 / y.df
        - y.w0 / y.df * (y.b0**2 + y.b1**2 - y.b2**2 - y.b3**2)
        - y.half_rho_d_pi_Cdt * (y.u - y.u_c) * abs(y.u - y.u_c) / y.df * np.sqrt(1 + y.eps),
        2: y.f * y.O3
        - y.S_b * y.O1
        - 2 * y.w0 * (y.b1 * y.b2 - y.b0 * y.b3)
        - y.half_rho_d_Cdp * (y.v - y.v_c) * normal,
        3: y.S_n * y.O1
        - y.f * y.O2
        - 2 * y.w0 * (y.b1 * y.b3 + y.b0 * y.b2)
        - y.half_rho_d_Cdp * (y.w - y.w_c) * normal,
        4: y.O2 * y.w - y.O3 * y.v,
        5: y.O3 * y.u - y.O1 * y.w,
        6: y.O1 * y.v - y.O2 * y.u,
        7: (y.b1 * y.O1 + y.b2 * y.O2 + y.b3 * y.O3) / 2,
        8: -(y.b0 * y.O1 - y.b3 * y.O2 + y.b2 * y.O3) / 2,
        9: -(y.b3 * y.O1 + y.b0 * y.O2 - y.b1 * y.O3) / 2,
        10: (y.b2 * y.O1 - y.b1 * y.O2 - y.b0 * y.O3) / 2,
        11: 0 * y.O1,
        12: (y.GIp / y.EI - 1) * y.O1 * y.O3 - y.S_b * (1 + y.eps) ** 3 / y.EI,
        13: (1 - y.GIp / y.EI) * y.O1 * y.O2 + y.S_n * (1 + y.eps) ** 3 / y.EI,
    }


def C_6(y):
    """The rotation matrix as printed: C31 without its factor 2."""
    return [
        [y.b0**2 + y.b1**2 - y.b2**2 - y.b3**2, 2 * (y.b1 * y.b2 + y.b0 * y.b3), 2 * (y.b1 * y.b3 - y.b0 * y.b2)],
        [2 * (y.b1 * y.b2 - y.b0 * y.b3), y.b0**2 - y.b1**2 + y.b2**2 - y.b3**2, 2 * (y.b2 * y.b3 + y.b0 * y.b1)],
        [y.b1 * y.b3 + y.b0 * y.b2, 2 * (y.b2 * y.b3 - y.b0 * y.b1), y.b0**2 - y.b1**2 - y.b2**2 + y.b3**2],
    ]


# what has to be added to printed rows: THEORY.md#17-misprints-of-the-paper
CORRECTIONS = {
    1: lambda y: (y.S_b - y.S_n) * y.O3 / y.df,
    2: lambda y: y.R * y.A_n,
    3: lambda y: y.R * y.A_b,
}
UNKNOWNS = "eps S_n S_b u v w b0 b1 b2 b3 O1 O2 O3".split()


def letters(scene, Y, water):
    """The paper's letters at nodes, arrays (n,). A_n, A_b: acceleration of the water along n and b."""
    tether, rho = scene.tether, scene.water.density_kgpm3
    d, law = tether.diameter_m, tether.tension
    displaced = rho * np.pi * d**2 / 4
    y = SimpleNamespace(**dict(zip(UNKNOWNS, Y, strict=True)), **dict(zip(("Uc", "Vc", "Wc"), water, strict=False)))
    y.u_c, y.v_c, y.w_c = turned(Y[6:10].T, water[:3].T, Y[6:10].T).T
    _, y.A_n, y.A_b = turned(Y[6:10].T, water[3:].T, Y[6:10].T).T
    y.m, y.R = tether.density_kgpm3 * tether.area_m2, displaced * (1 + tether.added_mass)
    y.w0 = (tether.density_kgpm3 - rho) * tether.area_m2 * scene.gravity_mps2
    y.EI, y.GIp = tether.bending_stiffness_Nm2, tether.torsion_stiffness_Nm2
    y.half_rho_d_pi_Cdt = 0.5 * rho * d * np.pi * tether.drag_tangential
    y.half_rho_d_Cdp = 0.5 * rho * d * tether.drag_normal
    y.f, y.df = law.stiffness_N * y.eps, law.stiffness_N
    return y


def wrong_rows(computed, right):
    """Numbers of the rows (13, n) that differ by more than rounding of their largest entry (or of 1)."""
    size = np.maximum(np.abs(right).max(1), 1.0)
    return set(1 + np.flatnonzero(np.abs(computed - right).max(1) > ROUNDING * size))


def test_the_print_is_wrong_where_it_is_said_to_be_and_nowhere_else():
    scene = scene_of()
    Y, water = states(11, 20, unit=False)
    steady = np.concatenate([water[:3], 0 * water[3:]])
    for F, wrong in ((water, {1, 2, 3}), (steady, {1})):
        y = letters(scene, Y, F)
        right = -space_derivatives(scene, Y, np.zeros_like(Y), F).real
        printed = P_40(y)
        rows = np.array([printed[row] for row in range(1, 14)])
        assert wrong_rows(rows, right) == wrong
        for row in CORRECTIONS:
            rows[row - 1] += CORRECTIONS[row](y)
        assert wrong_rows(rows, right) == set()
        for column, entries in ((6, M_36(y)), (7, M_37(y))):
            rate = 1j * STEP * np.eye(13)[:, column : column + 1] * np.ones(20)
            right_column = -space_derivatives(scene, Y, rate, F).imag / STEP
            assert wrong_rows(np.array([entries.get(row, 0 * y.eps) for row in range(1, 14)]), right_column) == set()


def test_the_rotation_matrix_needs_its_factor():
    """C31 of the print of (6) is half of it; t, n, b are at right angles with all of it, and turn G into C G."""
    Y, water = states(11, 20, unit=False)
    C, printed = rotation(Y[6:10]), np.array(C_6(SimpleNamespace(**dict(zip(UNKNOWNS, Y, strict=True)))))
    half = np.ones((3, 3, 1))
    half[2, 0] = 0.5
    assert np.allclose(printed, C * half, rtol=ROUNDING)
    assert np.allclose(to_local(Y[6:10], water[:3]), turned(Y[6:10].T, water[:3].T, Y[6:10].T).T, rtol=1e-11)
    length = np.sum(Y[6:10] ** 2, 0) ** 2
    assert np.allclose(np.einsum("ijk,ljk->ilk", C, C), np.eye(3)[:, :, None] * length, rtol=1e-11, atol=1e-11)


def test_true_accelerations_do_not_depend_on_the_roll_of_the_frame():
    """Rows 2, 3 of M dY/dt as a vector in fixed axes: with true accelerations a rolling frame changes nothing.

    With the component rates of the print it does, by (m_a V - R U_c) omega_1.
    """
    scene = scene_of()
    Y, water = states(3, 30)
    rng = np.random.default_rng(5)
    V, V_t = rng.normal(0, 2, (2, 3, 30))

    def force(line, rolling):
        """M dY/dt, normal part in fixed axes, for a frame whose t stands still, rolling at 2 rad/s or not."""
        state, rate = Y.copy(), np.zeros((13, 30))
        rate[6:10] = rolling * roll(Y[6:10])
        state[3:6] = to_local(Y[6:10], V)
        rate[3:6] = to_local(Y[6:10], V_t) + to_local(Y[6:10] + 1j * STEP * rate[6:10], V).imag / STEP  # C V_t + C_t V
        rows = times_M(line, state, rate, water)
        C = rotation(Y[6:10])
        return rows[1] * C[1] + rows[2] * C[2]

    for accelerations, depends in ((True, False), (False, True)):
        line = line_of(scene, accelerations)
        change = np.abs(force(line, 1.0) - force(line, 0.0)).max()
        assert (change > 1.0) if depends else (change < 1e-11)
