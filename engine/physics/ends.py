"""The upper end: buoy (30), held, or free under a force. (The lower one, V = 0, begins the elimination.)

Each condition is as many equations e = 0 as there are dimensions, in the force N and velocity V of the last node, with
e_N (eN) the factor of dN (1 or 0) and D = de/dV; V_t = cv (V - V~); this e is no length of an element:

    buoy   e = N + (M + M_a) V_t + C |v| v - (rho V + M_a) dU_w/dt - (B - W) z,   C = rho C_d A_p / 2, v = V - U_w
    held   e = V - V_e(t), V_e the velocity at which the end is moved; after its release e = N - F
    free   e = N - F, where it breaks F cos^2(pi t/(2 t_br)) until t_br and nothing after

In the record M_total = M + M_a, M_wave = rho V + M_a, lift = B - W, C_buoy = C (`engine.parameters`).
The place of a held end follows from V by integration: it is off by what Newton's method leaves over, 1 mm after ten
oscillations of 1 m at the default tolerances (`docs/scenes.md`). In statics V is a displacement, and V_e the one
that is left to go (`engine.time.statics` puts it into end_x ... end_z).

Motion of a held end in `tables`, n numbers or knots: velocities, since the displacement follows from them:
    harmonic  [A x y z | omega | phase | ramp | B x y z];  displacement r (A sin + B cos)(omega t + phase), r the ramp
              (circular: A = (0, 0, -R), B = (R, 0, 0))
    table     [t (n) | for each of the n - 1 pieces, for x, y, z: v0 v1 v2], v = v0 + v1 d + v2 d^2 at d after its knot

In the paper: eq. (30) motion of the buoy.
"""

import math

import numpy as np

from ..compiled import by_kind, kernel
from ..record import BUOY, FREE, HARMONIC, TABLE
from ..simd.elementary import bracket, smooth_start
from ..simd.select import where
from ..spatial.vectors import dot, minus, mixed, plus, vector


def table_of(time_s: np.ndarray, displacement_m: np.ndarray) -> np.ndarray:
    """Knots and velocities of a tabulated motion in the layout above.

    The displacement is the monotone cubic of Fritsch & Carlson (PCHIP) with slopes zero at both ends: beyond them the
    end is at rest, and a jump of its velocity would be a blow of infinite force.
    """
    from scipy.interpolate import CubicHermiteSpline, PchipInterpolator

    values = np.asarray(displacement_m, float)
    slopes = PchipInterpolator(time_s, values).derivative()(time_s)
    slopes[[0, -1]] = 0.0
    rates = CubicHermiteSpline(time_s, values, slopes).derivative().c[::-1]  # (power, piece, component)
    return np.concatenate([np.asarray(time_s, float), rates.transpose(1, 2, 0).ravel()])


@kernel
def end_velocity(p, tables, t):
    """Velocity (vx, vy, vz), m/s, at which a held end is moved at time t; zeros where nothing moves it."""
    at = p.end_at
    if p.end_motion == HARMONIC:
        omega = tables[at + 3]
        angle = omega * t + tables[at + 4]
        gain, gain_rate = smooth_start(t, tables[at + 5])
        sine, cosine = math.sin(angle), math.cos(angle)
        rate, rate_of_cosine = gain_rate * sine + gain * omega * cosine, gain_rate * cosine - gain * omega * sine
        return mixed(rate, vector(tables, at), rate_of_cosine, vector(tables, at + 6))
    if p.end_motion == TABLE:
        piece, part, inverse = bracket(tables, at, p.end_n, t)
        if inverse > 0.0:
            d = part / inverse
            c = at + p.end_n + 9 * piece
            return _parabola(d, tables, c), _parabola(d, tables, c + 3), _parabola(d, tables, c + 6)
    return 0.0, 0.0, 0.0


@kernel
def _parabola(d, tables, at):
    return tables[at] + d * (tables[at + 1] + d * tables[at + 2])


@kernel
def next_corner(p, tables, t):
    """Next time (s) after t at which a held end's acceleration jumps: its release, a row of its table, the end of its
    ramp; infinite where none is left. A step across it would leave the end 1e-5 m from its place.
    """
    corner = p.end_release if t < p.end_release else np.inf
    if p.end_motion == HARMONIC:
        ramp = tables[p.end_at + 5]
        if t < ramp < corner:
            corner = ramp
    elif p.end_motion == TABLE:
        for i in range(p.end_n):
            knot = tables[p.end_at + i]
            if t < knot:
                return min(corner, knot)
    return corner


@kernel
def _no_corner(p, tables, t):
    """As `next_corner` for a buoy."""
    return p.end_release


corner_after = by_kind(next_corner, next_corner, _no_corner)


@kernel
def released(p, t):
    """Has a held end been let go? Not in a step that ends at the release, whatever the rounding of its time."""
    return t > p.end_release * (1.0 + 1e-13)


@kernel
def force_left(p, t):
    """Share of the force on a free end that is left at time t: cos^2(pi t/(2 t_br)) where it breaks (section 4.1.1)."""
    if p.end_decay == 0.0:
        return 1.0
    return math.cos(0.5 * math.pi * t / p.end_decay) ** 2 if t < p.end_decay else 0.0


@kernel
def _given_end(p, tables, stage, end, force):
    """e_N of a held or free end, 1 where its force is given and 0 where its velocity is; the share of it that is left;
    and the force (N) or velocity (m/s), (x, y, z). end, force: end_x ... and end_fx ... of the record."""
    if p.end == FREE:
        return 1.0, force_left(p, stage.t), end
    if stage.in_motion == 0.0:
        return 0.0, 1.0, end
    if released(p, stage.t):
        return 1.0, 1.0, force
    return 0.0, 1.0, end_velocity(p, tables, stage.t)


@kernel
def upper_end(p, tables, stage, N, V, V_tilde, F):
    """Residual and derivatives of the upper end in a plane.

    stage: Stage; N (N), V, V_tilde (m/s): (x, z);  F : (4,) water velocity and acceleration there.
    Returns ex, ez, e_N, Dxx, Dxz, Dzz.
    """
    if p.end != BUOY:
        end, force = (p.end_x, 0.0, p.end_z), (p.end_fx, 0.0, p.end_fz)
        eN, share, target = _given_end(p, tables, stage, end, force)
        actual = V
        if eN > 0.0:
            actual = N
        return actual[0] - share * target[0], actual[1] - share * target[2], eN, 1.0 - eN, 0.0, 1.0 - eN
    return _buoy_end(p, tables, stage, N, V, V_tilde, F)


@kernel
def _buoy_end(p, tables, stage, N, V, V_tilde, F):
    """As `upper_end` for a buoy, eq. (30): the one end that runs of one batch may have (`engine.simd`)."""
    in_motion = stage.in_motion
    inertia = p.M_total * stage.cv
    ex = N[0] + inertia * (V[0] - V_tilde[0])
    ez = N[1] + inertia * (V[1] - V_tilde[1]) - p.lift
    Dxx = Dzz = inertia
    Dxz = 0.0
    if p.wet:
        u = in_motion * V[0] - F[0]
        w = in_motion * V[1] - F[1]
        speed = math.sqrt(u * u + w * w)
        ex += p.C_buoy * speed * u - p.M_wave * F[2]
        ez += p.C_buoy * speed * w - p.M_wave * F[3]
        over_speed = in_motion * p.C_buoy / where(speed > 0.0, speed, 1.0)
        Dxx += in_motion * p.C_buoy * speed + over_speed * u * u
        Dxz = over_speed * u * w
        Dzz += in_motion * p.C_buoy * speed + over_speed * w * w
    return ex, ez, 1.0, Dxx, Dxz, Dzz


planar_end = by_kind(upper_end, upper_end, _buoy_end)


@kernel
def upper_end_3d(p, tables, stage, N, V, V_tilde, F):
    """As `upper_end` in space: N, V, V_tilde (x, y, z);  F : (6,).

    Returns (ex, ey, ez), e_N, (Dxx, Dxy, Dxz, Dyy, Dyz, Dzz).
    """
    if p.end != BUOY:
        end, force = (p.end_x, p.end_y, p.end_z), (p.end_fx, p.end_fy, p.end_fz)
        eN, share, target = _given_end(p, tables, stage, end, force)
        actual = V
        if eN > 0.0:
            actual = N
        return mixed(-share, target, 1.0, actual), eN, (1.0 - eN, 0.0, 0.0, 1.0 - eN, 0.0, 1.0 - eN)
    inertia = p.M_total * stage.cv
    ex, ey, ez = mixed(inertia, minus(V, V_tilde), 1.0, N)
    e = ex, ey, ez - p.lift
    Dxx = Dyy = Dzz = inertia
    Dxy = Dxz = Dyz = 0.0
    if p.wet:
        slip = mixed(stage.in_motion, V, -1.0, vector(F, 0))
        speed = math.sqrt(dot(slip, slip))
        e = plus(e, mixed(p.C_buoy * speed, slip, -p.M_wave, vector(F, 3)))
        if speed > 0.0:
            u, v, w = slip
            factor = stage.in_motion * p.C_buoy
            over_speed = factor / speed
            Dxx += factor * speed + over_speed * u * u
            Dyy += factor * speed + over_speed * v * v
            Dzz += factor * speed + over_speed * w * w
            Dxy, Dxz, Dyz = over_speed * u * v, over_speed * u * w, over_speed * v * w
    return e, 1.0, (Dxx, Dxy, Dxz, Dyy, Dyz, Dzz)
