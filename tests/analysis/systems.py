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

import numpy as np

from benchmarks.known_flows import FLOWS, march

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
SAMPLED = {  # name in FLOWS, which coordinate is observed, sampling step, steps of integration in one of these
    "lorenz": ("Lorenz", 0, 0.03, 10),
    "rossler": ("Rossler", 0, 0.1, 4),
    "duffing": ("Duffing", 0, 2 * np.pi / 50, 5),
    "ueda": ("Ueda", 0, 2 * np.pi / 50, 5),
    "pendulum": ("pendulum", 1, 2 * np.pi / 0.7 / 50, 8),
}


def wells(starts, periods):
    """Duffing's two wells with a force of 0.26, from starts (n, 2): strobed states (p + 1, n, 2), and the least and the
    largest x of each period (p, n, 2)."""

    def rate(t, y):
        x, speed = y.T
        return np.column_stack([speed, x - x**3 - 0.25 * speed + 0.26 * np.cos(t)])

    h, path = np.pi / 24, [starts]
    for t in h * np.arange(48 * periods):
        y = path[-1]
        k1 = rate(t, y)
        k2 = rate(t + 0.5 * h, y + 0.5 * h * k1)
        k3 = rate(t + 0.5 * h, y + 0.5 * h * k2)
        k4 = rate(t + h, y + h * k3)
        path.append(y + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4))
    path = np.array(path)
    within = [path[48 * k : 48 * k + 49, :, 0] for k in range(periods)]
    return path[::48], np.stack([np.min(within, axis=1), np.max(within, axis=1)], axis=-1)


@cache
def states(name, samples, step=None, skip_time=500.0):
    """States (samples, d) on the attractor; one array for all who ask, not to be written into."""
    flow, _, usual_step, substeps = SAMPLED[name]
    step = usual_step if step is None else step
    substeps = max(1, int(np.ceil(step * substeps / usual_step)))
    start, skip = np.array(FLOWS[flow][0]), int(np.ceil(skip_time / step))
    orbit = march(list(FLOWS).index(flow), start, step, substeps, skip, samples)
    orbit.flags.writeable = False
    return orbit


def record(name, samples=20_000, noise=0.0, seed=0):
    """(series, step) of a flow, a map or the two tones: the observed coordinate, with white noise of `noise` standard
    deviations of the series."""
    if name in SAMPLED:
        _, observed, step, _ = SAMPLED[name]
        series = states(name, samples)[:, observed].copy()
    elif name == "two_tone":
        series, step = two_tone(samples), 0.1
    else:
        orbit = henon(samples, skip=999)[:, 0] if name == "henon" else logistic(4.0, samples, 0.1234, 999)
        series, step = orbit, 1.0
    return noisy(series, noise, seed), step


def noisy(x, share, seed):
    return x + share * np.std(x) * normal(seed, len(x)) if share else x


def normal(seed, *shape):
    """White noise: independent normal deviates."""
    return np.random.default_rng(seed).normal(size=shape)


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


def henon_plane(z, p):
    """Henon's map (x, y) -> (a - x^2 + y, b x) over both of its parameters p = (a, b), in the same way."""
    (a, b), (x, y) = p, z
    return np.array([a - x * x + y, b * x]), lambda vectors: np.array([[-2.0 * x, 1.0], [b, 0.0]]) @ vectors
