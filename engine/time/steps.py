"""One time step of either family of integrators: a trial state and rates, a result code, an error estimate.

Conserved variables of a node: C = (q, V), four numbers in a plane and six in space; K = dC/dt. A trial never changes
the accepted state. In Y (n, unknowns) and in C the velocity has the same columns; Q holds q from column
`engine.record.STRETCH` on. Stages count from 0: stage 0 is the accepted state with its rates and is not solved, the
last stage, s - 1, is the new state.
The parts of a Runge-Kutta step serve one run and, with vectors in the place of numbers, several (`engine.simd`).
"""

import math

import numpy as np

from ..arrays import Stage
from ..compiled import kernel
from ..dimensions import error_square, extrapolate, size_of
from ..physics.bed import with_landings
from ..physics.sea_series import forget
from ..physics.tension.kernels import tension
from ..planar.columns import EPS  # in space the same column
from ..record import STRETCH
from ..simd.elementary import copy_into
from ..simd.select import smaller
from .newton import newton
from .ringing import ringing_error
from .status import OK

SMALL_STEP_NEWTON = 100  # iterations: after a release each update is cut to one scale, and takes about 20


@kernel
def plan_stage(p, tables, i, small, dt, dt_before, a, w):
    """What stage i of a step asks for: a (s,) with C~ = C + sum a_j K_j, and w (3,), the weights of the first guess.

    The guess is the polynomial through the latest three (or two, or one) of: the state dt_before (s) earlier (0: there
    is none), the state, the stages so far; w belongs to the last three of these. small: a step of backward Euler, whose
    one stage is the last. Returns rate = 1/(a_ii dt) (1/s), c0 of THEORY.md, and the time of the stage within the
    step (s). Layout of the method in `tables`: `engine.time.integrators`.
    """
    s = max(p.stages, 2)
    for j in range(s):
        a[j] = 0.0
    w[0], w[1], w[2] = 0.0, 0.0, 1.0
    if small:
        if dt_before > 0.0:
            w[1], w[2] = -dt / dt_before, (dt_before + dt) / dt_before
        return 1.0 / dt, dt
    at = p.method_at + s * i
    at_c = p.method_at + s * s
    for j in range(i):
        a[j] = dt * tables[at + j]
    t = tables[at_c + i] * dt
    if i > 1 or dt_before > 0.0:
        t2 = tables[at_c + i - 1] * dt
        t1 = tables[at_c + i - 2] * dt if i > 1 else -dt_before
        if i > 2 or (i == 2 and dt_before > 0.0):
            t0 = tables[at_c + i - 3] * dt if i > 2 else -dt_before
            w[0] = (t - t1) * (t - t2) / ((t0 - t1) * (t0 - t2))
            w[1] = (t - t0) * (t - t2) / ((t1 - t0) * (t1 - t2))
            w[2] = (t - t0) * (t - t1) / ((t2 - t0) * (t2 - t1))
        else:
            w[1], w[2] = (t2 - t) / (t2 - t1), (t - t1) / (t2 - t1)
    return 1.0 / (tables[at + i] * dt), t


@kernel
def known_part(a, count, C, Ks, C_tilde):
    """C~ = C + sum over the first `count` of a_j K_j: C, C~ (n, m), Ks (s, n, m)."""
    copy_into(C_tilde, C)
    for j in range(count):
        share, K = a[j], Ks[j]
        for k in range(C.shape[0]):
            for m in range(C.shape[1]):
                C_tilde[k, m] += share * K[k, m]


@kernel
def stage_rate(rate, C, C_tilde, K):
    """K = rate (C - C~), for arrays (n, m)."""
    for k in range(C.shape[0]):
        for m in range(C.shape[1]):
            K[k, m] = rate * (C[k, m] - C_tilde[k, m])


@kernel
def guess(w, oldest, middle, latest):
    """First guess of one unknown from its last three values."""
    return w[0] * oldest + w[1] * middle + w[2] * latest


@kernel
def stage_rates(p, rate, Y, Q, C_tilde, C_new, K):
    """C_new, the conserved variables of a stage solved for Y, and K = rate (C_new - C~)."""
    half = size_of(p)[1] // 2
    for k in range(Y.shape[0]):
        for m in range(half):
            C_new[k, m] = Q[k, STRETCH + m]
            C_new[k, half + m] = Y[k, half + m]
    stage_rate(rate, C_new, C_tilde, K)


@kernel
def runge_kutta_step(p, tables, step, motion, trial, work):
    """A trial step of a stiffly accurate ESDIRK method, or (step.small) of backward Euler in its place.

    step: Step; motion: Motion, not changed; trial: Trial, filled; work: Work.
    Returns (code, Newton iterations, embedded error in units of the tolerance; 0 for fixed and for small steps).
    """
    t, dt, dt_before, small = step
    Y, Y_before, C, K = motion
    Ys, Ks, C_new = trial
    C_tilde = work.C_tilde
    s, unknowns = Ys.shape[0], Ys.shape[2]
    a, w = np.empty(s), np.empty(3)
    max_iterations = SMALL_STEP_NEWTON if small else p.max_newton
    iterations = 0
    forget(work.sea)
    copy_into(Ys[0], Y)
    copy_into(Ks[0], K)
    for i in range(s - 1 if small else 1, s):
        rate, delay = plan_stage(p, tables, i, small, dt, dt_before, a, w)
        known_part(a, 0 if small else i, C, Ks, C_tilde)
        # first guess: through the latest three of state before, state, stages; oldest has weight 0 at i = 1
        first = small or i == 1
        oldest, middle, latest = Y if first else Y_before, Y_before if first else Ys[i - 2], Y if first else Ys[i - 1]
        if i > 2 and not small:
            oldest = Ys[i - 3]
        for k in range(Y.shape[0]):
            for j in range(unknowns):
                Ys[i, k, j] = guess(w, oldest[k, j], middle[k, j], latest[k, j])
        stage = Stage(t + delay, 1.0, rate, rate)
        code, used = newton(p, tables, stage, p.newton_tolerance, max_iterations, Ys[i], work)
        iterations += used
        if code != OK:
            return code, iterations, np.inf
        stage_rates(p, rate, Ys[i], work.Q, C_tilde, C_new, Ks[i])
    if small or p.adaptive == 0:
        return OK, iterations, 0.0
    error = embedded_error(p, tables, dt, Ks, work.Q, a, C_tilde[0])  # the last two: work
    return OK, iterations, with_landings(p, tables, dt, Ys[s - 1], Ks, work.X, error)


@kernel
def trial_error(p, tables, dt, error, least, top, jumps):
    """The error by which a step is judged: the embedded estimate, or what ringing or buckling asks for.

    least, top: strains after the step, the least one and that of the upper end; jumps: `jumps_of_rates`.
    """
    error = max(error, ringing_error(p, tables, dt, top, jumps))
    if p.bent:
        rate = buckling_rate(p, tables, least)
        error = max(error, (dt * rate / p.growth_per_step) ** p.order)
    return error


@kernel
def least_strain(Y):
    """Least strain along the tether."""
    least = Y[0, EPS]
    for k in range(1, Y.shape[0]):
        least = smaller(least, Y[k, EPS])
    return least


@kernel
def buckling_rate(p, tables, least):
    """Growth rate (1/s) of the fastest buckle that the grid carries under the compression P at the least strain.

    rate^2 = (P k^2 - EI k^4)/(m + m_a) at k^2 = P/(2 EI), or at the shortest wave of the grid, k = pi/h, where that is
    longer (Triantafyllou & Howell 1994); p.shortest_wave is the k^2 of the latter. `trial_error` holds a step to
    p.growth_per_step e-folds (why: THEORY.md, section 8).
    """
    P = -tension(least, p, tables)[0]
    if P <= 0.0:
        return 0.0
    square = min(P / (2.0 * p.EI), p.shortest_wave)
    return math.sqrt(square * (P - p.EI * square) / (p.m + p.ma))


@kernel
def embedded_error(p, tables, dt, Ks, Q, d, errors):
    """Embedded error estimate over tolerance: rms over nodes of strain, angle and speed errors in scene scales.

    d (s,), errors (conserved,): work, for dt (b - b embedded) and for the error of one node.
    """
    s, n = Ks.shape[0], Ks.shape[1]
    at_d = p.method_at + s * s + s
    for j in range(s):
        d[j] = dt * tables[at_d + j]
    total = 0.0
    for k in range(n):
        for m in range(size_of(p)[1]):
            error = 0.0
            for j in range(s):
                error += d[j] * Ks[j, k, m]
            errors[m] = error
        total += error_square(p, k, errors, Q)
    return math.sqrt(total / n) / p.rtol


@kernel
def one_stage_step(p, tables, step, motion, trial, work):
    """A trial step of the generalized-alpha family (backward Euler and implicit midpoint included).

    With C_s the state and K_s the rates at the stage, t_n + alpha_f dt:
    K_s = c0 (C_s - C~), c0 = alpha_m/(alpha_f gamma dt), C~ = C_n + alpha_f dt (1 - gamma/alpha_m) K_n;
    C_(n+1) = C_n + (C_s - C_n)/alpha_f,  K_(n+1) = (K_s - (1 - alpha_m) K_n)/alpha_m.
    step, motion, trial, work: as for `runge_kutta_step`. Returns (code, Newton iterations).
    """
    t, dt, dt_before, _ = step
    alpha_m, alpha_f, gamma = p.alpha_m, p.alpha_f, p.gamma
    Y, Y_before, C, K = motion
    last = trial.Y.shape[0] - 1
    Y_new, K_new, C_new = trial.Y[last], trial.K[last], trial.C
    Q, C_tilde = work.Q, work.C_tilde
    unknowns, size = size_of(p)
    half = size // 2
    n = Y.shape[0]
    forget(work.sea)
    shift = alpha_f * dt * (1.0 - gamma / alpha_m)
    for k in range(n):
        for m in range(size):
            C_tilde[k, m] = C[k, m] + shift * K[k, m]
    ratio = alpha_f * dt / dt_before if dt_before > 0.0 else 0.0
    for k in range(n):
        for i in range(unknowns):
            Y_new[k, i] = Y[k, i] + ratio * (Y[k, i] - Y_before[k, i])
    rate = alpha_m / (alpha_f * gamma * dt)
    stage = Stage(t + alpha_f * dt, 1.0, rate, rate)
    code, used = newton(p, tables, stage, p.newton_tolerance, p.max_newton, Y_new, work)
    if code != OK:
        return code, used
    for k in range(n):
        for m in range(size):
            C_s = Q[k, STRETCH + m] if m < half else Y_new[k, m]
            C_new[k, m] = C[k, m] + (C_s - C[k, m]) / alpha_f
            K_new[k, m] = (rate * (C_s - C_tilde[k, m]) - (1.0 - alpha_m) * K[k, m]) / alpha_m
    if alpha_f != 1.0:
        extrapolate(p, alpha_f, Y, C_new, Y_new)
    return OK, used
