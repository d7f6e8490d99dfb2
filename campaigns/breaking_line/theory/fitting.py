"""Sets out the characteristics of a breaking line, has them followed, and makes a FittedBreak of them."""

import numpy as np

from analysis.compiled import kernel
from analysis.sampling import checked_count, checked_positive, locked
from campaigns.breaking_line.theory import characteristics as row
from campaigns.breaking_line.theory.characteristics import DONE, FULL, Net, march
from campaigns.breaking_line.theory.fitted import FittedBreak, ShockPath
from campaigns.breaking_line.theory.law import riemann, strain_of_riemann, strain_of_tension, tension, wave_speed
from campaigns.breaking_line.theory.simple_wave import case_of, end_force, shock_speed, shock_start, sonic_strain

# Emission times of the C- that meet the shock are spaced evenly in the log of what is left to the one that is just as
# fast as the shock. That one never meets it, and the time of meeting, in breaking times, is about the inverse of what
# is left: the last C- has this much times decay/until.
CLOSEST = 0.1
SCAN = 4001
ROOM = (1, 4, 16)  # tried one after the other, times `lines`: every echo of the broken end needs some more


@kernel
def _strains_at_end(case, t):
    """eps at the broken end at times t (m,) [s]."""
    out, eps = np.empty(len(t)), 0.2
    for i in range(len(t)):
        eps = strain_of_tension(case.law, end_force(case, t[i]), eps)
        out[i] = eps
    return out


def _spread(case, low, high, count):
    """`count` + 1 emission times from low to high, evenly in time and in wave speed, half and half."""
    times = np.linspace(low, high, SCAN)
    c = wave_speed(case.law, _strains_at_end(case, times))
    way = np.abs(np.diff(c)) / max(np.sum(np.abs(np.diff(c))), 1e-300) + np.diff(times) / (high - low)
    way = np.append(0.0, np.cumsum(way))
    return np.interp(np.linspace(0.0, way[-1], count + 1), way, times)


def _planned(case, start, count):
    """Emission times of the C- that are followed: with a shock from the one on which it begins, else from 0."""
    law, decay, strain0 = case.law, case.decay, case.strain0
    slack = np.linspace(decay, max(case.stop, 2.0 * decay), count // 2 + 1)[1:]
    if start is None:
        return np.append(_spread(case, 0.0, decay, count), slack)
    phi0, sonic = riemann(law, strain0), sonic_strain(law, strain0)
    p = riemann(law, sonic) - shock_speed(law, strain0, sonic) * (strain0 - sonic)
    pull = tension(law, strain_of_riemann(law, 0.5 * (p + phi0), 0.2))
    # of the line that keeps up with the late shock and never meets it
    slowest = 2.0 * decay / np.pi * np.arccos(np.sqrt(pull / case.force))
    spacing = CLOSEST * min(decay / case.stop, 1.0)
    met = slowest - (slowest - start.emission_s) * spacing ** np.linspace(0.0, 1.0, count + 1)
    return np.concatenate([met, _spread(case, met[-1], decay, count)[1:], slack])


def fitted_break(parameters, mass, length, tension0, decay_s, until_s, lines=400):
    """The exact motion of the breaking line by characteristics, with the shock fitted by Rankine-Hugoniot.

        m u_t = T(eps)_s,  eps_t = u_s,  u(0) = 0,  T(L) = tension0 cos^2(pi t/(2 decay_s)) until decay_s, then 0

    parameters    p1 ... p5 of eq. (20);  mass [kg/m];  length [m];  tension0 [N];  decay_s [s]
    until_s       [s];  lines  characteristics per part of the wave: the error falls with its square
    Returns a FittedBreak, whose valid_until_s may be less than asked for: when a second shock forms. With the paper's
    line, case 3 at 5 ms ends at 55 ms (the front is back from the fixed end before the shock has passed it) and case 4
    at 50 ms ends at 74 ms (the shock comes back as a shock); all others go on, through strains below -1 if need be.
    Error with 400 lines, case 4: place of the shock 2e-5 m, strain 2e-9 and speed 1e-6 m/s in the mean up to the fixed
    end; after its echo 1e-6 in strains above -1/2. From 500 kN on, where the law is nearly flat, the energy closes to
    1e-5 ... 1e-3 only.
    Source: `simple_wave`, `characteristics`.
    """
    until, lines = checked_positive(until_s, "until_s"), checked_count(lines, "lines", 16)
    case = case_of(parameters, mass, length, tension0, decay_s, until)
    start, at_rest = shock_start(case), riemann(case.law, case.strain0)
    front_arrival = case.length / wave_speed(case.law, case.strain0)
    shocked = start.distance_m < case.length and start.time_s < until
    planned_start = start if shocked else None
    planned = _planned(case, planned_start, lines)
    born_m = case.length - start.distance_m
    first = (start.time_s, born_m, start.strain, start.strain, start.speed_mps, start.emission_s)
    for room in ROOM:
        net, starts = _room(case, planned, room * lines)
        if shocked:
            starts[0, : row.LINE] = (*first, net.p[0], -at_rest)
        used, count, shock, code = march(case, net, starts, shocked, lines // 2, len(planned))
        if code != FULL:
            break
    starts = starts[:count]
    valid = until if code == DONE else min(until, starts[-1, row.TIME])
    # the front is back from the fixed end before the shock has passed it
    if np.any((starts[:shock, row.TIME] > front_arrival) & (starts[:shock, row.EMITTED] > 0.0)):
        valid = min(valid, front_arrival)
    echoes = net.tau[int(starts[shock - 1, row.LINE]) + 1 if shock else 0 : used]
    echoes = echoes[~np.isin(echoes, planned)]
    crossings, on_shock = (array[:used, :count] for array in (net.T, net.S)), (array[:used] for array in net[2:5])
    arrays = (*crossings, *on_shock, net.q[:count], net.last[:used])
    return FittedBreak(
        case=case,
        start=start,
        shock=ShockPath(*(locked(column.copy()) for column in starts[:shock, : row.P_BEHIND].T)),
        valid_until_s=float(valid),
        first_echo_s=float(echoes[0]) if len(echoes) else np.inf,
        net=Net(*(locked(array.copy()) for array in arrays)),
        starts=locked(starts.copy()),
    )


def _room(case, planned, extra):
    """The Net with its planned C- in place and room for `extra` that echoes start, twice, and empty starts."""
    count = len(planned)
    most_lines, most_starts = count + 2 * extra, count + extra
    T = np.full((most_lines, most_starts), np.nan)
    net = Net(T, T.copy(), *np.zeros((3, most_lines)), np.zeros(most_starts), np.zeros((most_lines, 3)))
    eps = _strains_at_end(case, planned)
    at_rest = riemann(case.law, case.strain0)
    net.tau[:count], net.born_q[:count] = planned, -at_rest
    net.p[:count] = 2.0 * riemann(case.law, eps) - at_rest
    net.last[:count] = np.column_stack([planned, np.full(count, case.length), wave_speed(case.law, eps)])
    return net, np.zeros((most_starts, row.COLUMNS))
