"""Systems with known largest exponents [nats/time]: right-hand sides and sampled records.

Lorenz 10, 28, 8/3             0.9056      Sprott, Chaos and Time-Series Analysis, 2003; Viswanath 1998: 0.90566
Rossler 0.2, 0.2, 5.7          0.0714      Sprott 2003
Duffing two-well .25, .4       0.1565      no standard value: two nearby copies over 1e5 units of time
Ueda .05, 7.5                  0.1034      Sprott 2003
driven pendulum .05, .6, .7    0.1400      Sprott 2003
Henon 1.4, .3                  0.41922     Sprott 2003
logistic 4                     ln 2        exact
two tones                      0           exact
"""

from dataclasses import dataclass

import numba
import numpy as np

from tests.analysis import maps

TRUTH = {
    "lorenz": 0.9056,
    "rossler": 0.0714,
    "duffing": 0.1565,
    "ueda": 0.1034,
    "pendulum": 0.1400,
    "henon": 0.41922,
    "logistic": np.log(2.0),
    "two_tone": 0.0,
}


@dataclass(frozen=True)
class Flow:
    """rhs(t, y); start; which coordinate is observed; sampling step; steps of integration in one of these."""

    rhs: object
    start: tuple
    observed: int
    step: float
    substeps: int


@numba.njit
def _lorenz(t, y):
    return np.array([10.0 * (y[1] - y[0]), y[0] * (28.0 - y[2]) - y[1], y[0] * y[1] - 8.0 / 3.0 * y[2]])


@numba.njit
def _rossler(t, y):
    return np.array([-y[1] - y[2], y[0] + 0.2 * y[1], 0.2 + y[2] * (y[0] - 5.7)])


@numba.njit
def _duffing(t, y):
    return np.array([y[1], -0.25 * y[1] + y[0] - y[0] ** 3 + 0.4 * np.cos(t)])


@numba.njit
def _ueda(t, y):
    return np.array([y[1], -0.05 * y[1] - y[0] ** 3 + 7.5 * np.cos(t)])


@numba.njit
def _pendulum(t, y):
    return np.array([y[1], -0.05 * y[1] - np.sin(y[0]) + 0.6 * np.sin(0.7 * t)])


@numba.njit
def _van_der_pol(t, y):
    return np.array([y[1], (1.0 - y[0] * y[0]) * y[1] - y[0]])


FLOWS = {
    "lorenz": Flow(_lorenz, (1.0, 1.0, 20.0), 0, 0.03, 10),
    "rossler": Flow(_rossler, (1.0, 1.0, 0.0), 0, 0.1, 4),
    "duffing": Flow(_duffing, (0.1, 0.1), 0, 2 * np.pi / 50, 5),
    "ueda": Flow(_ueda, (2.5, 0.0), 0, 2 * np.pi / 50, 5),
    "pendulum": Flow(_pendulum, (0.1, 0.0), 1, 2 * np.pi / 0.7 / 50, 8),
    "van_der_pol": Flow(_van_der_pol, (1.0, 0.0), 0, 0.1, 4),
}


@numba.njit
def _march(rhs, y, step, substeps, skip, samples):
    out = np.empty((samples, y.size))
    h = step / substeps
    for i in range(skip + samples):
        if i >= skip:
            out[i - skip] = y
        for j in range(substeps):
            t = i * step + j * h
            k1 = rhs(t, y)
            k2 = rhs(t + 0.5 * h, y + 0.5 * h * k1)
            k3 = rhs(t + 0.5 * h, y + 0.5 * h * k2)
            k4 = rhs(t + h, y + h * k3)
            y = y + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
    return out


def states(name, samples, step=None, skip_time=500.0):
    """States (samples, d) on the attractor."""
    flow = FLOWS[name]
    step = flow.step if step is None else step
    substeps = max(1, int(np.ceil(step * flow.substeps / flow.step)))
    return _march(flow.rhs, np.array(flow.start), step, substeps, int(np.ceil(skip_time / step)), samples)


def record(name, samples=20_000, noise=0.0, seed=0):
    """(series, step) of a flow, a map or the two tones: the observed coordinate, with white noise of `noise` standard
    deviations of the series."""
    if name in FLOWS:
        return noisy(states(name, samples)[:, FLOWS[name].observed].copy(), noise, seed), FLOWS[name].step
    make, step = {"henon": (henon, 1.0), "logistic": (logistic, 1.0), "two_tone": (two_tone, 0.1)}[name]
    return noisy(make(samples), noise, seed), step


def noisy(x, share, seed):
    return x + share * np.std(x) * np.random.default_rng(seed).normal(size=len(x)) if share else x


def henon(samples=20_000):
    """x of the Henon map, a = 1.4, b = 0.3."""
    return maps.henon(samples, skip=999)[:, 0]


def logistic(samples=20_000):
    """x of the logistic map at r = 4."""
    return maps.logistic(4.0, samples, 0.1234, 999)


def two_tone(samples=20_000, step=0.1):
    """sin t + 0.7 sin(1.618... t + 1): a torus."""
    t = step * np.arange(samples)
    return np.sin(t) + 0.7 * np.sin(1.618033988749895 * t + 1.0)
