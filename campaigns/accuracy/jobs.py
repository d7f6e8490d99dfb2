"""The runs of the accuracy campaign as jobs, in three phases: references, what is not timed, what is timed.

Errors are taken against runs of an earlier phase: a point's against the reference of its work (a tolerance's against
the run on its grid), another code's against its own refined run and against ours.
"""

from collections.abc import Callable
from dataclasses import asdict
from functools import partial
from pathlib import Path

from campaigns.accuracy import peers, plan
from campaigns.accuracy.plan import BEST, LONG_PERIODS, Effort, Point
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
    first, second, third = plan.phases(effort)
    jobs = [engine_job(point, {}) for point in first]
    known = {(job.labels["work"], job.labels["kind"]): kept(out, job) for job in jobs}
    others = peer_jobs(out, effort.works, quick, known) if with_peers else ([], [], [])
    timed = side_by_side([engine_job(point, known) for point in third], others[2], effort.rounds)
    return jobs + others[0], [engine_job(point, known) for point in second] + others[1], timed


def kept(out: Path, job: Job) -> KeptRun:
    """Where the run of a job is, or will be."""
    return KeptRun(trajectory_path(out, job.key))


def job_of(
    point: Point,
    scene,
    made: str,
    reference: KeptRun | None = None,
    ours: KeptRun | None = None,
    simulate: Callable | None = None,
    **labels: str,
) -> Job:
    """A run, held against its reference and against ours; made, simulate: as of `Job`; labels: more of them."""
    length_s = LONG_PERIODS * PERIOD_S if point.kind == "long" else BY_NAME[point.work].duration_s
    describe = partial(point_row, work_name=point.work, reference=reference, ours=ours)
    how = {"duration_s": length_s, "simulate": simulate, "describe": describe, "made": made}
    return Job(asdict(point) | labels, scene, **how)


def engine_job(point: Point, references: References) -> Job:
    """The job of one of the engine's points."""
    reference = references.get((point.work, "grid" if point.kind == "tolerance" else "reference"))
    scene, made = BY_NAME[point.work].made(point.changes()), f"{point.kind}-{point.round}"
    return job_of(point, scene, made, None if point.kind == "long" else reference)


def side_by_side(ours: list[Job], others: list[Job], rounds: int) -> list[Job]:
    """Timed jobs in the order in which they run: those of other codes, which run once, in the middle round of ours on
    the same work, so that the machine's noise meets both."""
    middle = rounds // 2
    found = [job for job in ours if job.labels["round"] < middle]
    rest = [*(job for job in ours if job.labels["round"] == middle), *others]
    for work in dict.fromkeys(job.labels["work"] for job in rest):
        found += [job for job in rest if job.labels["work"] == work]
    return found + [job for job in ours if job.labels["round"] > middle]


def peer_jobs(out: Path, works: tuple[str, ...], quick: bool, references: References) -> Phases:
    """Jobs of all other codes: their references and ours for them; what checks those; what is timed."""
    first, second, timed = [], [], []
    for peer, work, settings in peers.taking_part(works, quick):
        job = partial(_peer_job, peer, peers.version(peer), work)
        if not peers.version(peer):
            timed.append(job(TIMED, settings[0]))
            continue
        ours = own = references.get((work, "reference"))
        if peer.ours:
            nodes, rtol = OURS_REFINED
            scene = BY_NAME[work].made({**peer.ours, "tether.nodes": nodes, "solver.rtol": rtol})
            first.append(job_of(Point(work, OURS, BEST, nodes, "rtol", rtol), scene, f"{OURS} {peer.name}"))
            ours = kept(out, first[-1])
        refined = peer.refined.get(work, ())
        for setting in refined[:1]:
            first.append(job(REFERENCE, setting, None, ours))
            own = kept(out, first[-1])
        second += [job(CHECK, setting, own, ours) for setting in refined[1:]]
        timed += [job(TIMED, setting, own, ours) for setting in settings]
    return first, second, timed


def _peer_job(peer: Peer, version: str, work: str, kind: str, setting: tuple[int, float], own=None, ours=None) -> Job:
    """A run of another code, held against its own reference and against ours."""
    nodes, value = setting
    point = Point(work, kind, peer.name, nodes, peer.control, value)
    sources = made_by({}, *(f"campaigns/accuracy/peers/{name}.py" for name in (peer.module, "deck", "record")))
    made = f"{peer.name} {version} {kind} {nodes} {value!r} {sources}"
    scene = peers.scene_of(work, nodes if peer.package == "scipy" else None)
    return job_of(point, scene, made, own, ours, peers.simulation(peer, version, nodes, value), peer_version=version)
