"""Systems with known largest exponents: right-hand sides, Jacobians, sampled records, tangent-map exponents.

Literature values [nats/time]; where a book gives three digits, the tangent map below is the truth in the tests.
    Lorenz 10, 28, 8/3             0.9056      Sprott, Chaos and Time-Series Analysis, 2003; Viswanath 1998: 0.90566
    Rossler 0.2, 0.2, 5.7          0.0714      Sprott 2003
    Duffing two-well .25, .4       0.15 ...    no standard value: tangent map
    Ueda .05, 7.5                  0.1034      Sprott 2003
    driven pendulum .05, .6, .7    0.1400      Sprott 2003
    Henon 1.4, .3                  0.41922     Sprott 2003
    logistic 4                     ln 2        exact
"""

from dataclasses import dataclass

import numba
import numpy as np

from tests.analysis import maps


@dataclass(frozen=True)
class Flow:
    """rhs(t, y, out); start; what is observed (function of the states (n, d)); default sampling step."""

    name: str
    rhs: object
    start: tuple
    observe: object
    step: float
    substeps: int
    literature: float | None
    period: float = 2.0 * np.pi


@numba.njit
def _lorenz(t, y, f):
    f[0] = 10.0 * (y[1] - y[0])
    f[1] = y[0] * (28.0 - y[2]) - y[1]
    f[2] = y[0] * y[1] - 8.0 / 3.0 * y[2]


@numba.njit
def _rossler(t, y, f):
    f[0] = -y[1] - y[2]
    f[1] = y[0] + 0.2 * y[1]
    f[2] = 0.2 + y[2] * (y[0] - 5.7)


@numba.njit
def _duffing(t, y, f):
    f[0] = y[1]
    f[1] = -0.25 * y[1] + y[0] - y[0] ** 3 + 0.4 * np.cos(t)


@numba.njit
def _ueda(t, y, f):
    f[0] = y[1]
    f[1] = -0.05 * y[1] - y[0] ** 3 + 7.5 * np.cos(t)


@numba.njit
def _pendulum(t, y, f):
    f[0] = y[1]
    f[1] = -0.05 * y[1] - np.sin(y[0]) + 0.6 * np.sin(0.7 * t)


@numba.njit
def _van_der_pol(t, y, f):
    f[0] = y[1]
    f[1] = (1.0 - y[0] * y[0]) * y[1] - y[0]


def _first(y):
    return y[:, 0]


FLOWS = {
    flow.name: flow
    for flow in (
        Flow("lorenz", _lorenz, (1.0, 1.0, 20.0), _first, 0.03, 10, 0.9056),
        Flow("rossler", _rossler, (1.0, 1.0, 0.0), _first, 0.1, 4, 0.0714),
        Flow("duffing", _duffing, (0.1, 0.1), _first, 2 * np.pi / 50, 5, None),
        Flow("ueda", _ueda, (2.5, 0.0), _first, 2 * np.pi / 50, 5, 0.1034),
        Flow("pendulum", _pendulum, (0.1, 0.0), lambda y: y[:, 1], 2 * np.pi / 0.7 / 50, 8, 0.1400),
        Flow("van_der_pol", _van_der_pol, (1.0, 0.0), _first, 0.1, 4, 0.0),
    )
}


@numba.njit
def _rk4(rhs, y, t, h, k):
    rhs(t, y, k[0])
    rhs(t + 0.5 * h, y + 0.5 * h * k[0], k[1])
    rhs(t + 0.5 * h, y + 0.5 * h * k[1], k[2])
    rhs(t + h, y + h * k[2], k[3])
    y += h / 6.0 * (k[0] + 2.0 * k[1] + 2.0 * k[2] + k[3])


@numba.njit
def _march(rhs, y, step, substeps, skip, samples):
    k = np.empty((4, y.size))
    out = np.empty((samples, y.size))
    h = step / substeps
    for i in range(skip + samples):
        if i >= skip:
            out[i - skip] = y
        for j in range(substeps):
            _rk4(rhs, y, i * step + j * h, h, k)
    return out


@numba.njit
def _separation(rhs, y, step, substeps, skip, samples, size):
    """Benettin with two copies: `size` apart, rescaled after every sampling step."""
    k = np.empty((4, y.size))
    h = step / substeps
    z = y.copy()
    growth = np.empty(samples)
    for i in range(skip + samples):
        if i == skip:
            z[:] = y
            z[0] += size
        for j in range(substeps):
            t = i * step + j * h
            _rk4(rhs, y, t, h, k)
            if i >= skip:
                _rk4(rhs, z, t, h, k)
        if i >= skip:
            d = np.sqrt(np.sum((z - y) ** 2))
            growth[i - skip] = np.log(d / size)
            z[:] = y + (z - y) * (size / d)
    return growth


def states(name, samples, step=None, skip_time=500.0):
    """States (samples, d) on the attractor."""
    flow = FLOWS[name]
    step = flow.step if step is None else step
    substeps = max(1, int(np.ceil(step * flow.substeps / flow.step)))
    skip = int(np.ceil(skip_time / step))
    return _march(flow.rhs, np.array(flow.start, dtype=float), step, substeps, skip, samples)


def record(name, samples=20_000, step=None, noise=0.0, seed=0, skip_time=500.0):
    """(series, step): the observed coordinate, with white noise of `noise` standard deviations of the series."""
    flow = FLOWS[name]
    x = flow.observe(states(name, samples, step, skip_time)).copy()
    return noisy(x, noise, seed), flow.step if step is None else step


def noisy(x, share, seed):
    return x + share * np.std(x) * np.random.default_rng(seed).normal(size=len(x)) if share else x


def benettin(name, time=50_000.0):
    """(exponent, standard error) by two nearby copies over `time`, errors from 50 blocks."""
    flow = FLOWS[name]
    samples = int(time / flow.step)
    growth = _separation(
        flow.rhs, np.array(flow.start, dtype=float), flow.step, flow.substeps, int(500 / flow.step), samples, 1e-8
    )
    blocks = growth[: samples // 50 * 50].reshape(50, -1).mean(axis=1) / flow.step
    return float(blocks.mean()), float(blocks.std(ddof=1) / np.sqrt(50))


def henon(samples=20_000):
    """x of the Henon map, a = 1.4, b = 0.3; 0.41922 nats/step."""
    return maps.henon(samples, skip=999)[:, 0]


def logistic(samples=20_000):
    """x of the logistic map at r = 4; ln 2 nats/step."""
    return maps.logistic(4.0, samples, 0.1234, 999)


def two_tone(samples=20_000, step=0.1, ratio=1.618033988749895):
    """sin t + 0.7 sin(ratio t + 1): a torus, exponent 0."""
    t = step * np.arange(samples)
    return np.sin(t) + 0.7 * np.sin(ratio * t + 1.0)
