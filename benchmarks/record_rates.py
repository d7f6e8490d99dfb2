"""How often is the verdict on a record of unknown origin (`python -m analysis`) wrong, or missing?

    python -m benchmarks.record_rates [--count N] [--seed N] [--only WORD ...] [--show] [--write]

N records of each regular kind of `benchmarks.known_records`, which nothing may call chaotic, and 300 cycles of every
coordinate of ten chaotic flows and of eq. (33), sampled 12, 24 and 48 times a cycle, and 24 times with white noise of 1
and 5 % of their standard deviation. Prints how many records of each kind got which word, and the processor time.
--only: kinds whose name has this word; --show: a line a record, with its evidence; --write: all kinds, into the page.
"""

import time
from collections import Counter

import numpy as np

from analysis import evidence_text
from benchmarks.known_flows import chaotic_flows, with_noise
from benchmarks.known_records import REGULAR
from benchmarks.shared import command_line
from benchmarks.write_tables import publish
from campaigns.time_series.study import judged, seen

CYCLES = 300
NOISE = {0.0: (12, 24, 48), 0.01: (24,), 0.05: (24,)}  # share of the standard deviation: samples a cycle
WORDS = "chaotic", "undecided", "quasi-periodic", "period-N", "transient"


def kinds(count, seed):
    """(name, iterator of records) of each kind."""
    for place, (name, generate) in enumerate(REGULAR.items()):
        yield name, (generate(np.random.default_rng([seed, place, number])) for number in range(count))
    for share, samplings in NOISE.items():
        rng = np.random.default_rng([seed, 99, round(1000 * share)])
        yield f"chaos, {share:.0%} noise", _flows(share, samplings, rng)


def _flows(share, samplings, rng):
    for known in chaotic_flows(CYCLES, samplings, rng):
        yield with_noise(known, share, rng) if share else known


def main():
    parser = command_line(__doc__)
    parser.add_argument("--count", type=int, default=30, help="records of each regular kind (default: 30)")
    parser.add_argument("--seed", type=int, default=2024)
    parser.add_argument("--only", nargs="*", default=[""], metavar="WORD")
    parser.add_argument("--show", action="store_true")
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args()
    if options.write and options.only != [""]:
        parser.error("--write: the table of the page has all kinds; leave --only out")
    rows = []
    for name, records in kinds(options.count, options.seed):
        if any(word in name for word in options.only):
            words = words_of(records, options.show)
            rows.append([name, str(words.total()), *(str(words[word]) for word in WORDS)])
            print(f"{name}: {', '.join(f'{count} {word}' for word, count in words.most_common())}", flush=True)
    publish("record_rates", rows, options.write)


def words_of(records, show):
    """How many of these records got which word."""
    words, start_s = Counter(), time.process_time()
    for known in records:
        x = np.asarray(known.series, dtype=float)
        view = seen(x, known.step, known.period)
        verdict, _ = judged(x, view)
        words["period-N" if verdict.period else verdict.regime] += 1
        if show:
            summary = f"{verdict.regime} ({view.kind}, {len(view.points)}) {evidence_text(verdict)}"
            print(f"  {known.name}: {summary}", flush=True)
    print(f"{(time.process_time() - start_s) / max(words.total(), 1):.2f} s of processor time a record")
    return words


if __name__ == "__main__":
    main()
