"""The runs of the accuracy campaign as jobs, in three phases: references, what is not timed, what is timed.

Errors are taken against runs of an earlier phase: a point's against the reference of its work (a tolerance's against
the run on its grid), another code's against its own refined run and against ours.
"""

from dataclasses import asdict
from functools import partial
from pathlib import Path

from campaigns.accuracy import peers
from campaigns.accuracy.plan import BEST, first_phase, second_phase, third_phase
from campaigns.accuracy.points import LONG_PERIODS, Effort, Point
from campaigns.accuracy.rows import point_row
from campaigns.accuracy.works import BY_NAME, PERIOD_S, Peer
from campaigns.machinery.folder import made_by, trajectory_path
from campaigns.machinery.plan import Job, KeptRun

REFERENCE, CHECK, TIMED, OURS = "peer-reference", "peer-check", "peer", "ours-for-peer"
OURS_REFINED = (321, 1e-5)
References = dict[tuple[str, str], KeptRun]  # by work and kind
Phases = tuple[list[Job], list[Job], list[Job]]


def phases(out: Path, effort: Effort, quick: bool, with_peers: bool) -> Phases:
    """All jobs, those of other codes among them where they are asked for."""
    first = [engine_job(point, {}) for point in first_phase(effort)]
    known = {(job.labels["work"], job.labels["kind"]): kept(out, job) for job in first}
    second, third = ([engine_job(point, known) for point in of(effort)] for of in (second_phase, third_phase))
    others = peer_jobs(out, effort.works, quick, known) if with_peers else ([], [], [])
    return first + others[0], second + others[1], side_by_side(third, others[2], effort.rounds)


def kept(out: Path, job: Job) -> KeptRun:
    """Where the run of a job is, or will be."""
    return KeptRun(trajectory_path(out, job.key))


def engine_job(point: Point, references: References) -> Job:
    """The job of one of the engine's points."""
    work = BY_NAME[point.work]
    length_s = LONG_PERIODS * PERIOD_S if point.kind == "long" else work.duration_s
    reference = references.get((work.name, "grid" if point.kind == "tolerance" else "reference"))
    describe = partial(point_row, work_name=work.name, reference=None if point.kind == "long" else reference)
    scene, made = work.made(point.changes()), f"{point.kind}-{point.round}"
    return Job(asdict(point), scene, duration_s=length_s, describe=describe, made=made)


def side_by_side(ours: list[Job], others: list[Job], rounds: int) -> list[Job]:
    """Timed jobs in the order in which they run: those of other codes, which run once, in the middle round of ours on
    the same work, so that the machine's noise meets both."""
    middle = rounds // 2
    found = [job for job in ours if job.labels["round"] < middle]
    rest = [job for job in ours if job.labels["round"] == middle]
    for work in dict.fromkeys(job.labels["work"] for job in (*rest, *others)):
        found += [job for job in (*rest, *others) if job.labels["work"] == work]
    return found + [job for job in ours if job.labels["round"] > middle]


def peer_jobs(out: Path, works: tuple[str, ...], quick: bool, references: References) -> Phases:
    """Jobs of all other codes: their references and ours for them; what checks those; what is timed."""
    first, second, timed = [], [], []
    for peer, work, settings in peers.taking_part(works, quick):
        version = peers.version(peer)
        if not version:
            timed.append(_job(peer, version, work, TIMED, *settings[0]))
            continue
        ours = own = references.get((work, "reference"))
        if peer.ours:
            first.append(_ours(peer, work))
            ours = kept(out, first[-1])
        refined = peer.refined.get(work, ())
        for setting in refined[:1]:
            first.append(_job(peer, version, work, REFERENCE, *setting, ours=ours))
            own = kept(out, first[-1])
        second += [_job(peer, version, work, CHECK, *setting, own, ours) for setting in refined[1:]]
        timed += [_job(peer, version, work, TIMED, *setting, own, ours) for setting in settings]
    return first, second, timed


def _ours(peer: Peer, work: str) -> Job:
    """Our own refined run with what the other code does differently."""
    nodes, rtol = OURS_REFINED
    labels = asdict(Point(work, OURS, BEST, nodes, "rtol", rtol))
    scene = BY_NAME[work].made({**peer.ours, "tether.nodes": nodes, "solver.rtol": rtol})
    how = {"describe": partial(point_row, work_name=work), "made": f"{OURS} {peer.name}"}
    return Job(labels, scene, duration_s=BY_NAME[work].duration_s, **how)


def _job(peer: Peer, version: str, work: str, kind: str, nodes: int, value: float, own=None, ours=None) -> Job:
    """A run of another code, held against its own reference and against ours."""
    labels = asdict(Point(work, kind, peer.name, nodes, peer.control, value)) | {"peer_version": version}
    simulate = peers.simulation(peer, version, nodes, value)
    describe = partial(point_row, work_name=work, reference=own, ours=ours)
    sources = made_by({}, *(f"campaigns/accuracy/peers/{name}.py" for name in (peer.module, "deck", "record")))
    made = f"{peer.name} {version} {kind} {nodes} {value!r} {sources}"
    scene, length_s = peers.scene_of(work, nodes if peer.package == "scipy" else None), BY_NAME[work].duration_s
    return Job(labels, scene, duration_s=length_s, simulate=simulate, describe=describe, made=made)
