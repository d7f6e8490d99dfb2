"""Laws of the line that few scenes have; an EXTRA record (`engine.record`) has their numbers, no other compiles them.

Material damping (Kelvin and Voigt), T = f(eps) + c e_t, with the rate of strain e_t = t.q_t of the stage itself.

The whole of the undisturbed water's push, rho_w pi d^2/4 U_w,t as a vector, in the place of its part across the line:
what a body of that volume has in the pressure of the waves, and the effective tension then has on its cut.

The surface of the water on the line, as on the buoy (`engine.physics.submergence`): where the axis is H + eta - z below
the wave, x = (H + eta - z)/d + 1/2 and s = x^2 (3 - 2x) of the water acts, over the line's own diameter. The load g of
the fluid, the lift B of the displaced water and, so that passages make no energy, Lagrange's force of the energy
s m_a |v_p|^2/2, v_p = v - v_t t, become

    G = m V_t + w0 z + s g + (1 - s) B z + m_a s' (h_t v_p + |v_p|^2 n/2),  h_t = eta_t - n.V,  n = (-grad eta, 1)

The bed is in `engine.physics.bed`.

Loads depend on the place X of a node. A stage moves it with dX = dV/cq, and so their slopes join dG/dV.
Vectors have three components; a plane has y = 0.
"""

from ..compiled import kernel
from ..simd.select import larger, smaller, where
from ..spatial.vectors import dot, mixed, plus_diagonal, sum_of
from .submergence import surface

ZERO = (0.0, 0.0, 0.0)


@kernel
def outer(a, u, v):
    """Rows of a u v'."""
    return (
        (a * u[0] * v[0], a * u[0] * v[1], a * u[0] * v[2]),
        (a * u[1] * v[0], a * u[1] * v[1], a * u[1] * v[2]),
        (a * u[2] * v[0], a * u[2] * v[1], a * u[2] * v[2]),
    )


@kernel
def wetting(p, t, in_motion, heading, x, V):
    """At the place x (m) with the velocity V: s, s' (1/m), s'' (1/m2), h_t (m/s), n, and slopes of h_t and n along
    `heading`, the direction of the waves."""
    eta, slope, curve, rate, rate_slope = surface(p, t, in_motion, dot(heading, x))
    inverse = 1.0 / p.diameter
    y = smaller(larger((p.depth + eta - x[2]) * inverse + 0.5, 0.0), 1.0)
    bend = where((y > 0.0) & (y < 1.0), 6.0 * inverse * inverse * (1.0 - 2.0 * y), 0.0)
    n = (-heading[0] * slope, -heading[1] * slope, 1.0)
    faster = in_motion * (rate_slope + curve * dot(heading, V))
    share = y * y * (3.0 - 2.0 * y)
    return share, 6.0 * inverse * y * (1.0 - y), bend, in_motion * (rate - dot(n, V)), n, faster, -curve


@kernel
def across_of(v, tangent):
    """v_t and v_p = v - v_t t."""
    vt = dot(v, tangent)
    return vt, mixed(1.0, v, -vt, tangent)


@kernel
def surface_load(p, in_motion, heading, wet, v, tangent, fluid):
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
    by_v = plus_diagonal(sum_of(outer(slam * in_motion, n, vp), outer(-gain, tangent, tangent)), gain)
    of_place = outer(-1.0, mixed(ds, lost, p.ma * bend, impact), n)
    of_place = sum_of(of_place, outer(slam, mixed(faster, vp, half * turning, heading), heading))
    return load, by_v, outer(-slam * in_motion, vp, n), of_place


@kernel
def surface_turn(p, wet, v, tangent, dt):
    """Change of the load of `surface_load`, at given fluid, where the tangent turns towards dt."""
    _, ds, _, sinking, n, _, _ = wet
    vt, vp = across_of(v, tangent)
    change = mixed(-vt, dt, -dot(v, dt), tangent)
    return mixed(p.ma * ds * sinking, change, -p.ma * ds * vt * dot(vp, dt), n)
