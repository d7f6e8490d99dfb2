"""Motions whose regime or largest exponent is known by theory: orbits of maps, sampled records of flows.

Largest exponents, nats/time:

Lorenz 10, 28, 8/3             0.9056      Sprott, Chaos and Time-Series Analysis, 2003; Viswanath 1998: 0.90566
Rossler 0.2, 0.2, 5.7          0.0714      Sprott 2003
Duffing two-well .25, .4       0.1565      no standard value: two nearby copies over 1e5 units of time
Ueda .05, 7.5                  0.1034      Sprott 2003
driven pendulum .05, .6, .7    0.1400      Sprott 2003
Henon 1.4, .3                  0.41922     Sprott 2003
logistic 4                     ln 2        exact
two tones                      0           exact
"""

from functools import cache

import numba
import numpy as np

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
FLOWS = {  # start; which coordinate is observed; sampling step; steps of integration in one of these
    "lorenz": ((1.0, 1.0, 20.0), 0, 0.03, 10),
    "rossler": ((1.0, 1.0, 0.0), 0, 0.1, 4),
    "duffing": ((0.1, 0.1), 0, 2 * np.pi / 50, 5),
    "ueda": ((2.5, 0.0), 0, 2 * np.pi / 50, 5),
    "pendulum": ((0.1, 0.0), 1, 2 * np.pi / 0.7 / 50, 8),
    "van_der_pol": ((1.0, 0.0), 0, 0.1, 4),
    "wells": ((0.1, 0.1), 0, 2 * np.pi / 48, 1),  # Duffing's with a force of .26: several motions
}
LORENZ, ROSSLER, DUFFING, UEDA, PENDULUM, _, WELLS = range(len(FLOWS))


@numba.njit(cache=True)
def _rate(flow, t, y):
    if flow == LORENZ:
        return np.array([10.0 * (y[1] - y[0]), y[0] * (28.0 - y[2]) - y[1], y[0] * y[1] - 8.0 / 3.0 * y[2]])
    if flow == ROSSLER:
        return np.array([-y[1] - y[2], y[0] + 0.2 * y[1], 0.2 + y[2] * (y[0] - 5.7)])
    if flow == DUFFING or flow == WELLS:
        force = -0.25 * y[1] + y[0] - y[0] ** 3 + (0.4 if flow == DUFFING else 0.26) * np.cos(t)
    elif flow == UEDA:
        force = -0.05 * y[1] - y[0] ** 3 + 7.5 * np.cos(t)
    elif flow == PENDULUM:
        force = -0.05 * y[1] - np.sin(y[0]) + 0.6 * np.sin(0.7 * t)
    else:  # van der Pol
        force = (1.0 - y[0] * y[0]) * y[1] - y[0]
    return np.array([y[1], force])


@numba.njit(cache=True)
def _march(flow, y, step, substeps, skip, samples):
    out = np.empty((samples, y.size))
    h = step / substeps
    for i in range(skip + samples):
        if i >= skip:
            out[i - skip] = y
        for j in range(substeps):
            t = i * step + j * h
            k1 = _rate(flow, t, y)
            k2 = _rate(flow, t + 0.5 * h, y + 0.5 * h * k1)
            k3 = _rate(flow, t + 0.5 * h, y + 0.5 * h * k2)
            k4 = _rate(flow, t + h, y + h * k3)
            y = y + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
    return out


def wells(start, periods):
    """Strobed states (p + 1, 2) of Duffing's two wells, and measures (p, 2) of each period: least and largest x."""
    found = _march(WELLS, np.array(start), FLOWS["wells"][2], 1, 0, 48 * periods + 1)
    x = np.column_stack([found[:-1, 0].reshape(periods, 48), found[48::48, 0]])
    return found[::48], np.column_stack([x.min(axis=1), x.max(axis=1)])


@cache
def states(name, samples, step=None, skip_time=500.0):
    """States (samples, d) on the attractor; one array for all who ask, not to be written into."""
    start, _, own, substeps = FLOWS[name]
    step = own if step is None else step
    substeps = max(1, int(np.ceil(step * substeps / own)))
    found = _march(list(FLOWS).index(name), np.array(start), step, substeps, int(np.ceil(skip_time / step)), samples)
    found.flags.writeable = False
    return found


def record(name, samples=20_000, noise=0.0, seed=0):
    """(series, step) of a flow, a map or the two tones: the observed coordinate, with white noise of `noise` standard
    deviations of the series."""
    if name in FLOWS:
        _, observed, step, _ = FLOWS[name]
        series = states(name, samples)[:, observed].copy()
    elif name == "two_tone":
        series, step = two_tone(samples), 0.1
    else:
        orbit = henon(samples, skip=999)[:, 0] if name == "henon" else logistic(4.0, samples, 0.1234, 999)
        series, step = orbit, 1.0
    return noisy(series, noise, seed), step


def noisy(x, share, seed):
    return x + share * np.std(x) * np.random.default_rng(seed).normal(size=len(x)) if share else x


def two_tone(samples=20_000, step=0.1):
    """sin t + 0.7 sin(1.618... t + 1): a torus."""
    t = step * np.arange(samples)
    return np.sin(t) + 0.7 * np.sin(1.618033988749895 * t + 1.0)


def logistic(rate, points, start=0.3, skip=2000):
    """x -> rate x (1 - x)."""
    orbit, x = np.empty(points), start
    for k in range(-skip, points):
        x = rate * x * (1.0 - x)
        if k >= 0:
            orbit[k] = x
    return orbit


def henon(points, a=1.4, b=0.3, skip=200, start=(0.1, 0.1)):
    """x -> 1 - a x^2 + y, y -> b x."""
    orbit, (x, y) = np.empty((points, 2)), start
    for k in range(-skip, points):
        x, y = 1.0 - a * x * x + y, b * x
        if k >= 0:
            orbit[k] = x, y
    return orbit


def circle_map(coupling, rotation, points, skip=500, start=0.1):
    """angle -> angle + rotation - coupling/(2 pi) sin(2 pi angle), as (cos, sin); a homeomorphism for coupling < 1."""
    angle, theta = np.empty(points), start
    for k in range(-skip, points):
        theta = theta + rotation - coupling / (2.0 * np.pi) * np.sin(2.0 * np.pi * theta)
        if k >= 0:
            angle[k] = theta
    return circle(angle)


def nonchaotic_map(sigma, points, skip=1000):
    """x of x' = 2 sigma tanh(x) cos(2 pi theta), theta' = theta + golden mean: strange and not chaotic for sigma > 1
    (Grebogi, Ott, Pelikan & Yorke 1984)."""
    orbit, x = np.empty(points), 0.5
    for k in range(-skip, points):
        x = 2.0 * sigma * np.tanh(x) * np.cos(np.pi * (np.sqrt(5.0) - 1.0) * k)
        if k >= 0:
            orbit[k] = x
    return orbit


def circle(turns):
    """(cos, sin) of angles in turns."""
    return np.column_stack([np.cos(2.0 * np.pi * turns), np.sin(2.0 * np.pi * turns)])


def logistic_growth(rate, orbit):
    """Growth of a perturbation of `logistic` in each step, in nats: ln 2 in the mean where the rate is 4."""
    return np.log(np.maximum(np.abs(rate * (1.0 - 2.0 * orbit[:-1])), 1e-12))


def henon_growth(orbit, a=1.4, b=0.3):
    """The same along an orbit of `henon`."""
    (u, w), growth = (1.0, 0.0), np.empty(len(orbit) - 1)
    for k, (x, _) in enumerate(orbit[:-1]):
        u, w = -2.0 * a * x * u + w, b * u
        length = np.hypot(u, w)
        growth[k], u, w = np.log(length), u / length, w / length
    return growth


def logistic_step(z, rate):
    """`logistic` as `analysis.orbits` takes a map: its image, and its derivative times vectors."""
    return rate * z * (1.0 - z), lambda vectors: rate * (1.0 - 2.0 * z[:, None]) * vectors


def henon_step(z, a, b=0.3):
    """`henon` in the same way."""
    x, y = z
    return np.array([1.0 - a * x * x + y, b * x]), lambda vectors: np.array([[-2.0 * a * x, 1.0], [b, 0.0]]) @ vectors
