"""The runs of the accuracy campaign as jobs, phase by phase, other codes among them.

Errors are taken against runs of an earlier phase: a point's against the reference of its work (a tolerance's against
the run on its grid). Another code is held against its own refined run (`error`) and against ours
(`error_against_ours`); scipy solves our own equations, so that our reference is its own. A code that is not installed
is a row that says so. Its module in `campaigns.accuracy.peers` has
simulate(scene, duration_s, nodes or segments, setting, ...) -> Trajectory.
"""

import importlib.util
from collections.abc import Callable, Iterator
from dataclasses import asdict
from functools import partial
from importlib import metadata
from pathlib import Path

import numpy as np

from campaigns.accuracy import plan
from campaigns.accuracy.peers.record import nothing
from campaigns.accuracy.plan import BEST, BY_NAME, PEERS, Effort, Peer, Point
from campaigns.accuracy.rows import kept_samples, point_row
from campaigns.machinery import Job, made_by
from engine.trajectory import Trajectory

REFERENCE, CHECK, TIMED, OURS = "peer-reference", "peer-check", "peer", "ours-for-peer"
OURS_REFINED = (321, 1e-5)
Samples = dict[tuple[str, str], np.ndarray | None]  # by work and what they are; None of a run that failed


def phases(out: Path, effort: Effort, quick: bool, with_peers: bool) -> Iterator[list]:
    """The jobs of four phases: our references, those of other codes, what is not timed, what is timed.

    The runs of each phase have to be in `out` before the next is asked for. with_peers: whether there are other codes.
    """
    references, untimed, timed = plan.phases(effort)
    wanted = taking_part(effort.works, quick) if with_peers else []
    known = {}
    ours = {(point.work, point.kind): engine_job(point, known) for point in references}
    for peer, work, _ in wanted:
        if version(peer) and peer.ours:  # our refined run with the changes that another code is to be compared with
            nodes, rtol = OURS_REFINED
            scene = BY_NAME[work].made({**peer.ours, "tether.nodes": nodes, "solver.rtol": rtol})
            point = Point(work, OURS, BEST, nodes, "rtol", rtol)
            ours[work, OURS + peer.name] = job_of(point, scene, f"{OURS} {peer.name}")
    yield list(ours.values())
    keep_samples(known, out, ours)
    refined = [(peer, work) for peer, work, _ in wanted if version(peer) and work in peer.refined]
    theirs = {}
    for peer, work in refined:
        theirs[work, peer.name] = peer_job(peer, work, REFERENCE, peer.refined[work][0], known)
    yield list(theirs.values())
    keep_samples(known, out, theirs)
    jobs = [engine_job(point, known) for point in untimed]
    for peer, work in refined:
        for setting in peer.refined[work][1:]:
            jobs.append(peer_job(peer, work, CHECK, setting, known))
    yield jobs
    timed_peers = []
    for peer, work, settings in wanted:
        if not version(peer):
            settings = settings[:1]
        for setting in settings:
            timed_peers.append(peer_job(peer, work, TIMED, setting, known))
    yield side_by_side([engine_job(point, known) for point in timed], timed_peers, effort.rounds)


def keep_samples(known: Samples, out: Path, jobs: dict[tuple, Job]) -> None:
    """Add the samples of finished runs, by work and what they are."""
    for (work, role), job in jobs.items():
        known[work, role] = kept_samples(BY_NAME[work], out, job.key)


def job_of(
    point: Point,
    scene,
    made: str,
    reference: np.ndarray | None = None,
    ours: np.ndarray | None = None,
    simulate: Callable | None = None,
    **labels: str,
) -> Job:
    """A run, held against samples of its reference and of ours; made, simulate: as of `Job`; labels: more of them."""
    describe = partial(point_row, work_name=point.work, reference=reference, ours=ours)
    duration_s = BY_NAME[point.work].duration_s
    settings = {"duration_s": duration_s, "simulate": simulate, "describe": describe, "made": made}
    return Job(asdict(point) | labels, scene, **settings)


def engine_job(point: Point, known: Samples) -> Job:
    """The job of one of the engine's points."""
    reference = known.get((point.work, "reference"))
    if point.kind == "tolerance":
        reference = known.get((point.work, "grid"))
    scene, made = BY_NAME[point.work].made(point.changes()), f"{point.kind}-{point.round}"
    return job_of(point, scene, made, reference)


def side_by_side(ours: list[Job], peers: list[Job], rounds: int) -> list[Job]:
    """Timed jobs in the order in which they run: those of other codes, which run once, in the middle round of ours on
    the same work, so that the machine's noise meets both."""
    turns = [(job.labels["round"], job) for job in ours]
    turns += [(rounds // 2, job) for job in peers]
    works = list(dict.fromkeys(job.labels["work"] for _, job in turns))
    turns.sort(key=lambda turn: (turn[0], works.index(turn[1].labels["work"])))
    return [job for _, job in turns]


def version(peer: Peer) -> str:
    """The installed version, "" for none."""
    return metadata.version(peer.package) if importlib.util.find_spec(peer.module) is not None else ""


def sources_of(peer: Peer) -> str:
    """Hash of the code that runs it."""
    return made_by(f"campaigns/accuracy/peers/{peer.module}.py", "campaigns/accuracy/peers/record.py")


def taking_part(works: tuple[str, ...], quick: bool) -> list[tuple]:
    """(code, work, its settings) of all that is asked of other codes."""
    parts = []
    for peer in PEERS:
        settings = peer.settings
        if quick:
            settings = peer.quick
        for work in works:
            if settings.get(work):
                parts.append((peer, work, settings[work]))
    return parts


def peer_job(peer: Peer, work: str, kind: str, setting: tuple[int, float], known: Samples) -> Job:
    """A run of another code, held against its own reference and against ours."""
    (nodes, value), installed = setting, version(peer)
    reference = known.get((work, "reference"))
    reference_of_peer = None
    if kind != REFERENCE:
        reference_of_peer = known.get((work, peer.name), reference)
    recipe = f"{peer.name} {installed} {kind} {nodes} {value!r} {sources_of(peer)}"
    scene, point = scene_of(peer, work, nodes), Point(work, kind, peer.name, nodes, peer.control, value)
    simulate, ours = partial(other_code, peer=peer, settings=setting), known.get((work, OURS + peer.name), reference)
    return job_of(point, scene, recipe, reference_of_peer, ours, simulate, peer_version=installed)


def scene_of(peer: Peer, work: str, nodes: int):
    """The scene of a work for another code: no shock viscosity, nodes where they matter to it."""
    changes = {}
    if peer.package == "scipy":
        changes["tether.nodes"] = nodes
    if work.startswith("break"):
        changes["solver.shock_viscosity"] = None
    return BY_NAME[work].made(changes)


def other_code(scene, periods=None, duration_s=None, *, peer: Peer, settings: tuple) -> Trajectory:
    """The run of another code in the place of engine.simulate; settings: nodes or segments, value of its control.

    Where it is not installed, or raises, the record of a failed run, so that it is not tried again.
    """
    if not version(peer):
        advice = f"not installed; pip install {peer.package}, or the extra bench of this project"
        return nothing(scene, "not-installed", advice)
    try:
        module = importlib.import_module(f"campaigns.accuracy.peers.{peer.module}")
        return module.simulate(scene, duration_s, *settings, *peer.name.split()[1:])  # the method of scipy
    except Exception as error:
        return nothing(scene, "solver-failed", f"{type(error).__name__}: {error}")
