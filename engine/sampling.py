"""Output on an even time grid, from inside the accepted steps.

Runge-Kutta steps carry rates at both ends: cubic Hermite interpolation of the conserved variables, order 4; the
one-stage methods (order 2 and less, undamped rates) are interpolated linearly. Positions are the sums of the
interpolated q, tensions f(|q| - 1), so every column of a sample belongs to one configuration.

samples: 0 t | 1-2 x, z | 3-4 velocity | 5 tension at the top | 6 least tension along the tether |
7-8 least and greatest tension at the top over all steps since the sample before
profiles: x | z | strain | tension | speed, per node
"""

import math

import numpy as np

from .compiled import kernel
from .tension import tension


@kernel
def _weights(hermite, theta, dt):
    if not hermite:
        return 1.0 - theta, theta, 0.0, 0.0
    a = theta - 1.0
    return (1.0 + 2.0 * theta) * a * a, theta * theta * (3.0 - 2.0 * theta), dt * theta * a * a, dt * theta * theta * a


@kernel
def configuration(p, tables, weights, C0, K0, C1, K1, row):
    """Fill row (n, 5) with x, z, strain, tension, speed at one instant within a step; returns U, W of the last node."""
    w0, w1, g0, g1 = weights
    n = C0.shape[0]
    x = z = qx_below = qz_below = U = W = 0.0
    for k in range(n):
        qx = w0 * C0[k, 0] + w1 * C1[k, 0] + g0 * K0[k, 0] + g1 * K1[k, 0]
        qz = w0 * C0[k, 1] + w1 * C1[k, 1] + g0 * K0[k, 1] + g1 * K1[k, 1]
        U = w0 * C0[k, 2] + w1 * C1[k, 2] + g0 * K0[k, 2] + g1 * K1[k, 2]
        W = w0 * C0[k, 3] + w1 * C1[k, 3] + g0 * K0[k, 3] + g1 * K1[k, 3]
        if k > 0:
            half = 0.5 * tables[p.grid_at + k - 1]
            x += half * (qx_below + qx)
            z += half * (qz_below + qz)
        qx_below, qz_below = qx, qz
        eps = math.sqrt(qx * qx + qz * qz) - 1.0
        row[k, 0], row[k, 1], row[k, 2] = x, z, eps
        row[k, 3] = tension(eps, p, tables)[0]
        row[k, 4] = math.sqrt(U * U + W * W)
    return U, W


@kernel
def sample(p, tables, state, dt, hermite, C0, K0, C1, K1, samples, profiles):
    """Store the samples and profiles that lie within the step from state.t to state.t + dt."""
    n = C0.shape[0]
    end = state.t + dt
    row = np.empty((n, 5))
    while state.samples < samples.shape[0] and state.samples * p.output_step <= end:
        t = state.samples * p.output_step
        weights = _weights(hermite, (t - state.t) / dt, dt)
        U, W = configuration(p, tables, weights, C0, K0, C1, K1, row)
        least = row[0, 3]
        for k in range(1, n):
            least = min(least, row[k, 3])
        top = row[n - 1, 3]
        out = samples[state.samples]
        out[0], out[1], out[2], out[3], out[4] = t, row[n - 1, 0], row[n - 1, 1], U, W
        out[5], out[6], out[7], out[8] = top, least, min(state.low, top), max(state.high, top)
        state.low, state.high = top, top
        state.samples += 1
    while state.profiles < profiles.shape[0] and state.profiles * p.profile_step <= end:
        t = state.profiles * p.profile_step
        configuration(p, tables, _weights(hermite, (t - state.t) / dt, dt), C0, K0, C1, K1, profiles[state.profiles])
        state.profiles += 1
    eps = math.sqrt(C1[n - 1, 0] ** 2 + C1[n - 1, 1] ** 2) - 1.0
    top = tension(eps, p, tables)[0]
    state.low = min(state.low, top)
    state.high = max(state.high, top)
