"""How often is the verdict on a simulated motion (`analysis.motion_regime`) wrong, late, or missing?

    python -m benchmarks.verdict_rates [--quick]

Motions of which a much longer record of their own says what they are: eq. (33) over frequency, force and starts,
integrated exactly; tori and locked motions of a forced van der Pol oscillator; the Henon map; the strange nonchaotic
attractor of Grebogi, Ott, Pelikan & Yorke. Prints a row a kind: motions, words, false words, periods that were needed,
and the scatter of (estimate - long value)/error of the exponent over 200 and 500 periods.
"""

import argparse
from collections import Counter
from dataclasses import astuple, replace

import numpy as np
from numba import njit

from analysis import motion_regime, tangent_lyapunov
from analysis.oscillator import SnapOscillator
from analysis.oscillator.growth import random_starts
from analysis.oscillator.strobing import growth_over_values

BUDGET, LONG = 1575, 20_000


def snap_motions(count, periods):
    """(strobed, growth in nats) of eq. (33) at random frequencies, forces and starts."""
    random = np.random.default_rng(1)
    for i, start in enumerate(random_starts(count, 2)):
        oscillator = replace(SnapOscillator(), frequency=random.uniform(0.9, 1.6), force=random.uniform(0.8, 2.0))
        parameters = np.array([astuple(oscillator)])
        sums, section, _, _ = growth_over_values(parameters, start[None], 0, periods, 1, periods)
        if np.isfinite(section).all():
            yield f"{i}", section[0, 0], sums[0, 0, :, 0]


@njit(cache=False)
def _van_der_pol(force, frequency, periods, steps):
    """Strobed states and growth of x'' - 5 (1 - x^2) x' + x = force cos(frequency t), by Runge and Kutta's method."""
    y, out, growth = np.array([2.0, 0.0, 1.0, 0.0]), np.empty((periods, 2)), np.empty(periods)
    h = 2.0 * np.pi / frequency / steps
    for p in range(periods):
        out[p] = y[:2]
        for k in range(steps):
            total, stage = np.zeros(4), y.copy()
            for j in range(4):
                t = (k + (0.0, 0.5, 0.5, 1.0)[j]) * h
                x, v, dx, dv = stage
                slope = np.array(
                    [
                        v,
                        5.0 * (1.0 - x * x) * v - x + force * np.cos(frequency * t),
                        dv,
                        (-10.0 * x * v - 1.0) * dx + 5.0 * (1.0 - x * x) * dv,
                    ]
                )
                total += slope * (1.0, 2.0, 2.0, 1.0)[j] / 6.0
                if j < 3:
                    stage = y + h * (0.5, 0.5, 1.0)[j] * slope
            y = y + h * total
        length = np.hypot(y[2], y[3])
        growth[p] = np.log(length)
        y[2:] /= length
    return out, growth


def van_der_pol_motions(count, periods):
    """(strobed, growth) of tori and locked motions: the force is too weak for chaos."""
    random = np.random.default_rng(3)
    for i in range(count):
        yield f"{i}", *_van_der_pol(random.uniform(0.1, 1.0), random.uniform(0.8, 3.0), periods, 300)


def nonchaotic_motions(count, periods):
    """x' = 2 sigma tanh(x) cos(2 pi theta), theta' = theta + golden mean: strange, and not chaotic, for sigma > 1."""
    random = np.random.default_rng(5)
    for i in range(count):
        x, theta, sigma = 0.5, random.random(), random.uniform(1.1, 2.0)
        out, growth = np.empty((periods, 3)), np.empty(periods)
        for k in range(periods):
            phase = np.cos(2.0 * np.pi * theta)
            out[k] = x, phase, np.sin(2.0 * np.pi * theta)
            # a shift of theta neither grows nor shrinks: the largest exponent is 0, that of x is negative
            growth[k] = 0.0
            x, theta = 2.0 * sigma * np.tanh(x) * phase, (theta + 0.5 * (np.sqrt(5.0) - 1.0)) % 1.0
        yield f"{i}", out, growth


def henon_motions(count, periods):
    """(strobed, growth) of the Henon map, b = 0.3, over a: periods and chaos."""
    for i, a in enumerate(np.linspace(1.0, 1.4, count)):
        (x, y), (u, w) = (0.1, 0.1), (1.0, 0.0)
        out, growth = np.empty((periods, 2)), np.empty(periods)
        for k in range(periods):
            out[k] = x, y
            u, w = -2.0 * a * x * u + w, 0.3 * u
            length = np.hypot(u, w)
            growth[k], u, w = np.log(length), u / length, w / length
            x, y = 1.0 - a * x * x + y, 0.3 * x
        yield f"{i}", out, growth


def truth(strobed, growth, scale):
    """What the end of a long record is: "periodic", "torus" or "chaotic"; "" where it does not say."""
    half = len(strobed) // 2
    last = strobed[half:]
    for n in range(1, 65):
        if np.all(np.abs(last[n:][-1000:] - last[:-n][-1000:]) < 1e-3 * scale):
            return "periodic"
    (exponent,) = tangent_lyapunov(growth[half:])
    if exponent.value > max(5.0 * exponent.error, 0.005):
        return "chaotic"
    return "torus" if abs(exponent.value) + 3.0 * exponent.error < 0.005 else ""


def judged(strobed, growth, scale):
    """The verdict on the first BUDGET periods, with perturbations from the first look without a period on."""
    verdict = motion_regime(strobed[: BUDGET + 1], None, scale=scale, tolerance=0.01)
    if verdict.period is None:
        known = np.where(np.arange(BUDGET) < 90, np.nan, growth[:BUDGET])
        verdict = motion_regime(strobed[: BUDGET + 1], known, scale=scale, tolerance=0.01)
    return verdict


def scatter(growth, length):
    """(value of a stretch - that of the whole)/error, for stretches of that length."""
    (whole,) = tangent_lyapunov(growth[1000:])
    stretches = [tangent_lyapunov(growth[at : at + length])[0] for at in range(1000, len(growth) - length, length)]
    return [(one.value - whole.value) / one.error for one in stretches[:40]]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--quick", action="store_true", help="a tenth of the motions")
    share = 0.1 if parser.parse_args().quick else 1.0
    kinds = {
        "eq. (33)": (snap_motions, 400),
        "van der Pol": (van_der_pol_motions, 150),
        "Henon map": (henon_motions, 100),
        "strange nonchaotic": (nonchaotic_motions, 50),
    }
    for name, (make, count) in kinds.items():
        table, needed, z = Counter(), [], {200: [], 500: []}
        for _, strobed, growth in make(int(share * count), LONG):
            scale = np.maximum(np.ptp(strobed, axis=0).max(), 1e-9)
            what, verdict = truth(strobed, growth, scale), judged(strobed, growth, scale)
            word = "periodic" if verdict.period else verdict.regime
            table[what or "not known", word] += 1
            needed.append(verdict.transient + verdict.points - 1)
            if what == "chaotic":
                for length, found in z.items():
                    found += scatter(growth, length)
        print(f"{name}: {np.mean(needed):.0f} periods on average")
        for (what, word), times in sorted(table.items()):
            print(f"    {what:<10} called {word:<15} {times}")
        for length, found in z.items():
            if found:
                print(f"    z over {length} periods: standard deviation {np.std(found):.2f} ({len(found)})")


if __name__ == "__main__":
    main()
