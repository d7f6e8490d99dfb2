"""The start with the buoy displaced: static equilibrium of the line, its upper end held where the buoy is let go."""

import math

import numpy as np

from .. import parameters
from ..scene.models import Scene
from ..scene.sections import End
from ..spatial import lift
from .statics import MOST_STRAIN, static_equilibrium
from .status import STATICS_FAILED


def held_away(scene: Scene, rest: np.ndarray, s: np.ndarray) -> tuple[int, np.ndarray]:
    """Equilibrium with the buoy held at start.buoy_displacement_m from its rest (n, 6 or 13): a status code, the state.

    s (n,): unstretched arc length (m). A line that would hang slack hangs as an arc, a short one is stretched.
    """
    axes = [0, 1, 2] if rest.shape[1] == 13 else [0, 2]
    place = np.zeros(3)
    place[axes] = np.trapezoid(lift.stretch_vectors(rest), s, axis=0)
    place += scene.start.buoy_displacement_m
    if math.hypot(*place) > (1.0 + MOST_STRAIN) * s[-1]:
        return STATICS_FAILED, rest
    held = scene.model_copy(update={"end": End(kind="held", position_m=tuple(place)), "buoy": None})
    record, tables = parameters.numbers_of(held)
    return static_equilibrium(record, held, tables)


def why_not_held(record: np.void, scene: Scene) -> str:
    """Why `held_away` found no rest: the end of the sentence that `status.ADVICE` begins."""
    return (
        f"start.buoy_displacement_m = {list(scene.start.buoy_displacement_m)} m moves the buoy from its place at rest "
        f"to where the line does not settle, or is stretched by more than {MOST_STRAIN:g} times its length; displace "
        "it less"
    )
