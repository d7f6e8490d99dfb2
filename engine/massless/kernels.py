"""A point buoy on a line without mass, drag and bending: eq. (30) with N = T(r/l0 - 1) along the line, or nothing.

    (M + M_a) V_t = (rho V + M_a) dU_w/dt + (B - W) z - C |v| v - max(T, 0) X/r,   X = (x, z), r = |X|, v = V - U_w

with the changes of a wetted cap where the scene has one (`engine.physics.submergence`). Water, buoy, cap and tension
are the engine's own kernels; here are only their sum and the steps.

Steps. The classical Runge-Kutta method of order 4, equal steps. The slope of the right side jumps where the line
becomes taut or slack (T = 0) and where a cap begins to enter or has wholly entered (h = 0, h = D); a step over such a
place would have an error of order 2. The step is therefore made again in two parts, which meet where the cubic through
both ends of the step, with their rates, changes sign. Forces are continuous there, so that an error d of the place
costs d^2. A second change within one step is not looked for, nor one that both ends of a step do not show. Beside
h = 0 and h = D the wetted section of a cap goes as distance^(3/2), where no method of its kind has more than order 2.5.
"""

import math

import numpy as np

from ..arrays import Stage
from ..compiled import by_kind, kernel
from ..physics.currents import uniform_current
from ..physics.ends import planar_end
from ..physics.submergence import end_of_cap, surface_at, wetted
from ..physics.tension.kernels import tension
from ..physics.waves import wave_field
from ..simd.select import finite, larger, smaller, some, where
from ..simd.vector import as_lanes, lane_record

HALVINGS = 20


@kernel
def _cap(p, tables, t, x, z, U, W):
    """Added mass (kg) that the dry part of a cap lacks; depth h (m) of its lowest point, and its rate (m/s)."""
    if not p.spherical_cap:
        return 0.0, 2.0 * p.D_buoy, 0.0
    eta, slope, _, rate, _ = surface_at(p, t, 1.0, x, None)
    h = p.depth + eta - z + 0.5 * p.D_buoy
    return p.M_added * wetted(p, h)[0], h, rate + slope * U - W


@kernel
def _sphere(p, tables, t, x, z, U, W):
    """As `_cap` where no sphere has one."""
    return 0.0, 2.0 * p.D_buoy, 0.0


_part = by_kind(_cap, _cap, _cap, _sphere)


@kernel
def rates(p, tables, length, t, y, X, F):
    """Acceleration (m/s2) of a buoy in the state y = (x, z, U, W); length: l0 (m); X (1, 2), F (1, 4): work arrays."""
    x, z, U, W = y
    stage, V = Stage(t, 1.0, 1.0, 0.0), (U, W)
    X[0, 0], X[0, 1] = x, z
    F[0, 0] = F[0, 1] = F[0, 2] = F[0, 3] = 0.0
    if p.waves:
        wave_field(p, tables, t, X, F)
    if p.current:
        uniform_current(p, tables, t, X, F)
    r = math.sqrt(x * x + z * z)
    pull = larger(tension(r / length - 1.0, p, tables)[0], 0.0) / where(r > 0.0, r, 1.0)
    ex, ez, _, _, _, _ = planar_end(p, tables, stage, (pull * x, pull * z), V, V, F[0])
    mass = p.M_total - _part(p, tables, t, x, z, U, W)[0]
    if p.spherical_cap:
        cap = end_of_cap(p, stage, X[0], V, V, F[0], None)
        ex, ez = ex + cap[0], ez + cap[1]
    return -ex / mass, -ez / mass


@kernel
def _moved(y, dt, v, a):
    """y + dt (v, a), v and a pairs"""
    return y[0] + dt * v[0], y[1] + dt * v[1], y[2] + dt * a[0], y[3] + dt * a[1]


@kernel
def step(p, tables, length, t, dt, y, X, F):
    """The state after one step of dt (s)."""
    half = 0.5 * dt
    a1 = rates(p, tables, length, t, y, X, F)
    y2 = _moved(y, half, y[2:], a1)
    a2 = rates(p, tables, length, t + half, y2, X, F)
    y3 = _moved(y, half, y2[2:], a2)
    a3 = rates(p, tables, length, t + half, y3, X, F)
    y4 = _moved(y, dt, y3[2:], a3)
    a4 = rates(p, tables, length, t + dt, y4, X, F)
    v = y[2] + 2.0 * (y2[2] + y3[2]) + y4[2], y[3] + 2.0 * (y2[3] + y3[3]) + y4[3]
    a = a1[0] + 2.0 * (a2[0] + a3[0]) + a4[0], a1[1] + 2.0 * (a2[1] + a3[1]) + a4[1]
    return _moved(y, dt / 6.0, v, a)


@kernel
def _radius(y):
    """r (m) and its rate (m/s)."""
    r = math.sqrt(y[0] * y[0] + y[1] * y[1])
    return r, (y[0] * y[2] + y[1] * y[3]) / where(r > 0.0, r, 1.0)


@kernel
def _gauges(p, tables, length, t, y):
    """What changes sign where the forces have a kink, and the rates of these: T, h and h - D."""
    r, r_t = _radius(y)
    T, slope = tension(r / length - 1.0, p, tables)
    _, h, h_t = _part(p, tables, t, y[0], y[1], y[2], y[3])
    return (T, h, h - p.D_buoy), (slope * r_t / length, h_t, h_t)


@kernel
def _cubic(s, a, b, a_s, b_s):
    """At 0 <= s <= 1 the cubic with the values a, b and the slopes a_s, b_s at 0 and 1."""
    rise = b - a
    return a + s * (a_s + s * (3.0 * rise - 2.0 * a_s - b_s + s * (a_s + b_s - 2.0 * rise)))


@kernel
def _change(dt, a, b, a_t, b_t):
    """Share of a step of dt (s) at which a gauge that is a before and b after it changes sign; 1 where it does not."""
    rises = b > 0.0
    changes = ((a <= 0.0) & rises) | ((a > 0.0) & (b <= 0.0))
    low, high = where(changes, 0.0, 1.0), where(changes, 1.0, 1.0)
    if not some(changes):
        return high
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        value = _cubic(middle, a, b, dt * a_t, dt * b_t)
        too_early = where(rises, -value, value) > 0.0
        low, high = where(too_early, middle, low), where(too_early, high, middle)
    return 0.5 * (low + high)


@kernel
def _first_change(dt, old, new):
    """The first of `_change` of all gauges."""
    share = _change(dt, old[0][0], new[0][0], old[1][0], new[1][0])
    share = smaller(share, _change(dt, old[0][1], new[0][1], old[1][1], new[1][1]))
    return smaller(share, _change(dt, old[0][2], new[0][2], old[1][2], new[1][2]))


@kernel
def _range(dt, y, new, low, high):
    """Least and largest radius (m) so far, low and high, with those on the way from y to new."""
    a, a_t = _radius(y)
    b, b_t = _radius(new)
    turns = a_t * b_t < 0.0
    peak = where(turns, _cubic(a_t / where(turns, a_t - b_t, 1.0), a, b, dt * a_t, dt * b_t), b)
    return smaller(smaller(low, b), peak), larger(larger(high, b), peak)


@kernel
def march(p, tables, length, period, first, steps, y, strobed, measures, X, F):
    """One start y = (x, z, U, W), or one in each lane, at t = first wave periods, through the rows of measures (p, 3).

    Fills strobed (p + 1, 4) and measures (`engine.massless.MasslessRuns`); NaN where a state is not finite.
    """
    dt = period / steps
    gauges = _gauges(p, tables, length, first * period, y)
    for i in range(4):
        strobed[0, i] = y[i]
    for row in range(measures.shape[0]):
        low = high = _radius(y)[0]
        for n in range(steps):
            t = ((first + row) * steps + n) * dt
            at, want = t, dt
            for trial in range(3):  # the whole step, or then its two parts; a lane without a change makes it, then none
                new = step(p, tables, length, at, want, y, X, F)
                new_gauges = _gauges(p, tables, length, at + want, new)
                if trial == 0:
                    share = _first_change(dt, gauges, new_gauges)
                    if some(share < 1.0):
                        want = share * dt
                        continue
                low, high = _range(want, y, new, low, high)
                y = new
                if trial != 1:
                    break
                at, want = t + want, dt - want
            gauges = new_gauges
        sound = finite((y[0] + y[1]) + (y[2] + y[3]))
        T = larger(tension(high / length - 1.0, p, tables)[0], 0.0)
        for i in range(4):
            strobed[row + 1, i] = where(sound, y[i], np.nan)
        measures[row, 0], measures[row, 1] = where(sound, low, np.nan), where(sound, high, np.nan)
        measures[row, 2] = where(sound, T, np.nan)
        if not some(sound):
            return


@kernel
def march_lanes(records, counts, arrays, tables, length, period, first, steps):
    """`march` from starts that lie side by side in the last axis of starts, strobed and measures.

    records: of the type of the scene's record; counts, values: its numbers, as `engine.simd.vector.lane_record` has
    them; arrays: (values, starts, strobed, measures, X, F)
    """
    values, starts, strobed, measures, X, F = as_lanes(arrays)
    p = lane_record(records, counts, values)
    for i in range(len(starts)):
        y = starts[i, 0], starts[i, 1], starts[i, 2], starts[i, 3]
        march(p, tables, length, period, first, steps, y, strobed[i], measures[i], X, F)
