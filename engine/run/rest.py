"""What a scene is at rest, for runs that began elsewhere."""

from collections.abc import Mapping

import numpy as np

from ..physics.strains import tension_at
from ..planar.columns import EPS  # in space the same column
from ..scene.models import Scene
from . import Run


def static_tension_N(scene: Scene, columns: Mapping[str, np.ndarray]) -> float:
    """Tension at the top of the line at rest: of the first sample of a run that began so, else of the static start.

    columns: of a trajectory of the scene. NaN where the scene has no equilibrium.
    """
    displaced = any(scene.start.buoy_displacement_m)
    if columns["radius_rate_mps"][0] == 0.0 == columns["angle_rate_radps"][0] and not displaced:
        return float(columns["tension_top_N"][0])
    start = scene.start.model_copy(update={"buoy_displacement_m": (0.0, 0.0, 0.0)})
    rest = Run(scene.model_copy(update={"start": start}), 0.0)
    return tension_at(float(rest.motion.Y[-1, EPS]), scene.tether.tension) if rest.state["status"] == 0 else np.nan
