"""Appendix A of the paper, entry by entry in its own notation: what is printed, and what is put right.

Entries are keyed by row and, for M, the rate that they multiply: ("eps", "S_n", ... of eq. 22). They are functions of a
namespace of the paper's letters, so that the same text serves numbers, complex numbers and SymPy symbols.
Eqs. (36), (37) and (40) are copied from the scan; (34), (35), (38) and (39) are missing there and come from the manual
of a code that descends from the paper's. CORRECTED replaces printed entries of (40), nothing else: the
print of (36) and (37) is right but for a fourteenth entry.
"""

from types import SimpleNamespace

UNKNOWNS = "eps S_n S_b u v w b0 b1 b2 b3 O1 O2 O3".split()


def M_34_35(y):
    """Columns of eps ... w: missing in the scan."""
    return {
        (4, "eps"): -1,
        (1, "u"): -y.m / y.df,
        (2, "v"): -(y.m + y.m_a),
        (3, "w"): -(y.m + y.m_a),
    }


def M_36(y):
    """Column of beta_0, as printed."""
    return {
        (1, "b0"): -2 * y.m * (y.v * y.b3 - y.w * y.b2) / y.df,
        (2, "b0"): -2 * (y.R * (y.b3 * y.Uc - y.b0 * y.Vc - y.b1 * y.Wc) + y.m * (y.w * y.b1 - y.u * y.b3)),
        (3, "b0"): 2 * (y.R * (y.b2 * y.Uc - y.b1 * y.Vc + y.b0 * y.Wc) + y.m * (y.v * y.b1 - y.u * y.b2)),
        (5, "b0"): 2 * (1 + y.eps) * y.b3,
        (6, "b0"): -2 * (1 + y.eps) * y.b2,
    }


def M_37(y):
    """Column of beta_1, as printed."""
    return {
        (1, "b1"): 2 * y.m * (y.w * y.b3 + y.v * y.b2) / y.df,
        (2, "b1"): 2 * (y.R * (y.b2 * y.Uc - y.b1 * y.Vc + y.b0 * y.Wc) - y.m * (y.u * y.b2 - y.w * y.b0)),
        (3, "b1"): 2 * (y.R * (y.b3 * y.Uc - y.b0 * y.Vc - y.b1 * y.Wc) - y.m * (y.v * y.b0 + y.u * y.b3)),
        (5, "b1"): -2 * (1 + y.eps) * y.b2,
        (6, "b1"): -2 * (1 + y.eps) * y.b3,
    }


def M_38_39(y):
    """Columns of beta_2 and beta_3: missing in the scan."""
    return {
        (1, "b2"): -2 * y.m * (y.w * y.b0 + y.v * y.b1) / y.df,
        (2, "b2"): 2 * (y.R * (y.b1 * y.Uc + y.b2 * y.Vc + y.b3 * y.Wc) + y.m * (y.u * y.b1 + y.w * y.b3)),
        (3, "b2"): 2 * (y.R * (y.b0 * y.Uc + y.b3 * y.Vc - y.b2 * y.Wc) + y.m * (y.u * y.b0 - y.v * y.b3)),
        (5, "b2"): 2 * (1 + y.eps) * y.b1,
        (6, "b2"): 2 * (1 + y.eps) * y.b0,
        (1, "b3"): -2 * y.m * (y.w * y.b1 - y.v * y.b0) / y.df,
        (2, "b3"): -2 * (y.R * (y.b0 * y.Uc + y.b3 * y.Vc - y.b2 * y.Wc) + y.m * (y.u * y.b0 + y.w * y.b2)),
        (3, "b3"): 2 * (y.R * (y.b1 * y.Uc + y.b2 * y.Vc + y.b3 * y.Wc) + y.m * (y.v * y.b2 + y.u * y.b1)),
        (5, "b3"): -2 * (1 + y.eps) * y.b0,
        (6, "b3"): 2 * (1 + y.eps) * y.b1,
    }


def P_40(y):
    """Rows of P, as printed. y.u_c, y.v_c, y.w_c: water in the local frame; y.absolute: |x|; y.sqrt."""
    normal = y.sqrt((y.v - y.v_c) ** 2 + (y.w - y.w_c) ** 2) * y.sqrt(1 + y.eps)
    return {
        1: y.S_b * y.O2 / y.df
        - y.S_b * y.O3 / y.df
        - y.w0 / y.df * (y.b0**2 + y.b1**2 - y.b2**2 - y.b3**2)
        - y.half_rho_d_pi_Cdt * (y.u - y.u_c) * y.absolute(y.u - y.u_c) / y.df * y.sqrt(1 + y.eps),
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


def C_right(y):
    """C of eq. (6) with C31 doubled."""
    C = C_6(y)
    C[2][0] = 2 * C[2][0]
    return C


def M_right(y):
    """Every entry of M that is not zero."""
    return {**M_34_35(y), **M_36(y), **M_37(y), **M_38_39(y)}


def corrections_40(y):
    """What has to be added to the printed rows of P. y.Ac: local acceleration of the water, fixed axes."""
    C = C_right(y)
    return {
        1: (y.S_b - y.S_n) * y.O3 / y.df,
        2: y.R * sum(C[1][j] * y.Ac[j] for j in range(3)),
        3: y.R * sum(C[2][j] * y.Ac[j] for j in range(3)),
    }


def P_right(y):
    """P with its printed rows put right."""
    rows = P_40(y)
    for row, more in corrections_40(y).items():
        rows[row] = rows[row] + more
    return rows


def letters(Y, **others):
    """The namespace of the unknowns Y, 13 of them, and other letters; u_c, v_c, w_c follow from Uc, Vc, Wc."""
    y = SimpleNamespace(**dict(zip(UNKNOWNS, Y, strict=True)), **others)
    C = C_right(y)
    y.u_c, y.v_c, y.w_c = (C[i][0] * y.Uc + C[i][1] * y.Vc + C[i][2] * y.Wc for i in range(3))
    return y
