"""The laws of `engine.physics.extras` in the nodal quantities in space, and in its matrix."""

from ..compiled import of_extras
from ..physics.bed import bed_load
from ..physics.extras import surface_load, surface_turn, wetting
from . import columns as col
from .vectors import (
    dot,
    minus,
    mixed,
    multiple,
    plus,
    plus_diagonal,
    put,
    put_rows,
    rows_of,
    scaled_rows,
    sum_of,
    third_column,
    vector,
)


@of_extras()
def more_loads(p, tables, stage, Y, work):
    """Add to Q, as `node_quantities` left it, what these laws do at every node, at X~ + V/cq (THEORY.md, section 5)."""
    t, in_motion, cq, cv = stage
    heading, over, known = (p.dir_x, p.dir_y, 0.0), 1.0 / cq, (p.anchor_x, p.anchor_y, p.anchor_z)
    for k in range(Y.shape[0]):
        row, F, V = work.Q[k], work.F[k], vector(Y[k], col.V)
        tangent, n, b = rows_of(row, col.T_VECTOR)
        if k > 0:
            passed = plus(vector(work.C_tilde[k - 1], 0), vector(work.C_tilde[k], 0))
            known = mixed(1.0, known, 0.5 * tables[p.grid_at + k - 1], passed)
        x = mixed(1.0, known, over, V)
        if p.damping > 0.0:
            damping, q_t = in_motion * p.damping, vector(row, col.Q_T)
            rate = damping * dot(tangent, q_t)
            put(row, col.N, mixed(1.0, vector(row, col.N), rate, tangent))
            row[col.TENSION] += rate
            row[col.SLOPE] += damping * cq
            row[col.N_TURN2], row[col.N_TURN3] = damping * dot(b, q_t), -damping * dot(n, q_t)
        G = mixed(1.0, vector(row, col.G), -p.pushed, vector(F, col.ACCELERATION))
        by_V = rows_of(row, col.G_V)
        if p.surfaced:
            inertia = p.m * cv
            gx, gy, gz = mixed(1.0, G, -inertia, minus(V, vector(work.C_tilde[k], col.V)))
            v = mixed(in_motion, V, -1.0, vector(F, 0))
            wet = wetting(p, t, in_motion, heading, x, V)
            load, by_v, by_velocity, place = surface_load(p, in_motion, heading, wet, v, tangent, (gx, gy, gz - p.w0))
            share = wet[0]
            put(row, col.G_EPS, multiple(share, vector(row, col.G_EPS)))
            for at, dt in ((col.G_THETA2, mixed(-1.0, b, 0.0, b)), (col.G_THETA3, n)):
                put(row, at, mixed(share, vector(row, at), 1.0, surface_turn(p, wet, v, tangent, dt)))
            G = plus(G, load)
            matrix = sum_of(sum_of(by_v, by_velocity), scaled_rows(over, place))
            by_V = plus_diagonal(sum_of(matrix, scaled_rows(share, by_V)), inertia - share * inertia)
        if p.floored:
            load, of_V, by_z = bed_load(p, in_motion, x[2], V)
            G = plus(G, load)
            by_V = sum_of(by_V, sum_of(of_V, scaled_rows(over, third_column(by_z))))
        put(row, col.G, G)
        put_rows(row, col.G_V, by_V)


@of_extras((0.0, 0.0))
def along_by_turn(p, row):
    """What dN/dtheta2 and dN/dtheta3 along t are less."""
    return row[col.N_TURN2], row[col.N_TURN3]


@of_extras(col.NODE_WIDTH)
def node_width(p):
    """Columns of Q."""
    return col.EXTRA_WIDTH
