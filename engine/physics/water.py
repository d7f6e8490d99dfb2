"""The water at the nodes: waves, regular or not, and current."""

from ..compiled import by_kind, kernel
from .currents import current_field, uniform_current
from .sea import sea_field
from .waves import wave_field


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
