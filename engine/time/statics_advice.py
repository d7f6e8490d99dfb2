"""Why a scene has no static equilibrium, in words: what can be told from its loads and its tension law alone."""

import math

import numpy as np

from ..record import BUOY, FREE
from ..scales import tension_at
from ..scene.models import Scene

MOST_STRAIN = 10.0  # up to which the engine looks for the strain under a load (`scales.strain_at`)
NEARLY_NOTHING = -0.99  # a strain at which next to nothing is left of the line


def why_no_rest(record: np.void, scene: Scene) -> str:
    """Why `statics.settle` found no rest, as far as is known: the end of the sentence that `guards.ADVICE` begins."""
    law, loads = scene.tether.tension, loads_of(record, scene)
    if loads is not None:
        largest = max(loads)
        carried = tension_at(MOST_STRAIN, law)
        if largest > carried:
            return (
                f"the line has to carry {largest:.4g} N, and tether.tension gives {carried:.4g} N at a strain of "
                f"{MOST_STRAIN:g}; lower the load or raise the stiffness"
            )
        if largest == 0 and not record["bent"]:
            return (
                "nothing pulls on the line and it has no bending stiffness, so that nothing gives it a shape; add "
                "gravity, a force or tether.bending_stiffness_Nm2"
            )
    pull = tension_at(NEARLY_NOTHING, law)
    if pull > 0 and (loads is None or pull > min(loads)):
        return (
            f"tether.tension still pulls with {pull:.4g} N at a strain of {NEARLY_NOTHING:g}; let it fall to zero "
            "where the line is not stretched"
        )
    if record["spherical_cap"]:
        return (
            "the iteration did not settle; where the buoy floats on a slack line (buoy.submergence 'spherical-cap'), "
            "give the line more tether.nodes or tether.bending_stiffness_Nm2, or make water.depth_m larger than its "
            "length"
        )
    return (
        "the iteration did not settle; try more tether.nodes, a tether.tension with stiffness in compression too, a "
        "weaker current, or a held end that the line reaches without being folded"
    )


def loads_of(record: np.void, scene: Scene) -> tuple[float, float] | None:
    """Static forces (N) at the upper and at the lower end, without current.

    None where they follow from the place: of a held end, and of a buoy that may come out of the water.
    """
    if record["end"] == BUOY and not record["spherical_cap"]:
        side, up = 0.0, float(record["lift"])
    elif record["end"] == FREE:
        x, y, up = scene.end.force_N
        side = math.hypot(x, y)
    else:
        return None
    return math.hypot(side, up), math.hypot(side, up - float(record["w0"]) * scene.tether.length_m)
