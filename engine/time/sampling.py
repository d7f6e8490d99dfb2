"""Output on an even time grid, from inside the accepted steps.

Runge-Kutta steps carry rates at both ends: cubic Hermite interpolation of the conserved variables, order 4; the
one-stage methods (order 2 and less, undamped rates) are interpolated linearly. Positions are the sums of the
interpolated q, tensions f(|q| - 1), so every column of a sample belongs to one configuration.

Columns of samples and profiles: `engine.record`.
"""

import numpy as np

from .. import record as col
from ..compiled import kernel
from ..dimensions import configuration, last_strain
from ..physics.tension.kernels import tension


@kernel
def weights_within(hermite, theta, dt):
    """Weights of C0, C1, K0, K1 at the share theta of a step."""
    if not hermite:
        return 1.0 - theta, theta, 0.0, 0.0
    a = theta - 1.0
    return (1.0 + 2.0 * theta) * a * a, theta * theta * (3.0 - 2.0 * theta), dt * theta * a * a, dt * theta * theta * a


@kernel
def sample(p, tables, state, dt, hermite, begin, end, samples, profiles):
    """Store the samples and profiles that lie within the step from state.t to state.t + dt.

    begin, end: conserved variables and rates (n, conserved) at its begin and its end; samples, profiles: of Output.
    """
    (C0, K0), (C1, K1) = begin, end
    n, until = C0.shape[0], state.t + dt
    row = np.empty((n, col.PROFILE_WIDTH))
    while state.samples < samples.shape[0] and state.samples * p.output_step <= until:
        t = state.samples * p.output_step
        weights = weights_within(hermite, (t - state.t) / dt, dt)
        out = samples[state.samples]
        out[col.AT_U], out[col.AT_V], out[col.AT_W], out[col.OFFPLANE] = configuration(
            p, tables, weights, C0, K0, C1, K1, row
        )
        least = row[0, col.TENSION]
        for k in range(1, n):
            least = min(least, row[k, col.TENSION])
        for i in range(3):
            out[col.AT_X + i] = row[n - 1, col.PLACE + i]
        top = row[n - 1, col.TENSION]
        out[col.TIME], out[col.TOP], out[col.LEAST] = t, top, least
        out[col.TOP_LOW], out[col.TOP_HIGH] = min(state.low, top), max(state.high, top)
        state.low, state.high = top, top
        state.samples += 1
    while state.profiles < profiles.shape[0] and state.profiles * p.profile_step <= until:
        t = state.profiles * p.profile_step
        weights = weights_within(hermite, (t - state.t) / dt, dt)
        configuration(p, tables, weights, C0, K0, C1, K1, profiles[state.profiles])
        state.profiles += 1
    top = tension(last_strain(p, C1), p, tables)[0]
    state.low, state.high = min(state.low, top), max(state.high, top)
