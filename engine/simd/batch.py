"""Which runs share a batch, and how: a lane whose run has ended gets the next run that waits."""

from collections import deque

from ..run import Run
from .cover import goes_in_lanes
from .machine import Machine, kind_of
from .vector import COUNT

LEAST = 2  # runs of a kind for which a batch pays: eight lanes cost about as much as one and a half runs alone


def shares(jobs):
    """Groups of at least LEAST jobs (number, scene, duration_s) that may share a batch; the others are left out."""
    groups = {}
    for job in jobs:
        if goes_in_lanes(job[1]):
            groups.setdefault(kind_of(job[1]), []).append(job)
    return [group for group in groups.values() if len(group) >= LEAST]


def run_through(jobs, progress):
    """Run jobs of one kind; yields (number, Run) as they end, in no order.

    progress: callable(share of these jobs that is done), called now and then.
    """
    waiting, machine, done, numbers = deque(jobs), None, 0, [0] * COUNT
    longest = max(job[2] / job[1].sample_step_s() for job in jobs)
    most_periods = max(job[2] / (job[1].waves.period_s if job[1].waves is not None else 1.0) for job in jobs)
    while True:
        for b in range(COUNT):
            while waiting and (machine is None or machine.runs[b] is None):
                number, scene, duration_s = waiting.popleft()
                run = Run(scene, duration_s)
                if run.done():  # no equilibrium to start from
                    done += 1
                    yield number, run
                    continue
                if machine is None:
                    machine = Machine(run, int(longest) + 2, int(most_periods) + 1)
                    machine.compile()
                machine.load(b, run)
                numbers[b] = number
        if machine is None or all(run is None for run in machine.runs):
            return
        for b in machine.advance():
            run = machine.unload(b)
            done += 1
            yield numbers[b], run
        progress((done + sum(machine.fraction(b) for b, run in enumerate(machine.runs) if run is not None)) / len(jobs))
