"""How often is the verdict on a record of unknown origin (`python -m analysis`) wrong, or missing?

    python -m benchmarks.record_rates [--count N] [--seed N] [--only WORD ...] [--show]

N records of each regular kind of `benchmarks.known_records`, which nothing may call chaotic, and 300 cycles of every
coordinate of ten chaotic flows and of eq. (33), sampled 12, 24 and 48 times a cycle, and 24 times with white noise of 1
and 5 % of their standard deviation. Prints a row a kind: how many got which word, seconds of processor time a record.
--only: kinds whose name has this word; --show: a line a record, with its evidence.
"""

import argparse
import time
from collections import Counter

import numpy as np

from analysis import evidence_text
from benchmarks.known_flows import chaotic_flows, with_noise
from benchmarks.known_records import REGULAR
from campaigns.time_series.study import judged, least_tolerance, seen

CYCLES = 300
NOISE = {0.0: (12, 24, 48), 0.01: (24,), 0.05: (24,)}  # share of the standard deviation: samples a cycle
WORDS = "chaotic", "undecided", "quasi-periodic", "period", "transient"


def kinds(count, seed):
    """(name, iterator of records) of each kind."""
    for place, (name, make) in enumerate(REGULAR.items()):
        yield name, (make(np.random.default_rng([seed, place, number])) for number in range(count))
    for share, samplings in NOISE.items():
        rng = np.random.default_rng([seed, 99, round(1000 * share)])
        yield f"chaos, {share:.0%} noise", _flows(share, samplings, rng)


def _flows(share, samplings, rng):
    for known in chaotic_flows(CYCLES, samplings, rng):
        yield with_noise(known, share, rng) if share else known


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--count", type=int, default=30, help="records of each regular kind (default: 30)")
    parser.add_argument("--seed", type=int, default=2024)
    parser.add_argument("--only", nargs="*", default=[""], metavar="WORD")
    parser.add_argument("--show", action="store_true")
    asked = parser.parse_args()
    print(f"{'':32s}" + "".join(f"{word:>15s}" for word in WORDS) + f"{'s a record':>12s}")
    for name, records in kinds(asked.count, asked.seed):
        if not any(word in name for word in asked.only):
            continue
        words, spent = Counter(), 0.0
        for known in records:
            start = time.process_time()
            x = np.asarray(known.series, dtype=float)
            try:
                view = seen(x, known.step, known.period)
                verdict = judged(x, view, least_tolerance(view), 0)
            except ValueError as fault:
                print(known.name, fault)
                raise
            spent += time.process_time() - start
            words[verdict.regime.split("-")[0] if verdict.period else verdict.regime] += 1
            if asked.show:
                print(
                    f"  {known.name}: {verdict.regime} ({view.kind}, {len(view.points)}) {evidence_text(verdict)}",
                    flush=True,
                )
        row = "".join(f"{words[word]:15d}" for word in WORDS)
        print(f"{name:32s}{row}{spent / max(sum(words.values()), 1):12.2f}", flush=True)


if __name__ == "__main__":
    main()
