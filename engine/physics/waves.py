"""One linear (Airy) wave over finite depth: its wave number, and the velocity and acceleration of the water.

With psi = k d x - omega t + phase, height z above the bed, amplitude A, and d = 1 or -1 for a wave along +x or -x,

    U = d A omega cosh(kz)/sinh(kH) cos psi,   W = A omega sinh(kz)/sinh(kH) sin psi,   omega^2 = g k tanh kH;

accelerations are the local time derivatives. With up = exp(k(z - H)) and down = exp(-k(z + H)), which do not overflow
in deep water, the two quotients are (up + down) and (up - down) over 1 - exp(-2kH). Along the tether psi and kz change
little from node to node. The kernel therefore gets up, down, sin psi and cos psi of a node from those of the node
below, by short polynomials, and computes them anew where an element is too long for these. No sea floor is modelled:
what sinks below the bed is given the motion of the water at the bed, because the formulas grow without bound there.
"""

import math

from ..compiled import kernel
from ..record import WHEELER, ZERO
from ..simd.elementary import sincos, small_exponentials, small_sincos, smooth_start
from ..simd.select import every, larger, where
from .currents import AXES

SMALL, TINY = 0.25, 1e-250
MICHE = 0.142 * math.pi  # kA of the highest wave that stands in deep water, of height 0.142 lambda (Miche 1944)
# Hedges (1995), Regions of validity of analytical wave theories, Proc. ICE 112: beyond this Ursell number waves are
# cnoidal, and no longer linear.
MOST_URSELL = 40.0


def wave_number(period_s: float, depth_m: float, gravity_mps2: float = 9.81) -> float:
    """Wave number k (rad/m) with omega^2 = g k tanh kH, to rounding."""
    from scipy.optimize import brentq

    k_deep = (2 * math.pi / period_s) ** 2 / gravity_mps2
    x0 = k_deep * depth_m  # with x = kH: x tanh x = x0, and x lies between max(x0, sqrt(x0)) and x0 + sqrt(x0)
    low, high = 0.5 * x0, x0 + math.sqrt(x0) + 1e-12  # for tiny x0 many decades apart: hence so many iterations
    x = brentq(lambda x: x * math.tanh(x) - x0, low, high, xtol=1e-300, rtol=1e-15, maxiter=5000)
    return x / depth_m


def breaking_steepness(k: float, depth_m: float) -> float:
    """kA of the highest wave of this wave number k (rad/m) in this depth (Miche 1944)."""
    return MICHE * math.tanh(k * depth_m)


def ursell_number(k: float, height_m: float, depth_m: float) -> float:
    """Height x length^2 / depth^3 of a wave of wave number k (rad/m); waves of more than MOST_URSELL are not linear."""
    return height_m * (2.0 * math.pi / k) ** 2 / depth_m**3


@kernel
def wave_field(p, tables, t, X, F):
    """Water velocity and local acceleration at the nodes of a line in a plane, added into F (a sea: `physics.sea`).

    X : (n, 2) positions x, z (m);  F : (n, 4) U, W (m/s), dU/dt, dW/dt (m/s2)
    """
    n = X.shape[0]
    k, kx = p.k, p.k * p.direction  # direction: its cosine, d above
    gain, gain_rate = smooth_start(t, p.ramp)
    speed = p.amplitude * p.omega / (1.0 - math.exp(-2.0 * k * p.depth))
    u0, u1 = speed * gain, speed * gain_rate  # under the ramp of the waves; their rate
    om = p.omega
    up, down, s, c = 0.0, 0.0, 0.0, 1.0
    x_below = z_below = 0.0
    for j in range(n):
        x, z = X[j, 0], larger(X[j, 1], 0.0)
        dz, dx = k * (z - z_below), kx * (x - x_below)
        near = (abs(dz) < SMALL) & (abs(dx) < SMALL) & (up > TINY)
        x_below, z_below = x, z
        e1, e2 = small_exponentials(dz)
        ds, dc = small_sincos(dx)
        near_up, near_down, near_s, near_c = up * e1, down * e2, s * dc + c * ds, c * dc - s * ds
        if j > 0 and p.above != WHEELER and every(near):
            up, down, s, c = near_up, near_down, near_s, near_c
        else:
            s, c = sincos(kx * x - om * t + p.phase)
            if p.above == WHEELER:  # stretched so that the crest is where the still water level was
                z = z * p.depth / (p.depth + p.amplitude * gain * c)
            up = math.exp(k * (z - p.depth))
            down = math.exp(-k * (z + p.depth))
            if j > 0 and p.above != WHEELER:
                up, down = where(near, near_up, up), where(near, near_down, down)
                s, c = where(near, near_s, s), where(near, near_c, c)
        cosh_part, sinh_part = up + down, up - down  # of cosh and of sinh
        if p.above == ZERO:
            dry = X[j, 1] > p.depth
            cosh_part, sinh_part = where(dry, 0.0, cosh_part), where(dry, 0.0, sinh_part)
        uc = p.direction * cosh_part * c
        us = p.direction * cosh_part * s
        ws = sinh_part * s
        wc = sinh_part * c
        F[j, 0] += u0 * uc
        F[j, 1] += u0 * ws
        F[j, 2] += u0 * om * us + u1 * uc
        F[j, 3] += u1 * ws - u0 * om * wc


@kernel
def wave_field_in_space(p, tables, t, X, F):
    """As `wave_field` at places X (n, 3) x, y, z; F (n, 6): U, V, W and their rates."""
    n = X.shape[0]
    gain, gain_rate = smooth_start(t, p.ramp)
    k, om, phase, cosine, sine = p.k, p.omega, p.phase, p.dir_x, p.dir_y
    speed = p.amplitude * om / (1.0 - math.exp(-2.0 * k * p.depth))
    u0, u1 = speed * gain, speed * gain_rate
    up, down, s, c = 0.0, 0.0, 0.0, 1.0
    x_below = z_below = 0.0
    for j in range(n):
        x = cosine * X[j, 0] + sine * X[j, 1]
        z = max(X[j, 2], 0.0)
        if p.above == WHEELER:
            eta = p.amplitude * sincos(k * x - om * t + phase)[1]
            z = z * p.depth / max(p.depth + gain * eta, 1e-3 * p.depth)
        dz, dx = k * (z - z_below), k * (x - x_below)
        x_below, z_below = x, z
        if j > 0 and abs(dz) < SMALL and abs(dx) < SMALL and up > TINY:
            e1, e2 = small_exponentials(dz)
            ds, dc = small_sincos(dx)
            up, down, s, c = up * e1, down * e2, s * dc + c * ds, c * dc - s * ds
        else:
            s, c = sincos(k * x - om * t + phase)
            up, down = math.exp(k * (z - p.depth)), math.exp(-k * (z + p.depth))
        cosh_part, sinh_part = up + down, up - down
        if p.above == ZERO and X[j, 2] > p.depth:
            cosh_part = sinh_part = 0.0
        uc, us, wc, ws = cosh_part * c, cosh_part * s, sinh_part * c, sinh_part * s
        u, u_t = u0 * uc, u0 * om * us + u1 * uc
        F[j, 0] += cosine * u
        F[j, 1] += sine * u
        F[j, 2] += u0 * ws
        F[j, 3] += cosine * u_t
        F[j, 4] += sine * u_t
        F[j, 5] += u1 * ws - u0 * om * wc


@kernel
def wave_slopes(p, tables, t, X, F, J):
    """J (n, 8): dF/dx (4) and dF/dz (4) at the nodes, from the water F (n, 4) at X (n, 2); the current is uniform.

    The field is harmonic, dU/dx = -dW/dz and dU/dz = dW/dx, and so are its rates. Without a ramp the slopes of
    velocity are its rates times k d/omega, and those of the rates -omega^2 times that.
    """
    kx, om = p.k * p.direction, p.omega
    gain, gain_rate = smooth_start(t, p.ramp)
    rising = gain_rate / where(gain > 0.0, gain, 1.0)
    per_rate = 1.0 / om
    u = w = 0.0
    if p.current:
        u, w = tables[p.cur_at + AXES], tables[p.cur_at + AXES + 2]
    for j in range(X.shape[0]):
        U, W = F[j, 0] - u, F[j, 1] - w
        # gain (more sin, less cos)
        across, lengthwise = per_rate * (F[j, 2] - rising * U), per_rate * (rising * W - F[j, 3])
        U_x, W_x = -kx * across, kx * lengthwise
        A_x, B_x = kx * (om * U - rising * across), kx * (om * W + rising * lengthwise)
        # the height at which the field is taken, by x and by z
        by_x, by_z = 0.0, where(X[j, 1] > 0.0, 1.0, 0.0)
        if p.above == WHEELER:
            s, c = sincos(kx * X[j, 0] - om * t + p.phase)
            high = p.amplitude * gain
            stretch = p.depth / (p.depth + high * c)
            by_x, by_z = larger(X[j, 1], 0.0) * stretch * stretch / p.depth * high * kx * s, by_z * stretch
        J[j, 0], J[j, 4] = U_x + by_x * W_x, by_z * W_x
        J[j, 1], J[j, 5] = W_x - by_x * U_x, -by_z * U_x
        J[j, 2], J[j, 6] = A_x + by_x * B_x, by_z * B_x
        J[j, 3], J[j, 7] = B_x - by_x * A_x, -by_z * A_x
