"""Other codes on the works of the accuracy campaign: which does what, at which settings, and what is left different.

A code that is not installed is a row that says so. Each is held against its own refined run (`error`) and against ours
(`error_against_ours`); scipy solves our own equations, so that our reference is its own.
"""

import importlib.util
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial
from importlib import metadata

from campaigns.accuracy.peers import cabledyn, elastica, moordyn
from campaigns.accuracy.peers.record import nothing
from campaigns.accuracy.works import BY_NAME
from engine.trajectory import Trajectory


@dataclass(frozen=True, eq=False)
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


def taking_part(works: tuple[str, ...], quick: bool) -> list[tuple[Peer, str, tuple]]:
    """(code, work, its settings) of all that is asked of other codes."""
    chosen = ((peer, peer.quick if quick else peer.settings) for peer in PEERS)
    return [(peer, work, settings[work]) for peer, settings in chosen for work in works if settings.get(work)]


def scene_of(work: str, nodes: int | None):
    """The scene of a work for another code: no shock viscosity, nodes where they matter to it."""
    changes = {"tether.nodes": nodes} if nodes else {}
    if work.startswith("break"):
        changes |= {"solver.shock_viscosity": None}
    return BY_NAME[work].made(changes)


def simulation(peer: Peer, version: str, nodes: int, setting: float) -> Callable:
    """What stands in the place of engine.simulate: the run of another code, or the record that it is not installed."""
    if not version:
        return partial(absent, package=peer.package)
    return partial(called, call=peer.run, nodes=nodes, setting=setting)


def called(scene, periods=None, duration_s=None, call=None, nodes=0, setting=0.0) -> Trajectory:
    """The run of another code; what it raises becomes the record of a failed run, so that it is not tried again."""
    try:
        return call(scene, duration_s, nodes, setting)
    except Exception as error:
        return nothing(scene, "solver-failed", f"{type(error).__name__}: {error}")


def absent(scene, periods=None, duration_s=None, package="") -> Trajectory:
    """The record of a code that is not installed."""
    return nothing(scene, "not-installed", f"not installed; pip install {package}, or the extra bench of this project")


def notes(works: tuple[str, ...], quick: bool) -> dict[str, str]:
    """What is left different, by name of the code, for those that take part."""
    peers = dict.fromkeys(peer for peer, _, _ in taking_part(works, quick))
    return {f"{peer.name} {peer.version() or '(not installed)'}": peer.notes for peer in peers}
