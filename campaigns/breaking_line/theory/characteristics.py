r"""The breaking line by its characteristics, the shock fitted between them (kernel of `fitted`).

    p = u + phi constant on C-, ds/dt = -c;   q = u - phi constant on C+, ds/dt = +c;   phi = (p - q)/2 gives eps, c

     t |   wall: q = -p       end: p = q + 2 phi(F)     Lines C-_i leave the broken end at tau_i with p_i and end at
       |\  /\          C+_k  /|                         the shock or at the wall. There starts a C+_k, which crosses
       | \/  \ shock        / |                         the C- behind it and starts a new C- where it meets the end.
       |  \   *----*----.  /  |                         Invariants are exact: only the places of the crossings are
       |       \    \  C-_i   |                         computed, on straight pieces with the mean c of their ends.
       0 -------------------- s = L

Second order in the spacing of the lines. Ahead of the shock the simple wave is exact. A shock point is where the next
C- meets the shock, whose path is a trapezoid in sigma; p of that line and Rankine-Hugoniot give the state behind it.
The echo q - q_0 is of third order in the strength of the shock, hence smooth where it begins. At the wall the shock
starts a centred fan of C+.
"""

from collections import namedtuple

import numpy as np

from analysis.compiled import kernel
from campaigns.breaking_line.theory.law import riemann, strain_of_riemann, strain_of_tension, wave_speed
from campaigns.breaking_line.theory.simple_wave import end_force, shock_speed, simple_wave_at

DONE, CROSSED, FULL, FRONT_AT_WALL = range(4)
MOST_ROUNDS = 200
# Columns of the starts of the C+: the shock path, then the wall. EMITTED: of the C- that the shock meets from ahead.
TIME, PLACE, AHEAD, BEHIND, SIGMA, EMITTED, P_BEHIND, Q_BEHIND, LINE = range(9)
COLUMNS = 9

# T, S: (lines, starts) time and place of the crossing of C-_i with C+_k, nan where none; p, tau (lines,) of the C-,
# born_q: q where it leaves the end; q (starts,) of the C+; last: (lines, 3) latest known t, s, c of each C-
Net = namedtuple("Net", "T S p born_q tau q last")


@kernel
def strain_behind(law, ahead, u_ahead, p, guess):
    """eps_b behind a shock into (ahead, u_ahead) [1, m/s] that a C- with invariant p reaches from behind.

    u_b + phi(eps_b) = p with Rankine-Hugoniot for u_b; the left side rises with slope (c + sigma)^2/(2 sigma).
    """
    eps = guess
    for _ in range(MOST_ROUNDS):
        sigma, c = shock_speed(law, ahead, eps), wave_speed(law, eps)
        excess = u_ahead - sigma * (ahead - eps) + riemann(law, eps) - p
        step = excess * 2.0 * sigma / (c + sigma) ** 2
        eps -= step
        if abs(step) < 1e-15:
            break
    return eps


@kernel
def shock_step(case, previous, last_known, p, out):
    """Fill `out` (a row of starts) with the point where a C- (t, s, c last_known) meets the shock that was last at the
    row `previous`. False when they do not meet: the C- is slower."""
    law = case.law
    tn, sn, cn = last_known
    phi0 = riemann(law, case.strain0)
    t0, s0, sigma0 = previous[TIME], previous[PLACE], previous[SIGMA]
    sigma, behind = sigma0, previous[BEHIND]
    c, t = wave_speed(law, behind), t0
    for _ in range(MOST_ROUNDS):
        cc, ss = 0.5 * (cn + c), 0.5 * (sigma0 + sigma)
        if cc <= ss:
            return False
        last = t
        t = (sn - s0 + cc * tn - ss * t0) / (cc - ss)
        s = s0 - ss * (t - t0)
        ahead, tau = simple_wave_at(case, s, t, previous[EMITTED])
        behind = strain_behind(law, ahead, riemann(law, ahead) - phi0, p, behind)
        sigma, c = shock_speed(law, ahead, behind), wave_speed(law, behind)
        out[:LINE] = t, s, ahead, behind, sigma, tau, p, p - 2.0 * riemann(law, behind)
        if abs(t - last) <= 1e-15 * t:
            break
    return True


@kernel
def cross(case, net, k, start, t, s, c, lines):
    """Carry C+_k from its start on line `start` at (t, s), speed c, across the C- behind it; emit one at the end.

    Returns the number of lines and a code.
    """
    net.T[start, k], net.S[start, k] = t, s
    eps = 0.0
    for i in range(start + 1, lines):
        t_i, s_i, c_i = net.last[i]
        if t_i > case.stop:  # so are all behind it
            return lines, DONE
        eps = strain_of_riemann(case.law, 0.5 * (net.p[i] - net.q[k]), eps)
        new = wave_speed(case.law, eps)
        back, forth = 0.5 * (c_i + new), 0.5 * (c + new)
        crossing = (s_i - s + back * t_i + forth * t) / (back + forth)
        if crossing < net.tau[i]:  # at the end before this line leaves it: planned lines from here on are not needed
            lines = i
            break
        if crossing <= t or crossing <= t_i:
            return lines, CROSSED
        s += forth * (crossing - t)
        t, c = crossing, new
        net.T[i, k], net.S[i, k] = t, s
        net.last[i] = t, s, c
    if lines == len(net.p):
        return lines, FULL
    arrival = t + (case.length - s) / c
    for _ in range(MOST_ROUNDS):
        earlier = arrival
        eps = strain_of_tension(case.law, end_force(case, arrival), eps)
        arrival = t + (case.length - s) / (0.5 * (c + wave_speed(case.law, eps)))
        if abs(arrival - earlier) <= 1e-15 * arrival:
            break
    net.tau[lines], net.born_q[lines] = arrival, net.q[k]
    net.p[lines] = net.q[k] + 2.0 * riemann(case.law, eps)
    net.last[lines] = arrival, case.length, wave_speed(case.law, eps)
    return lines + 1, DONE


@kernel
def follow_shock(case, net, starts, lines):
    """Carry the C+ that start on the shock, from row 0 of `starts`, where it begins, to the wall or to case.stop.

    Returns the number of lines, the last C+ and a code.
    """
    law = case.law
    front_arrival = case.length / wave_speed(law, case.strain0)
    net.q[0] = starts[0, Q_BEHIND]
    k = 0
    while True:
        row = starts[k]
        row[LINE] = k
        lines, code = cross(case, net, k, k, row[TIME], row[PLACE], wave_speed(law, row[BEHIND]), lines)
        if code != DONE or row[TIME] > case.stop or row[PLACE] == 0.0:
            return lines, k, code
        if row[EMITTED] > 0.0 and row[TIME] > front_arrival:
            return lines, k, FRONT_AT_WALL
        k += 1
        if k == len(net.q) or k == lines:
            return lines, k - 1, FULL
        if not shock_step(case, row, net.last[k], net.p[k], starts[k]):
            return lines, k - 1, CROSSED
        if starts[k, PLACE] < 0.0:
            if lines == len(net.p):
                return lines, k - 1, FULL
            insert_at_wall(case, net, starts, k, lines)
            lines += 1
        net.q[k] = starts[k, Q_BEHIND]


@kernel
def insert_at_wall(case, net, starts, k, lines):
    """Put in, as line k, the C- that meets the shock just at the fixed end: line k, which moves up, meets it beyond.

    It lies between the neighbours k - 1, already at the shock, and k, in proportion along the last C+.
    """
    left, right = np.empty(4), np.empty(4)
    left[:3] = starts[k - 1, TIME], starts[k - 1, PLACE], wave_speed(case.law, starts[k - 1, BEHIND])
    right[:3] = net.last[k]
    left[3], right[3] = net.p[k - 1], net.p[k]
    low, high, share = 0.0, 1.0, 0.5
    for _ in range(60):
        share = 0.5 * (low + high)
        at = left + share * (right - left)
        if shock_step(case, starts[k - 1], at[:3], at[3], starts[k]) and starts[k, PLACE] > 0.0:
            low = share
        else:
            high = share
    starts[k, PLACE] = 0.0
    for i in range(lines, k, -1):
        net.T[i, :k], net.S[i, :k], net.last[i] = net.T[i - 1, :k], net.S[i - 1, :k], net.last[i - 1]
        net.p[i], net.born_q[i], net.tau[i] = net.p[i - 1], net.born_q[i - 1], net.tau[i - 1]
    for j in range(k):
        net.T[k, j] = net.T[k - 1, j] + share * (net.T[k + 1, j] - net.T[k - 1, j])
        net.S[k, j] = net.S[k - 1, j] + share * (net.S[k + 1, j] - net.S[k - 1, j])
    net.p[k] = left[3] + share * (right[3] - left[3])
    net.tau[k] = net.tau[k - 1] + share * (net.tau[k + 1] - net.tau[k - 1])
    net.last[k] = (left + share * (right - left))[:3]


@kernel
def from_wall(case, net, starts, k, line, t, q, lines):
    """Start C+_k with invariant q on `line` at the fixed end at t, and carry it; as `cross`."""
    net.q[k] = q
    starts[k, TIME], starts[k, PLACE], starts[k, LINE] = t, 0.0, line
    starts[k, P_BEHIND], starts[k, Q_BEHIND] = net.p[line], q
    c = wave_speed(case.law, strain_of_riemann(case.law, 0.5 * (net.p[line] - q), 0.0))
    return cross(case, net, k, line, t, 0.0, c, lines)


@kernel
def march(case, net, starts, shocked, fan, lines):
    """Carry the C+ of the shock, when `shocked`, then its fan of `fan` lines at the wall, then those of the wall.

    lines     C- planned so far, in p, born_q, tau and last of `net`; there is room for more behind them
    starts    (starts, COLUMNS) filled row by row; row 0 holds the beginning of the shock
    Returns the number of lines, of C+, of those that belong to the shock, and a code.
    """
    line, k = 0, 0
    shock = 0
    if shocked:
        lines, k, code = follow_shock(case, net, starts, lines)
        shock = k + 1
        if code != DONE or starts[k, TIME] > case.stop:
            return lines, shock, shock, code
        line, q_front, q_wall = k, net.q[k], -net.p[k]
        for j in range(1, fan + 1):
            k += 1
            if k == len(net.q):
                return lines, k, shock, FULL
            q = q_front + (q_wall - q_front) * j / fan
            lines, code = from_wall(case, net, starts, k, line, starts[shock - 1, TIME], q, lines)
            if code != DONE:
                return lines, k, shock, code
        line, k = line + 1, k + 1
    while k < len(net.q) and line < lines:
        c_wall = wave_speed(case.law, strain_of_riemann(case.law, net.p[line], 0.0))
        t = net.last[line, 0] + net.last[line, 1] / (0.5 * (net.last[line, 2] + c_wall))
        lines, code = from_wall(case, net, starts, k, line, t, -net.p[line], lines)
        if code != DONE or t > case.stop:
            return lines, k + 1, shock, code
        line, k = line + 1, k + 1
    return lines, k, shock, FULL
