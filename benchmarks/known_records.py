"""Records that are not chaotic: periods and tori with and without noise, linear noise, strange nonchaotic attractors.

Each generator takes a random generator and returns a `Known`. Lengths, sampling and parameters are drawn; the exponents
of driven maps, which have to be negative, are those of the map itself, from its derivative.
"""

import numpy as np
from numba import njit
from scipy.signal import lfilter

from analysis import iaaft_surrogates
from benchmarks.known_flows import FLOWS, Known, flow

GOLDEN = 0.5 * (np.sqrt(5.0) - 1.0)


def _noise(samples, rng):
    white = rng.normal(size=samples)
    memory = rng.uniform(0.5, 0.99)
    return white if rng.random() < 0.5 else lfilter([np.sqrt(1 - memory**2)], [1, -memory], white)


def _clock(rng):
    """Times in periods, samples a period, and the forcing period given or not."""
    samples = int(rng.choice([12, 24, 48]))
    time = np.arange(int(rng.integers(200, 401)) * samples + 1) / samples
    return time, samples, (1.0 if rng.random() < 0.6 else None)


def periodic_with_noise(rng):
    time, samples, period = _clock(rng)
    n = int(rng.integers(1, 9))
    x = sum(rng.normal() / (1 + j / n) * np.cos(2 * np.pi * (j * time / n + rng.random())) for j in range(1, 3 * n + 1))
    x = x + 10 ** rng.uniform(-3, -0.3) * x.std() * _noise(len(x), rng)
    return Known(x, 1.0 / samples, period, f"period {n}")


def _torus(time, rng):
    first = rng.uniform(0.03, 0.5)
    second = first * rng.uniform(0.2, 0.9)
    tones = int(rng.integers(1, 3))
    angles = [2 * np.pi * (f * time + rng.random()) for f in (first, second)[:tones]]
    x = np.cos(2 * np.pi * time) + sum(
        rng.uniform(0.3, 1.5) * np.cos(a + rng.normal() * np.sin(2 * np.pi * time)) for a in angles
    )
    return x + 0.4 * rng.normal() * x**2 * np.cos(angles[0]) + 0.3 * rng.normal() * np.exp(np.sin(angles[tones - 1]))


def torus(rng):
    time, samples, period = _clock(rng)
    return Known(_torus(time, rng), 1.0 / samples, period, "torus")


def torus_with_noise(rng):
    known = torus(rng)
    x = known.series
    return known._replace(series=x + 10 ** rng.uniform(-3, -0.3) * x.std() * _noise(len(x), rng))


def linear_noise(rng):
    """A damped oscillator or a first-order process driven by noise, plain or through an instrument."""
    _, samples, period = _clock(rng)
    n = int(rng.integers(200, 401)) * samples
    frequency = 10 ** rng.uniform(-0.7, 0.3) / samples
    damping = np.exp(-(10 ** rng.uniform(-2.5, -0.2)) * 5 * frequency)
    x = lfilter([1], [1, -2 * damping * np.cos(2 * np.pi * frequency), damping**2], rng.normal(size=4 * n))[-n:]
    if rng.random() < 0.3:
        x = lfilter([1], [1, -rng.uniform(0.5, 0.99)], rng.normal(size=2 * n))[-n:]
    x = x / x.std()
    x = (x, np.exp(x), x**3 + x, np.tanh(2 * x), x + 2 * np.cos(2 * np.pi * np.arange(n) / samples))[
        int(rng.integers(5))
    ]
    if rng.random() < 0.3:
        return Known(x[:: max(1, round(0.4 / frequency))][:1500], 1.0, None, "linear, as a map")
    return Known(x, 1.0 / samples, period, "linear")


def scrambled_chaos(rng):
    """Spectrum and values of a chaotic flow, phases at random: linear by construction."""
    name = list(FLOWS)[int(rng.integers(len(FLOWS)))]
    known = flow(name, 0, int(rng.choice([12, 24])), int(rng.integers(200, 401)), rng)
    return known._replace(
        series=iaaft_surrogates(known.series, 1, int(rng.integers(1 << 30)))[0], name=f"scrambled {name}"
    )


@njit(cache=False)
def _driven_by_noise(kind, a, noise, samples, count, rng_values):
    """Van der Pol's oscillator (0), a Hopf normal form (1) and a forced, damped Duffing oscillator at rest in one well
    or in a regular motion (2), with white noise on the velocity."""
    out, y, sub = np.empty(count), np.array([1.0, 0.1]), 200 // samples
    period = 2.0 * np.pi
    h = period / (samples * sub)
    for i in range(-100 * samples, count):
        if i >= 0:
            out[i] = y[0]
        for j in range(sub):
            t = ((i + 200 * samples) * sub + j) * h
            x, v = y[0], y[1]
            if kind == 0:
                f0, f1 = v, a * (1.0 - x * x) * v - x
            elif kind == 1:
                r = x * x + v * v
                f0, f1 = (
                    a * x * (1.0 - r) - v * (1.0 + 0.5 * (1.0 - r)),
                    a * v * (1.0 - r) + x * (1.0 + 0.5 * (1.0 - r)),
                )
            else:
                f0, f1 = v, -0.25 * v + x - x**3 + 0.2 * a * np.cos(t)
            kick = noise * np.sqrt(h) * rng_values[(i + 100 * samples) * sub + j]
            y = y + h * np.array([f0, f1])
            y[1] += kick
    return out


def noisy_cycle(rng):
    kind, samples, periods = int(rng.integers(3)), int(rng.choice([12, 24, 48])), int(rng.integers(200, 401))
    a = rng.uniform(0.2, 3.0) if kind < 2 else rng.uniform(0.2, 1.2)
    noise = 10 ** rng.uniform(-2.5, -0.5)
    values = rng.normal(size=(periods + 100) * 200 + 400)
    x = _driven_by_noise(kind, a, noise, samples, periods * samples, values)
    period = 2 * np.pi if kind == 2 or rng.random() < 0.3 else None
    return Known(x, 2 * np.pi / samples, period, ("van der Pol", "Hopf", "Duffing")[kind] + " with noise")


def noisy_window(rng):
    """The logistic map in its periodic windows, driven by noise that leaves its exponent below -0.1 bits."""
    while True:
        rate, noise = rng.choice([rng.uniform(2.6, 3.56), rng.uniform(3.829, 3.846)]), 10 ** rng.uniform(-4, -1.3)
        points = int(rng.integers(300, 1500))
        x, out, total = 0.4, np.empty(points), 0.0
        for k in range(-300, points):
            x = min(max(rate * x * (1 - x) + noise * rng.normal(), 0.001), 0.999)
            if k >= 0:
                out[k] = x
                total += np.log2(abs(rate * (1 - 2 * x)) + 1e-12)
        if total / points < -0.1:
            return Known(out, 1.0, 1.0, f"logistic {rate:.3f} with noise")


@njit(cache=False)
def _forced_map(kind, a, b, x, theta, points):
    """x of a map forced at the golden mean, and its exponent across the forcing [nats]."""
    out, total, y = np.empty(points), 0.0, 0.0
    u, w = 1.0, 0.0
    for k in range(-1000, points):
        if k >= 0:
            out[k] = x if kind != 3 else np.sin(2.0 * np.pi * x)
        c = np.cos(2.0 * np.pi * theta)
        y, previous = 0.0 if kind != 4 else y, x
        if kind == 0:  # Grebogi, Ott, Pelikan & Yorke 1984
            slope, x = 2.0 * a * c / np.cosh(x) ** 2, 2.0 * a * np.tanh(x) * c
        elif kind == 1:  # Heagy & Hammel 1994; Prasad, Mehra & Ramaswamy 1998
            slope, x = a * (1.0 + b * c) * (1.0 - 2.0 * x), a * (1.0 + b * c) * x * (1.0 - x)
        elif kind == 2:  # cubic map, Venkatesan & Lakshmanan 2001
            slope, x = -a + 3.0 * x * x, b * c - a * x + x**3
        elif kind == 3:  # circle map, Ding, Grebogi & Ott 1989
            slope, x = (
                1.0 - a * np.cos(2.0 * np.pi * x),
                x + 0.2840 + b * c - a / (2.0 * np.pi) * np.sin(2.0 * np.pi * x),
            )
        else:  # Henon's map
            slope, x, y = 0.0, 1.0 - a * x * x + y + b * c, 0.3 * x
        if kind == 4:
            u, w = -2.0 * a * previous * u + w, 0.3 * u
            slope = np.hypot(u, w)
            u, w = u / slope, w / slope
        if k >= 0:
            total += np.log(abs(slope) + 1e-300)
        theta = (theta + GOLDEN) % 1.0
        if not abs(x) < 1e3:
            return out, np.inf
    return out, total / points


def strange_nonchaotic(rng):
    """Maps forced quasi-periodically, where they are strange and not chaotic or close to it."""
    while True:
        kind, points = int(rng.integers(5)), int(rng.choice([300, 600, 1500, 3000, 5000]))
        a, b = (
            (rng.uniform(1.05, 2.0), 0.0),
            (rng.uniform(2.8, 3.6), rng.uniform(0.02, 0.3)),
            (rng.uniform(1.6, 2.1), rng.uniform(0.1, 0.8)),
            (rng.uniform(0.8, 3.0), rng.uniform(0.1, 0.8)),
            (rng.uniform(0.9, 1.2), rng.uniform(0.02, 0.3)),
        )[kind]
        if kind == 1 and a * (1.0 + b) > 4.0:
            continue
        out, exponent = _forced_map(kind, a, b, 0.1 + 0.3 * rng.random(), rng.random(), max(points, 5000))
        if (exponent < -0.01 and kind == 0) or -0.15 < exponent < -0.01:
            name = ("GOPY", "logistic", "cubic", "circle", "Henon")[kind]
            return Known(out[:points], 1.0, 1.0, f"{name} {a:.2f} {b:.2f}, {points}, {exponent:.2f}")


def transient(rng):
    time, samples, period = _clock(rng)
    rate, frequency = 10 ** rng.uniform(-3, -1), rng.uniform(0.05, 0.5)
    decaying = rng.uniform(0.5, 5) * np.exp(-rate * time) * np.cos(2 * np.pi * frequency * time + 1)
    x = (
        np.cos(2 * np.pi * time)
        + rng.normal() * np.cos(4 * np.pi * time + 1)
        + decaying
        + rng.uniform(0, 0.3) * decaying**2
    )
    return Known(x + float(rng.choice([0, 1e-3, 1e-2])) * rng.normal(size=len(x)), 1.0 / samples, period, "transient")


REGULAR = {
    "periodic with noise": periodic_with_noise,
    "torus": torus,
    "torus with noise": torus_with_noise,
    "linear noise": linear_noise,
    "chaos, phases scrambled": scrambled_chaos,
    "cycle driven by noise": noisy_cycle,
    "periodic map driven by noise": noisy_window,
    "strange nonchaotic": strange_nonchaotic,
    "transient": transient,
}
