"""Exponents from one and the same series: ours beside nolds, error and wall time.

    python -m benchmarks.wolf_speed [--samples N] [--noise SHARE] [--systems NAME ...] [--setting]

nolds comes with the extra `bench` (0.6.3 cannot be imported by Python 3.11). It has no method of Wolf's. It is given
our delay, dimension and Theiler window, and a fitted stretch of one mean period (five steps for maps).
Ours is the whole estimate (embedding, noise level, grid of settings, error). `--setting` times one setting of Wolf's
method on 100,000 samples. Ours is compiled before it is timed; wall clock, one process.
"""

import time
import warnings
from functools import partial

import numpy as np

from analysis.divergence import rosenstein_lyapunov
from analysis.embedding import choose_delay, choose_embedding, noise_level
from analysis.wolf_pairs import wolf_run
from analysis.wolf_plateau import wolf_lyapunov
from benchmarks.shared import command_line, seconds
from tests.analysis.systems import TRUTH, record

OURS = {"Wolf plateau": wolf_lyapunov, "Rosenstein": rosenstein_lyapunov}


def theirs(series, step):
    """{label: function() -> nats/time} of nolds, none where it is not installed."""
    try:
        import nolds
    except ImportError:
        return {}
    embedding = choose_embedding(series)
    window = round(embedding.mean_period)
    settings = {"emb_dim": embedding.dimension, "lag": embedding.lag, "trajectory_len": max(5, window), "fit": "poly"}
    return {
        "nolds lyap_r": partial(nolds.lyap_r, series, tau=step, min_tsep=window, **settings),
        "nolds lyap_e": lambda: nolds.lyap_e(series, min_tsep=window, tau=step)[0],
    }


def compare(names, samples, noise):
    """One line per system and method: value, error, wall time."""
    for method in OURS.values():
        method(*record("henon", 1000))
    for name in names:
        series, step = record(name, samples, noise)
        truth = TRUTH[name]
        print(f"\n{name}: {samples} samples, noise {noise:g}, truth {truth:.4f} nats/time")
        calls = {label: partial(method, series, step) for label, method in OURS.items()} | theirs(series, step)
        for label, call in calls.items():
            start = time.perf_counter()
            try:
                estimate, fault = call(), ""
            except Exception as error:
                estimate, fault = np.nan, f"{type(error).__name__}: {error}"
            spent, value = time.perf_counter() - start, float(getattr(estimate, "value", estimate))
            error, reason = getattr(estimate, "error", np.nan), getattr(estimate, "reason", fault)
            off = f"{value:+10.1e}"
            if truth:
                off = f"{100 * (value / truth - 1):+8.1f} %"
            print(f"  {label:22s} {value:9.4f} +- {error:7.4f}  off {off}  {spent:7.2f} s  {reason[:70]}", flush=True)


def settings(samples=100_000):
    """Seconds of one setting of Wolf's method, evolution time half a mean period."""
    for name in ("lorenz", "rossler", "pendulum", "henon"):
        series, step = record(name, samples)
        delay = choose_delay(series)
        noise, evolution = noise_level(series, delay.delay), max(1, round(0.5 * delay.mean_period))
        run = partial(wolf_run, series, step, delay.delay, 4, evolution, round(delay.mean_period), noise)
        run()
        times = [seconds(run) for _ in range(3)]
        print(f"{name:10s} {samples} samples, every {evolution}: {np.median(times):.3f} s a setting")


def main():
    parser = command_line(__doc__)
    parser.add_argument("--samples", type=int, default=5000)
    parser.add_argument("--noise", type=float, default=0.0)
    parser.add_argument("--systems", nargs="+", choices=TRUTH, default=list(TRUTH))
    parser.add_argument("--setting", action="store_true", help="time one setting on 100,000 samples instead")
    options = parser.parse_args()
    warnings.filterwarnings("ignore")
    if options.setting:
        settings()
    else:
        compare(options.systems, options.samples, options.noise)


if __name__ == "__main__":
    main()
