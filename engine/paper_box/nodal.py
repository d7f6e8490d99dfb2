"""M dY/dt and P of eq. (21), appendix A (34)-(40), at the nodes.

Y = [eps, S_n, S_b, u, v, w, beta_0 ... beta_3, Omega_1, Omega_2, Omega_3] (22), component first: (13, ...). With
omega the angular velocity of the frame (`line.turning`), the columns of M that multiply d(beta)/dt are

    row 1     -m (omega x V)_1 / f'
    rows 2-3  -m (omega x V)_2,3 + R (dC/dt U_c)_2,3
    rows 4-6  -(1 + eps) (omega x t)

Every entry agrees with the print (tests/engine/paper_box/test_appendix.py; misprints: THEORY.md). A product with M
needs omega once, in place of 31 entries. Rows 2 and 3 of P have the term R C dU_c/dt, which the print leaves out:
without this term waves act on the tether by drag alone.

water (6, ...): velocity and local acceleration of the water in the paper's axes (`line`).
Arguments may be complex, because `newton.residual` differentiates by complex step. |x| is therefore written in a form
that stays analytic.

In the paper: eq. (34) M, columns of ε … w; eq. (35) M, columns of ε … w; eq. (36) M, column of β₀; eq. (37) M, column
of β₁; eq. (38) M, column of β₂; eq. (39) M, column of β₃; eq. (40) P.
"""

from typing import NamedTuple

import numpy as np

from ..physics.sea_series import WIDTH
from ..physics.water import water as water_of_engine
from ..spatial.vectors import dot_of
from .line import EPS, EULER, SPEEDS, TO_ENGINE, TO_PAPER, Line, U, V, W, normal_rates, rotation, to_local, turning


def positions(line: Line, Y: np.ndarray) -> np.ndarray:
    """Positions (3, n) of the nodes in the paper's axes, m: R_s = (1 + eps) t summed from the anchor."""
    q = (1 + Y[EPS]) * rotation(Y[EULER])[0]
    steps = 0.5 * line.h * (q[:, 1:] + q[:, :-1])
    return np.concatenate([np.zeros((3, 1)), np.cumsum(steps, axis=1)], axis=1)


def water_at(line: Line, t: float, Y: np.ndarray, waves: bool = True) -> np.ndarray:
    """Velocity and local acceleration of the water at the nodes, (6, n), paper's axes. waves: False in statics.

    The paper does not say at which positions it takes the water. The position of a node depends on all nodes below it.
    As in the conservation form, each Newton iteration computes the positions anew, and the Jacobian neglects them.
    """
    axes = [0, 1, 2] if line.spatial else [0, 2]
    X = np.ascontiguousarray(positions(line, Y)[TO_ENGINE][axes].T)
    F = np.zeros((len(X), 2 * len(axes)))
    sea = np.zeros((len(X) + 1, WIDTH))
    water_of_engine(line.record, line.tables, t, 1.0 if waves else 0.0, X, F, sea)
    fields = np.zeros((2, 3, len(X)))
    fields[:, axes] = F.T.reshape(2, len(axes), -1)
    return fields[:, TO_PAPER].reshape(6, -1)


class Level(NamedTuple):
    """One time level: t (s), Y (13, n), the water (6, n) and P (13, n) there."""

    t: float
    Y: np.ndarray
    water: np.ndarray
    P: np.ndarray


def level_of(line: Line, t: float, Y: np.ndarray) -> Level:
    """The time level at t (s) with the unknowns Y (13, n)."""
    water = water_at(line, t, Y)
    return Level(t, Y, water, P(line, Y, water))


def times_M(line: Line, Y: np.ndarray, D: np.ndarray, water: np.ndarray) -> np.ndarray:
    """M(Y) D, (13, ...), for any D of the shape of Y.

    Rows 2 and 3 have a term with n_rate or b_rate, and a term with omega. In the paper their factors are
    R = rho_w pi d^2/4 + m_a and m, because Morison's force has the rates of the components v and v_c. With
    `line.accelerations` it has the normal components of the accelerations. The factors are then 0 and m + m_a, and the
    force does not depend on the roll of the frame (THEORY.md, section 4).
    """
    eps, (u, v, w) = Y[EPS], Y[SPEEDS]
    slope = line.tension(eps)[1]
    omega1, omega2, omega3 = turning(Y[EULER], D[EULER])
    n_rate, b_rate = normal_rates(Y[EULER], D[EULER])
    m, inertia = line.record["m"], line.record["m"] + line.record["ma"]
    m_turn, R_turn = (inertia, 0.0) if line.accelerations else (m, line.record["Rw"])
    zero = np.zeros_like(omega1)
    return np.array(
        [
            -m * (D[U] + omega2 * w - omega3 * v) / slope,
            -inertia * D[V] - m_turn * (omega3 * u - omega1 * w) + R_turn * dot_of(n_rate, water),
            -inertia * D[W] - m_turn * (omega1 * v - omega2 * u) + R_turn * dot_of(b_rate, water),
            zero - D[EPS],
            -(1 + eps) * omega3,
            (1 + eps) * omega2,
            *7 * [zero],
        ]
    )


def P(line: Line, Y: np.ndarray, water: np.ndarray) -> np.ndarray:
    """P(Y), (13, ...), eq. (40)."""
    eps, Sn, Sb, u, v, w, b0, b1, b2, b3, O1, O2, O3 = Y
    p = line.record
    w0, c_t, c_n, EI, ratio = p["w0"], p["ct"], p["cn"], p["EI"], line.GIp / p["EI"]
    T, slope = line.tension(eps)
    C = rotation(Y[EULER])
    u_r, v_r, w_r = (Y[U + i] - C[i, 0] * water[0] - C[i, 1] * water[1] - C[i, 2] * water[2] for i in range(3))
    _, n_push, b_push = p["Rw"] * to_local(Y[EULER], water[3:])
    root, cube = np.sqrt(1 + eps), (1 + eps) ** 3 / EI
    size = np.where(u_r.real < 0, -u_r, u_r)  # |u_r|, analytic on either side of zero
    across = np.sqrt(v_r * v_r + w_r * w_r)  # not analytic at zero, but its products with v_r, w_r are
    return np.array(
        [
            (Sb * O2 - Sn * O3 - w0 * C[0, 0] - c_t * size * u_r * root) / slope,
            T * O3 - Sb * O1 - w0 * C[1, 0] - c_n * across * v_r * root + n_push,
            Sn * O1 - T * O2 - w0 * C[2, 0] - c_n * across * w_r * root + b_push,
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
