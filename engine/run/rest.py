"""Where a scene begins: the line at rest, its buoy displaced where the scene says so; and the static tension."""

import math
from typing import NamedTuple

import numpy as np

from ..parameters import numbers_of
from ..physics.strains import tension_at
from ..planar.columns import EPS, PHI  # in space EPS is the same column
from ..record import arc_lengths, is_spatial
from ..scene.models import Scene
from ..spatial import lift
from ..time.held_start import held_away, why_not_held
from ..time.statics import largest_turn, static_equilibrium, why_no_rest
from ..time.status import OK, STATICS_FAILED, TURN_UNRESOLVED
from ..trajectory.columns import Columns


class Rest(NamedTuple):
    """A scene at rest.

    status    OK, or why there is none (`engine.time.status`)
    fault     why statics failed: the end of the sentence that `status.ADVICE` begins; else empty
    Y         unknowns (n, 6 or 13), with velocities of zero
    top_N     tension at the upper end
    turn      largest turn (rad) in one element
    """

    status: int
    fault: str
    Y: np.ndarray
    top_N: float
    turn: float


def rest_of(scene: Scene) -> Rest:
    """The static equilibrium of a scene."""
    record, tables = numbers_of(scene)
    fault = why_no_rest
    status, Y = static_equilibrium(record, scene, tables)
    if status == OK and any(scene.start.buoy_displacement_m):
        fault = why_not_held
        status, Y = held_away(scene, Y, arc_lengths(record, tables))
    if not record["bent"]:  # a whole turn in an element is none where nothing resists bending
        if is_spatial(record):
            lift.unwind(Y)
        else:
            Y[:, PHI] = np.unwrap(Y[:, PHI])
    turn = largest_turn(Y)
    if status == OK and record["bent"] and turn > math.pi:
        status = TURN_UNRESOLVED
    words = fault(record, scene) if status == STATICS_FAILED else ""
    return Rest(status, words, Y, tension_at(float(Y[-1, EPS]), scene.tether.tension), turn)


def static_tension_N(scene: Scene, columns: Columns) -> float:
    """Tension at the top of the line at rest: of the first sample of a run that began so, else of the static start.

    columns: of a trajectory of the scene. NaN where the scene has no equilibrium. What a line without weight bears,
    buoyancy less weight of the buoy, is in `engine.natural_frequencies`.
    """
    resting = columns["radius_rate_mps"][0] == 0.0 == columns["angle_rate_radps"][0]
    if resting and not any(scene.start.buoy_displacement_m):
        return float(columns["tension_top_N"][0])
    rest = rest_of(scene.with_values("start", buoy_displacement_m=(0.0, 0.0, 0.0)))
    return rest.top_N if rest.status == OK else np.nan
