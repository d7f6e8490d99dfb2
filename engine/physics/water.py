"""The water at the nodes: waves, regular or not, and current."""

import numpy as np

from ..compiled import by_kind, kernel
from ..simd.elementary import copy_into
from .currents import current_field, uniform_current
from .sea_series import sea_in_plane
from .sea_sum import sea_field
from .waves import wave_field, wave_slopes

NUDGE = 1e-6  # m


@kernel
def _regular(p, tables, t, X, F, sea):
    wave_field(p, tables, t, X, F)


@kernel
def _in_plane(p, tables, t, X, F, sea):
    if p.sea_n == 0:
        wave_field(p, tables, t, X, F)
    else:
        sea_in_plane(p, tables, t, X, F, None, sea)


@kernel
def _in_space(p, tables, t, X, F, sea):
    if p.sea_n == 0:
        wave_field(p, tables, t, X, F)
    else:
        sea_field(p, tables, t, X, F, sea)


waves = by_kind(_in_plane, _in_space, plain=_regular)
current = by_kind(current_field, current_field, uniform_current)


@kernel
def _at_rest(F):
    for k in range(F.shape[0]):
        for i in range(F.shape[1]):
            F[k, i] = 0.0


@kernel
def water(p, tables, t, in_motion, X, F, sea):
    """Velocity and acceleration of the water at places X (n, 2) or (n, 3), into F (n, 4) or (n, 6).

    in_motion: 1.0, or 0.0 to leave out the waves. sea: of Work. Where there is no water F is not touched.
    """
    if p.wet == 0:
        return
    _at_rest(F)
    if p.waves and in_motion > 0.0:
        waves(p, tables, t, X, F, sea)
    if p.current:
        current(p, tables, t, X, F)


@kernel
def _slopes_of_regular(p, tables, t, X, F, J, sea):
    water(p, tables, t, 1.0, X, F, sea)
    wave_slopes(p, tables, t, X, F, J)


@kernel
def _slopes_over_uniform(p, tables, t, X, F, J, sea):
    if p.sea_n > 0:
        _at_rest(F)
        sea_in_plane(p, tables, t, X, F, J, sea)
        if p.current:
            current(p, tables, t, X, F)
    else:
        _slopes_of_regular(p, tables, t, X, F, J, sea)


@kernel
def _slopes_in_plane(p, tables, t, X, F, J, sea):
    """By differences: of a current that is not the same everywhere, and of regular waves over one."""
    _slopes_over_uniform(p, tables, t, X, F, J, sea)
    if p.current == 0 or p.cur_nx * p.cur_nz == 1:
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
        _at_rest(moved)
        if p.sea_n == 0 and p.waves:
            wave_field(p, tables, t, X_moved, moved)
        current_field(p, tables, t, X_moved, moved)
        for k in range(n):
            for m in range(4):
                slope = (moved[k, m] - there[k, m]) * (1.0 / NUDGE)
                J[k, 4 * axis + m] = slope + (J[k, 4 * axis + m] if p.sea_n > 0 else 0.0)


# Water F (n, 4) as `water` gives it in motion, at the nodes of a line in a plane, and how it depends on their places X:
# J (n, 8), dF/dx (4) and dF/dz (4)
water_and_slopes = by_kind(_slopes_in_plane, _slopes_in_plane, _slopes_over_uniform, _slopes_of_regular)
