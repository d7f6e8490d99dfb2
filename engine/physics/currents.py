"""Currents: one table serves uniform, profile and fully variable currents, U_c(x, y, z, t); in a plane y = 0.

Table in `tables`: [x (nx) | y (ny) | z (nz) | t (nt) | U (nt, nz, ny, nx) | V (same) | W (same)], linear in each
direction and constant beyond its ends. The local acceleration is the slope in time.
"""

from ..compiled import kernel
from ..simd.elementary import bracket

AXES = 4  # numbers before the velocity where every axis has length one


@kernel
def uniform_current(p, tables, t, X, F):
    """As `current_field` where every axis has length one; all that runs of one batch may have."""
    n, size = X.shape
    for j in range(n):
        for column in range(size):
            F[j, column] += tables[p.cur_at + AXES + (column if size == 3 else 2 * column)]


@kernel
def current_field(p, tables, t, X, F):
    """Current velocity and its local acceleration at the nodes, added into F, in a plane and in space.

    X : (n, 2) x, z or (n, 3) x, y, z (m);  F : (n, 4) or (n, 6), velocity (m/s), then its local rate (m/s2)
    """
    n, size = X.shape
    nx, ny, nz, nt = p.cur_nx, p.cur_ny, p.cur_nz, p.cur_nt
    at_y = p.cur_at + nx
    at_z = at_y + ny
    at_t = at_z + nz
    at_u = at_t + nt
    if nx * ny * nz * nt == 1:
        uniform_current(p, tables, t, X, F)
        return
    it, ft, inverse = bracket(tables, at_t, nt, t)
    for j in range(n):
        ix, fx, _ = bracket(tables, p.cur_at, nx, X[j, 0])
        iy, fy, _ = bracket(tables, at_y, ny, X[j, 1] if size == 3 else 0.0)
        iz, fz, _ = bracket(tables, at_z, nz, X[j, size - 1])
        for column in range(size):
            component = column if size == 3 else 2 * column  # a plane has no V
            base = at_u + component * nx * ny * nz * nt
            early = late = 0.0
            for dt in range(2 if nt > 1 else 1):
                value = 0.0
                for dz in range(2 if nz > 1 else 1):
                    wz = fz if dz else 1.0 - fz
                    for dy in range(2 if ny > 1 else 1):
                        wy = wz * (fy if dy else 1.0 - fy)
                        row = base + (((it + dt) * nz + iz + dz) * ny + iy + dy) * nx + ix
                        for dx in range(2 if nx > 1 else 1):
                            value += wy * (fx if dx else 1.0 - fx) * tables[row + dx]
                if dt:
                    late = value
                else:
                    early = value
            F[j, column] += early if nt == 1 else (1.0 - ft) * early + ft * late
            F[j, size + column] += (late - early) * inverse
