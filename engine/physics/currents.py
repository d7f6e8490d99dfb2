"""Currents: one table serves uniform, profile and fully variable currents, U_c(x, z, t) or, in space, U_c(x, y, z, t).

Table layout in `tables`:
    plane  [x (nx) | z (nz) | t (nt) | U (nt, nz, nx) | W (nt, nz, nx)]
    space  [x (nx) | y (ny) | z (nz) | t (nt) | U (nt, nz, ny, nx) | V (same) | W (same)]
linear in each direction and constant beyond its ends; an axis of length one costs nothing. The local acceleration is
the slope in time.
"""

import numpy as np

from ..compiled import by_kind, kernel
from ..simd.elementary import bracket


def table_of(axes, velocities):
    """Current table in the layout above: the axes, then the components, m/s."""
    return np.concatenate([np.asarray(part, float).ravel() for part in (*axes, *velocities)])


@kernel
def is_uniform(p):
    """Is the current of a plane the same everywhere and at all times?"""
    return p.cur_nx == 1 and p.cur_nz == 1 and p.cur_nt == 1


@kernel
def uniform_current(p, tables, t, X, F):
    """As `current_field` where every axis has length one; all that runs of one batch may have (`engine.simd`)."""
    u, w = tables[p.cur_at + 3], tables[p.cur_at + 4]
    for j in range(X.shape[0]):
        F[j, 0] += u
        F[j, 1] += w


@kernel
def current_field(p, tables, t, X, F):
    """Current velocity and its local acceleration at the nodes, added into F (as `engine.physics.waves.wave_field`)."""
    if is_uniform(p):
        uniform_current(p, tables, t, X, F)
        return
    nx, nz, nt = p.cur_nx, p.cur_nz, p.cur_nt
    at_z = p.cur_at + nx
    at_t = at_z + nz
    at_u = at_t + nt
    size = nx * nz * nt
    it, ft, inverse = bracket(tables, at_t, nt, t)
    for j in range(X.shape[0]):
        ix, fx, _ = bracket(tables, p.cur_at, nx, X[j, 0])
        iz, fz, _ = bracket(tables, at_z, nz, X[j, 1])
        for component in range(2):
            base = at_u + component * size
            early = late = 0.0
            for dt in range(2 if nt > 1 else 1):
                value = 0.0
                for dz in range(2 if nz > 1 else 1):
                    wz = fz if dz else 1.0 - fz
                    for dx in range(2 if nx > 1 else 1):
                        wx = fx if dx else 1.0 - fx
                        value += wz * wx * tables[base + ((it + dt) * nz + iz + dz) * nx + ix + dx]
                if dt:
                    late = value
                else:
                    early = value
            F[j, component] += early if nt == 1 else (1.0 - ft) * early + ft * late
            F[j, component + 2] += (late - early) * inverse


planar_current = by_kind(current_field, current_field, uniform_current)


@kernel
def current_field_3d(p, tables, t, X, F):
    """Current velocity and its local acceleration at the nodes, added into F (as `physics.waves.wave_field_3d`)."""
    nx, ny, nz, nt = p.cur_nx, p.cur_ny, p.cur_nz, p.cur_nt
    at_y = p.cur_at + nx
    at_z = at_y + ny
    at_t = at_z + nz
    at_u = at_t + nt
    size = nx * ny * nz * nt
    it, ft, inverse = bracket(tables, at_t, nt, t)
    for j in range(X.shape[0]):
        ix, fx, _ = bracket(tables, p.cur_at, nx, X[j, 0])
        iy, fy, _ = bracket(tables, at_y, ny, X[j, 1])
        iz, fz, _ = bracket(tables, at_z, nz, X[j, 2])
        for component in range(3):
            base = at_u + component * size
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
            F[j, component] += early if nt == 1 else (1.0 - ft) * early + ft * late
            F[j, component + 3] += (late - early) * inverse
