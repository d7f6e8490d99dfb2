"""The bed, z = 0, on the axis of the line: its load and energy, and what Newton's method and steps do where nodes land.

At the depth p = -z a metre of line meets a spring that begins softly, up to the depth p_0 that its own weight has on
it, a damper as soft, which does not pull, and Coulomb's friction, regular over the speed v_s:

    N = max(k y(p) + c y'(p) p_t, 0),   y = p^2/(2 p_0) up to p_0, then p - p_0/2
    G = ... - N z + mu N u/sqrt(u^2 + v_s^2)

The spring holds k times the integral of y; what N p_t has beyond k y p_t the damper takes, |G.u| friction.
Vectors have three components; a plane has y = 0. Numbers: of an EXTRA record (`engine.record`).
"""

import math

from ..compiled import by_kind, kernel, of_extras
from ..simd.select import larger, smaller, some, where
from ..spatial.vectors import affine, dot, minus, mixed, multiple

ZERO = (0.0, 0.0, 0.0)
WITHIN = 0.99  # of the soft beginning
ROUNDING = 1e-14  # m, of places


@kernel
def _spring(p, depth):
    """y (m), y' and the integral of y (m2) at a depth (m)."""
    onset, gate = p.bed_onset, smaller(larger(depth, 0.0) / p.bed_onset, 1.0)
    beyond = larger(depth - onset, 0.0)
    soft = 0.5 * onset * gate * gate
    return soft + beyond, gate, onset * soft * gate / 3.0 + beyond * (0.5 * onset + 0.5 * beyond)


@kernel
def bed_load(p, in_motion, z, V):
    """Load of the bed on a metre of line at the height z (m) of its axis: the load G has of it, its derivative by V
    (rows) and by z."""
    depth = -z
    y, gate, _ = _spring(p, depth)
    sinking = -in_motion * V[2]
    N = p.bed_stiffness * y + p.bed_damping * gate * sinking
    bears = (depth > 0.0) & (N > 0.0)
    N, gate = where(bears, N, 0.0), where(bears, gate, 0.0)
    if not some(bears):
        nothing = N, N, N
        return nothing, (nothing, nothing, nothing), nothing
    softens = where(bears & (depth < p.bed_onset), p.bed_damping * sinking / p.bed_onset, 0.0)
    by_depth = p.bed_stiffness * gate + softens
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
    return multiple(N, way), rows, multiple(-by_depth, way)


@of_extras((0, 0.0))
def bed_under(p):
    """Is there one, and the height (m) of the anchor above it?"""
    return p.floored, p.anchor_z


@of_extras(0.0)
def bed_energy(p, z):
    """In the spring at the height z (m), J/m."""
    return p.bed_stiffness * _spring(p, -z)[2]


@of_extras((ZERO, 0.0, 0.0, 0.0))
def bed_powers(p, z, V):
    """The load at the height z (m) and the velocity V, and its powers (W/m): into the spring, the damper, friction."""
    load = bed_load(p, 1.0, z, V)[0]
    spring = -p.bed_stiffness * _spring(p, -z)[0] * V[2]
    return load, spring, load[2] * V[2] - spring, load[0] * V[0] + load[1] * V[1]


@kernel
def _last_of(p, *arguments):
    """Without a bed the size of an update, or the error of a step, stays as it is: it is the last argument."""
    return arguments[-1]


@kernel
def _on_the_bed(p, tables, stage, Y, work, factor, size):
    """Mend an update of Newton's method, `factor` of D, where nodes land; returns the size by which it is judged.

    An update that takes a node through all of the soft beginning ends within it: from there Newton's method comes to
    the load; without this it goes to and fro where the damper stops the node at once. An update of size e leaves one of
    e^2: so it counts for no less than the root of what the bed does otherwise than the matrix foresaw, over the weight
    of the line. Speeds alone do not see that 1e-7 m may be this weight.
    """
    axes, over, height, largest = work.C_tilde.shape[1] // 2, 1.0 / stage.cq, p.anchor_z, 0.0
    weight = p.bed_stiffness * p.bed_onset * (p.nodes - 1)  # over the length of an element
    for k in range(1, Y.shape[0] if p.floored else 1):
        rise = work.C_tilde[k - 1, axes - 1] + work.C_tilde[k, axes - 1]
        height += 0.5 * tables[p.grid_at + k - 1] * rise
        V, dV = _velocity(axes, Y[k]), _velocity(axes, work.D[k])
        V_before = mixed(1.0, V, -factor, dV)
        low, high = height + over * V_before[2], height + over * V[2]
        lands = (smaller(low, high) <= -p.bed_onset) & (larger(low, high) >= 0.0)
        Y[k, 2 * axes - 1] = where(lands, -(height + WITHIN * p.bed_onset) * stage.cq, Y[k, 2 * axes - 1])
        size = larger(size, where(lands, 1.0, 0.0))
        load, rows, by_z = bed_load(p, stage.in_motion, low, V_before)
        foreseen = mixed(1.0, affine(rows, multiple(factor, dV), load), high - low, by_z)
        missed = minus(bed_load(p, stage.in_motion, high, V)[0], foreseen)
        largest = larger(largest, dot(missed, missed))
    known = p.bed_stiffness * ROUNDING
    missed_weights = math.sqrt(largest) / weight
    return where(largest > known * known, larger(size, math.sqrt(missed_weights)), size)


@kernel
def _velocity(axes, row):
    return row[axes], row[axes + 1] if axes == 3 else 0.0, row[2 * axes - 1]


on_the_bed = by_kind(_last_of, _last_of, extra=_on_the_bed)


@kernel
def _of_landing(p, tables, dt, Y, Ks, X, error):
    """The greater of the error of a Runge-Kutta step and, where it is too long for the bed's own motion, the speed that
    the bed takes from a node in one stage, over the tolerance.

    Later stages use that stage's force with weights of their own, and so a node may leave faster than it came; the
    embedded estimate, in which the weights of the stage nearly cancel, does not see it. Y: the last stage; Ks: as in
    Trial; X: places.
    """
    s, at = Ks.shape[0], Ks.shape[2] - 1
    too_long = dt * (math.sqrt(p.bed_stiffness / p.m) + p.bed_damping / p.m) > 1.0
    if p.floored and some(too_long):
        share = where(too_long, tables[p.method_at + s * s - 1] * dt * p.per_speed / p.rtol, 0.0)
        for k in range(1, Ks.shape[1]):
            share_there = where(X[k, X.shape[1] - 1] < dt * abs(Y[k, at]), share, 0.0)
            if some(share_there > 0.0):
                for i in range(1, s):
                    error = larger(error, share_there * abs(Ks[i, k, at] - Ks[i - 1, k, at]))
    return error


with_landings = by_kind(_last_of, _last_of, extra=_of_landing)
