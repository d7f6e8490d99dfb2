"""Chaotic flows, sampled: ten of the textbooks' and eq. (33), every coordinate, with and without noise."""

from collections import namedtuple

import numpy as np
from numba import njit

from analysis.oscillator import SnapOscillator, snap_motion

# series (n,), sampling step, forcing period (None: seen at maxima or sample by sample), what it is
Known = namedtuple("Known", "series step period name")
# start; forcing period, or 0; mean time between the maxima of a coordinate where there is none
FLOWS = {
    "Lorenz": ((1.0, 1.0, 20.0), 0.0),
    "Rossler": ((1.0, 1.0, 0.0), 0.0),
    "Chen": ((1.0, 1.0, 20.0), 0.0),
    "Rucklidge": ((1.0, 0.0, 4.5), 0.0),
    "Moore-Spiegel": ((0.1, 0.0, 0.0), 0.0),
    "Duffing": ((0.1, 0.1), 2.0 * np.pi),
    "Ueda": ((2.5, 0.0), 2.0 * np.pi),
    "pendulum": ((0.1, 0.0), 2.0 * np.pi / 0.7),
    "van der Pol-Duffing": ((1.0, 0.5), 2.0 * np.pi / 4.0),
    "van der Pol": ((-1.9, 0.0), 2.0 * np.pi / 1.788),
}


@njit(cache=True)
def _rate(flow, t, y, out):
    """Slopes of the flow of that number in FLOWS; parameters of Sprott, Chaos and Time-Series Analysis (2003)."""
    if flow == 0:
        out[:] = 10.0 * (y[1] - y[0]), y[0] * (28.0 - y[2]) - y[1], y[0] * y[1] - 8.0 / 3.0 * y[2]
    elif flow == 1:
        out[:] = -y[1] - y[2], y[0] + 0.2 * y[1], 0.2 + y[2] * (y[0] - 5.7)
    elif flow == 2:
        out[:] = 35.0 * (y[1] - y[0]), -7.0 * y[0] - y[0] * y[2] + 28.0 * y[1], y[0] * y[1] - 3.0 * y[2]
    elif flow == 3:
        out[:] = -2.0 * y[0] + 6.7 * y[1] - y[1] * y[2], y[0], -y[2] + y[1] ** 2
    elif flow == 4:
        out[:] = y[1], y[2], -y[2] - (20.0 * y[0] ** 2 - 14.0) * y[1] - 6.0 * y[0]
    else:
        x, v = y[0], y[1]
        if flow == 5:
            force = -0.25 * v + x - x**3 + 0.4 * np.cos(t)
        elif flow == 6:
            force = -0.05 * v - x**3 + 7.5 * np.cos(t)
        elif flow == 7:
            force = -0.05 * v - np.sin(x) + 0.6 * np.sin(0.7 * t)
        elif flow == 8:
            force = 0.2 * (1.0 - x * x) * v - x**3 + 17.0 * np.cos(4.0 * t)
        else:
            force = 3.0 * (1.0 - x * x) * v - x + 5.0 * np.sin(1.788 * t)
        out[:] = v, force


@njit(cache=True)
def march(flow, y, step, substeps, skip, samples):
    """States (samples, d) after `skip` samples, by Runge and Kutta's method."""
    out, h, y = np.empty((samples, y.size)), step / substeps, y.copy()
    k1, k2, k3, k4 = np.empty(y.size), np.empty(y.size), np.empty(y.size), np.empty(y.size)
    for i in range(skip + samples):
        if i >= skip:
            out[i - skip] = y
        for j in range(substeps):
            t = i * step + j * h
            _rate(flow, t, y, k1)
            _rate(flow, t + 0.5 * h, y + 0.5 * h * k1, k2)
            _rate(flow, t + 0.5 * h, y + 0.5 * h * k2, k3)
            _rate(flow, t + h, y + h * k3, k4)
            y = y + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
    return out


def flow(name, coordinate, samples_a_cycle, cycles, rng):
    """One coordinate of a flow of FLOWS, its start drawn."""
    start, period = FLOWS[name]
    number, cycle = list(FLOWS).index(name), period
    start = np.array(start) + 0.01 * rng.normal(size=len(start))
    if not period:
        scale = {"Lorenz": 0.75, "Rossler": 6.0, "Chen": 0.35, "Rucklidge": 4.0, "Moore-Spiegel": 2.0}[name]
        fine = march(number, start, scale / 200, 1, 20_000, 100_000)[:, coordinate]
        cycle = scale / 200 * len(fine) / np.sum((fine[1:-1] > fine[:-2]) & (fine[1:-1] >= fine[2:]))
    step = cycle / samples_a_cycle
    skip = samples_a_cycle * (200 + int(rng.integers(50)))
    substeps = max(1, int(np.ceil(200 / samples_a_cycle)))
    y = march(number, start, step, substeps, skip, samples_a_cycle * cycles + 1)[:, coordinate]
    y = np.sin(y) if name == "pendulum" and coordinate == 0 else y
    return Known(y, step, period or None, f"{name} {coordinate}, {samples_a_cycle}")


def snapping(samples_a_cycle, cycles, rng):
    """Displacement of eq. (33) at the paper's parameters: chaotic, 0.509 bits per period."""
    oscillator = SnapOscillator()
    y = snap_motion(oscillator, (0.68 + 0.01 * rng.random(), 0.0), cycles + 300, samples_a_cycle).displacement
    return Known(
        y[300 * samples_a_cycle :],
        oscillator.period / samples_a_cycle,
        oscillator.period,
        f"eq. (33), {samples_a_cycle}",
    )


def with_noise(known, share, rng):
    x = known.series
    return known._replace(series=x + share * x.std() * rng.normal(size=len(x)))


def chaotic_flows(cycles, samplings, rng):
    """Every flow and coordinate, sampled so many times a cycle."""
    for name in FLOWS:
        for coordinate in range(len(FLOWS[name][0])):
            for samples in samplings:
                yield flow(name, coordinate, samples, cycles, rng)
    for samples in samplings:
        yield snapping(samples, cycles, rng)
