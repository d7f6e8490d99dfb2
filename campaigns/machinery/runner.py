"""Runs all simulations of a campaign that are not on disk yet and keeps table.csv up to date.

What the workers do is in `campaigns.machinery.worker`. Every run is saved, and has its row, as soon as it ends: a
killed campaign loses what was running and nothing else.
"""

import contextlib
import math
import tempfile
import time
from collections import Counter
from collections.abc import Iterator, Sequence
from functools import partial
from itertools import chain
from pathlib import Path

import engine
from campaigns.machinery.folder import PROGRESS, Table, trajectory_path
from campaigns.machinery.long_runs import LongRun
from campaigns.machinery.plan import Job, Jobs, Outcome, Plan, Summary, name_of
from campaigns.machinery.pools import PoolBroken, opened
from campaigns.machinery.progress import print_line, reports, stage
from campaigns.machinery.store import orbits_in
from campaigns.machinery.tasks import as_completed
from campaigns.machinery.worker import Spare, failed, keep_row, reuse, run_jobs
from engine.atomic import write_atomic
from tables import Row

ENGINE = "machine code, compiled once and then loaded"
MOST = 96  # jobs of a group: results reach the table group by group
MOST_SENT = 8  # where a group's runs are sent together: few, so that a lost worker costs only what was running
GOLDEN = 0.5 * (math.sqrt(5.0) - 1.0)  # its multiples, less whole numbers, fill any range evenly
# jobs for each worker below which they go alone: eight lanes cost as much as two to four runs alone, four as two
FEWEST = 3
_ready: set[tuple] = set()  # pieces of machine code that are on disk since a campaign of this process compiled them


def run(plan: Plan, jobs: Jobs, ahead: Jobs = ()) -> Summary:
    """Compile and do the runs. ahead: of these what they need is compiled too, because they come next and two processes
    are done sooner with all of it.
    """
    missing = _missing(plan.out, jobs)
    start = time.perf_counter()
    if missing and plan.how.sends and plan.how.dask_address is not None:
        print_line("each worker compiles the engine in its first run, unless it has done so before")
    elif missing:
        later = chain.from_iterable(spare.jobs for spare in plan.spare)
        _compile(plan, [*missing, *ahead, *later])
    compiled = time.perf_counter()
    summary = run_campaign(plan, jobs)
    summary.times.update(compile_s=compiled - start, run_s=time.perf_counter() - compiled)
    return summary


def write_scene(directory: Path, campaign: str, jobs: Jobs) -> None:
    """Write scene.toml. Raises OSError."""
    head = f"# the scene of the first run of {campaign}; what varies over the runs is listed in provenance.json\n"
    write_atomic(directory / "scene.toml", (head + jobs[0].scene.to_toml()).encode())


def groups_of(plan: Plan, jobs: Jobs) -> list[tuple]:
    """Jobs of one run length, all with `going` or none, that a worker does side by side, in groups as even as can be.

    Jobs that are too few to fill lanes at every worker stay alone: so they are done sooner, and none waits for others.
    Beside jobs of other lengths, which keep the other workers busy, one worker does them in its lanes.
    """
    alike = {}  # jobs by their length
    for job in jobs:
        if shares_worker(plan, job):
            alike.setdefault((job.periods, job.duration_s, job.going is None), []).append(job)
    groups, workers = [], plan.how.jobs
    most = MOST
    if plan.how.sends:
        most = MOST_SENT
    for members in alike.values():
        sharing = workers
        if len(members) < FEWEST * workers and len(alike) > 1:
            sharing = 1
        if len(members) < FEWEST * sharing:
            continue
        for group in _dealt(members, sharing * math.ceil(len(members) / (sharing * most))):
            groups.append(tuple(_mixed(group)))
    return groups


def _dealt(jobs: Jobs, count: int) -> list[list]:
    """The jobs in so many groups, none of them empty, dealt like cards: neighbours cost alike, and so the groups do.

    Jobs whose lines have unlike numbers of nodes, or carry unlike numbers of perturbations, share no lanes. If there
    are such jobs, those that do share lanes are dealt together, as many as there are lanes: those that cost most first,
    and always to the group that has least to do.
    """
    from engine.simd.vector import COUNT

    alike = {}  # jobs by their cost
    for job in jobs:
        alike.setdefault(_cost(job), []).append(job)
    together = 1
    if len(alike) > 1:
        together = min(COUNT, len(jobs) // count)  # more together would leave a group without jobs
    groups, costs = [[] for _ in range(count)], [0.0] * count
    for cost, members in sorted(alike.items(), reverse=True):
        for first in range(0, len(members), together):
            least = costs.index(min(costs))
            groups[least] += members[first : first + together]
            costs[least] += cost
    return groups


def _cost(job: Job) -> float:
    """About what a wave period costs, in units of one node; a perturbation costs half as much as its run."""
    return job.scene.tether.nodes * (1.0 + 0.5 * job.scene.output.tangent_vectors)


def shares_worker(plan: Plan, job: Job) -> bool:
    """Whether a job can go side by side with others. Not in threads: nothing interrupts a group within the process."""
    return plan.simulate_each is not None and plan.how.backend != "threading" and engine.goes_in_lanes(job.scene)


def spare_groups(plan: Plan, folder: Path, jobs: Jobs, **changes) -> list[Spare]:
    """Runs of a later step in a folder of a campaign, for `Plan.spare`; none where workers do not see the folder.

    changes: of the plan in that step. Raises OSError.
    """
    missing = _missing(folder, jobs)
    if not missing or plan.how.sends:
        return []
    trajectory_path(folder, "").parent.mkdir(parents=True, exist_ok=True)
    later = plan.within(folder.absolute(), spare=[], **changes)
    firsts = range(0, len(missing), MOST_SENT)
    return [Spare(later, missing[first : first + MOST_SENT]) for first in firsts]


def _missing(folder: Path, jobs: Jobs) -> list[Job]:
    return [job for job in jobs if not trajectory_path(folder, job.key).exists()]


def _keys(groups: Sequence[Sequence]) -> set[str]:
    return {job.key for job in chain.from_iterable(groups)}


def _mixed(jobs: Jobs) -> list[Job]:
    """The jobs in an order in which any part of them is like the whole.

    The slow ones of a sweep are neighbours; if they began last, they would end alone. The first one, which is often the
    fastest, does not lead.
    """
    order = sorted(range(len(jobs)), key=lambda place: place * GOLDEN % 1.0, reverse=True)
    return [jobs[place] for place in order]


def _compile(plan: Plan, missing: Jobs) -> None:
    """Compile what the runs may call: what has kernels in common in one process, the rest in others meanwhile."""
    if plan.simulate is not engine.simulate:
        return
    together = _keys(groups_of(plan, missing))
    wanted = []
    for job in missing:
        if job.simulate is None:
            wanted.append((job.scene, job.key in together, job.carrying))
            if job.key in together or job.carrying:
                # its companion on half the elements goes alone, and so may its last part
                wanted.append((job.scene, False, job.carrying))
    tasks = []
    for part in engine.shares_of(wanted):
        task = {key: scene for key, scene in part.items() if key not in _ready}
        if task:
            tasks.append(task)
    if not tasks:
        return
    pool = "loky", min(plan.how.jobs, max(2, len(missing)))
    if plan.how.backend == "threading":  # Numba compiles in one of them at a time
        pool = "threading", 1
    ended = []
    with (
        opened(*pool) as execute,
        stage(ENGINE, len(tasks), "pieces", lambda: len(ended)),
        contextlib.suppress(PoolBroken),  # a run that cannot be compiled says so itself
    ):
        for task, _ in execute(_compiled, tasks):
            ended.append(task)
            _ready.update(task)


def _compiled(pieces: dict) -> None:
    for key, scene in pieces.items():
        with contextlib.suppress(Exception):  # not the place to judge a scene: its run fails in the same way
            engine.compile_piece(key, scene)


def run_campaign(plan: Plan, jobs: Jobs) -> Summary:
    """Do every run that is not there yet; keep table.csv up to date while results come.

    Raises CampaignStopped (disk full, folder lost) or KeyboardInterrupt; finished runs and their rows are then on disk.
    """
    by_key = {job.key: job for job in jobs}
    table = Table(plan.out / "table.csv", plan.columns, list(by_key))
    finished = set()
    times = Counter()
    with stage("looking for finished runs"):
        for key, job in by_key.items():
            outcome = reuse(plan, job, print_line)
            if outcome is not None and LongRun(job, row=outcome.row).next_part() is None:
                finished.add(key)
                times["analysis_s"] += outcome.analysis_s
                table.rows[key] = _row(job, outcome)
    table.write()
    missing = [job for key, job in by_key.items() if key not in finished]
    try:
        for key, outcome in _computed(plan, missing, len(finished)):
            if outcome.content:
                write_atomic(trajectory_path(plan.out, key), outcome.content)
                keep_row(plan, outcome, outcome.content)
                orbits_in(plan.out).add(outcome.orbits)
            times["analysis_s"] += outcome.analysis_s
            row = _row(by_key[key], outcome)
            table.add(key, row)
            if plan.on_row is not None:
                plan.on_row(row)
    except BaseException:
        with contextlib.suppress(OSError):
            table.write()
        raise
    table.write()
    return Summary(table.in_order(), len(finished), len(missing), times, made=frozenset(_keys([missing])))


def _row(job: Job, outcome: Outcome) -> Row:
    return {**job.labels, **outcome.row, "run_key": job.key}


def _computed(plan: Plan, jobs: Jobs, reused: int) -> Iterator[tuple]:
    """Key and outcome of the jobs, as they come: those that can share a worker first, then what these leave undone.

    A run that kills its worker twice, the second time alone, is given up. reused: runs that were there before.
    """
    if not jobs:
        return
    out = plan.how.seen(plan.out)
    groups = groups_of(plan, jobs)
    total = reused + len(jobs)
    unfinished = _keys([jobs])
    together = _keys(groups)
    by_name = {name_of(group): group for group in groups}
    for job in jobs:
        by_name[name_of([job])] = (job,)
        if job.key not in together:
            groups.append((job,))

    def count():
        """Runs that have ended; of groups under way those that their workers report."""
        ended = total - len(unfinished)
        for name, (runs, *_) in reports(Path(place)).items():
            taken = len(_keys([by_name[name]]) - unfinished)  # those counted above
            ended += max(runs - taken, 0)
        return ended

    lengths_s = [job.duration_s or job.periods * job.scene.waves.period_s for job in jobs if job.going is None]
    of_all, most_s = "", math.inf
    if len(lengths_s) == len(jobs):
        most_s = sum(lengths_s)
        of_all = f" of {most_s:,.0f}"

    def simulated():
        seconds = [length_s for _, length_s in reports(Path(place)).values()]
        so_far_s = min(sum(seconds), most_s)  # a run that is repeated has two reports
        return f"{so_far_s:,.0f}{of_all} s simulated"

    # workers say there how far they are; a campaign drops what a kill leaves of it
    folder = tempfile.TemporaryDirectory(prefix=PROGRESS, dir=out)
    with folder as place, stage(plan.title, total, "runs", count, simulated):
        call = partial(run_jobs, plan.within(out, reports=Path(place), on_row=None, spare=[]))
        for key, outcome in as_completed(plan.how, groups, call, _given_up, plan.spare):
            unfinished.discard(key)
            yield key, outcome


def _given_up(job: Job, reason: str) -> Outcome:
    return failed(job, "worker-died", f"its process ended twice, the second time running alone: {reason}")
