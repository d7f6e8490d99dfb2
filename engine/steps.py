"""One time step of either family of integrators: a trial state and rates, a result code, an error estimate.

Conserved variables of a node: C = (q, V), four numbers in a plane and six in space; K = dC/dt. A trial never changes
the accepted state. In Y (n, unknowns) and in C the velocity has the same columns; Q holds q from column 5 on.
"""

import math

import numpy as np

from .compiled import kernel
from .dimensions import error_square, extrapolate, size_of
from .elementary import copy_into
from .guards import OK
from .newton import newton
from .tension import tension


@kernel
def _predict(p, times, Ys, count, t, Y):
    """Y at time t by the polynomial through the last `count` (1, 2 or 3) entries of Ys; times relative to the step."""
    unknowns, _ = size_of(p)
    last = times.shape[0] - 1
    if count == 1:
        copy_into(Y, Ys[last])
    elif count == 2:
        a = (t - times[last - 1]) / (times[last] - times[last - 1])
        for k in range(Y.shape[0]):
            for i in range(unknowns):
                Y[k, i] = Ys[last - 1, k, i] + a * (Ys[last, k, i] - Ys[last - 1, k, i])
    else:
        t0, t1, t2 = times[last - 2], times[last - 1], times[last]
        w0 = (t - t1) * (t - t2) / ((t0 - t1) * (t0 - t2))
        w1 = (t - t0) * (t - t2) / ((t1 - t0) * (t1 - t2))
        w2 = (t - t0) * (t - t1) / ((t2 - t0) * (t2 - t1))
        for k in range(Y.shape[0]):
            for i in range(unknowns):
                Y[k, i] = w0 * Ys[last - 2, k, i] + w1 * Ys[last - 1, k, i] + w2 * Ys[last, k, i]


@kernel
def runge_kutta_step(p, tables, t, dt, dt_before, Y, Y_before, C, K, Ys, Ks, C_new, work):
    """A trial step of a stiffly accurate ESDIRK method.

    Y, C, K: accepted state at t and its rates; Y_before: the state dt_before earlier (0: none), for the first guess.
    Ys (s, n, unknowns), Ks (s, n, conserved): stages; the last of each is the new state and its rates; C_new: its
    conserved variables.
    Returns (code, Newton iterations, error in units of the tolerance; 0 for fixed steps).
    """
    X, F, Q, E, D, C_tilde = work
    unknowns, size = size_of(p)
    half = size // 2
    s, n = p.stages, Y.shape[0]
    at_c = p.method_at + s * s
    times = np.empty(3)
    guesses = np.empty((3, n, unknowns))
    iterations = 0
    copy_into(Ys[0], Y)
    copy_into(Ks[0], K)
    for i in range(1, s):
        a_ii = tables[p.method_at + s * i + i]
        copy_into(C_tilde, C)
        for j in range(i):
            a = dt * tables[p.method_at + s * i + j]
            if a != 0.0:
                for k in range(n):
                    for m in range(size):
                        C_tilde[k, m] += a * Ks[j, k, m]
        # first guess: linear from the step before for the first stage, quadratic through the latest stages after
        count = 0
        for j in range(max(0, i - 3), i):
            copy_into(guesses[3 - i + j], Ys[j])
            times[3 - i + j] = tables[at_c + j] * dt
            count += 1
        if count < 3 and dt_before > 0.0:
            copy_into(guesses[2 - count], Y_before)
            times[2 - count] = -dt_before
            count += 1
        c_dt = tables[at_c + i] * dt
        _predict(p, times, guesses, count, c_dt, Ys[i])
        rate = 1.0 / (a_ii * dt)
        code, used = newton(
            p, tables, t + c_dt, 1.0, rate, rate, p.newton_tolerance, p.max_newton, Ys[i], C_tilde,
            X, F, Q, E, D,
        )
        iterations += used
        if code != OK:
            return code, iterations, np.inf
        for k in range(n):
            for m in range(half):
                C_new[k, m] = Q[k, 5 + m]
                C_new[k, half + m] = Ys[i, k, half + m]
            for m in range(size):
                Ks[i, k, m] = rate * (C_new[k, m] - C_tilde[k, m])
    if not p.adaptive:
        return OK, iterations, 0.0
    error = _error(p, tables, dt, Ks, Q)
    if p.bent:
        error = max(error, (dt * buckling_rate(p, tables, Ys[s - 1]) / p.growth_per_step) ** p.order)
    return OK, iterations, error


@kernel
def buckling_rate(p, tables, Y):
    """Growth rate (1/s) of the fastest buckle that the grid carries under the greatest compression P of a state.

    rate^2 = (P k^2 - EI k^4)/(m + m_a) at k^2 = P/(2 EI), or at the shortest wave of the grid, k = pi/h, where that is
    longer (Triantafyllou & Howell 1994). Small errors made while a tether goes slack choose the side to which it
    buckles, and an L-stable method with a step much longer than 1/rate damps what should grow, unseen by the error
    estimate: two runs then part by metres of slack. A step is therefore held to p.growth_per_step e-folds.
    """
    least = Y[0, 0]
    for k in range(1, Y.shape[0]):
        least = min(least, Y[k, 0])
    P = -tension(least, p, tables)[0]
    if P <= 0.0:
        return 0.0
    square = min(P / (2.0 * p.EI), p.shortest_wave)
    return math.sqrt(square * (P - p.EI * square) / (p.m + p.ma))


@kernel
def _error(p, tables, dt, Ks, Q):
    """Embedded error estimate over tolerance: rms over nodes of strain, angle and speed errors in scene scales."""
    s, n = Ks.shape[0], Ks.shape[1]
    at_d = p.method_at + s * s + s
    size = size_of(p)[1]
    total = 0.0
    errors = np.empty(size)
    for k in range(n):
        for m in range(size):
            errors[m] = 0.0
            for j in range(s):
                errors[m] += dt * tables[at_d + j] * Ks[j, k, m]
        total += error_square(p, k, errors, Q)
    return math.sqrt(total / n) / p.rtol


@kernel
def one_stage_step(
    p, tables, t, dt, dt_before, alpha_m, alpha_f, gamma, most, Y, Y_before, C, K, Y_new, K_new, C_new, work
):
    """A trial step of the generalized-alpha family (backward Euler and implicit midpoint included).

    With C_s the state and K_s the rates at the stage, t_n + alpha_f dt:
    K_s = c0 (C_s - C~), c0 = alpha_m/(alpha_f gamma dt), C~ = C_n + alpha_f dt (1 - gamma/alpha_m) K_n;
    C_(n+1) = C_n + (C_s - C_n)/alpha_f,  K_(n+1) = (K_s - (1 - alpha_m) K_n)/alpha_m.
    Returns (code, Newton iterations).
    """
    X, F, Q, E, D, C_tilde = work
    unknowns, size = size_of(p)
    half = size // 2
    n = Y.shape[0]
    shift = alpha_f * dt * (1.0 - gamma / alpha_m)
    for k in range(n):
        for m in range(size):
            C_tilde[k, m] = C[k, m] + shift * K[k, m]
    ratio = alpha_f * dt / dt_before if dt_before > 0.0 else 0.0
    for k in range(n):
        for i in range(unknowns):
            Y_new[k, i] = Y[k, i] + ratio * (Y[k, i] - Y_before[k, i])
    rate = alpha_m / (alpha_f * gamma * dt)
    code, used = newton(
        p, tables, t + alpha_f * dt, 1.0, rate, rate, p.newton_tolerance, most, Y_new, C_tilde, X, F, Q, E, D
    )
    if code != OK:
        return code, used
    for k in range(n):
        for m in range(size):
            C_s = Q[k, 5 + m] if m < half else Y_new[k, m]
            C_new[k, m] = C[k, m] + (C_s - C[k, m]) / alpha_f
            K_new[k, m] = (rate * (C_s - C_tilde[k, m]) - (1.0 - alpha_m) * K[k, m]) / alpha_m
    if alpha_f != 1.0:
        extrapolate(p, alpha_f, Y, C_new, Y_new)
    return OK, used
