"""Where a run left what its laws are made for, in words: a whole sphere in the air, a line below the bed.

A sphere counts as in the air where its lowest point is above the linear wave: its top is then more than a diameter
above the water, and nothing of its constant buoyancy, eq. (30), is there. Less than that is a part of it.
"""

import re
from collections.abc import Iterator, Mapping

import numpy as np

from ..scene.models import Scene

AIR = (
    "the sphere was in the air for {share:.2g} % of the time from t = {first:.5g} to {last:.5g} s, its lowest point up "
    "to {most:.2g} m above the water, and kept its whole buoyancy there (buoy.submergence = 'full'): "
)
CAP = "'spherical-cap' loads what is below the wave"
NO_CAP = (
    "loads of an irregular sea hold where it stays in the water; waves.above_still_water = 'zero' adds none up there"
)
BED = (
    "the line was up to {most:.2g} m below the bed (first at t = {first:.5g} s), because the scene has no floor: "
    "floor.stiffness_Npm3 = 1e5 adds one"
)
_BEGINNING = re.compile("[;:]? ?(?=the sphere was in the air|the line was up to)")


def message_of(own: str, scene: Scene, columns: Mapping[str, np.ndarray], status: str) -> str:
    """The message of a run: what the engine says of it, and where it left the water or went below the bed.

    A run that failed with its sphere in the air says so in place of advice on steps, which helps nowhere there. own:
    may be such a message, whose excursions are found anew.
    """
    own = own_words(own)
    if scene.water is None or not len(columns["time_s"]):
        return own
    height = above_the_wave(scene, columns)
    if status != "ok" and height[-1] > 0.0:
        event = re.sub(": [^:]*$", "", own)
        return f"{event}: {'; '.join(_excursions(scene, columns, height))}"
    return "; ".join(filter(None, (own, *_excursions(scene, columns, height))))


def own_words(message: str) -> str:
    """A message without its excursions: what the engine says of a run itself."""
    return _BEGINNING.split(message)[0]


def _excursions(scene: Scene, columns: Mapping[str, np.ndarray], height: np.ndarray) -> Iterator[str]:
    time_s, depth = columns["time_s"], -scene.anchor.position_m[2] - columns["line_lowest_m"]
    flying, buried = height > 0.0, depth > scene.tether.diameter_m
    if flying.any():
        first, last = time_s[flying][[0, -1]]
        said = AIR.format(share=100.0 * flying.mean(), first=first, last=last, most=height[flying].max())
        yield said + (NO_CAP if scene.waves is not None and scene.waves.irregular else CAP)
    if scene.floor is None and buried.any():
        yield BED.format(most=depth[buried].max(), first=time_s[buried][0])


def above_the_wave(scene: Scene, columns: Mapping[str, np.ndarray]) -> np.ndarray:
    """Height (m) of the lowest point of a buoy without a cap above the linear wave at its place; -inf without one."""
    from ..physics.sea import elevation_m

    if scene.buoy is None or scene.buoy.submergence != "full":
        return np.full(len(columns["time_s"]), -np.inf)
    lowest_m = scene.anchor.position_m[2] + columns["z_m"] - 0.5 * scene.buoy.diameter_m - scene.water.depth_m
    if scene.waves is None:
        return lowest_m
    with np.errstate(all="ignore"):  # places of a run that blew up
        return lowest_m - elevation_m(scene, *(columns[name] for name in ("time_s", "x_m", "y_m")))
