"""Output on an even time grid, from inside the accepted steps.

Runge-Kutta steps carry rates at both ends: cubic Hermite interpolation of the conserved variables, order 4; the
one-stage methods (order 2 and less, undamped rates) are interpolated linearly. Positions are the sums of the
interpolated q, tensions f(|q| - 1), so every column of a sample belongs to one configuration.

samples: 0 t | 1-3 x, y, z | 4-6 velocity | 7 tension at the top | 8 least tension along the tether |
9-10 least and greatest tension at the top over all steps since the sample before | 11 largest distance from the plane
profiles: x | y | z | strain | tension | speed, per node
"""

import numpy as np

from ..compiled import kernel
from ..dimensions import configuration, last_strain
from ..physics.tension import tension


@kernel
def weights_within(hermite, theta, dt):
    """Weights of C0, C1, K0, K1 at the share theta of a step."""
    if not hermite:
        return 1.0 - theta, theta, 0.0, 0.0
    a = theta - 1.0
    return (1.0 + 2.0 * theta) * a * a, theta * theta * (3.0 - 2.0 * theta), dt * theta * a * a, dt * theta * theta * a


@kernel
def sample(p, tables, state, dt, hermite, C0, K0, C1, K1, samples, profiles):
    """Store the samples and profiles that lie within the step from state.t to state.t + dt."""
    n = C0.shape[0]
    end = state.t + dt
    row = np.empty((n, 6))
    while state.samples < samples.shape[0] and state.samples * p.output_step <= end:
        t = state.samples * p.output_step
        weights = weights_within(hermite, (t - state.t) / dt, dt)
        out = samples[state.samples]
        out[4], out[5], out[6], out[11] = configuration(p, tables, weights, C0, K0, C1, K1, row)
        least = row[0, 4]
        for k in range(1, n):
            least = min(least, row[k, 4])
        out[1], out[2], out[3] = row[n - 1, 0], row[n - 1, 1], row[n - 1, 2]
        complete_sample(state, out, t, row[n - 1, 4], least)
    while state.profiles < profiles.shape[0] and state.profiles * p.profile_step <= end:
        t = state.profiles * p.profile_step
        weights = weights_within(hermite, (t - state.t) / dt, dt)
        configuration(p, tables, weights, C0, K0, C1, K1, profiles[state.profiles])
        state.profiles += 1
    note_top(state, tension(last_strain(p, C1), p, tables)[0])


@kernel
def complete_sample(state, out, t, top, least):
    """Time and tensions of a sample `out` that has its place and velocity; the sample is then booked."""
    out[0], out[7], out[8], out[9], out[10] = t, top, least, min(state.low, top), max(state.high, top)
    state.low, state.high = top, top
    state.samples += 1


@kernel
def note_top(state, top):
    """Take in the tension at the top at the end of a step."""
    state.low = min(state.low, top)
    state.high = max(state.high, top)
