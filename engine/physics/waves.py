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

from ..compiled import by_kind, kernel
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
def _heading_in_plane(p):
    return p.direction, 0.0


@kernel
def _heading_in_space(p):
    return p.dir_x, p.dir_y


heading = by_kind(_heading_in_plane, _heading_in_space)  # cosine and sine of the direction of the waves


@kernel
def _stretched_in_plane(p, gain, z, crest):
    return z * p.depth / (p.depth + p.amplitude * gain * crest)


@kernel
def _stretched_in_space(p, gain, z, crest):
    return z * p.depth / max(p.depth + gain * (p.amplitude * crest), 1e-3 * p.depth)


# Wheeler's height: stretched so that the crest is where the still water level was; crest: cosine of the phase there
stretched = by_kind(_stretched_in_plane, _stretched_in_space)


@kernel
def wave_field(p, tables, t, X, F):
    """Water velocity and local acceleration at the nodes, added into F (a sea: `physics.sea`).

    X : (n, 2) x, z or (n, 3) x, y, z (m);  F : (n, 4) or (n, 6), velocity (m/s), then its local rate (m/s2)
    """
    n, size = X.shape
    k, om = p.k, p.omega
    cosine, sine = heading(p)
    gain, gain_rate = smooth_start(t, p.ramp)
    speed = p.amplitude * om / (1.0 - math.exp(-2.0 * k * p.depth))
    u0, u1 = speed * gain, speed * gain_rate  # under the ramp of the waves; their rate
    up, down, s, c = 0.0, 0.0, 0.0, 1.0
    fresh_s = fresh_c = x_below = z_below = 0.0
    for j in range(n):
        x = cosine * X[j, 0] + sine * X[j, 1]
        z = larger(X[j, size - 1], 0.0)
        if p.above == WHEELER:
            fresh_s, fresh_c = sincos(k * x - om * t + p.phase)
            z = stretched(p, gain, z, fresh_c)
        dz, dx = k * (z - z_below), k * (x - x_below)
        near = (abs(dz) < SMALL) & (abs(dx) < SMALL) & (up > TINY)
        x_below, z_below = x, z
        e1, e2 = small_exponentials(dz)
        ds, dc = small_sincos(dx)
        near_up, near_down, near_s, near_c = up * e1, down * e2, s * dc + c * ds, c * dc - s * ds
        recurs = j > 0 and (size == 3 or p.above != WHEELER)
        if recurs and every(near):
            up, down, s, c = near_up, near_down, near_s, near_c
        else:
            if p.above != WHEELER:
                fresh_s, fresh_c = sincos(k * x - om * t + p.phase)
            s, c = fresh_s, fresh_c
            up = math.exp(k * (z - p.depth))
            down = math.exp(-k * (z + p.depth))
            if recurs:
                up, down = where(near, near_up, up), where(near, near_down, down)
                s, c = where(near, near_s, s), where(near, near_c, c)
        cosh_part, sinh_part = up + down, up - down  # of cosh and of sinh
        if p.above == ZERO:
            dry = X[j, size - 1] > p.depth
            cosh_part, sinh_part = where(dry, 0.0, cosh_part), where(dry, 0.0, sinh_part)
        uc, us, wc, ws = cosh_part * c, cosh_part * s, sinh_part * c, sinh_part * s
        u, u_t = u0 * uc, u0 * om * us + u1 * uc
        F[j, 0] += cosine * u
        F[j, size] += cosine * u_t
        if size == 3:
            F[j, 1] += sine * u
            F[j, 4] += sine * u_t
        F[j, size - 1] += u0 * ws
        F[j, 2 * size - 1] += u1 * ws - u0 * om * wc


@kernel
def put_slopes(J, by_x, by_z, velocity, rate):
    """J (8,) of a node: dF/dx (4), dF/dz (4), where the water is taken at a height that changes by by_x dx + by_z dz.

    velocity, rate: slopes of U and of dU/dt by x, and by that height. The field is harmonic, dU/dx = -dW/dz and
    dU/dz = dW/dx, and so are its rates.
    """
    U_x, U_z = velocity
    A_x, A_z = rate
    J[0], J[4] = U_x + by_x * U_z, by_z * U_z
    J[1], J[5] = U_z - by_x * U_x, -by_z * U_x
    J[2], J[6] = A_x + by_x * A_z, by_z * A_z
    J[3], J[7] = A_z - by_x * A_x, -by_z * A_x


@kernel
def wave_slopes(p, tables, t, X, F, J):
    """J (n, 8): dF/dx (4) and dF/dz (4) at the nodes, from the water F (n, 4) at X (n, 2); the current is uniform.

    Without a ramp the slopes of velocity are its rates times k d/omega, and those of the rates -omega^2 times that.
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
        by_velocity = -kx * across, kx * lengthwise
        by_rate = kx * (om * U - rising * across), kx * (om * W + rising * lengthwise)
        # the height at which the field is taken, by x and by z
        by_x, by_z = 0.0, where(X[j, 1] > 0.0, 1.0, 0.0)
        if p.above == WHEELER:
            s, c = sincos(kx * X[j, 0] - om * t + p.phase)
            high = p.amplitude * gain
            stretch = p.depth / (p.depth + high * c)
            by_x, by_z = larger(X[j, 1], 0.0) * stretch * stretch / p.depth * high * kx * s, by_z * stretch
        put_slopes(J[j], by_x, by_z, by_velocity, by_rate)
