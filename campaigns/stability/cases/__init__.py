"""The cases of `campaigns.stability`: what is run, for how long, how it is judged, and which endings are expected.

Every case starts from a shipped scene. `check` names a function of `campaigns.stability.checks`. `ends` names what is
expected besides a run that ends "ok" with its check below the bar, and `limit` says why: statuses of runs that end
early, REFUSED for a scene that the engine does not accept, ABOVE_BAR for a check that may fail.
"""

from dataclasses import dataclass, field

REGULAR = {"waves.steepness": 0.016, "water.depth_m": 22.5}
VIOLENT = {"waves.steepness": 0.13, "water.depth_m": 21.6}
DRY = {"water": None, "waves": None}
STILL = {"waves": None}
SPACE = {"motion.dimensions": 3}
REFUSED, ABOVE_BAR = "refused", "above bar"
CHAOS = "the motion is sensitive: its own rounding grows, and no two tolerances give one path for long"


@dataclass(frozen=True)
class Case:
    """One row of the table. bar: what the measured number must stay below; quick: also in `--quick`."""

    group: str
    name: str
    changes: dict
    length_s: float
    check: str = "finite"
    bar: float = 0.0
    ends: tuple[str, ...] = ()
    limit: str = ""
    scene: str = "tethered_buoy"
    quick: bool = False
    options: dict = field(default_factory=dict)


def held(x, y, z):
    """Changes that hold the upper end at (x, y, z), m."""
    return {"end": {"kind": "held", "position_m": [float(x), float(y), float(z)]}, "buoy": None}


def free(x, y, z):
    """Changes that leave the upper end free under the force (x, y, z), N."""
    return {"end": {"kind": "free", "force_N": [float(x), float(y), float(z)]}, "buoy": None}


def all_cases() -> list[Case]:
    """Every case, in the order of the report."""
    from campaigns.stability.cases import inputs, line, motion, surface

    groups = (
        line.bending, line.stretching, line.laws, line.grids,
        line.masses, motion.water, motion.waves, surface.surface,
        motion.starts, motion.snaps, motion.compression, motion.steps, inputs.inputs,
    )  # fmt: skip
    return [case for group in groups for case in group()]
