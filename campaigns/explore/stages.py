"""How the motions of places are found, judged and named, stage by stage.

1. The run from rest of each place is a motion (`run_from_rest`). 2. Starts on the motions of a massless tether find
others, islands among them (`propose`). 3. The last state of every motion is the start of a run at each neighbour
(`carry`). 4. Kicks, drawn independently and uniformly at each place: the share of them that ends in a motion estimates
the size of its basin (`kick`); the motions that they find are carried on too. 5. Each motion has a judged run of its
own, and motions that these find to be one become one (`judge`). 6. Two motions at neighbours are one branch where each,
carried to the other, becomes the other (`name`).

The order is that of the continuation of attractors in Attractors.jl (Datseris, Rossi & Wagemakers, Chaos 33, 073151
(2023)): find at each value from the motions of the one before, then match.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from string import ascii_uppercase

import engine
from analysis import distance, grouped, matched
from campaigns.explore.motions import FROM_REST, KICKED, Motion, Motions, Search, settled_in
from campaigns.explore.proposals import has_proposals, kicks, proposals
from campaigns.explore.starts import DISPLACED, Request, Start, kick_speed_mps, reached, start_job
from campaigns.judge import judged_job
from campaigns.machinery import Job, Jobs, in_parts

TIMES = 4  # one transient of chaos in 55 lasts so many mean times


def explore(motions: Motions, jobs: Jobs, search: Search, *later: Callable) -> None:
    """Find the motions of the places of these runs from rest; later: further parts of the same work.

    Raises as `runner.run`.
    """
    places = range(len(motions.jobs), len(motions.jobs) + len(jobs))

    parts = [partial(run_from_rest, motions, jobs)]
    if motions.plan.simulate is engine.simulate:
        parts += parts_beside_rest(motions, places, search)
    in_parts([*parts, partial(judge, motions, search), partial(name, motions), *later])


def parts_beside_rest(motions: Motions, places: Sequence[int], search: Search) -> list[Callable]:
    """What finds the motions of places beside those from rest, to be called in this order."""
    return [
        partial(propose, motions, places, search),
        partial(carry, motions),
        partial(kick, motions, places, search),
        partial(carry, motions),
    ]


def run_from_rest(motions: Motions, jobs: Jobs) -> range:
    """Add the places of these runs from rest, with the motions to which they lead; returns their numbers."""
    places, scene = motions.add(jobs), jobs[0].scene
    ahead = []
    if motions.plan.simulate is engine.simulate and has_proposals(scene):
        ahead.append(start_job(Request({}, scene, DISPLACED)))  # what its starts need is compiled at once
    motions.judged_runs("runs from rest", jobs, ahead)
    let_chaos_last(motions)
    for place in places:
        key = motions.jobs[place].key
        run = motions.judged_run(key)
        if run is not None:
            motion = Motion(place, reached(run, motions.orbits), run.final_state, FROM_REST)
            motions.at[place].append(motion)
            motions.job_keys[motion] = key
    return places


def propose(motions: Motions, places: Sequence[int], search: Search) -> None:
    """Starts on the motions of a massless tether at each place."""
    scenes = [motions.jobs[place].scene for place in places]
    proposed = proposals(motions.plan, scenes, search.speed_mps, search.seed)
    starts = []
    for place, of_place in zip(places, proposed, strict=True):
        starts += [(place, motions.fine(place, start)) for start in of_place]
    motions.run_starts("starts on motions of a massless tether", starts)


def carry(motions: Motions) -> None:
    """Carry every motion to the neighbours where it has not been, and the motions found there further."""
    while True:
        carried, starts = [], []
        for motion in motions.all_motions():
            if motion.state is None:
                continue
            for neighbour, found_by in motions.neighbours(motion.place).items():
                if neighbour in motion.becomes:
                    continue
                match = nearest_match(motion, motions.at[neighbour], motions.match_distance)
                if match is not None:
                    motion.becomes[neighbour] = match
                    continue
                carried.append((motion, neighbour))
                start = Start(found_by, state=motion.state.at_zero())
                starts.append((neighbour, motions.fine(neighbour, start)))
        if not starts:
            return
        results = motions.run_starts("motions carried to the next value", starts)
        for (motion, neighbour), result in zip(carried, results, strict=True):
            motion.becomes[neighbour] = result


def nearest_match(motion: Motion, candidates: Sequence[Motion], match_distance: float) -> Motion | None:
    """The nearest of the candidates with the motion's period that is nearer than match_distance; None: none is."""
    nearest, least = None, match_distance
    for candidate in candidates:
        if not match_distance or candidate.settled.period != motion.settled.period:
            continue
        size = distance(motion.settled, candidate.settled)
        if size < least:
            nearest, least = candidate, size
    return nearest


def nothing_beside(number: int) -> tuple[int, ...]:
    """Kicks are drawn at random: none lies beside another."""
    return ()


def kick(motions: Motions, places: Sequence[int], search: Search) -> None:
    """Kicks at each place; the share that ends in a motion is that of `Motions.labels`."""
    motions.kicks = search.kicks
    starts = []
    for place in places:
        speed_mps = kick_speed_mps(search.speed_mps, motions.jobs[place].scene)
        for velocity in kicks(search.kicks, speed_mps, search.seed, place):
            starts.append((place, Start(KICKED, velocity)))
    kicked = {}  # the motions that kicks have found, each with its last kick
    for start, motion in zip(starts, motions.run_starts("kicks", starts, nothing_beside), strict=True):
        if motion is not None:
            motion.kicks += 1
            if motion.found_by == KICKED:
                kicked[motion] = start
    # few samples are enough to tell a motion, not to take up its state without a shift in the wave
    requests = []
    for place, start in kicked.values():
        requests.append(Request(motions.name_of(place), motions.jobs[place].scene, motions.fine(place, start)))
    endings = motions.starts.run("kicks that found a motion", requests, listed=False)
    for motion, ending in zip(kicked, endings, strict=True):
        motion.state = ending.state or motion.state


def judge(motions: Motions, search: Search) -> None:
    """Do the judged run of every motion that has none, from its state; motions that these find to be one are merged."""
    order, jobs = search.order, {}
    for motion in motions.all_motions():
        if motion not in motions.job_keys:
            place = motions.jobs[motion.place]
            job = judged_job(order, place.labels, place.scene, motion.state.at_zero(), search.most)
            if motion.found_by == KICKED:
                job = as_long_as(job, order.periods)
            jobs[motion] = job
    motions.judged_runs("judged runs of the other motions", list(jobs.values()))
    settled = {}
    for motion, job in jobs.items():
        motions.job_keys[motion] = job.key
        run = motions.judged_run(job.key)
        if run is not None:
            settled[motion] = reached(run, motions.orbits)
    merge(motions, settled)


def merge(motions: Motions, settled: Mapping[Motion, object]) -> None:
    """Merge the motions of a place that longer runs have found to be one; the first of them stays.

    settled: what these runs settled to.
    """
    merged = {}  # by motion the one into which it is merged
    for place, motions_here in enumerate(motions.at):
        for motion in motions_here:
            motion.settled = settled.get(motion, motion.settled)
        first = {}  # motion of each label
        for label, motion in zip(grouped(settled_in(motions_here)), motions_here, strict=True):
            merged[motion] = first.setdefault(int(label), motion)
            if merged[motion] is not motion:
                merged[motion].kicks += motion.kicks
        motions.at[place] = list(first.values())
    for motion in merged:
        for neighbour, successor in motion.becomes.items():
            motion.becomes[neighbour] = merged.get(successor)
    for ending in motions.starts.endings:
        ending.motion = merged.get(ending.motion)


def name(motions: Motions) -> None:
    """Give every branch its letter: A to the one that begins at the first place, from rest where two do.

    `analysis.matched` is asked where no run tells how motions continue.
    """
    ordered = []
    for motions_here in motions.at:
        ordered += sorted(motions_here, key=lambda motion: motion.found_by != FROM_REST)
    branches = {motion: {motion.place: motion} for motion in ordered}  # by motion its branch: a motion by place
    for place in range(len(motions.at)):
        for neighbour in sorted(motions.neighbours(place)):
            if neighbour > place:
                _continue_unsettled(motions, place, neighbour)
                _join_branches(motions, place, neighbour, branches)
    first = {}  # motion of each branch
    for motion in ordered:
        motion.branch = first.setdefault(id(branches[motion]), motion)
        if motion.branch is motion:
            repetition, letter = divmod(len(first) - 1, len(ascii_uppercase))
            motion.letter = ascii_uppercase[letter]
            if repetition:
                motion.letter += str(repetition + 1)


def _continue_unsettled(motions: Motions, place: int, neighbour: int) -> None:
    """Say how motions continue that did not settle when they were carried from a place to a neighbour, or back."""
    own_motions, neighbours = motions.at[place], motions.at[neighbour]
    _follow_back(own_motions, neighbours, place, neighbour)
    _follow_back(neighbours, own_motions, neighbour, place)
    unsettled = [motion for motion in own_motions if motion.becomes.get(neighbour) is None]
    candidates = [motion for motion in neighbours if motion.becomes.get(place) is None]
    numbers = matched(settled_in(unsettled), settled_in(candidates))
    for motion, number in zip(unsettled, numbers, strict=True):
        if number is not None:
            motion.becomes[neighbour] = candidates[number]
            candidates[number].becomes[place] = motion


def _follow_back(motions: Sequence[Motion], candidates: Sequence[Motion], place: int, neighbour: int) -> None:
    """A motion that did not settle at a neighbour becomes the one there that becomes it, if there is but one."""
    for motion in motions:
        back = [candidate for candidate in candidates if candidate.becomes.get(place) is motion]
        if motion.becomes.get(neighbour) is None and len(back) == 1:
            motion.becomes[neighbour] = back[0]


def _join_branches(motions: Motions, place: int, neighbour: int, branches: dict[Motion, dict]) -> None:
    """Join the branches of motions that become each other, unless both have a motion at one place, as round a cusp."""
    for motion in motions.at[place]:
        successor = motion.becomes.get(neighbour)
        if successor is None or successor.becomes.get(place) is not motion:
            continue
        branch, joining = branches[motion], branches[successor]
        if branch is not joining and branch.keys().isdisjoint(joining):
            branch.update(joining)
            for member in joining.values():
                branches[member] = branch


def let_chaos_last(motions: Motions) -> None:
    """Let chaos go on until it has lasted long enough, or its budget is spent.

    A run that settles meanwhile is a longer transient: the chaos beside it may have to last longer.
    """
    periods_before = {}  # wave periods of the runs of the last round, by key
    while True:
        late = outlasting(motions.jobs, motions.rows, motions.neighbours)
        periods = {job.key: motions.rows[job.key]["periods"] for job in late}
        if periods == periods_before:
            return
        motions.judged_runs("chaos that may be a transient", late)
        periods_before = periods


def outlasting(jobs: Jobs, rows: Mapping[str, Mapping], neighbours: Callable) -> list[Job]:
    """The jobs whose chaos has not lasted long enough; they go on until it has.

    It may be a transient, because periodic motions beside it began as chaos, or because only a kick led to it.
    Transients of chaos end at random, after a mean time that changes little from a value to the next (Grebogi, Ott &
    Yorke, Physica D 7 (1983) 181). Chaos counts when it has lasted TIMES as long as the longest transient known beside
    it; that of a kick, when its budget is spent.

    jobs: by number of the place.
    rows: of their runs, by key.
    neighbours: the places beside a place.
    """
    transients = {}  # by place, of those whose motion is periodic
    chaotic = {}  # rows by place, of those whose motion is chaotic
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
