"""A motion chosen first, and the scene that must produce it: a current table whose drag is the force that is missing.

    phi = phi_L + A(t) g(s/L),  eps = e_L + B(t) g(s/L),  g(x) = (1 - x^2)^3,  A, B = constant + share * sin^4(omega t)

g' = 0 below, g' = g'' = 0 above: both ends are moment-free, the shear force vanishes at the top, and the tension there
is constant: a free end under a steady force. sin^4 leaves the line at rest, without acceleration, at t = 0.
With N = T t + S n, S = -EI phi_ss/(1 + eps)^3, the momentum equation leaves for the drag, along t and n,

    a = T_s - S phi_s - m V_t.t - w0 sin(phi),   b = T phi_s + S_s - m V_t.n - w0 cos(phi),

which fixes the relative velocity (c sqrt(1+eps) |v| v = a or b) and with it the current at (z, t). Both stay below
zero, so that no square root is singular. The line is thin (1 um) with drag coefficients to match: drag without fluid
inertia.
"""

import numpy as np
from numpy.polynomial import Polynomial
from scipy.interpolate import CubicSpline

from engine.scene import build_scene

L, M_LINE, EA, EI, RHO, D, C_N, C_T = 20.0, 0.7, 5e3, 500.0, 1000.0, 1e-6, 1e5, 3e4
AREA, GRAVITY, OMEGA = 7.85e-5, 9.81, 1.0
W0 = (M_LINE - RHO * AREA) * GRAVITY
PHI_L, E_L = 0.9, 0.1
A0, A1, B0, B1 = 0.3, 0.05, 0.01, 0.02
G = Polynomial([1, 0, -1]) ** 3


def motion(t, s):
    """Strain, angle, their derivatives in s, and q, q_t, q_tt (len(s), 2) at one time."""
    sin, cos = np.sin(OMEGA * t), np.cos(OMEGA * t)
    rise = np.array([sin**4, 4 * OMEGA * sin**3 * cos, OMEGA**2 * (12 * sin**2 * cos**2 - 4 * sin**4)])
    A, B = np.array([A0, 0, 0]) + A1 * rise, np.array([B0, 0, 0]) + B1 * rise
    g = [G.deriv(i)(s / L) / L**i if i else G(s / L) for i in range(4)]
    lam, phi = 1 + E_L + B[0] * g[0], PHI_L + A[0] * g[0]
    along, across = np.stack([np.cos(phi), np.sin(phi)], 1), np.stack([-np.sin(phi), np.cos(phi)], 1)
    lam_t, lam_tt, phi_t, phi_tt = ((X[i] * g[0])[:, None] for X in (B, A) for i in (1, 2))
    wide = lam[:, None]
    q = wide * along
    q_t = lam_t * along + wide * phi_t * across
    q_tt = (lam_tt - wide * phi_t**2) * along + (2 * lam_t * phi_t + wide * phi_tt) * across
    return lam, phi, [A[0] * g[i] for i in range(4)], B[0] * g[1], along, across, q, q_t, q_tt


def integral(s, values):
    """Integral over s from 0, by cubic splines on a fine grid."""
    antiderivative = CubicSpline(s, values).antiderivative()
    return antiderivative(s) - antiderivative(0.0)


def exact(t, s):
    """x, z (m) and strain of the chosen motion at stations s."""
    fine = np.linspace(0, L, 2001)
    x, z = CubicSpline(fine, integral(fine, motion(t, fine)[6]))(s).T
    return x, z, motion(t, s)[0] - 1


def drag_shares(t, s):
    """a and b of the head of this file, with what the current needs of the motion."""
    lam, phi, (_, kappa, kappa_s, kappa_ss), eps_s, along, across, q, q_t, q_tt = motion(t, s)
    S = -EI * kappa_s / lam**3
    S_s = -EI * (kappa_ss / lam**3 - 3 * kappa_s * eps_s / lam**4)
    V, V_t = integral(s, q_t), integral(s, q_tt)
    a = EA * eps_s - S * kappa - M_LINE * np.sum(V_t * along, 1) - W0 * np.sin(phi)
    b = EA * (lam - 1) * kappa + S_s - M_LINE * np.sum(V_t * across, 1) - W0 * np.cos(phi)
    return a, b, lam, along, across, V, integral(s, q)[:, 1]


def current_table(end_s, times, heights):
    """The current (law "table") in which the chosen motion happens."""
    s = np.linspace(0.0, L + 1.0, 2101)  # beyond the top, because a coarse grid may put it too high
    z_axis = np.linspace(0.0, 1.2 * L, heights)
    t_axis = np.linspace(0, end_s, times)
    table = np.empty((times, heights, 2))
    for j, t in enumerate(t_axis):
        a, b, lam, along, across, V, z = drag_shares(t, s)
        assert a.max() < 0 and b.max() < 0 and np.all(np.diff(z) > 0)
        slip_t = -np.sqrt(-a / (0.5 * RHO * np.pi * D * C_T * np.sqrt(lam)))
        slip_n = -np.sqrt(-b / (0.5 * RHO * D * C_N * np.sqrt(lam)))
        water = V - slip_t[:, None] * along - slip_n[:, None] * across
        table[j] = CubicSpline(z, water)(np.minimum(z_axis, z[-1]))
    return {
        "law": "table",
        "x_m": [0.0],
        "height_m": z_axis.tolist(),
        "time_s": t_axis.tolist(),
        "velocity_x_mps": table[:, :, :1].tolist(),
        "velocity_z_mps": table[:, :, 1:].tolist(),
    }


def scene_of(current, nodes, end_s, step_s, stretching=0.0):
    """The scene: a heavy line, moment-free at the anchor, its upper end under the steady force EA e_L."""
    return build_scene(
        {
            "name": "manufactured",
            "gravity_mps2": GRAVITY,
            "tether": {
                "length_m": L,
                "area_m2": AREA,
                "density_kgpm3": M_LINE / AREA,
                "diameter_m": D,
                "nodes": nodes,
                "grid_stretching": stretching,
                "bending_stiffness_Nm2": EI,
                "drag_normal": C_N,
                "drag_tangential": C_T,
                "added_mass": 0.0,
                "tension": {"law": "linear", "stiffness_N": EA},
            },
            "end": {"kind": "free", "force_N": [EA * E_L * np.cos(PHI_L), 0.0, EA * E_L * np.sin(PHI_L)]},
            "water": {"depth_m": 30.0, "density_kgpm3": RHO},
            "current": current,
            "solver": {"step_s": step_s, "newton_tolerance": 1e-12, "max_newton_iterations": 50},
            "output": {"step_s": end_s, "profiles": True},
        }
    )
