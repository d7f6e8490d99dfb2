"""The loop over the tasks of a campaign: what is not finished is computed in a pool, and a lost worker is no end.

A group of tasks may share a worker. `as_completed` is the loop. Runs of simulations go through it
(`campaigns.machinery.runner`), and so does every other computation, as a `Task` whose result a `Store` keeps.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import NamedTuple

from campaigns.machinery.cli import Running
from campaigns.machinery.folder import CampaignStopped
from campaigns.machinery.pools import PoolBroken, opened
from campaigns.machinery.progress import stage
from campaigns.machinery.store import Result, Store


@dataclass(frozen=True, eq=False)
class Task:
    """A computation. key: of everything that its result depends on; compute(): the result. Both go to a worker."""

    key: str
    compute: Callable[[], Result]


class Results(NamedTuple):
    """Results of tasks, in their order, and how many of them were finished before."""

    results: list[Result]
    reused: int


def results(
    how: Running, store: Store, title: str, tasks: Sequence[Task], size: int = 1, spare: Sequence[Callable] = ()
) -> Results:
    """The results of tasks; those that the store does not have are computed, and saved as they come.

    size: how many a worker is given at once, where each takes a moment only. spare: as of `pools.opened`.
    Raises CampaignStopped where a task kills its worker twice; what is finished is kept.
    """
    finished, missing = {}, {}
    reused = 0
    for task in tasks:
        result = store.get(task.key)
        if result is None:
            missing[task.key] = task
        else:
            finished[task.key] = result
            reused += 1
    if missing:
        compute = partial(_computed, Store(how.seen(store.folder), store.suffix))
        tasks_left = list(missing.values())
        groups = [tasks_left[first : first + size] for first in range(0, len(tasks_left), size)]
        with stage(title, len(tasks), "tasks", lambda: len(finished)):
            for key, result in as_completed(how, groups, compute, _stopped, spare):
                finished[key] = result
                if how.sends:
                    store.put(key, result)
    return Results([finished[task.key] for task in tasks], reused)


def _computed(store: Store, group: Sequence[Task]) -> list[tuple]:
    return [(task.key, store.finished(task.key, task.compute)) for task in group]


def _stopped(task: Task, reason: str) -> Result:
    raise CampaignStopped(f"a worker process ended twice at the same task: {reason}; what is finished is kept")


def as_completed(
    how: Running, groups: Sequence[Sequence], call: Callable, lost: Callable, spare: Sequence[Callable] = ()
) -> Iterator[tuple]:
    """Key and result of each task of the groups, as they come.

    call(group) -> key and result of those of its tasks that came to an end; the others are done one by one, when all
    groups have ended. A task whose worker dies is done again, alone. Where it dies again: lost(task, reason) -> result.
    spare: as of `pools.opened`.
    """
    unfinished = {}
    for group in groups:
        unfinished.update((task.key, task) for task in group)
    waiting = list(groups)
    with opened(how.backend, min(how.jobs, max(1, len(unfinished) + len(spare))), how.dask_address) as execute:
        while unfinished:
            try:
                for group, ended in execute(call, waiting or [(task,) for task in unfinished.values()], spare=spare):
                    waiting = _without(group, waiting)
                    for key, result in ended:
                        del unfinished[key]
                        yield key, result
            except PoolBroken as broken:
                for suspect in broken.suspects:
                    waiting = _without(suspect, waiting)
                    if len(suspect) == 1:
                        yield _by_itself(execute, call, unfinished.pop(suspect[0].key), lost)


def _without(group: Sequence, waiting: list[Sequence]) -> list[Sequence]:
    """The groups that wait, without this one; by identity, because tasks may be large to compare."""
    return [member for member in waiting if member is not group]


def _by_itself(execute: Callable, call: Callable, task, lost: Callable) -> tuple[str, object]:
    try:
        ((_, ended),) = execute(call, [(task,)], alone=True)
        return ended[0]
    except PoolBroken as broken:
        return task.key, lost(task, str(broken))
