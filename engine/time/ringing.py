"""Axial ringing of the line in a step: what it asks of the step, what of it the step was too long for.

omega^2 = T'/(l_0 (M + M_a + m l_0/3)) for a buoy on the line; of waves between two held ends omega is measured
(THEORY.md, section 8). An L-stable step damps what it does not resolve, and an error norm of speeds does not see the
mm/s that are kilonewtons in a stiff line.
"""

import math

from ..compiled import kernel
from ..dimensions import size_of
from ..physics.tension.kernels import tension
from ..planar.columns import EPS  # in space the same column
from ..record import BUOY, STRAIN, TENSION
from .damping import extremes, left_after

HEARD = 0.02  # ringing of this share of the static strain is resolved; less of it may be damped
LEFT_BEHIND = 0.1  # phase (rad) in one passage along the line beyond which a wave is the grid's: it may be damped
BEYOND = 0.05  # of the range of the stages of a step: cosines of up to 2 rad in a step have no extreme further off
SMOOTH = 0.2  # phase (rad) of ringing in a step beyond which the tension may have an extreme worth seeing within


@kernel
def ringing_error(p, tables, dt, top, jumps):
    """The error by which ringing judges a step, (z/z_0)^p while its share is above HEARD, less below.

    top: strain of the upper end after the step; jumps: `jumps_of_rates`. 0 where its period is too short to resolve.
    """
    z, _, share = ringing(p, tables, dt, top, jumps)
    if too_short(p, z, dt):
        return 0.0
    return (z / p.phase_per_step) ** p.order * min(1.0, (share / HEARD) ** (0.5 * p.order))


@kernel
def ringing(p, tables, dt, top, jumps):
    """Phase z = omega dt (rad) of the axial motion in a step, its amplitude a over the static strain, and its share.

    omega^2 = T'/p.inertia at the strain of the upper end; jumps: `jumps_of_rates`, a z^2 of an oscillation of amplitude
    a. Beyond z = 2 the strain follows the load and its rate means little: the speed alone is asked, which jumps by up
    to 2 z a. The share is a over the greater of the static and the present strain. Of a held end, whatever the waves:
    the jump of rates is 2 sin(z/2) times the rates.
    """
    if p.all_waves:
        jump, level = jumps
        z = 2.0 * math.asin(min(1.0, 0.5 * jump / max(level, 1e-300)))
        a = math.sqrt(2.0) * level / max(z, 1e-300)
        return z, a, a / max(1.0, abs(top) * p.per_strain)
    z = dt * math.sqrt(max(tension(top, p, tables)[1], 0.0) / p.inertia)
    strain, speed = jumps
    a = speed / (2.0 * z) if z > 2.0 else math.sqrt(strain * strain + speed * speed) / max(z * z, 1e-300)
    return z, a, a / max(1.0, abs(top) * p.per_strain)


@kernel
def too_short(p, z, dt):
    """Is the period of ringing that turns by z in a step too short to be resolved, by steps or, of waves, by the grid?

    Steps that resolve what the grid does not carry at the speed of waves keep its errors, which run ahead of a front.
    """
    if p.all_waves and dispersed(p, z / dt) > LEFT_BEHIND:
        return True
    return z * p.shortest > 2.0 * math.pi * dt


@kernel
def dispersed(p, omega):
    """Phase (rad, at most 1) that axial waves of frequency omega (rad/s) gain along the line on this grid.

    The box scheme carries them at c (1 + x^2/12), x = omega h/c the phase from node to node.
    """
    x = omega * math.pi / math.sqrt(p.shortest_wave) * p.per_ringing / p.per_strain
    return min(1.0, (p.nodes - 1) * x * x * x / 12.0)


@kernel
def jumps_of_rates(p, dt, begin, end):
    """dt times the change, within a step, of the rate of strain and of the axial acceleration, scaled.

    begin, end: (C, K) at both ends of the step. Both jumps are those of the slowest axial motion: mean strain and speed
    of the upper end. They are a quarter turn apart, so that an oscillation shows in one or the other at any time. Where
    the end is held: rms over the nodes of both jumps, and in the place of the second of both rates.
    """
    n = end[0].shape[0]
    mean = jumps = levels = speed = 0.0
    for k in range(n):
        stretching, acceleration = rates_along(p, begin, k)
        later, accelerated = rates_along(p, end, k)
        strain, speed = (later - stretching) * p.per_strain, (accelerated - acceleration) * p.per_ringing
        mean += strain
        if p.all_waves:
            jumps += strain * strain + speed * speed
            strain, speed = stretching * p.per_strain, acceleration * p.per_ringing
            levels += strain * strain + speed * speed
            strain, speed = later * p.per_strain, accelerated * p.per_ringing
            levels += strain * strain + speed * speed
    if p.all_waves:
        return math.sqrt(jumps / n) * dt, math.sqrt(0.5 * levels / n) * dt
    return abs(mean / n) * dt, abs(speed) * dt


@kernel
def rates_along(p, state, k):
    """Rate of strain (1/s) and acceleration along the line (m/s2) at node k of a state (C, K)."""
    C, K = state
    half = size_of(p)[1] // 2
    square = stretching = acceleration = 0.0
    for m in range(half):
        square += C[k, m] * C[k, m]
        stretching += C[k, m] * K[k, m]
        acceleration += C[k, m] * K[k, half + m]
    length = math.sqrt(square)
    return stretching / length, acceleration / length


@kernel
def watch_ringing(p, tables, state, top, low, high, jumps):
    """Of an accepted step: the ringing that it was too long for, or else the extremes of the tension at its stages.

    Of the upper end: top, its strain after the step; low and high, the extremes of its tension over the stages; jumps:
    `jumps_of_rates`. A ringing that the damping of the material takes away within the step is no loss.
    """
    z, a, share = ringing(p, tables, state.trial_dt, top, jumps)
    damped = z > p.phase_per_step or (not p.all_waves and z > SMOOTH and too_short(p, z, state.trial_dt))
    lost = 1.0 if damped else dispersed(p, z / state.trial_dt) if p.all_waves else 0.0
    lost *= left_after(p, tables, top, z, state.trial_dt)
    if share * lost > HEARD:
        state.ringing = max(state.ringing, lost * a * tension(1.0 / p.per_strain, p, tables)[0])
    if z > SMOOTH and not damped:
        state.low = min(state.low, low)
        state.high = max(state.high, high)


@kernel
def near_stages(p, tables, Ys, row):
    """Keep the strains of a row of output within BEYOND of the range of the stages Ys (s, n, unknowns) of its step.

    Not of a buoy. What a step damps in waves that it does not resolve stays in its rates, omega times as large, and a
    cubic through them swings; the stages do not. Where waves are resolved no strain is that far off.
    """
    if p.end == BUOY:
        return
    for k in range(row.shape[0]):
        low, high = extremes(Ys[:, k, EPS])
        beyond = BEYOND * (high - low)
        eps = min(max(row[k, STRAIN], low - beyond), high + beyond)
        if eps != row[k, STRAIN]:
            row[k, STRAIN], row[k, TENSION] = eps, tension(eps, p, tables)[0]
