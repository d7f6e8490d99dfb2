"""How often is a start put to the wrong motion, and after how many periods (`analysis.settled`, `joins`, `grouped`)?

    python -m benchmarks.motion_rates [--starts N]

Forced systems with motions side by side: eq. (33), Duffing's two wells, Ueda's oscillator, the driven pendulum, the
Henon map. The truth is that of 3000 periods: the period of the last 600, within 1e-4, and which of them lie on each
other. Starts run one after the other, as a campaign runs them: every period, has it joined a known motion; every 15
periods from 60 on, has it settled; after 400 periods it is unsettled.
"""

import argparse
from collections import Counter
from dataclasses import replace

import numpy as np
from numba import njit

from analysis import detect_period, distance, joins, settled
from analysis.motions import APART
from analysis.oscillator import SnapOscillator, snap_motion

LONG, BUDGET, SAMPLES = 3000, 400, 64
DUFFING, UEDA, PENDULUM = range(3)
SYSTEMS = {  # law, damping, force, frequency; starts within
    "Duffing, force .22": (DUFFING, 0.25, 0.22, 1.0, 1.5),
    "Duffing, force .26": (DUFFING, 0.25, 0.26, 1.0, 1.5),
    "Duffing, force .30": (DUFFING, 0.25, 0.30, 1.0, 1.5),
    "Ueda, force .2": (UEDA, 0.08, 0.2, 1.0, 2.0),
    "Ueda, force 7": (UEDA, 0.2, 7.0, 1.0, 4.0),
    "pendulum, force 1.66": (PENDULUM, 0.2, 1.66, 1.0, 3.0),
    "pendulum, force .6": (PENDULUM, 0.05, 0.6, 0.7, 3.0),
}


@njit(cache=False)
def _force(law, damping, force, frequency, t, x, v):
    spring = x - x**3 if law == DUFFING else -(x**3) if law == UEDA else -np.sin(x)
    return spring - damping * v + force * np.cos(frequency * t)


@njit(cache=False)
def _flow(law, damping, force, frequency, x, v, periods):
    """(periods, SAMPLES, 2): x and v within each period, by the classical Runge-Kutta method."""
    out, h = np.empty((periods, SAMPLES, 2)), 2.0 * np.pi / frequency / SAMPLES
    for k in range(periods):
        for i in range(SAMPLES):
            out[k, i, 0], out[k, i, 1] = x, v
            t = i * h
            a1 = _force(law, damping, force, frequency, t, x, v)
            a2 = _force(law, damping, force, frequency, t + h / 2, x + h / 2 * v, v + h / 2 * a1)
            a3 = _force(law, damping, force, frequency, t + h / 2, x + h / 2 * v + h * h / 4 * a1, v + h / 2 * a2)
            a4 = _force(law, damping, force, frequency, t + h, x + h * v + h * h / 2 * a2, v + h * a3)
            x, v = x + h * v + h * h / 6 * (a1 + a2 + a3), v + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4)
    return out


def henon(a, b, x, y):
    out = np.empty((LONG, 1, 2))
    for k in range(LONG):
        out[k, 0] = x, y
        x, y = 1.0 - a * x * x + y, b * x
        if abs(x) > 10.0:
            return None
    return out


def runs(starts):
    """name, list of records (LONG, samples, d) with the period's first sample at the strobe."""
    random = np.random.default_rng(1)
    for name, (law, damping, force, frequency, box) in SYSTEMS.items():
        begin = random.uniform(-box, box, (starts, 2))
        flows = [_flow(law, damping, force, frequency, x, v, LONG) for x, v in begin]
        if law == PENDULUM:
            flows = [np.stack([np.cos(f[..., 0]), np.sin(f[..., 0]), f[..., 1]], axis=-1) for f in flows]
        yield name, flows
    for frequency, force in ((1.14, 1.4), (1.0, 1.2), (1.3, 1.6), (1.5, 1.0)):
        oscillator = replace(SnapOscillator(), frequency=frequency, force=force)
        begin = random.uniform((-60.0, -25.0), (20.0, 25.0), (starts, 2))
        motions = (snap_motion(oscillator, start, LONG, SAMPLES) for start in begin)
        records = (np.column_stack([m.displacement, m.velocity])[:-1] for m in motions)
        yield f"eq. (33), {frequency}, {force}", [r.reshape(LONG, SAMPLES, 2) for r in records]
    for a, b in ((1.4, 0.3), (1.0, 0.54), (0.98, 0.43)):
        found = (henon(a, b, *start) for start in random.uniform(-1.0, 1.0, (4 * starts, 2)))
        yield f"Henon, {a}, {b}", [f for f in found if f is not None][:starts]


def record(flow):
    """Strobed states, least and largest of the first coordinate and of the last, and the size within the period."""
    measures = np.hstack([flow.min(axis=1), flow.max(axis=1)])
    return flow[:, 0], measures[:-1], np.maximum(np.ptp(flow[-100:], axis=(0, 1)), 1e-6)


def truth(states, scale):
    """Labels of the runs by their last 600 states, and the period of each label (None: aperiodic)."""
    from scipy.spatial import cKDTree

    labels, motions = [], []
    for x in states:
        late = x[-600:] / scale
        period = detect_period(late, 64, 1e-4, np.ones(len(scale))).period
        same = (
            label
            for label, (other, tree, spacing) in enumerate(motions)
            if period == other and np.median(tree.query(late)[0]) <= max(3.0 * spacing, 1e-3)
        )
        labels.append(next(same, len(motions)))
        if labels[-1] == len(motions):
            tree = cKDTree(late)
            motions.append((period, tree, 0.0 if period else np.median(tree.query(late, k=2)[0][:, 1])))
    return np.array(labels), [m[0] for m in motions]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--starts", type=int, default=60)
    starts = parser.parse_args().starts
    print("system | motions (starts) | found | wrong joined | wrong settled | unsettled | periods to join, settle")
    for name, flows in runs(starts):
        records = [record(flow) for flow in flows]
        scale = np.median([r[2] for r in records], axis=0)
        labels, periods = truth([r[0] for r in records], scale)
        known, of, counts, took = [], [], Counter(), {"joined": [], "settled": []}
        for (x, e, _), label in zip(records, labels, strict=True):
            how, n = "unsettled", 0
            for n in range(10, BUDGET):
                index = joins(x[: n + 1], e[:n], known)
                if index is not None:
                    how = "joined"
                    break
                if n >= 60 and n % 15 == 0 and (new := settled(x[: n + 1], e[:n], scale=scale)) is not None:
                    how = "settled"
                    index = min(range(len(known)), key=lambda i: distance(new, known[i]), default=None)
                    if index is None or distance(new, known[index]) > APART:
                        index = len(known)
                        known.append(new)
                        of.append(label)
                    break
            if how in took:
                took[how].append(n)
                how += " right" if of[index] == label and known[index].period == periods[label] else " wrong"
            counts[how] += 1
        sizes = ", ".join(f"{periods[k] or 'chaos'} ({np.sum(labels == k)})" for k in range(len(periods)))
        found = ", ".join(str(m.period or "chaos") for m in known)
        medians = ", ".join(f"{np.median(v):.0f}" if v else "-" for v in took.values())
        rates = " | ".join(str(counts[key]) for key in ("joined wrong", "settled wrong", "unsettled"))
        print(f"{name} | {sizes} | {found} | {rates} | {medians}", flush=True)


if __name__ == "__main__":
    main()
