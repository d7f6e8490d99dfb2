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


def outlasting(jobs: Sequence[Job], rows: Mapping[str, Mapping], beside: Callable[[int], Iterable[int]]) -> list[Job]:
    """The jobs whose chaos has not lasted long enough; they go on until it has.

    jobs: by number of the place; rows: of their runs, by key; beside: the places beside a place.
    """
    regimes = {at: str(rows[job.key].get("regime")) for at, job in enumerate(jobs) if job.key in rows}
    settled = {at: rows[jobs[at].key]["transient_periods"] for at in regimes if regimes[at].startswith("period")}
    found = []
    for at in regimes:
        least = TIMES * max((settled.get(place, 0) for place in beside(at)), default=0)
        if regimes[at] == "chaotic" and rows[jobs[at].key]["periods"] < least:
            found.append(as_long_as(jobs[at], least))
    return found


def as_long_as(job: Job, periods: float) -> Job:
    """The job whose chaos counts after so many wave periods only."""
    return replace(job, going=partial(job.going, least=periods)) if job.going else job
