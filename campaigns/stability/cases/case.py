"""What a case of `campaigns.stability` is: a scene, its length, its check, and the endings that are expected."""

from dataclasses import dataclass, field

REGULAR = {"waves.steepness": 0.016, "water.depth_m": 22.5}
VIOLENT = {"waves.steepness": 0.13, "water.depth_m": 21.6}
DRY = {"water": None, "waves": None}
STILL = {"waves": None}
SPACE = {"motion.dimensions": 3}
REFUSED, ABOVE_BAR = "refused", "above bar"


@dataclass(frozen=True)
class Ending:
    """An expected ending besides "ok" with the check below its bar, and why it is expected.

    statuses: of runs that end early; REFUSED for a scene that the engine does not accept; ABOVE_BAR for a check that
    may fail.
    """

    statuses: tuple[str, ...] = ()
    why: str = ""


AS_ASKED, NOT_STARTED = Ending(), Ending((REFUSED,))
CHAOS = Ending(
    (ABOVE_BAR,), "the motion is sensitive: its own rounding grows, and no two tolerances give one path for long"
)
FINITE, REST = {"check": "finite", "bar": 0.0}, {"check": "rest", "bar": 1e-6}


@dataclass(frozen=True)
class Case:
    """One row of the table.

    changes: keys of the scene; check: a function of `campaigns.stability.checks`; bar: what the number that it measures
    must stay below; ending: what else is expected; quick: whether the case is also part of `--quick`.
    """

    group: str
    name: str
    changes: dict
    length_s: float = 10.0
    check: str = "refined"
    bar: float = 0.02
    ending: Ending = AS_ASKED
    quick: bool = False
    options: dict = field(default_factory=dict)


def over(group: str, name: str, key: str, values: tuple, base: dict | None = None, quick: tuple = (), **rest):
    """A case for each value of a key of the scene. name: a format of the value; quick: values; rest: of every case."""
    return [
        Case(group, name.format(value), {**(base or {}), key: value}, quick=value in quick, **rest) for value in values
    ]


def held(x: float, y: float, z: float) -> dict:
    """Changes that hold the upper end at (x, y, z), m."""
    return {"end": {"kind": "held", "position_m": [float(x), float(y), float(z)]}, "buoy": None}


def free(x: float, y: float, z: float) -> dict:
    """Changes that leave the upper end free under the force (x, y, z), N."""
    return {"end": {"kind": "free", "force_N": [float(x), float(y), float(z)]}, "buoy": None}
