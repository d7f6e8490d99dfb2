"""The map from one point of a section to the next, fitted: how well it predicts, and how fast neighbours part in it.

On a section of a deterministic motion the next point is a function of the present one. Two predictors of it, each
tested on points that it was not fitted to:

    linear    one affine map for all points, least squares; each point left out of its own fit in turn
    local     one affine map per point, least squares over its nearest neighbours, Theiler's window left out

    gain = ln(rms error of the linear)/(rms error of the local)          [nats]

A linear stochastic process has no use for neighbourhoods and pays for fewer data: its gain is below 0, whatever its
spectrum. A chaotic map folds, so that its gain is of the order of the nats of precision that the record resolves. The
gain is also high for periodic and quasi-periodic motions with or without noise: what it says about chaos is said by its
rank among the surrogates that keep the lines.

How many rows make a state and how many neighbours a fit is what predicts best: few where the record is clean, many in
noise. A surrogate chooses for itself, so that ranks stay fair.

The slopes A_k of the local maps are the derivative of the map along the record, so that a perturbation grows as

    v_{k+1} = A_k v_k,     growth_k = ln |A_k v_k|/|v_k|,     mean growth = the largest Lyapunov exponent

No pair of neighbours has to be followed past the reach of noise, which is why 200 points of a clean section show it.
Noise on the record flattens the slopes: the exponent comes out too small, and below 0 for a noisy cycle.
"""

from dataclasses import field, replace

import numpy as np
from numpy.typing import ArrayLike

from analysis.exponents import BITS_PER_PERIOD, Exponent, no_exponent
from analysis.neighbours import THEILER, nearest_outside
from analysis.sampling import checked_columns, in_deviations, record, rows_of_state, states_of
from analysis.tangent_growth import tangent_lyapunov

METHOD = "derivative of the section's map, Eckmann & Ruelle 1985"
LEAST_PER_COORDINATE = 8
NEIGHBOURS_PER_COEFFICIENT = (2, 4, 8)
# Directions in which neighbours lie this much closer than in their widest are not resolved by so few of them.
_RIDGE = 1e-3
_LEAST_GROWTH = 1e-12


@record
class PredictionGain:
    """Errors of two predictors of the next point, and their ratio.

    gain             ln(linear_error/local_error) [nats]; NaN where the test does not apply
    linear_error     rms over points and coordinates, each coordinate in units of its standard deviation
    local_error      the same for the local maps
    reason           one sentence
    delays           rows of the section that make a state of the local maps
    neighbours       of each point in its fit
    slopes (k, s, c) of the local maps: from the s numbers of a state to the c coordinates that move
    """

    gain: float
    linear_error: float
    local_error: float
    reason: str
    delays: int = 0
    neighbours: int = 0
    slopes: np.ndarray = field(default_factory=lambda: np.empty((0, 0, 0)), repr=False)

    def growth_nats(self) -> np.ndarray:
        """Logarithm of the growth of a perturbation from each point to the next, nats (k,)."""
        growth, size = np.empty(len(self.slopes)), self.slopes.shape[1]
        usable = size - self.slopes.shape[2]
        v = np.full(size, 1.0)
        for k, slope in enumerate(self.slopes):
            v = np.concatenate([v @ slope, v[:usable]]) / np.sqrt(v @ v)
            growth[k] = np.log(max(np.sqrt(v @ v), _LEAST_GROWTH))
            if growth[k] == np.log(_LEAST_GROWTH):
                v = np.full(size, 1.0)
        return growth


def prediction_gain(section: ArrayLike) -> PredictionGain:
    """Gain of local-linear over linear one-step prediction on a section (formula at the head of this file).

    section (m,) or (m, d)   one row a forcing period
    Returns a PredictionGain: NaN, with the reason, where nothing moves or the record is short: it
    takes eight states per number in a state, and the window. Rows taken together as one state, (x_k, x_{k-1}, ...), are
    from one to as few as make a state of 3 or more numbers, whichever predict best.
    Raises ValueError for values that are not finite.
    Source: E. N. Lorenz (analogues), J. Atmos. Sci. 26 (1969) 636; J. D. Farmer & J. J. Sidorowich, Phys. Rev. Lett. 59
    (1987) 845; gain over linear prediction as a test: M. Casdagli, J. R. Stat. Soc. B 54 (1992) 303.
    """
    x = checked_columns(section, "section")
    z = in_deviations(x, centred=True)
    if z.shape[1] == 0:
        return PredictionGain(np.nan, np.nan, np.nan, "no motion: the section is one point to the last digits")
    longest = rows_of_state(x.shape[1])
    size, points = longest * z.shape[1], len(z) - longest
    needed = LEAST_PER_COORDINATE * (size + 1) + 2 * THEILER
    if points < needed:
        wanted = f"{needed + longest} points are needed for a state of {size} numbers"
        return PredictionGain(np.nan, np.nan, np.nan, f"too short: {wanted}, given {len(x)}")
    target, linear, local, best = z[longest:], np.inf, np.inf, None
    for rows in range(1, longest + 1):
        state = states_of(z, rows)[:-1][-points:]
        linear = min(linear, _linear_error(state, target))
        for error, neighbours, slopes in _local_maps(state, target):
            if error < local:
                local, best = error, (rows, neighbours, slopes)
    # Errors at rounding cannot be compared: a clean period-N motion is predicted to the last digit by both.
    gain = np.log(max(linear, 1e-9) / max(local, 1e-9))
    reason = f"errors {linear:.3g} linear and {local:.3g} local, of a standard deviation: a gain of {gain:.2f} nats"
    return PredictionGain(gain, linear, local, reason, *(best or ()))


def section_lyapunov(section: ArrayLike) -> tuple[Exponent, ...]:
    """The largest exponent of a section's map, of the whole record and of each half, in bits per row of the section.

    section   as in `prediction_gain`
    Returns three Exponents, NaN with the reason where the section is too short or does not move. The error is that of
    the mean growth; what noise does to the slopes is not in it.
    Source: J.-P. Eckmann & D. Ruelle, Rev. Mod. Phys. 57 (1985) 617; in noise: D. Nychka, S. Ellner, D. McCaffrey &
    A. R. Gallant, J. R. Stat. Soc. B 54 (1992) 399; error: `analysis.tangent_growth`.
    """
    gain = prediction_gain(section)
    if not np.isfinite(gain.gain):
        return (no_exponent(METHOD, gain.reason, BITS_PER_PERIOD),) * 3
    growth = gain.growth_nats()
    half = len(growth) // 2
    parts = growth, growth[:half], growth[half:]
    return tuple(replace(tangent_lyapunov(part)[0], method=METHOD) for part in parts)


def _linear_error(state, target):
    """Leave-one-out rms error of the affine least-squares map: residual/(1 - leverage)."""
    design = np.hstack([np.ones((len(state), 1)), state])
    u, s, _ = np.linalg.svd(design, full_matrices=False)
    u = u[:, s > 1e-9 * s[0]]
    residual = target - u @ (u.T @ target)
    leverage = np.minimum(np.sum(u**2, axis=1, keepdims=True), 1.0 - 1e-6)
    return np.sqrt(np.mean((residual / (1.0 - leverage)) ** 2))


def _local_maps(state, target):
    """(rms error, neighbours, slopes (points, s, c)) of affine maps fitted to the nearest neighbours of each state,
    itself not among them, for each number of neighbours."""
    points, size = state.shape
    largest = points - 2 * THEILER - 1
    counts = sorted({min(per_coefficient * (size + 1), largest) for per_coefficient in NEIGHBOURS_PER_COEFFICIENT})
    near, _ = nearest_outside(state, THEILER, count=counts[-1])
    offset, aim = state[near] - state[:, None, :], target[near]
    for count in counts:
        centre, mean = offset[:, :count].mean(axis=1, keepdims=True), aim[:, :count].mean(axis=1, keepdims=True)
        spread = (offset[:, :count] - centre).transpose(0, 2, 1)
        square = spread @ spread.transpose(0, 2, 1)
        trace = np.trace(square, axis1=1, axis2=2)[:, None, None]
        square = square + (_RIDGE * trace / size + 1e-24) * np.eye(size)
        slope = np.linalg.solve(square, spread @ (aim[:, :count] - mean))
        predicted = mean[:, 0] - (centre @ slope)[:, 0]
        yield np.sqrt(np.mean((predicted - target) ** 2)), count, slope
