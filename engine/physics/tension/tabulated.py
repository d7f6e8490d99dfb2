"""T through measured points: the monotone cubic of Fritsch & Carlson (1980, PCHIP), so that T' is continuous and
Newton's method does not chatter at a kink. Outside the table T goes on along the end tangents.

Table, n knots: [knots (n) | c0 c1 c2 c3 of each of the n - 1 pieces | slope below | slope above].
"""

from typing import Literal

from engine.scene.faults import fault
from engine.scene.values import Section, Series, described

IN_LANES = False


class Model(Section):
    """T interpolated through measured points; strain increasing, tension never falling."""

    law: Literal["tabulated"]
    strain: Series = described("tabulated: strains of the measured points, increasing", paper="(20)")
    tension_N: Series = described("tabulated: tensions at these strains, never falling", paper="(20)")


def faults(sound):
    strain, tension = "tether.tension.strain", "tether.tension.tension_N"
    yield from sound.increasing(strain)
    yield from sound.increasing(tension, "a tension that never falls with strain", may_stay=True)
    yield from sound.paired(tension, strain)
    if (first := (sound[strain] or (0,))[0]) <= -1:
        yield fault(f"{strain}[0]", first, "strains above -1")


def numbers(law):
    import numpy as np
    from scipy.interpolate import PchipInterpolator

    curve = PchipInterpolator(law.strain, law.tension_N)
    pieces = curve.c[::-1].T.ravel()  # ascending powers, piece by piece
    ends = curve.derivative()(np.array(law.strain)[[0, -1]])
    return {"law_n": len(law.strain)}, [*law.strain, *pieces, *ends]


def value(eps, p, tables):
    first, last = p.law_at, p.law_at + p.law_n - 1
    pieces, ends = last + 1, last + 1 + 4 * (p.law_n - 1)
    if eps <= tables[first]:
        return tables[pieces] + tables[ends] * (eps - tables[first]), tables[ends]
    # the piece in which eps lies, or the last one
    low, high = first, last
    while high - low > 1:
        mid = (low + high) // 2
        if tables[mid] <= eps:
            low = mid
        else:
            high = mid
    piece = pieces + 4 * (low - first)
    d = min(eps, tables[last]) - tables[low]
    T = tables[piece] + d * (tables[piece + 1] + d * (tables[piece + 2] + d * tables[piece + 3]))
    if eps >= tables[last]:
        return T + tables[ends + 1] * (eps - tables[last]), tables[ends + 1]
    return T, tables[piece + 1] + d * (2.0 * tables[piece + 2] + d * 3.0 * tables[piece + 3])


def integral(eps, p, tables):
    first, last = p.law_at, p.law_at + p.law_n - 1
    pieces, ends = last + 1, last + 1 + 4 * (p.law_n - 1)
    if eps <= tables[first]:
        d = eps - tables[first]
        return d * (tables[pieces] + 0.5 * d * tables[ends])
    total = top = 0.0
    for i in range(p.law_n - 1):
        piece = pieces + 4 * i
        d = min(eps, tables[first + i + 1]) - tables[first + i]
        if d <= 0.0:
            return total
        c0, c1, c2, c3 = tables[piece], tables[piece + 1], tables[piece + 2], tables[piece + 3]
        total += d * (c0 + d * (0.5 * c1 + d * (c2 / 3.0 + d * (c3 / 4.0))))
        top = c0 + d * (c1 + d * (c2 + d * c3))
    d = max(eps - tables[last], 0.0)
    return total + d * (top + 0.5 * d * tables[ends + 1])


def of_array(eps, p, tables):
    import numpy as np

    n, table = int(p["law_n"]), tables[p["law_at"] :]
    knots, pieces = table[:n], table[n : n + 4 * (n - 1)].reshape(n - 1, 4)
    inside = np.clip(eps.real, knots[0], knots[-1])
    beyond = eps.real != inside
    at = np.clip(np.searchsorted(knots, inside, side="right") - 1, 0, n - 2)
    d = np.where(beyond, inside, eps) - knots[at]
    c0, c1, c2, c3 = np.moveaxis(pieces[at], -1, 0)
    T = c0 + d * (c1 + d * (c2 + d * c3))
    slope = c1 + d * (2 * c2 + d * 3 * c3)
    return np.where(beyond, T + slope * (eps - inside), T), slope
