"""Chaos that may be a transient, because periodic motions beside it began as chaos, or because only a kick led to it.

Transients of chaos end at random, after a mean time that changes little from a value to the next (Grebogi, Ott & Yorke,
Physica D 7 (1983) 181). Chaos counts when it has lasted TIMES as long as the longest transient known beside it; that of
a kick, when its budget is spent.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from functools import partial

from campaigns.machinery.plan import Job

TIMES = 4  # one transient in 55 lasts so many mean times


def outlasting(
    jobs: Sequence[Job], rows: Mapping[str, Mapping], neighbours: Callable[[int], Iterable[int]]
) -> list[Job]:
    """The jobs whose chaos has not lasted long enough; they go on until it has.

    jobs: by number of the place.
    rows: of their runs, by key.
    neighbours: the places beside a place.
    """
    transients: dict[int, float] = {}  # of the places whose motion is periodic
    chaotic: dict[int, Mapping] = {}  # rows of the places whose motion is chaotic
    for place, job in enumerate(jobs):
        row = rows.get(job.key, {})
        regime = str(row.get("regime"))
        if regime.startswith("period"):
            transients[place] = row["transient_periods"]
        elif regime == "chaotic":
            chaotic[place] = row
    late = []
    for place, row in chaotic.items():
        least = TIMES * max((transients.get(neighbour, 0) for neighbour in neighbours(place)), default=0)
        if row["periods"] < least:
            late.append(as_long_as(jobs[place], least))
    return late


def as_long_as(job: Job, periods: float) -> Job:
    """The job whose chaos counts after so many wave periods only."""
    return replace(job, going=partial(job.going, least=periods)) if job.going else job
