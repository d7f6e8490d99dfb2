"""The drag laws of this folder, compiled: what planar, spatial and lateral equations need of F = C |v| v.

With C = C_0 s(|v|), dF/dv = C' |v|, C' = C_0 (2 s + ds/d ln|v|); root = sqrt(1 + eps). Across the line in space,
dF/dv = C |v_p| I + (C' - C)/|v_p| v_p v_p'.

In the paper: eq. (24) Morison's force on the line.
"""

from ...compiled import kernel
from ..law_choice import of_the_law
from . import LAWS


@kernel
def _code(p):
    return p.drag


_along, _across = of_the_law(LAWS, "along", _code), of_the_law(LAWS, "across", _code)


@kernel
def drag_along(p, tables, root, speed):
    """C and C' (N s2/m3) of drag along the line at a speed |v_t|."""
    share, per_log = _along(p, tables, speed)
    return p.ct * root * share, p.ct * root * (2.0 * share + per_log)


@kernel
def drag_across(p, tables, root, speed):
    """C and C' (N s2/m3) of drag across the line at a speed |v_p|."""
    share, per_log = _across(p, tables, speed)
    return p.cn * root * share, p.cn * root * (2.0 * share + per_log)
