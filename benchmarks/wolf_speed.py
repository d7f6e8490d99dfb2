"""Exponents from one and the same series: ours beside nolds, error and wall time.

    python -m benchmarks.wolf_speed [--samples N] [--noise SHARE] [--systems NAME ...] [--setting]

nolds comes with the extra `bench` (0.6.3 cannot be imported by Python 3.11). It has no method of Wolf's. It is given
our delay, dimension and Theiler window, and a fitted stretch of one mean period (five steps for maps).
Ours is the whole estimate (embedding, noise level, grid of settings, error). `--setting` times one setting of Wolf's
method on 100,000 samples. Every function runs once before it is timed; wall clock, one process.
"""

import argparse
import time
import warnings
from functools import partial

import numpy as np

from analysis.divergence import kantz_lyapunov, rosenstein_lyapunov
from analysis.embedding import choose_delay, choose_embedding, noise_level
from analysis.wolf_pairs import wolf_run
from analysis.wolf_plateau import wolf_lyapunov
from benchmarks.shared import seconds
from tests.analysis.systems import TRUTH, record


def others():
    """{label: function(series, step, embedding) -> nats/time} of the packages that are installed."""
    found = {}
    try:
        import nolds

        def rosenstein(x, step, e):
            how = {"emb_dim": e.dimension, "lag": e.lag, "min_tsep": round(e.mean_period), "trajectory_len": stretch(e)}
            return nolds.lyap_r(x, tau=step, fit="poly", **how)

        found["nolds lyap_r"] = rosenstein
        found["nolds lyap_e"] = lambda x, step, e: nolds.lyap_e(x, min_tsep=round(e.mean_period), tau=step)[0]
    except ImportError:
        print("nolds is not installed: pip install -c constraints.txt '.[bench]'")
    return found


def stretch(embedding):
    """Samples over which the others fit their line."""
    return max(5, round(embedding.mean_period))


def compare(names, samples, noise):
    """One line per system and method: value, error, wall time."""
    ours = {"Wolf plateau": wolf_lyapunov, "Rosenstein": rosenstein_lyapunov, "Kantz": kantz_lyapunov}
    theirs = others()
    for name in names:
        series, step = record(name, samples, noise)
        embedding = choose_embedding(series)
        print(f"\n{name}: {samples} samples, noise {noise:g}, truth {TRUTH[name]:.4f} nats/time")
        for label, method in ours.items():
            method(series, step)
            began = time.perf_counter()
            found = method(series, step)
            line(label, found.value, found.error, TRUTH[name], time.perf_counter() - began, found.reason)
        for label, method in theirs.items():
            began = time.perf_counter()
            try:
                value, reason = float(method(series, step, embedding)), ""
            except Exception as fault:
                value, reason = np.nan, f"{type(fault).__name__}: {fault}"
            line(label, value, np.nan, TRUTH[name], time.perf_counter() - began, reason)


def line(label, value, error, truth, seconds, reason):
    """Print one result."""
    off = f"{100 * (value / truth - 1):+8.1f} %" if truth else f"{value:+10.1e}"
    print(f"  {label:22s} {value:9.4f} +- {error:7.4f}  off {off}  {seconds:7.2f} s  {reason[:70]}", flush=True)


def settings(samples=100_000):
    """Seconds of one setting of Wolf's method, evolution time half a mean period."""
    for name in ("lorenz", "rossler", "pendulum", "henon"):
        series, step = record(name, samples, 0.0)
        delay = choose_delay(series)
        noise, evolution = noise_level(series, delay.delay), max(1, round(0.5 * delay.mean_period))
        one = partial(wolf_run, series, step, delay.delay, 4, evolution, round(delay.mean_period), noise)
        one()
        times = [seconds(one) for _ in range(3)]
        print(f"{name:10s} {samples} samples, every {evolution}: {np.median(times):.3f} s a setting")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--samples", type=int, default=5000)
    parser.add_argument("--noise", type=float, default=0.0)
    parser.add_argument("--systems", nargs="+", choices=TRUTH, default=list(TRUTH))
    parser.add_argument("--setting", action="store_true", help="time one setting on 100,000 samples instead")
    arguments = parser.parse_args()
    warnings.filterwarnings("ignore")
    if arguments.setting:
        settings()
    else:
        compare(arguments.systems, arguments.samples, arguments.noise)


if __name__ == "__main__":
    main()
