"""The water at the nodes: waves, regular or not, and current."""

import numpy as np

from ..compiled import by_kind, kernel
from ..simd.elementary import copy_into
from .currents import current_field, uniform_current
from .sea import sea_field
from .waves import wave_field, wave_slopes

NUDGE = 1e-6  # m


@kernel
def _any(p, tables, t, X, F):
    """In a plane: a regular wave, which has no rows of a sea, or a sea. In space and in lanes only one kind occurs."""
    if p.sea_n == 0:
        wave_field(p, tables, t, X, F)
    else:
        sea_field(p, tables, t, X, F)


waves = by_kind(_any, sea_field, wave_field)
current = by_kind(current_field, current_field, uniform_current)


@kernel
def water(p, tables, t, in_motion, X, F):
    """Velocity and acceleration of the water at places X (n, 2) or (n, 3), into F (n, 4) or (n, 6).

    in_motion: 1.0, or 0.0 to leave out the waves. Where there is no water F is not touched.
    """
    if p.wet == 0:
        return
    for k in range(F.shape[0]):
        for i in range(F.shape[1]):
            F[k, i] = 0.0
    if p.waves and in_motion > 0.0:
        waves(p, tables, t, X, F)
    if p.current:
        current(p, tables, t, X, F)


@kernel
def _any_slopes(p, tables, t, X, F, J):
    """By differences but for regular waves and a current that is the same everywhere."""
    if p.sea_n == 0 and (p.current == 0 or p.cur_nx * p.cur_nz == 1):
        wave_slopes(p, tables, t, X, F, J)
        return
    n = X.shape[0]
    X_moved, F_moved = np.empty((n, 2)), np.empty((n, 4))
    for axis in range(2):
        copy_into(X_moved, X)
        for k in range(n):
            X_moved[k, axis] += NUDGE
        water(p, tables, t, 1.0, X_moved, F_moved)
        for k in range(n):
            for m in range(4):
                J[k, 4 * axis + m] = (F_moved[k, m] - F[k, m]) * (1.0 / NUDGE)


# J (n, 8): how the water F at the nodes of a line in a plane depends on their places X, dF/dx (4) and dF/dz (4)
water_slopes = by_kind(_any_slopes, _any_slopes, wave_slopes)
