"""Other codes on the works of the accuracy campaign: which does what, at which settings, and what is left different.

A code that is not installed is a row that says so. Each is held against its own refined run (`error`) and against ours
(`error_against_ours`); scipy solves our own equations, so that our reference is its own.
"""

import importlib.util
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial
from importlib import metadata
from pathlib import Path

from campaigns.accuracy.peers import cabledyn, elastica, moordyn
from campaigns.accuracy.works import BY_NAME
from campaigns.machinery.kept_run import KeptRun

REFERENCE, CHECK, TIMED, OURS = "peer-reference", "peer-check", "peer", "ours-for-peer"
OURS_REFINED = (321, 1e-5)


@dataclass(frozen=True)
class Peer:
    """Another code. package, module: as installed and as imported.

    run(scene, duration_s, nodes, setting) -> Trajectory. settings, quick: (nodes or segments, value) that are timed, by
    work; control: what the value is. refined: its reference, then a check, by work; none: ours is its own. ours:
    changes of the scene with which our refined run is the one to compare with.
    """

    name: str
    package: str
    module: str
    run: Callable
    control: str
    settings: dict[str, tuple[tuple[int, float], ...]]
    refined: dict[str, tuple[tuple[int, float], ...]]
    notes: str
    quick: dict[str, tuple[tuple[int, float], ...]] = field(default_factory=dict)
    ours: dict[str, object] = field(default_factory=dict)

    def version(self) -> str:
        """The installed version, "" for none."""
        if importlib.util.find_spec(self.module) is None:
            return ""
        return metadata.version(self.package)


def by_scipy(scene, duration_s, nodes, setting, method):
    """scipy's solve_ivp; nodes are those of the scene."""
    from campaigns.accuracy.peers.scipy import run

    return run(scene, duration_s, method, setting)


_RADAU = {
    "regular": tuple((n, rtol) for n in (6, 11, 21) for rtol in (1e-1, 1e-2, 1e-3, 1e-4)),
    "snap": ((11, 1e-2), (11, 1e-3), (21, 1e-2), (21, 1e-3)),
    "violent": ((11, 1e-2), (21, 1e-2)),
    "break-1": ((51, 1e-2), (51, 1e-3), (101, 1e-3), (201, 1e-3)),
    "break-1-slow": ((51, 1e-2), (51, 1e-3), (51, 1e-4), (101, 1e-4), (201, 1e-4)),
    "pendulum": tuple((n, rtol) for n in (6, 11) for rtol in (1e-1, 1e-2, 1e-3, 1e-4)),
}
_BDF = {
    "regular": ((6, 1e-2), (11, 1e-2), (11, 1e-3)),
    "snap": ((11, 1e-2),),
    "break-1-slow": ((51, 1e-2),),
    "pendulum": ((6, 1e-2), (6, 1e-4)),
}
_BY_RESOLVENT = (
    "solve_ivp on the engine's own semi-discrete equations, rates by one backward Euler step of 1e-7 s solved to "
    "rounding (campaigns/accuracy/peers/scipy.py); Jacobian by differences in compiled code; no loop release and no "
    "shock viscosity"
)
PEERS = (
    Peer("scipy Radau", "scipy", "scipy", partial(by_scipy, method="Radau"), "rtol", _RADAU, {}, _BY_RESOLVENT,
         {"regular": ((6, 1e-2), (6, 1e-3)), "pendulum": ((6, 1e-2), (6, 1e-3))}),
    Peer("scipy BDF", "scipy", "scipy", partial(by_scipy, method="BDF"), "rtol", _BDF, {},
         "as Radau; of order 3 and more it is not A-stable, and the undamped axial waves of the grid shrink its steps",
         {"regular": ((6, 1e-2),)}),
    Peer("MoorDyn", "moordyn", "moordyn", moordyn.simulate, "steps per period", moordyn.SETTINGS,
         moordyn.REFINED, moordyn.NOTES),
    Peer("CableDyn", "cabledyn", "cabledyn", cabledyn.simulate, "step_s", cabledyn.SETTINGS,
         cabledyn.REFINED, cabledyn.NOTES, ours=cabledyn.OURS),
    Peer("PyElastica", "pyelastica", "elastica", elastica.simulate, "step_s", elastica.SETTINGS,
         elastica.REFINED, elastica.NOTES),
)  # fmt: skip


def peer_jobs(
    out: Path, works: tuple[str, ...], quick: bool, references: dict[str, KeptRun]
) -> tuple[list, list, list]:
    """Jobs of all other codes: (their references and ours for them, what checks those, what is timed)."""
    from campaigns.machinery.folder import trajectory_path

    first, second, timed = [], [], []
    for peer in PEERS:
        version = peer.version()
        for work in works:
            settings = (peer.quick if quick else peer.settings).get(work, ())
            if not settings:
                continue
            if not version:
                away = partial(absent, package=peer.package)
                timed.append(_job(peer, work, TIMED, *settings[0], "", away, None, None))
                continue
            ours = own = references.get(work)
            if peer.ours:
                first.append(_ours(peer, work))
                ours = KeptRun(trajectory_path(out, first[-1].key))
            refined = peer.refined.get(work, ())
            for nodes, value in refined[:1]:
                first.append(_job(peer, work, REFERENCE, nodes, value, version, None, None, ours))
                own = KeptRun(trajectory_path(out, first[-1].key))
            second += [_job(peer, work, CHECK, nodes, value, version, None, own, ours) for nodes, value in refined[1:]]
            timed += [_job(peer, work, TIMED, nodes, value, version, None, own, ours) for nodes, value in settings]
    return first, second, timed


def _ours(peer: Peer, work: str):
    """Our own refined run with what the other code does differently."""
    from campaigns.accuracy.rows import point_row
    from campaigns.machinery.plan import make_job

    nodes, rtol = OURS_REFINED
    labels = {
        "work": work,
        "kind": OURS,
        "method": "esdirk43",
        "nodes": nodes,
        "control": "rtol",
        "setting": rtol,
        "round": 0,
    }
    scene = BY_NAME[work].made({**peer.ours, "tether.nodes": nodes, "solver.rtol": rtol})
    describe = partial(point_row, work_name=work)
    return make_job(
        scene, duration_s=BY_NAME[work].duration_s, labels=labels, describe=describe, made=f"{OURS} {peer.name}"
    )


def _job(peer: Peer, work: str, kind: str, nodes: int, value: float, version: str, run, own, ours):
    from campaigns.accuracy.rows import point_row
    from campaigns.machinery.plan import make_job
    from campaigns.machinery.row_cache import made_by

    labels = {
        "work": work, "kind": kind, "method": peer.name, "nodes": nodes, "control": peer.control, "setting": value,
        "round": 0, "peer_version": version,
    }  # fmt: skip
    simulate = run or partial(_called, call=peer.run, nodes=nodes, setting=value)
    describe = partial(point_row, work_name=work, reference=own, ours=ours)
    sources = made_by({}, *(f"campaigns/accuracy/peers/{name}.py" for name in (peer.module, "deck", "record")))
    made = f"{peer.name} {version} {kind} {nodes} {value!r} {sources}"
    scene = scene_of(work, nodes if peer.package == "scipy" else None)
    return make_job(
        scene, duration_s=BY_NAME[work].duration_s, labels=labels, simulate=simulate, describe=describe, made=made
    )


def scene_of(work: str, nodes: int | None):
    """The scene of a work for another code: no shock viscosity, nodes where they matter to it."""
    changes = {"tether.nodes": nodes} if nodes else {}
    if work.startswith("break"):
        changes |= {"solver.shock_viscosity": None}
    return BY_NAME[work].made(changes)


def _called(scene, periods=None, duration_s=None, call=None, nodes=0, setting=0.0):
    """The run of another code; what it raises becomes the record of a failed run, so that it is not tried again."""
    import numpy as np

    from campaigns.accuracy.peers.record import as_trajectory

    try:
        return call(scene, duration_s, nodes, setting)
    except Exception as error:
        said = f"{type(error).__name__}: {error}"
        return as_trajectory(scene, "solver-failed", said, np.empty(0), np.empty((0, 3)), {})


def absent(scene, periods=None, duration_s=None, package=""):
    """The record of a code that is not installed."""
    import numpy as np

    from campaigns.accuracy.peers.record import as_trajectory

    message = f"not installed; pip install {package}, or the extra bench of this project"
    return as_trajectory(scene, "not-installed", message, np.empty(0), np.empty((0, 3)), {})


def notes(works: tuple[str, ...], quick: bool) -> dict[str, str]:
    """What is left different, by name of the code, for those that take part."""
    return {
        f"{peer.name} {peer.version() or '(not installed)'}": peer.notes
        for peer in PEERS
        if set(works) & set(peer.quick if quick else peer.settings)
    }
