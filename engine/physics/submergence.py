"""The sphere of eq. (30) partly out of the water: what its wetted cap has less, or more, than the whole sphere.

The cap reaches h below the surface, 0 <= h <= D; h follows from the height of the centre and the surface above it, that
of one linear wave or of a whole sea, h = H + eta(x, t) - z + D/2. With x = h/D, of the whole sphere there are in the
water

    volume   s = pi h^2 (3R - h)/3 / (4 pi R^3/3) = x^2 (3 - 2x)      buoyancy, wave load, added mass
    section  a = (acos(1 - 2x) - 2 (1 - 2x) sqrt(x (1 - x)))/pi       drag: the part of the circle below the surface

both with continuous first derivatives, and exactly 1 from h = D on: a sphere in the water is that of `physics.ends`, to
the last bit. The added mass s M_a varies with the depth. Its force is Lagrange's of the energy s M_a |v|^2/2 of the
water, v = V - U_w, and of the pressure gradient,

    e = ... + s M_a (V_t - dU_w/dt) + M_a s' (h_t v + |v|^2 n/2),    h_t = eta_t + eta_x U - W,    n = (-eta_x, 1)

so that in still water no energy is lost or made (docs/results.md). On the way straight down the last term is
M_a s' W^2/2, half the impact force of von Karman (1929); the other half takes energy away into spray, of which
buoy.impact_loss asks for a share: - loss M_a s' h_t^2 n/2 in e while the cap grows, h_t > 0.

Everything here is the difference to the whole sphere, with signs as in e = N + (M + M_a) V_t + ... = 0.
Derivatives hold the water still at the buoy, but not its surface: the buoy's place moves with dX = dV/cq.
"""

import math

from ..arrays import Stage
from ..compiled import by_kind, kernel
from ..planar import columns as col
from ..simd.elementary import sincos, smooth_start
from ..simd.select import larger, smaller, where
from ..spatial.vectors import dot, minus, mixed, multiple, pair, plus, plus_diagonal, vector
from .sea_series import surface_of_series
from .sea_sum import surface_of_sea


@kernel
def surface(p, t, in_motion, distance):
    """Linear wave at `distance` (m) in its direction of travel: eta, eta', eta'', eta_t, eta_t'; zeros in statics."""
    eta = slope = curve = rate = rate_slope = 0.0
    if p.waves and in_motion > 0.0:
        gain, gain_rate = smooth_start(t, p.ramp)
        high, rising = p.amplitude * gain, p.amplitude * gain_rate
        s, c = sincos(p.k * distance - p.omega * t + p.phase)
        eta = high * c
        slope = -p.k * high * s
        curve = -p.k * p.k * high * c
        rate = p.omega * high * s + rising * c
        rate_slope = p.k * (p.omega * high * c - rising * s)
    return eta, slope, curve, rate, rate_slope


@kernel
def _surface_in_wave(p, t, in_motion, x):
    """As `surface_at`, of one wave."""
    eta, slope, curve, rate, rate_slope = surface(p, t, in_motion, p.direction * x)
    return eta, p.direction * slope, curve, rate, p.direction * rate_slope


@kernel
def surface_at(p, t, in_motion, x, sea):
    """The surface at x (m) in a plane: eta, eta_x, eta_xx, eta_t, eta_tx; zeros in statics.

    sea: of Work, whose water was taken at t, the buoy at x; or None, where there is one wave.
    """
    if sea is None:
        return _surface_in_wave(p, t, in_motion, x)
    if p.sea_n > 0 and p.waves and in_motion > 0.0:
        return surface_of_series(sea)
    return _surface_in_wave(p, t, in_motion, x)


@kernel
def surface_in_space(p, tables, t, in_motion, x, y):
    """The surface at x, y (m): eta, its slopes by x, y, its second derivatives by xx, xy, yy, eta_t and its slopes."""
    if p.sea_n == 0:
        ax, ay = p.dir_x, p.dir_y
        eta, slope, curve, rate, rate_slope = surface(p, t, in_motion, ax * x + ay * y)
        along, across = curve * ax, curve * ay
        rate_x, rate_y = rate_slope * ax, rate_slope * ay
        return eta, slope * ax, slope * ay, along * ax, along * ay, across * ay, rate, rate_x, rate_y
    if in_motion == 0.0 or not p.waves:
        return 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    return surface_of_sea(tables, p.sea_at, p.sea_n, p.ramp, t, x, y)


@kernel
def wetted(p, h):
    """Shares of the sphere in the water whose lowest point is h (m) below the surface.

    Returns 1 - s, s' (1/m), s'' (1/m2), 1 - a, a' (1/m).
    """
    inverse = 1.0 / p.D_buoy
    x = larger(smaller(h * inverse, 1.0), 0.0)
    y = 1.0 - x
    root = math.sqrt(x * y)
    middle = y - x
    crossing = (x > 0.0) & (x < 1.0)
    volume = x * x * (3.0 - 2.0 * x)
    section = (math.acos(middle) - 2.0 * middle * root) / math.pi
    bend = where(crossing, 6.0 * inverse * inverse * middle, 0.0)
    return 1.0 - volume, 6.0 * inverse * x * y, bend, 1.0 - section, 8.0 / math.pi * inverse * root


@kernel
def _passage(p, t, in_motion, X, V, F, sea):
    """Where a buoy at X = (x, z) meets the surface: -eta_x, eta_xx and eta_tx; `wetted`; v, |v|^2; h_t."""
    eta, slope, curve, rate, rate_slope = surface_at(p, t, in_motion, X[0], sea)
    shares = wetted(p, p.depth + eta - X[1] + 0.5 * p.D_buoy)
    u, w = in_motion * V[0] - F[0], in_motion * V[1] - F[1]
    sinking = in_motion * (rate + slope * V[0] - V[1])
    return (-slope, curve, rate_slope), shares, (u, w), u * u + w * w, sinking


@kernel
def cap_end(p, stage, X, V, V_tilde, F, sea):
    """What the cap adds to `engine.physics.ends.upper_end` of a buoy at X = (x, z), m, and to its derivatives.

    Other arguments as there. Returns ex, ez, Dxx, Dxz, Dzx, Dzz.
    """
    cv, over = stage.cv, 1.0 / stage.cq
    A = cv * (V[0] - V_tilde[0]), cv * (V[1] - V_tilde[1])
    ex, ez, Dxx, Dxz, Dzx, Dzz, Gxx, Gxz, Gzx, Gzz = _loads(p, stage, X, V, A, F, sea)
    return ex, ez, Dxx + over * Gxx, Dxz + over * Gxz, Dzx + over * Gzx, Dzz + over * Gzz


@kernel
def _loads(p, stage, X, V, A, F, sea):
    """Loads of the cap less those of the sphere, their derivatives D by the velocity and G by the place."""
    t, in_motion, _, cv = stage
    met, shares, (u, w), square, sinking = _passage(p, t, in_motion, X, V, F, sea)
    nx, curve, rate_slope = met
    dry, ds, bend, bare, da = shares
    speed, (ax, az) = math.sqrt(square), A
    entering = p.impact_loss * larger(sinking, 0.0)
    push = 0.5 * (square - entering * larger(sinking, 0.0))
    impact_x, impact_z = sinking * u + push * nx, sinking * w + push
    slam = p.M_added * ds
    drag = p.C_buoy * bare
    ex = slam * impact_x + p.M_wave * dry * F[2] - p.M_added * dry * ax - drag * speed * u
    ez = slam * impact_z + p.M_wave * dry * F[3] - p.M_added * dry * az - drag * speed * w + p.B_whole * dry
    over_speed = in_motion * drag / where(speed > 0.0, speed, 1.0)
    Dxx = in_motion * (slam * sinking - drag * speed) - p.M_added * dry * cv
    turning = in_motion * slam * (nx * w - u)
    lost = in_motion * slam * entering
    across = over_speed * u * w - lost * nx
    # by the place: through h, whose gradient is -n, and through the slope and the rate of the surface
    added_bend = p.M_added * bend
    gx = added_bend * impact_x + ds * (p.M_added * ax - p.M_wave * F[2]) + p.C_buoy * da * speed * u
    gz = added_bend * impact_z + ds * (p.M_added * az - p.M_wave * F[3] - p.B_whole) + p.C_buoy * da * speed * w
    turned = curve * V[0]
    faster = in_motion * slam * (rate_slope + turned)
    Gxx = faster * (u - entering * nx) - slam * push * curve - gx * nx
    return (
        ex, ez, Dxx - over_speed * u * u + lost * nx * nx, turning - across,
        -turning - across, Dxx - over_speed * w * w + lost,
        Gxx, -gx, faster * (w - entering) - gz * nx, -gz,
    )  # fmt: skip


@kernel
def cap_change(p, base, X, F, dV_tilde, dX_tilde, dF, sea):
    """Known part of the linearised `cap_end` in the tangent dynamics (`engine.perturbations.tangent`): x and z.

    base: Base (`engine.perturbations.tangent`); X (2,), F (4,): place of the last node, and the water there; dV_tilde,
    dX_tilde: what the perturbation of C~ makes of velocity and place there; dF (4,): of the water; sea: of Work.
    """
    last, cv = base.Y.shape[0] - 1, base.rate
    V, A = pair(base.Y[last], col.VX), pair(base.K[last], col.VX)
    G = _loads(p, Stage(base.t, 1.0, cv, cv), X, V, A, F, sea)
    met, shares, (u, w), square, sinking = _passage(p, base.t, 1.0, X, V, F, sea)
    nx, dry, ds, bare = met[0], shares[0], shares[1], shares[3]
    speed = math.sqrt(square)
    product = u * dF[0] + w * dF[1]
    slip_change = product / where(speed > 0.0, speed, 1.0)
    slam, drag, inertia = p.M_added * ds, p.C_buoy * bare, p.M_added * dry * cv
    known_x = G[6] * dX_tilde[0] + G[7] * dX_tilde[1] + inertia * dV_tilde[0] + p.M_wave * dry * dF[2]
    known_z = G[8] * dX_tilde[0] + G[9] * dX_tilde[1] + inertia * dV_tilde[1] + p.M_wave * dry * dF[3]
    known_x += drag * (speed * dF[0] + u * slip_change) - slam * (sinking * dF[0] + nx * product)
    known_z += drag * (speed * dF[1] + w * slip_change) - slam * (sinking * dF[1] + product)
    return known_x, known_z


@kernel
def cap_across(p, t, cv, X, Y, F, V_tilde, sea):
    """What the cap adds to the lateral condition of a buoy: factor of V_y, and the known part."""
    _, (dry, ds, _, bare, _), _, square, sinking = _passage(p, t, 1.0, X, pair(Y, col.VX), F, sea)
    inertia = p.M_added * dry * cv
    of_V = p.M_added * ds * sinking - inertia - p.C_buoy * bare * math.sqrt(square)
    return of_V, inertia * V_tilde


@kernel
def cap_end_3d(p, tables, stage, X, V, V_tilde, F):
    """As `cap_end` in space: X, V, V_tilde (x, y, z), F (6,). Returns e, and the three rows of D."""
    t, in_motion, cq, cv = stage
    eta, eta_x, eta_y, xx, xy, yy, rate, rate_x, rate_y = surface_in_space(p, tables, t, in_motion, X[0], X[1])
    dry, ds, bend, bare, da = wetted(p, p.depth + eta - X[2] + 0.5 * p.D_buoy)
    n, curves_x, curves_y = (-eta_x, -eta_y, 1.0), (xx, xy, 0.0), (xy, yy, 0.0)
    A, v, water = multiple(cv, minus(V, V_tilde)), mixed(in_motion, V, -1.0, vector(F, 0)), vector(F, 3)
    square = dot(v, v)
    speed = math.sqrt(square)
    sinking = in_motion * (rate - dot(n, V))
    entering = p.impact_loss * max(sinking, 0.0)
    push = 0.5 * (square - entering * max(sinking, 0.0))
    impact = mixed(sinking, v, push, n)
    slam, drag = p.M_added * ds, p.C_buoy * bare
    e = mixed(slam, impact, -drag * speed, v)
    e = plus(e, mixed(p.M_wave * dry, water, -p.M_added * dry, A))
    g = mixed(p.M_added * bend, impact, p.C_buoy * da * speed, v)
    g = mixed(1.0, g, ds, mixed(p.M_added, A, -p.M_wave, water))
    g = (g[0], g[1], g[2] - p.B_whole * ds)
    # the place changes the rate of the surface as the buoy sees it, and by its curvature the normal
    faster = (in_motion * slam * (rate_x + dot(curves_x, V)), in_motion * slam * (rate_y + dot(curves_y, V)), 0.0)
    met, bent = mixed(1.0, v, -entering, n), -slam * push
    over_speed = in_motion * drag / speed if speed > 0.0 else 0.0
    diagonal = in_motion * (slam * sinking - drag * speed) - p.M_added * dry * cv
    turning, over = in_motion * slam, 1.0 / cq
    back = mixed(-turning, v, turning * entering, n)
    x = mixed(turning * n[0] - over_speed * v[0], v, back[0] - over * g[0], n)
    y = mixed(turning * n[1] - over_speed * v[1], v, back[1] - over * g[1], n)
    z = mixed(turning * n[2] - over_speed * v[2], v, back[2] - over * g[2], n)
    x = mixed(1.0, x, over, mixed(met[0], faster, bent, curves_x))
    y = mixed(1.0, y, over, mixed(met[1], faster, bent, curves_y))
    z = mixed(1.0, z, over * met[2], faster)
    return (e[0], e[1], e[2] + p.B_whole * dry), plus_diagonal((x, y, z), diagonal)


@kernel
def _nothing_of(p, *arguments):
    """As `cap_end` where the sphere has no cap: it is not called."""
    return 0.0, 0.0, 0.0, 0.0, 0.0, 0.0


end_of_cap = by_kind(cap_end, cap_end, cap_end, _nothing_of)
change_of_cap = by_kind(cap_change, cap_change, cap_change, _nothing_of)
across_cap = by_kind(cap_across, cap_across, cap_across, _nothing_of)
