"""The upper end: buoy (30), held, or free under a force. (Lower end: V = 0, moment-free; in the sweeps.)

Each condition is two equations e = 0 in the force N and velocity V of the last node, with e_N the factor of dN (1 or 0)
and D = de/dV:

    buoy   e = N + (M + M_a) V_t + C |v| v - (rho V + M_a) dU_w/dt - (B - W) z,   C = rho C_d A_p / 2, v = V - U_w
    held   e = V
    free   e = N - F(t)
"""

import math

from .compiled import kernel

BUOY, HELD, FREE = 0, 1, 2


@kernel
def upper_end(p, cv, in_motion, Nx, Nz, U, W, U_tilde, W_tilde, F):
    """Residual and derivatives of the upper end.

    F : (4,) water velocity and acceleration there.
    Returns ex, ez, e_N, Dxx, Dxz, Dzz.
    """
    if p.end == HELD:
        return U - p.end_x, W - p.end_z, 0.0, 1.0, 0.0, 1.0
    if p.end == FREE:
        return Nx - p.end_x, Nz - p.end_z, 1.0, 0.0, 0.0, 0.0
    mass = p.M_total
    ex = Nx + mass * cv * (U - U_tilde)
    ez = Nz + mass * cv * (W - W_tilde) - p.lift
    Dxx = mass * cv
    Dxz = 0.0
    Dzz = Dxx
    if p.wet:
        u = in_motion * U - F[0]
        w = in_motion * W - F[1]
        speed = math.sqrt(u * u + w * w)
        ex += p.C_buoy * speed * u - p.M_wave * F[2]
        ez += p.C_buoy * speed * w - p.M_wave * F[3]
        if speed > 0.0:
            factor = in_motion * p.C_buoy
            Dxx += factor * (speed + u * u / speed)
            Dxz = factor * u * w / speed
            Dzz += factor * (speed + w * w / speed)
    return ex, ez, 1.0, Dxx, Dxz, Dzz
