"""Currents: one table U_c(x, z, t) in the plane serves uniform, profile and fully variable currents.

Table layout in `tables`: [x (nx) | z (nz) | t (nt) | U (nt, nz, nx) | W (nt, nz, nx)], linear in each direction and
constant beyond its ends; an axis of length one costs nothing. The local acceleration is the slope in time.
"""

import numpy as np

from .compiled import kernel


def table_of(x_m, height_m, time_s, velocity_x_mps, velocity_z_mps):
    """Current table in the layout above; velocities are (nt, nz, nx), m/s."""
    parts = [x_m, height_m, time_s, velocity_x_mps, velocity_z_mps]
    return np.concatenate([np.asarray(part, float).ravel() for part in parts])


@kernel
def _bracket(tables, at, n, value):
    """Lower index, weight of the upper neighbour, and 1/spacing (0 beyond the ends)."""
    if n == 1 or value <= tables[at]:
        return 0, 0.0, 0.0
    if value >= tables[at + n - 1]:
        return n - 2, 1.0, 0.0
    low, high = 0, n - 1
    while high - low > 1:
        mid = (low + high) // 2
        if tables[at + mid] <= value:
            low = mid
        else:
            high = mid
    inverse = 1.0 / (tables[at + low + 1] - tables[at + low])
    return low, (value - tables[at + low]) * inverse, inverse


@kernel
def current_field(p, tables, t, X, F):
    """Current velocity and its local acceleration at the nodes, added into F (as `engine.waves.wave_field`)."""
    nx, nz, nt = p.cur_nx, p.cur_nz, p.cur_nt
    at_z = p.cur_at + nx
    at_t = at_z + nz
    at_u = at_t + nt
    size = nx * nz * nt
    it, ft, inverse = _bracket(tables, at_t, nt, t)
    for j in range(X.shape[0]):
        ix, fx, _ = _bracket(tables, p.cur_at, nx, X[j, 0])
        iz, fz, _ = _bracket(tables, at_z, nz, X[j, 1])
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
