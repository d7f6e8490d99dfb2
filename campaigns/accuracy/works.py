"""The works of the accuracy campaign and the other codes on them, read from works.toml.

Errors, over the even samples of a run:

    radius   rms of r(t) - r(t) of the reference, mm
    place    rms of the distance between the upper end's places, mm
    strain   mean over line and time of |strain - exact strain|, per cent of the static strain

The buoy is that of Table 1. The pendulum is a rope of its diameter, softer and shorter, with 2 kg at its lower end, in
air, pushed along and across: smooth, in three dimensions, and what every peer of rods can do. The breaking line is that
of section 4.1 without gravity on an even grid: it stays straight, so that the exact solution in one dimension
(`campaigns.breaking_line.theory`) is the reference.
"""

import tomllib
from dataclasses import dataclass, field
from pathlib import Path

import engine

BUOY = "tethered_buoy"
RADIUS, PLACE, STRAIN = "radius", "place", "strain"
UNITS = {RADIUS: "mm", PLACE: "mm", STRAIN: "%"}
PERIOD_S = 5.0


@dataclass(frozen=True)
class Work:
    """One work: a shipped scene with the changes of a set and its own.

    rough: why methods do not show their orders on it, "" where it is smooth. reference, checks: (nodes, rtol) of the
    reference and of runs that show how far it is converged; no reference: the exact solution. The wave period, or
    1 s where there is none, is what steps per period are counted in. timed: False for a work that shows orders only.
    """

    name: str
    title: str
    scene: str
    set: str
    changes: dict
    duration_s: float
    measure: str
    rough: str = ""
    reference: tuple[int, float] | None = None
    checks: tuple[tuple[int, float], ...] = ()
    period_s: float = PERIOD_S
    timed: bool = True

    def made(self, changes: dict):
        """The scene with further changes. Raises SceneError."""
        own = {**FILE["sets"][self.set], **self.changes}
        return engine.load_scene(self.scene, {key: None if own[key] == "none" else own[key] for key in own} | changes)


@dataclass(frozen=True, eq=False)
class Peer:
    """Another code. package, module: as installed and as imported.

    settings, quick: (nodes or segments, value) that are timed, by work; control: what the value is. refined: its
    reference, then a check, by work; none: ours is its own. ours: changes of the scene with which our refined run is
    the one to compare with. notes: what is left different.
    """

    name: str
    package: str
    module: str
    control: str
    notes: str
    settings: dict[str, list]
    quick: dict[str, list] = field(default_factory=dict)
    refined: dict[str, list] = field(default_factory=dict)
    ours: dict[str, object] = field(default_factory=dict)


FILE = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))
BY_NAME = {name: Work(name, **row) for name, row in FILE["works"].items()}
WORKS = tuple(BY_NAME.values())
PEERS = tuple(Peer(name, **row) for name, row in FILE["peers"].items())
