"""Appendix A against the equations that it abbreviates, by symbols: every entry of M and every row of P.

The momentum (12), moments (16), compatibility (19) and beta_s are written with cross products and Morison's force
(23)-(24) (the fluid pushes with +), solved for dY/ds, and differentiated by the rates. Nothing is rounded, and |beta|
is any.
"""

import pytest
import sympy as sp

from tests.engine.paper_box.appendix import (
    C_6,
    M_36,
    M_37,
    P_40,
    UNKNOWNS,
    C_right,
    M_right,
    P_right,
    corrections_40,
    letters,
)

Y = sp.symbols(UNKNOWNS, real=True)
RATES = dict(zip(UNKNOWNS, sp.symbols([f"{name}_t" for name in UNKNOWNS], real=True), strict=True))
NAMES = "m m_a R w0 EI GIp half_rho_d_pi_Cdt half_rho_d_Cdp".split()
CONSTANTS = {name: sp.Symbol(name, positive=True) for name in NAMES}
WATER = sp.symbols("Uc Vc Wc", real=True)
ACCELERATION = sp.symbols("Uc_t Vc_t Wc_t", real=True)
F, DF = sp.symbols("f df", positive=True)
MAGNITUDE = sp.Function("absolute")


@pytest.fixture(scope="module")
def y():
    water = dict(zip(("Uc", "Vc", "Wc"), WATER, strict=True))
    return letters(Y, **CONSTANTS, **water, Ac=ACCELERATION, f=F, df=DF, sqrt=sp.sqrt, absolute=MAGNITUDE)


def product(p, q):
    """Quaternion product p o q, components 0 to 3."""
    p0, q0, pv, qv = p[0], q[0], sp.Matrix(p[1:]), sp.Matrix(q[1:])
    return [p0 * q0 - pv.dot(qv), *(p0 * qv + q0 * pv + pv.cross(qv))]


@pytest.fixture(scope="module")
def space_derivatives(y):
    """dY/ds of the thirteen unknowns, as the equations have it, linear in the rates."""
    t = sp.Matrix([1, 0, 0])
    V, V_t = sp.Matrix([y.u, y.v, y.w]), sp.Matrix([RATES[name] for name in "uvw"])
    T, Omega = sp.Matrix([y.f, y.S_n, y.S_b]), sp.Matrix([y.O1, y.O2, y.O3])
    beta, beta_t = [y.b0, y.b1, y.b2, y.b3], [RATES[f"b{i}"] for i in range(4)]
    conjugate = [beta[0], *(-b for b in beta[1:])]
    omega = 2 * sp.Matrix(product(conjugate, beta_t)[1:])
    C = sp.Matrix(C_right(y))
    C_t = sum((C.diff(b) * rate for b, rate in zip(beta, beta_t, strict=True)), sp.zeros(3))
    water, acceleration = sp.Matrix(WATER), sp.Matrix(ACCELERATION)
    slip = V - C * water
    root = sp.sqrt(1 + y.eps)
    across = sp.sqrt(slip[1] ** 2 + slip[2] ** 2)
    drag = -root * sp.Matrix(
        [
            y.half_rho_d_pi_Cdt * slip[0] * MAGNITUDE(slip[0]),
            y.half_rho_d_Cdp * across * slip[1],
            y.half_rho_d_Cdp * across * slip[2],
        ]
    )
    normal = sp.diag(0, 1, 1)
    push = normal * (y.R * (C_t * water + C * acceleration) - y.m_a * V_t)  # component rates, as in (24)
    weight = -y.w0 * C[:, 0]  # axis 1 is up
    T_s = y.m * (V_t + omega.cross(V)) - Omega.cross(T) - drag - push - weight
    V_s = RATES["eps"] * t + (1 + y.eps) * omega.cross(t) - Omega.cross(V)
    beta_s = [b / 2 for b in product(beta, [0, *Omega])]
    moment = sp.Matrix([y.GIp * y.O1, y.EI * y.O2, y.EI * y.O3])
    M_s = -Omega.cross(moment) - (1 + y.eps) ** 3 * t.cross(T)
    return [T_s[0] / y.df, T_s[1], T_s[2], *V_s, *beta_s, M_s[0] / y.GIp, M_s[1] / y.EI, M_s[2] / y.EI]


def equal(a, b):
    return sp.expand(a - b) == 0


def test_every_entry_of_M(y, space_derivatives):
    entries = M_right(y)
    for row, expression in enumerate(space_derivatives, 1):
        for name, rate in RATES.items():
            assert equal(-expression.diff(rate), entries.get((row, name), 0)), (row, name)


def test_every_row_of_P(y, space_derivatives):
    at_rest = dict.fromkeys(RATES.values(), 0)
    rows = P_right(y)
    for row, expression in enumerate(space_derivatives, 1):
        assert equal(-expression.subs(at_rest), rows[row]), row


def test_the_print_is_wrong_where_it_is_said_to_be_and_nowhere_else(y, space_derivatives):
    at_rest = dict.fromkeys(RATES.values(), 0)
    printed = P_40(y)
    wrong = {row for row, found in enumerate(space_derivatives, 1) if not equal(-found.subs(at_rest), printed[row])}
    assert wrong == set(corrections_40(y)) == {1, 2, 3}
    # still water and steady currents: only row 1 is left
    steady = dict.fromkeys(ACCELERATION, 0)
    assert {row for row in wrong if corrections_40(y)[row].subs(steady) != 0} == {1}
    for column, name in ((M_36, "b0"), (M_37, "b1")):
        for row, expression in enumerate(space_derivatives, 1):
            assert equal(-expression.diff(RATES[name]), column(y).get((row, name), 0))


def test_the_rotation_matrix_needs_its_factor(y):
    """Rows of C have length |beta|^2; t, n, b in the print of (6) are at right angles only with 2 in C31."""
    for form, right in ((C_right, True), (C_6, False)):
        C = sp.Matrix(form(y))
        length = (y.b0**2 + y.b1**2 + y.b2**2 + y.b3**2) ** 2
        assert (sp.expand(C * C.T - length * sp.eye(3)) == sp.zeros(3)) is right


def test_angular_velocity_is_that_of_the_frame(y):
    """2 beta* o beta_t is the omega of (3): the rows of C turn with it where |beta| = 1, C_t = -[omega x] C."""
    beta, beta_t = [y.b0, y.b1, y.b2, y.b3], [RATES[f"b{i}"] for i in range(4)]
    omega = 2 * sp.Matrix(product([beta[0], *(-b for b in beta[1:])], beta_t)[1:])
    C = sp.Matrix(C_right(y))
    C_t = sum((C.diff(b) * rate for b, rate in zip(beta, beta_t, strict=True)), sp.zeros(3))
    turned = sp.Matrix([[0, omega[2], -omega[1]], [-omega[2], 0, omega[0]], [omega[1], -omega[0], 0]]) * C
    length, rate = sum(b * b for b in beta), 2 * sum(b * r for b, r in zip(beta, beta_t, strict=True))
    # for any |beta|: C grows with |beta|^2 besides
    assert sp.expand(length * C_t - turned - rate * C) == sp.zeros(3)
