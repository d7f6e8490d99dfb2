"""Laws of the line that few scenes have; an EXTRA record (`engine.record`) has their numbers, no other compiles them.

Material damping (Kelvin and Voigt), T = f(eps) + c e_t, with the rate of strain e_t = t.q_t of the stage itself.

The whole of the undisturbed water's push, rho_w pi d^2/4 U_w,t as a vector, in the place of its part across the line:
what a body of that volume has in the pressure of the waves, and the effective tension then has on its cut.

The surface of the water on the line, as on the buoy (`engine.physics.submergence`): where the axis is H + eta - z below
the wave, x = (H + eta - z)/d + 1/2 and s = x^2 (3 - 2x) of the water acts, over the line's own diameter. The load g of
the fluid, the lift B of the displaced water and, so that passages make no energy, Lagrange's force of the energy
s m_a |v_p|^2/2, v_p = v - v_t t, become

    G = m V_t + w0 z + s g + (1 - s) B z + m_a s' (h_t v_p + |v_p|^2 n/2),  h_t = eta_t - n.V,  n = (-grad eta, 1)

The bed, z = 0, on the axis of the line. At the depth p = -z a metre of line meets a spring that begins softly, up to
the depth p_0 that its own weight has on it, a damper as soft, which does not pull, and Coulomb's friction, regular over
the speed v_s:

    N = max(k y(p) + c y'(p) p_t, 0),   y = p^2/(2 p_0) up to p_0, then p - p_0/2
    G = ... - N z + mu N u/sqrt(u^2 + v_s^2)

Loads depend on the place X of a node. A stage moves it with dX = dV/cq, and so their slopes join dG/dV.
Vectors have three components; a plane has y = 0.
"""

import math

from ..compiled import by_kind, kernel
from ..spatial.vectors import affine, dot, mixed
from .submergence import surface

ZERO = (0.0, 0.0, 0.0)
WITHIN = 0.99  # of the soft beginning of the bed


@kernel
def outer(a, u, v):
    """Rows of a u v'."""
    return (
        (a * u[0] * v[0], a * u[0] * v[1], a * u[0] * v[2]),
        (a * u[1] * v[0], a * u[1] * v[1], a * u[1] * v[2]),
        (a * u[2] * v[0], a * u[2] * v[1], a * u[2] * v[2]),
    )


@kernel
def sum_of(A, B):
    """A + B, of three rows each."""
    return mixed(1.0, A[0], 1.0, B[0]), mixed(1.0, A[1], 1.0, B[1]), mixed(1.0, A[2], 1.0, B[2])


@kernel
def wetting(p, t, in_motion, ahead, x, V):
    """At the place x (m) with the velocity V: s, s' (1/m), s'' (1/m2), h_t (m/s), n, and slopes of h_t and n along
    `ahead`, the direction of the waves."""
    eta, slope, curve, rate, rate_slope = surface(p, t, in_motion, dot(ahead, x))
    inverse = 1.0 / p.width
    y = min(max((p.depth + eta - x[2]) * inverse + 0.5, 0.0), 1.0)
    bend = 6.0 * inverse * inverse * (1.0 - 2.0 * y) if 0.0 < y < 1.0 else 0.0
    n = (-ahead[0] * slope, -ahead[1] * slope, 1.0)
    faster = in_motion * (rate_slope + curve * dot(ahead, V))
    share = y * y * (3.0 - 2.0 * y)
    return share, 6.0 * inverse * y * (1.0 - y), bend, in_motion * (rate - dot(n, V)), n, faster, -curve


@kernel
def across_of(v, tangent):
    """v_t and v_p = v - v_t t."""
    vt = dot(v, tangent)
    return vt, mixed(1.0, v, -vt, tangent)


@kernel
def surface_load(p, in_motion, ahead, wet, v, tangent, fluid):
    """What the surface adds to the load of a metre of line, and rows of its derivatives.

    wet: of `wetting`; fluid (N/m): load of the fluid on a line that is all in the water. Returns the load; its
    derivative by v, at given fluid, and by V in h_t alone; by the place.
    """
    share, ds, bend, sinking, n, faster, turning = wet
    vp = across_of(v, tangent)[1]
    half = 0.5 * dot(vp, vp)
    lost = (fluid[0], fluid[1], fluid[2] - p.buoyed)
    impact = mixed(sinking, vp, half, n)
    slam = p.ma * ds
    load = mixed(share - 1.0, lost, slam, impact)
    gain = slam * sinking * in_motion
    by_v = sum_of(outer(slam * in_motion, n, vp), outer(-gain, tangent, tangent))
    by_v = (
        (by_v[0][0] + gain, by_v[0][1], by_v[0][2]),
        (by_v[1][0], by_v[1][1] + gain, by_v[1][2]),
        (by_v[2][0], by_v[2][1], by_v[2][2] + gain),
    )
    of_place = outer(-1.0, mixed(ds, lost, p.ma * bend, impact), n)
    of_place = sum_of(of_place, outer(slam, mixed(faster, vp, half * turning, ahead), ahead))
    return load, by_v, outer(-slam * in_motion, vp, n), of_place


@kernel
def surface_turn(p, wet, v, tangent, dt):
    """Change of the load of `surface_load`, at given fluid, where the tangent turns towards dt."""
    _, ds, _, sinking, n, _, _ = wet
    vt, vp = across_of(v, tangent)
    change = mixed(-vt, dt, -dot(v, dt), tangent)
    return mixed(p.ma * ds * sinking, change, -p.ma * ds * vt * dot(vp, dt), n)


@kernel
def bed_load(p, in_motion, z, V):
    """Load of the bed on a metre of line at the height z (m) of its axis: the load G has of it, its derivative by V
    (rows) and by z."""
    depth = -z
    if depth <= 0.0:
        return ZERO, (ZERO, ZERO, ZERO), ZERO
    gate = min(depth / p.bed_onset, 1.0)
    y = depth - 0.5 * p.bed_onset if depth > p.bed_onset else 0.5 * depth * gate
    sinking = -in_motion * V[2]
    N = p.bed_stiffness * y + p.bed_damping * gate * sinking
    if N <= 0.0:
        return ZERO, (ZERO, ZERO, ZERO), ZERO
    by_depth = p.bed_stiffness * gate + (p.bed_damping * sinking / p.bed_onset if depth < p.bed_onset else 0.0)
    by_sinking = in_motion * p.bed_damping * gate
    u = (in_motion * V[0], in_motion * V[1], 0.0)
    inverse = 1.0 / math.sqrt(u[0] * u[0] + u[1] * u[1] + p.bed_speed * p.bed_speed)
    way = (p.bed_friction * inverse * u[0], p.bed_friction * inverse * u[1], -1.0)  # of the load over N
    rub = in_motion * N * p.bed_friction * inverse
    bent = -rub * inverse * inverse
    rows = (
        (rub + bent * u[0] * u[0], bent * u[0] * u[1], -way[0] * by_sinking),
        (bent * u[0] * u[1], rub + bent * u[1] * u[1], -way[1] * by_sinking),
        (0.0, 0.0, by_sinking),
    )
    return (N * way[0], N * way[1], -N), rows, (-way[0] * by_depth, -way[1] * by_depth, by_depth)


@kernel
def _as_it_is(p, tables, stage, Y, work, factor, size):
    return size


@kernel
def _on_the_bed(p, tables, stage, Y, work, factor, size):
    """Mend an update of Newton's method, `factor` of D, where a node meets the bed; returns its size.

    An update that takes a node through the whole soft beginning of the bed, where the damper sets in, ends within it:
    from there Newton's method comes to the load, without it jumps to and fro. Else, what the bed does otherwise than
    the matrix made of the update, over the weight of the line, is left to the next one, which is of the size e where e^2 is left: so an
    update counts for no less than the root.
    """
    axes, over, height, most = work.C_tilde.shape[1] // 2, 1.0 / stage.cq, p.anchor_z, 0.0
    weight = p.bed_stiffness * p.bed_onset * (p.nodes - 1)  # over the length of an element
    for k in range(1, Y.shape[0] if p.floored else 1):
        rise = work.C_tilde[k - 1, axes - 1] + work.C_tilde[k, axes - 1]
        height += 0.5 * tables[p.grid_at + k - 1] * rise
        V, dV = _velocity(axes, Y[k]), _velocity(axes, work.D[k])
        before = mixed(1.0, V, -factor, dV)
        low, high = height + over * before[2], height + over * V[2]
        if min(low, high) <= -p.bed_onset and max(low, high) >= 0.0:
            Y[k, 2 * axes - 1] = -(height + WITHIN * p.bed_onset) * stage.cq
            size = max(size, 1.0)
        load, rows, by_z = bed_load(p, stage.in_motion, low, before)
        foreseen = mixed(1.0, affine(rows, mixed(factor, dV, 0.0, dV), load), high - low, by_z)
        missed = mixed(1.0, bed_load(p, stage.in_motion, high, V)[0], -1.0, foreseen)
        most = max(most, dot(missed, missed))
    return max(size, (most / (weight * weight)) ** 0.25) if p.floored else size


@kernel
def _velocity(axes, row):
    return row[axes], row[axes + 1] if axes == 3 else 0.0, row[2 * axes - 1]


on_the_bed = by_kind(_as_it_is, _as_it_is, extra=_on_the_bed)


@kernel
def _as_embedded(p, tables, dt, Ys, Ks, X, error):
    return error


@kernel
def _of_landing(p, tables, dt, Ys, Ks, X, error):
    """The greater of the error of a Runge-Kutta step and, where it is too long for the bed's own motion, the speed that
    the bed takes from a node in one stage, over the tolerance.

    Later stages use that stage's force with weights of their own, and so a node may leave faster than it came; the
    embedded estimate, in which the weights of the stage nearly cancel, does not see it. Ys, Ks: as in Trial; X: places.
    """
    s, at = Ks.shape[0], Ks.shape[2] - 1
    rate = math.sqrt(p.bed_stiffness / p.m) + p.bed_damping / p.m
    if p.floored and dt * rate > 1.0:
        share = tables[p.method_at + s * s - 1] * dt * p.per_speed / p.rtol
        for k in range(1, Ks.shape[1]):
            if X[k, X.shape[1] - 1] < dt * abs(Ys[s - 1, k, at]):
                for i in range(1, s):
                    error = max(error, share * abs(Ks[i, k, at] - Ks[i - 1, k, at]))
    return error


with_landings = by_kind(_as_embedded, _as_embedded, extra=_of_landing)
