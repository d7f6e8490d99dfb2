"""M dY/dt and P of eq. (21), appendix A (34)-(40), at the nodes.

Y = [eps, S_n, S_b, u, v, w, beta_0 ... beta_3, Omega_1, Omega_2, Omega_3] (22), component first: (13, ...). With
omega the angular velocity of the frame (`frame.turning`), the columns of M that multiply d(beta)/dt are

    row 1     -m (omega x V)_1 / f'
    rows 2-3  -m (omega x V)_2,3 + R (dC/dt U_c)_2,3
    rows 4-6  -(1 + eps) (omega x t)

which entry by entry is the print (tests/engine/paper_box/appendix.py has it entry by entry, docs/appendix_a.md its
misprints); written so, a product with M costs one omega instead of 31 entries. Rows 2 and 3 of P carry the term
R C dU_c/dt that the print leaves out: without it waves act on the tether by drag alone.

water (6, ...): velocity and local acceleration of the water in the paper's axes (`frame`).
Arguments may be complex (`box` differentiates by complex step): |x| is written so that it stays analytic.

In the paper: eq. (34) M, columns of ε … w; eq. (35) M, columns of ε … w; eq. (36) M, column of β₀; eq. (37) M, column
of β₁; eq. (38) M, column of β₂; eq. (39) M, column of β₃; eq. (40) P.
"""

import numpy as np

from .frame import normal_rates, rotation, turning
from .law import tension_law
from .line import EULER, Line


def times_M(line: Line, Y: np.ndarray, D: np.ndarray, water: np.ndarray) -> np.ndarray:
    """M(Y) D, (13, ...), for any D of the shape of Y."""
    eps, u, v, w = Y[0], Y[3], Y[4], Y[5]
    slope = tension_law(line.record, line.tables, eps)[1]
    omega1, omega2, omega3 = turning(Y[EULER], D[EULER])
    n_rate, b_rate = normal_rates(Y[EULER], D[EULER])
    Uc, Vc, Wc = water[:3]
    inertia = line.m + line.m_a
    zero = np.zeros_like(omega1)
    return np.array(
        [
            -line.m * (D[3] + omega2 * w - omega3 * v) / slope,
            -inertia * D[4]
            - line.m_turn * (omega3 * u - omega1 * w)
            + line.R_turn * (n_rate[0] * Uc + n_rate[1] * Vc + n_rate[2] * Wc),
            -inertia * D[5]
            - line.m_turn * (omega1 * v - omega2 * u)
            + line.R_turn * (b_rate[0] * Uc + b_rate[1] * Vc + b_rate[2] * Wc),
            zero - D[0],
            -(1 + eps) * omega3,
            (1 + eps) * omega2,
            *(zero for _ in range(7)),
        ]
    )


def P(line: Line, Y: np.ndarray, water: np.ndarray) -> np.ndarray:
    """P(Y), (13, ...): eq. (40)."""
    eps, Sn, Sb, u, v, w, b0, b1, b2, b3, O1, O2, O3 = Y
    T, slope = tension_law(line.record, line.tables, eps)
    root = np.sqrt(1 + eps)
    C = rotation(Y[EULER])
    u_r, v_r, w_r = (Y[3 + i] - C[i, 0] * water[0] - C[i, 1] * water[1] - C[i, 2] * water[2] for i in range(3))
    n_push, b_push = (line.R * (C[i, 0] * water[3] + C[i, 1] * water[4] + C[i, 2] * water[5]) for i in (1, 2))
    across = np.sqrt(v_r * v_r + w_r * w_r)  # at zero its square root is not analytic, the products below are
    cube = (1 + eps) ** 3 / line.EI
    ratio = line.GIp / line.EI
    return np.array(
        [
            (Sb * O2 - Sn * O3 - line.w0 * C[0, 0] - line.c_t * magnitude(u_r) * u_r * root) / slope,
            T * O3 - Sb * O1 - line.w0 * C[1, 0] - line.c_n * across * v_r * root + n_push,
            Sn * O1 - T * O2 - line.w0 * C[2, 0] - line.c_n * across * w_r * root + b_push,
            O2 * w - O3 * v,
            O3 * u - O1 * w,
            O1 * v - O2 * u,
            0.5 * (b1 * O1 + b2 * O2 + b3 * O3),
            -0.5 * (b0 * O1 - b3 * O2 + b2 * O3),
            -0.5 * (b3 * O1 + b0 * O2 - b1 * O3),
            0.5 * (b2 * O1 - b1 * O2 - b0 * O3),
            np.zeros_like(T),
            (ratio - 1) * O1 * O3 - Sb * cube,
            (1 - ratio) * O1 * O2 + Sn * cube,
        ]
    )


def magnitude(x: np.ndarray) -> np.ndarray:
    """|x|, analytic on either side of zero."""
    return np.where(x.real < 0, -x, x)
