"""Runs of a campaign that share a worker: the engine computes several at once faster than one after another.

A group of jobs goes to a worker as one task. The worker saves every run, and makes its row, as soon as it ends: a
killed campaign loses what was running and nothing else. On a cluster the runs of a group are sent when its last one has
ended, so groups there are small. What a group leaves undone - the engine raised, the worker died - is left to
`campaigns.machinery.runner`, which runs it job by job and finds on disk what was finished.
"""

import math
from dataclasses import dataclass

from campaigns.machinery.plan import Job, Outcome, Plan
from campaigns.machinery.worker import kept, other_sources

MOST = 96  # jobs of a group: results reach the table group by group
MOST_SENT = 8  # where a group's runs are sent together: one for each lane, so a lost worker costs what was running
FEWEST = 4  # jobs for each worker below which they are not put together


@dataclass(frozen=True)
class Group:
    """Jobs of one run length that one worker does side by side."""

    number: int
    jobs: tuple[Job, ...]


def groups_of(plan: Plan, jobs: list[Job]) -> list[Group]:
    """Groups for the workers, as even as can be; none where the plan or the jobs do not allow it.

    Threads are left out: a group cannot be interrupted from within the process.
    """
    if plan.simulate_each is None or plan.backend == "threading":
        return []
    from engine import goes_in_lanes

    alike: dict[tuple, list[Job]] = {}
    for job in jobs:
        if goes_in_lanes(job.scene):
            alike.setdefault((job.periods, job.duration_s), []).append(job)
    found = []
    for members in alike.values():
        if len(members) < FEWEST:
            continue
        workers = max(1, min(plan.jobs, len(members) // FEWEST))
        count = workers * math.ceil(len(members) / (workers * (MOST_SENT if plan.sends else MOST)))
        # dealt like cards: neighbours cost alike, and so the groups do
        found += [tuple(members[first::count]) for first in range(count)]
    return [Group(number, members) for number, members in enumerate(found)]


def run_group(plan: Plan, group: Group) -> tuple[int, list[Outcome]]:
    """Runs in the worker: the outcomes of those jobs of the group that came to an end."""
    from engine import source_hash

    first = group.jobs[0]
    if source_hash() != first.engine:
        return group.number, [other_sources(first)]
    outcomes = []
    try:
        scenes = [job.scene for job in group.jobs]
        for i, trajectory in plan.simulate_each(scenes, periods=first.periods, duration_s=first.duration_s):
            outcomes.append(kept(plan, group.jobs[i], trajectory))
            if outcomes[-1].stop:
                break
    except (Exception, SystemExit):
        pass  # run again one by one, each of the jobs left says for itself what is wrong
    return group.number, outcomes
