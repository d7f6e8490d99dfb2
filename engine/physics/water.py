"""The water at the nodes: waves, regular or not, and current."""

import numpy as np

from ..compiled import by_kind, kernel
from ..simd.elementary import copy_into
from .currents import current_field, uniform_current
from .sea_series import sea_in_lanes, sea_in_plane, sea_slopes
from .sea_sum import sea_field
from .waves import wave_field, wave_field_in_space, wave_slopes

NUDGE = 1e-6  # m


@kernel
def _in_plane(p, tables, t, X, F, sea):
    if p.sea_n == 0:
        wave_field(p, tables, t, X, F)
    else:
        sea_in_plane(p, tables, t, X, F, sea)


@kernel
def _in_space(p, tables, t, X, F, sea):
    if p.sea_n == 0:
        wave_field_in_space(p, tables, t, X, F)
    else:
        sea_field(p, tables, t, X, F, sea)


@kernel
def _in_lanes(p, tables, t, X, F, sea):
    if p.sea_n == 0:
        wave_field(p, tables, t, X, F)
    else:
        sea_in_lanes(p, tables, t, X, F, sea)


@kernel
def _regular(p, tables, t, X, F, sea):
    wave_field(p, tables, t, X, F)


waves = by_kind(_in_plane, _in_space, _in_lanes, _regular)
current = by_kind(current_field, current_field, uniform_current)


@kernel
def water(p, tables, t, in_motion, X, F, sea):
    """Velocity and acceleration of the water at places X (n, 2) or (n, 3), into F (n, 4) or (n, 6).

    in_motion: 1.0, or 0.0 to leave out the waves. sea: of Work. Where there is no water F is not touched.
    """
    if p.wet == 0:
        return
    for k in range(F.shape[0]):
        for i in range(F.shape[1]):
            F[k, i] = 0.0
    if p.waves and in_motion > 0.0:
        waves(p, tables, t, X, F, sea)
    if p.current:
        current(p, tables, t, X, F)


@kernel
def _slopes_in_plane(p, tables, t, X, F, J, sea):
    """By differences: of a current that is not the same everywhere, and of regular waves over one."""
    varied = p.current and p.cur_nx * p.cur_nz > 1
    if p.sea_n > 0:
        sea_slopes(p, t, X, J, sea)
        if not varied:
            return
    elif not varied:
        wave_slopes(p, tables, t, X, F, J)
        return
    n = X.shape[0]
    X_moved, there, moved = np.empty((n, 2)), np.zeros((n, 4)), np.empty((n, 4))
    if p.sea_n > 0:
        current_field(p, tables, t, X, there)
    else:
        copy_into(there, F)
    for axis in range(2):
        copy_into(X_moved, X)
        for k in range(n):
            X_moved[k, axis] += NUDGE
            for m in range(4):
                moved[k, m] = 0.0
        if p.sea_n == 0 and p.waves:
            wave_field(p, tables, t, X_moved, moved)
        current_field(p, tables, t, X_moved, moved)
        for k in range(n):
            for m in range(4):
                slope = (moved[k, m] - there[k, m]) * (1.0 / NUDGE)
                J[k, 4 * axis + m] = slope + (J[k, 4 * axis + m] if p.sea_n > 0 else 0.0)


@kernel
def _slopes_in_lanes(p, tables, t, X, F, J, sea):
    if p.sea_n > 0:
        sea_slopes(p, t, X, J, sea)
    else:
        wave_slopes(p, tables, t, X, F, J)


@kernel
def _slopes_of_regular(p, tables, t, X, F, J, sea):
    wave_slopes(p, tables, t, X, F, J)


# J (n, 8): how the water F at the nodes of a line in a plane depends on their places X, dF/dx (4) and dF/dz (4);
# F, and with it what Work.sea holds, are those of these places
water_slopes = by_kind(_slopes_in_plane, _slopes_in_plane, _slopes_in_lanes, _slopes_of_regular)
