"""Other codes on the works of the accuracy campaign: which does what, at which settings, and what is left different.

A code that is not installed is a row that says so. Each is held against its own refined run (`error`) and against ours
(`error_against_ours`); scipy solves our own equations, so that our reference is its own.
"""

import importlib.util
from collections.abc import Callable
from functools import partial
from importlib import metadata

from campaigns.accuracy.peers import cabledyn, elastica, moordyn
from campaigns.accuracy.peers.record import nothing
from campaigns.accuracy.works import BY_NAME, PEERS, Peer
from engine.trajectory import Trajectory


def by_scipy(scene, duration_s, nodes, setting, method):
    """scipy's solve_ivp; nodes are those of the scene."""
    from campaigns.accuracy.peers.scipy import run

    return run(scene, duration_s, method, setting)


RUN = {  # run(scene, duration_s, nodes, setting) -> Trajectory
    "scipy Radau": partial(by_scipy, method="Radau"),
    "scipy BDF": partial(by_scipy, method="BDF"),
    "MoorDyn": moordyn.simulate,
    "CableDyn": cabledyn.simulate,
    "PyElastica": elastica.simulate,
}


def version(peer: Peer) -> str:
    """The installed version, "" for none."""
    return metadata.version(peer.package) if importlib.util.find_spec(peer.module) is not None else ""


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


def simulation(peer: Peer, installed: str, nodes: int, setting: float) -> Callable:
    """What stands in the place of engine.simulate: the run of another code, or the record that it is not installed."""
    if not installed:
        return partial(absent, package=peer.package)
    return partial(called, call=RUN[peer.name], nodes=nodes, setting=setting)


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
    return {f"{peer.name} {version(peer) or '(not installed)'}": peer.notes for peer in peers}
