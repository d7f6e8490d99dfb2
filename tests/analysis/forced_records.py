"""Records of forced motions that are not chaotic, drawn at random: 100 to 400 forcing periods of 24 samples.

periodic         sums of harmonics of 1/N, N = 1 ... 8
quasi            one or two incommensurate tones, modulated and distorted together with the forcing
noisy-periodic   the first with noise of 0.1 % to 50 % of its size, white or red
noisy-quasi      the second with the same
ar2              a noisy damped oscillation without or with forcing, plain or through a distorting instrument
transient        a decay towards a periodic motion, with its square, clean or slightly noisy
"""

import numpy as np
from scipy.signal import lfilter

KINDS = ("periodic", "quasi", "noisy-periodic", "noisy-quasi", "ar2", "transient")
SAMPLES = 24


def record(kind, number):
    """One record of a kind; the same number gives the same record."""
    rng = np.random.default_rng([number, KINDS.index(kind)])
    time = np.arange(int(rng.integers(100, 401)) * SAMPLES + 1) / SAMPLES
    if kind in ("periodic", "noisy-periodic"):
        clean = _harmonics(time, int(rng.integers(1, 9)), rng)
    elif kind in ("quasi", "noisy-quasi"):
        clean = _tones(time, rng)
    elif kind == "ar2":
        return _autoregressive(time, rng)
    else:
        return _decay(time, rng)
    if kind.startswith("noisy"):
        return clean + 10 ** rng.uniform(-3, -0.3) * clean.std() * _noise(len(time), rng)
    return clean


def _harmonics(time, period, rng):
    tones = [j / period for j in range(1, 4 * period)]
    return sum(_tone(time, f, rng.normal() / (1 + 2 * f), rng) for f in tones)


def _tone(time, frequency, amplitude, rng):
    return amplitude * np.cos(2 * np.pi * frequency * time + rng.uniform(0, 2 * np.pi))


def _tones(time, rng):
    first = rng.uniform(0.02, 0.5)
    tones = [first, np.sqrt(0.7 * first)][: int(rng.integers(1, 3))]
    angles = [2 * np.pi * f * time + 0.3 * rng.normal() * np.sin(2 * np.pi * time) for f in tones]
    x = np.cos(2 * np.pi * time) + sum(rng.uniform(0.3, 1) * np.cos(angle + 1) for angle in angles)
    x = x + 0.4 * rng.normal() * x**2 * np.cos(angles[0])
    return x + 0.3 * rng.normal() * np.exp(np.sin(angles[0])) * np.cos(np.pi * time * int(rng.integers(1, 3)))


def _noise(samples, rng):
    white = rng.normal(size=samples)
    if rng.random() < 0.5:
        return white
    memory = rng.uniform(0.5, 0.99)
    return lfilter([np.sqrt(1 - memory**2)], [1, -memory], white)


def _autoregressive(time, rng):
    frequency = 10 ** rng.uniform(-1.5, 0.3) / SAMPLES
    radius = np.exp(-(10 ** rng.uniform(-3, -0.3)) * 5 * frequency)
    driven = rng.normal(size=len(time) + int(20 / (1 - radius)))
    x = lfilter([1], [1, -2 * radius * np.cos(2 * np.pi * frequency), radius**2], driven)[-len(time) :]
    x = x / x.std()
    return (x, np.exp(x), x**3 + x, x + 2 * np.cos(2 * np.pi * time))[int(rng.integers(4))]


def _decay(time, rng):
    rate, frequency = 10 ** rng.uniform(-3, -1), rng.uniform(0.05, 0.5)
    away = rng.uniform(0.5, 5) * np.exp(-rate * time) * np.cos(2 * np.pi * frequency * time + 1)
    noise = float(rng.choice([0, 1e-3, 1e-2])) * rng.normal(size=len(time))
    return _harmonics(time, 1, rng) + away + rng.uniform(0, 0.3) * away**2 + noise
