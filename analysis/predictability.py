"""How much better a nonlinear predictor knows the next point of a section than a linear one: the sign of a map.

On a section of a deterministic motion the next point is a function of the present one. Two predictors of it, each
tested on points that it was not fitted to:

    linear    one affine map for all points, least squares; each point left out of its own fit in turn
    local     one affine map per point, least squares over its nearest neighbours, Theiler's window left out

    gain = ln(rms error of the linear)/(rms error of the local)          [nats]

A linear stochastic process has no use for neighbourhoods and pays for fewer data: its gain is below 0, whatever its
spectrum. A chaotic map folds, so that its gain is of the order of the nats of precision that the record resolves. The
gain is also high for periodic and quasi-periodic motions with or without noise: what it says about chaos is said by its
rank among the surrogates that keep the lines.
"""

import numpy as np
from numpy.typing import ArrayLike

from analysis.neighbours import nearest_outside
from analysis.sampling import checked_columns, in_deviations, states_of

LEAST_PER_COORDINATE = 8
NEIGHBOURS_PER_COEFFICIENT = 2
# Directions in which neighbours lie this much closer than in their widest are not resolved by so few of them.
_RIDGE = 1e-3


def prediction_gain(section: ArrayLike) -> float:
    """Gain of local-linear over linear one-step prediction on a section (formula at the head of this file).

    section (m,) or (m, d)   one row a forcing period; as many rows are taken together as one state as make 3 or more
                             numbers
    Returns ln(linear error/local error) [nats], each rms over points and coordinates; NaN where nothing moves or the
    record is short: it takes eight states per number in a state, and the window.
    Raises ValueError for values that are not finite.
    Source: E. N. Lorenz (analogues), J. Atmos. Sci. 26 (1969) 636; J. D. Farmer & J. J. Sidorowich, Phys. Rev. Lett. 59
    (1987) 845; gain over linear prediction as a test: M. Casdagli, J. R. Stat. Soc. B 54 (1992) 303.
    """
    x = checked_columns(section, "section")
    z = in_deviations(x, centred=True)
    if z.shape[1] == 0:
        return np.nan
    state = states_of(z, x.shape[1])[:-1]
    target = z[len(z) - len(state) :]
    if len(state) < LEAST_PER_COORDINATE * (state.shape[1] + 1) + 2:
        return np.nan
    linear, local = _linear_error(state, target), _local_error(state, target)
    # Errors at rounding cannot be compared: a clean period-N motion is predicted to the last digit by both.
    return float(np.log(max(linear, 1e-9) / max(local, 1e-9)))


def _linear_error(state, target):
    """Leave-one-out rms error of the affine least-squares map: residual/(1 - leverage)."""
    design = np.hstack([np.ones((len(state), 1)), state])
    u, s, _ = np.linalg.svd(design, full_matrices=False)
    u = u[:, s > 1e-9 * s[0]]
    residual = target - u @ (u.T @ target)
    leverage = np.minimum(np.sum(u**2, axis=1, keepdims=True), 1.0 - 1e-6)
    return float(np.sqrt(np.mean((residual / (1.0 - leverage)) ** 2)))


def _local_error(state, target):
    """rms error of the affine maps fitted to the nearest neighbours of each state, itself not among them."""
    points, size = state.shape
    near, _ = nearest_outside(state, 1, count=min(NEIGHBOURS_PER_COEFFICIENT * (size + 1), points - 3))
    away = state[near] - state[:, None, :]
    centre, mean = away.mean(axis=1, keepdims=True), target[near].mean(axis=1, keepdims=True)
    spread = away - centre
    square = np.einsum("pki,pkj->pij", spread, spread)
    trace = np.trace(square, axis1=1, axis2=2)[:, None, None]
    square = square + (_RIDGE * trace / size + 1e-24) * np.eye(size)
    slope = np.linalg.solve(square, np.einsum("pki,pkj->pij", spread, target[near] - mean))
    predicted = mean[:, 0] - np.einsum("pi,pij->pj", centre[:, 0], slope)
    return float(np.sqrt(np.mean((predicted - target) ** 2)))
