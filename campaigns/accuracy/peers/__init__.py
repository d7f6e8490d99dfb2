"""Other codes on the works of the accuracy campaign: which does what, at which settings, and what is left different.

A code that is not installed is a row that says so. Each is held against its own refined run (`error`) and against ours
(`error_against_ours`); scipy solves our own equations, so that our reference is its own. A code's module here has
simulate(scene, duration_s, nodes or segments, setting, ...) -> Trajectory.
"""

import importlib.util
from collections.abc import Callable
from functools import partial
from importlib import metadata

from campaigns.accuracy.peers.record import nothing
from campaigns.accuracy.works import BY_NAME, PEERS, Peer
from engine.trajectory import Trajectory


def version(peer: Peer) -> str:
    """The installed version, "" for none."""
    return metadata.version(peer.package) if importlib.util.find_spec(peer.module) is not None else ""


def taking_part(works: tuple[str, ...], quick: bool) -> list[tuple[Peer, str, list]]:
    """(code, work, its settings) of all that is asked of other codes."""
    chosen = ((peer, peer.quick if quick else peer.settings) for peer in PEERS)
    return [(peer, work, settings[work]) for peer, settings in chosen for work in works if settings.get(work)]


def scene_of(work: str, nodes: int | None):
    """The scene of a work for another code: no shock viscosity, nodes where they matter to it."""
    changes = {"tether.nodes": nodes} if nodes else {}
    return BY_NAME[work].made(changes | ({"solver.shock_viscosity": None} if work.startswith("break") else {}))


def simulation(peer: Peer, installed: str, nodes: int, setting: float) -> Callable:
    """What stands in the place of engine.simulate: the run of another code, or the record that it is not installed."""
    if not installed:
        return partial(absent, package=peer.package)
    method = peer.name.split()[1:]  # of scipy
    return partial(called, module=peer.module, settings=(nodes, setting, *method))


def called(scene, periods=None, duration_s=None, module="", settings=()) -> Trajectory:
    """The run of another code; what it raises becomes the record of a failed run, so that it is not tried again."""
    try:
        return importlib.import_module(f"{__name__}.{module}").simulate(scene, duration_s, *settings)
    except Exception as error:
        return nothing(scene, "solver-failed", f"{type(error).__name__}: {error}")


def absent(scene, periods=None, duration_s=None, package="") -> Trajectory:
    """The record of a code that is not installed."""
    return nothing(scene, "not-installed", f"not installed; pip install {package}, or the extra bench of this project")


def notes(works: tuple[str, ...], quick: bool) -> dict[str, str]:
    """What is left different, by name of the code, for those that take part."""
    peers = dict.fromkeys(peer for peer, _, _ in taking_part(works, quick))
    return {f"{peer.name} {version(peer) or '(not installed)'}": peer.notes for peer in peers}
