"""Chaos that may be a transient: where periodic motions beside it began so, or where only a kick led to it.

Transients of chaos end at random, after a mean time that changes little from a value to the next (Grebogi, Ott & Yorke,
Physica D 7 (1983) 181). Chaos counts when it has lasted TIMES as long as the longest transient known there.
"""

from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from functools import partial

from campaigns.machinery.plan import Job
from campaigns.motions.along import KICKED

TIMES = 4  # one transient in 55 lasts so many mean times


def outlasting(
    judged: Sequence[tuple[int, Job, Mapping[str, object]]], beside: Callable[[int], Iterable[int]]
) -> list[Job]:
    """The jobs whose chaos has to last longer to count; they go on until it has, or to the end of their budget.

    judged: number of the place, job and row of each run; beside: the places beside a place.
    """
    longest: Counter = Counter()
    for at, _, row in judged:
        if str(row.get("regime")).startswith("period"):
            longest[at] = max(longest[at], row["transient_periods"])
    found = []
    for at, job, row in judged:
        if row.get("regime") != "chaotic":
            continue
        known = max(longest[place] for place in (at, *beside(at)))
        least = job.periods if row.get("found_by") == KICKED else TIMES * known
        if row["periods"] < least:
            found.append(replace(job, going=partial(job.going, least=least)))
    return found
