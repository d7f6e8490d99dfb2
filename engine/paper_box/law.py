"""T = f(eps) and f'(eps), eqs. (20) and (29), on arrays of real or complex strains.

`physics.tension` in NumPy, from the same record and the same tables, so that a complex step differentiates f'(eps) too.
"""

import numpy as np

from ..physics.tension import LINEAR, TANH


def tension_law(p, tables, eps):
    """Tension (N) and its slope (N) at strains eps of any shape. p, tables: as in `engine.parameters`."""
    if p["law"] == LINEAR:
        return p["p1"] * eps, np.full_like(eps, p["p1"])
    if p["law"] == TANH:
        th = np.tanh(p["p2"] * eps + p["p3"])
        return p["p1"] * th + p["p4"] + p["p5"] * eps, p["p1"] * p["p2"] * (1 - th * th) + p["p5"]
    return _tabulated(eps, tables[p["law_at"] :], int(p["law_n"]))


def _tabulated(eps, table, n):
    """Layout of `table` as in `physics.tension`: knots, four coefficients of each piece, slopes below and above."""
    knots, pieces = table[:n], table[n : n + 4 * (n - 1)].reshape(n - 1, 4)
    inside = np.clip(eps.real, knots[0], knots[-1])
    beyond = eps.real != inside
    at = np.clip(np.searchsorted(knots, inside, side="right") - 1, 0, n - 2)
    d = np.where(beyond, inside, eps) - knots[at]
    c0, c1, c2, c3 = np.moveaxis(pieces[at], -1, 0)
    value = c0 + d * (c1 + d * (c2 + d * c3))
    slope = c1 + d * (2 * c2 + d * 3 * c3)
    return np.where(beyond, value + slope * (eps - inside), value), slope
