"""The laws of `engine.physics.extras` in the nodal quantities of the plane, and in its matrix."""

from ..compiled import by_kind, kernel, of_extras
from ..physics.bed import bed_load
from ..physics.ends import released
from ..physics.extras import ZERO, surface_load, surface_turn, wetting
from ..record import HELD
from ..simd.select import some, where
from ..spatial.vectors import mixed, pair, plus, put_quaternion, quaternion, scaled_rows, sum_of, third_column
from . import columns as col

# Columns of H of lateral perturbations: coefficients of a node: sine and cosine of half the turn of the box below it,
# then derivatives by tau and rho of q_y, N_y (without -dS_b) and G_y, dG_y/dV_y, and (1 + eps)^3
SIN_HALF, COS_HALF, Q_TAU, Q_RHO, N_TAU, N_RHO, G_TAU, G_RHO, G_V, CUBE = range(10)


@kernel
def in_plane(rows):
    """xx, xz, zx, zz of a matrix of three rows."""
    x, _, z = rows
    return x[0], x[2], z[0], z[2]


@of_extras()
def more_loads(p, tables, stage, Y, work):
    """Add to Q, as `node_quantities` left it, what these laws do at every node, at X~ + V/cq (THEORY.md, section 5)."""
    t, in_motion, cq, cv = stage
    heading, over, known = (p.direction, 0.0, 0.0), 1.0 / cq, (p.anchor_x, 0.0, p.anchor_z)
    for k in range(Y.shape[0]):
        row, F, C_tilde = work.Q[k], work.F[k], work.C_tilde[k]
        c, s = pair(row, col.COS)
        if some(p.damping > 0.0):
            damping = in_motion * p.damping
            rate = c * row[col.QX_T] + s * row[col.QZ_T]
            row[col.NX] += damping * rate * c
            row[col.NZ] += damping * rate * s
            row[col.SLOPE] += damping * cq
            row[col.N_TURN] = damping * (c * row[col.QZ_T] - s * row[col.QX_T])
        V, tangent = (Y[k, col.VX], 0.0, Y[k, col.VZ]), (c, 0.0, s)
        if k > 0:
            half, below = 0.5 * tables[p.grid_at + k - 1], work.C_tilde[k - 1]
            known = mixed(1.0, known, half, (below[col.CX] + C_tilde[col.CX], 0.0, below[col.CZ] + C_tilde[col.CZ]))
        x = mixed(1.0, known, over, V)
        load, by_velocity, place, row[col.SHARE] = ZERO, (ZERO, ZERO, ZERO), (ZERO, ZERO, ZERO), 1.0
        row[col.GX] -= p.pushed * F[col.AX]
        row[col.GZ] -= p.pushed * F[col.AZ]
        if p.surfaced:
            inertia = p.m * cv
            ax, az = V[0] - C_tilde[col.VX], V[2] - C_tilde[col.VZ]
            fluid = (row[col.GX] - inertia * ax, 0.0, row[col.GZ] - inertia * az - p.w0)
            v = (in_motion * V[0] - F[col.UX], 0.0, in_motion * V[2] - F[col.UZ])
            wet = wetting(p, t, in_motion, heading, x, V)
            share = row[col.SHARE] = wet[0]
            load, by_v, by_velocity, place = surface_load(p, in_motion, heading, wet, v, tangent, fluid)
            turn = surface_turn(p, wet, v, tangent, (-s, 0.0, c))
            row[col.GX_EPS] *= share
            row[col.GZ_EPS] *= share
            row[col.GX_PHI] = share * row[col.GX_PHI] + turn[0]
            row[col.GZ_PHI] = share * row[col.GZ_PHI] + turn[2]
            row[col.GXX] = share * (row[col.GXX] - inertia) + inertia + by_v[0][0]
            row[col.GXZ] = share * row[col.GXZ] + by_v[0][2]
            row[col.GZX] = share * row[col.GZX] + by_v[2][0]
            row[col.GZZ] = share * (row[col.GZZ] - inertia) + inertia + by_v[2][2]
        if p.floored:
            of_bed, by_V, by_z = bed_load(p, in_motion, x[2], V)
            load = plus(load, of_bed)
            by_velocity = sum_of(by_velocity, by_V)
            place = sum_of(place, third_column(by_z))
        row[col.GX] += load[0]
        row[col.GZ] += load[2]
        put_quaternion(row, col.OWN, in_plane(by_velocity))
        put_quaternion(row, col.BY_PLACE, in_plane(scaled_rows(over, place)))
        for at in range(4):
            row[col.GXX + at] += row[col.OWN + at] + row[col.BY_PLACE + at]


@of_extras()
def known_places(p, tables, over, Y, work):
    """Into C~ of a stage such q~ that X~ + V/c is the place of every node; over: 1/c.

    The box rule of compatibility ties sums of the rates of q to V; lanes keep no others. Where the line is damped, C~
    has the rates themselves already.
    """
    if some(p.damping > 0.0):
        return
    rate_x = rate_z = 0.0
    for k in range(Y.shape[0]):
        if k > 0:
            half = 0.5 * tables[p.grid_at + k - 1]
            rate_x = (Y[k, col.VX] - Y[k - 1, col.VX]) / half - rate_x
            rate_z = (Y[k, col.VZ] - Y[k - 1, col.VZ]) / half - rate_z
        work.C_tilde[k, col.CX] = work.Q[k, col.QX] - over * rate_x
        work.C_tilde[k, col.CZ] = work.Q[k, col.QZ] - over * rate_z


@kernel
def _turns(p, row):
    return row[col.NZ], row[col.NX]


@kernel
def _turns_damped(p, row):
    return row[col.NZ] - row[col.N_TURN] * row[col.COS], row[col.NX] + row[col.N_TURN] * row[col.SIN]


force_by_turn = by_kind(_turns, _turns, extra=_turns_damped)  # -dN_x/dphi and dN_z/dphi


@of_extras((1.0, (0.0, 0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0)))
def beside_drag(p, row):
    """Share of a node in the water; what dG/dV has beside inertia and drag: through V itself, and through the place."""
    return row[col.SHARE], quaternion(row, col.OWN), quaternion(row, col.BY_PLACE)


@of_extras()
def push_by_place(p, over, row, J):
    """Add to dG/dV what the place does to the push of the water, J (8) its slopes (`engine.physics.water`)."""
    push = over * p.pushed * row[col.SHARE]
    row[col.GXX] -= push * J[2]
    row[col.GZX] -= push * J[3]
    row[col.GXZ] -= push * J[6]
    row[col.GZZ] -= push * J[7]


@of_extras((0.0, 0.0))
def known_force(p, rate, row, dC_tilde):
    """Change of N that a change of C~ makes."""
    c, s = row[col.COS], row[col.SIN]
    force = -p.damping * rate * (c * dC_tilde[col.CX] + s * dC_tilde[col.CZ])
    return force * c, force * s


@of_extras((0.0, 0.0))
def known_end(p, t, x, z):
    """Of `known_force` at the upper end, what the condition there has."""
    if p.end == HELD:
        share = where(released(p, t), 1.0, 0.0)
        return share * x, share * z
    return x, z


@of_extras()
def more_across(p, base, X, Q, F, H):
    """Change the coefficients H of lateral perturbations (`engine.perturbations.lateral`) of every node."""
    Y, K, heading = base.Y, base.K, (p.direction, 0.0, 0.0)
    for k in range(Y.shape[0]):
        row, h = Q[k], H[k]
        c, s = pair(row, col.COS)
        x, V = (X[k, 0], 0.0, X[k, 1]), (Y[k, col.VX], 0.0, Y[k, col.VZ])
        row[col.SHARE] = 1.0
        viscous = p.damping * (c * K[k, col.CX] + s * K[k, col.CZ])
        h[N_TAU] += viscous * h[COS_HALF]
        h[N_RHO] -= viscous * h[SIN_HALF]
        if p.surfaced:
            share, ds, _, sinking, _, _, _ = wetting(p, base.t, 1.0, heading, x, V)
            row[col.SHARE] = share
            slam = p.ma * ds * sinking
            vt = (V[0] - F[k, col.UX]) * c + (V[2] - F[k, col.UZ]) * s
            h[G_TAU] = share * h[G_TAU] - slam * vt * h[COS_HALF]
            h[G_RHO] = share * h[G_RHO] + slam * vt * h[SIN_HALF]
            inertia = p.m * base.rate
            h[G_V] = inertia + share * (h[G_V] - inertia) + slam
        if p.floored:
            h[G_V] += bed_load(p, 1.0, x[2], V)[1][1][1]


@kernel
def _inertia_of(p, rate, e, Qa, Qb, below, above):
    return e * ((p.m + p.ma) * rate), below + above


@kernel
def _inertia_of_shares(p, rate, e, Qa, Qb, below, above):
    return e * rate, (p.m + Qa[col.SHARE] * p.ma) * below + (p.m + Qb[col.SHARE] * p.ma) * above


# two factors of e times inertia times the known lateral velocities below and above
lateral_inertia = by_kind(_inertia_of, _inertia_of, extra=_inertia_of_shares)


@of_extras(col.NODE_WIDTH)
def node_width(p):
    """Columns of Q."""
    return col.EXTRA_WIDTH
