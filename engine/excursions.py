"""Where a run left what its laws are made for, in words: a whole sphere in the air, a line below the bed.

A sphere counts as in the air where its lowest point is above the linear wave: its top is then more than a diameter
above the water, and nothing of its constant buoyancy, eq. (30), is there. Less than that is a part of it.
"""

import math
from collections.abc import Mapping

import numpy as np

from .physics.sea import elevation_m
from .scene.models import Scene

AIR = (
    "the sphere was in the air for {share:.2g} % of the time ({when}, its lowest point up to {most:.2g} m above the "
    "water) and kept its whole buoyancy there (buoy.submergence = 'full'): {cure}"
)
CAP = "'spherical-cap' loads what is below the wave"
NO_CAP = "loads of an irregular sea are sound only where it stays in the water"
LEAPS_LEAST = ", and waves.above_still_water = 'zero' makes it leap least"
BED = (
    "the line was up to {depth:.2g} m below the bed (first at t = {first:.5g} s), because the scene has no floor: "
    "floor.stiffness_Npm3 = 1e5 adds one"
)


def message_of(own: str, scene: Scene, columns: Mapping[str, np.ndarray], ended_early: bool) -> str:
    """The message of a run: the engine's own words, and where it left the water or went below the bed.

    A run that ended early with its sphere in the air gets this in place of advice on steps, which helps nowhere there.
    """
    air, bed, aloft = excursions(scene, columns)
    if ended_early and aloft:
        own, air = f"{own.partition(': ')[0]}: {air}", ""
    return "; ".join(filter(None, (own, air, bed)))


def own_words(message: str, scene: Scene, columns: Mapping[str, np.ndarray]) -> str:
    """What `message_of` was given."""
    for sentence in excursions(scene, columns)[:2]:
        message = message.replace(sentence, "")
    return message.strip(":; ")


def excursions(scene: Scene, columns: Mapping[str, np.ndarray]) -> tuple[str, str, bool]:
    """A sentence on the sphere in the air and one on the line below the bed, each empty where there is nothing to say;
    whether the record ends in the air."""
    time_s, air, bed, aloft = columns["time_s"], "", "", False
    if scene.water is None or not len(time_s):
        return air, bed, aloft
    depth = -scene.anchor.position_m[2] - columns["line_lowest_m"]
    if scene.floor is None and (below := depth > scene.tether.diameter_m).any():
        bed = BED.format(depth=depth[below].max(), first=time_s[below][0])
    if scene.buoy is not None and scene.buoy.submergence == "full":
        height = above_the_wave(scene, columns)
        flying = height > 0.0
        if flying.any():
            aloft, when = bool(flying[-1]), f"first at t = {time_s[flying][0]:.5g} s"
            if aloft:
                begin_s = time_s[np.append(np.flatnonzero(~flying) + 1, 0).max()]
                when += f", last from t = {begin_s:.5g} s to the end"
            air = AIR.format(share=100.0 * flying.mean(), when=when, most=height[flying].max(), cure=_cure(scene))
    return air, bed, aloft


def height_at_rest(scene: Scene, top_m: float) -> float:
    """Height (m) above still water of the centre of a buoy without a cap, top_m above the anchor; without one -inf."""
    if scene.water is None or scene.buoy is None or scene.buoy.submergence != "full":
        return -math.inf
    return scene.anchor.position_m[2] + top_m - scene.water.depth_m


def above_the_wave(scene: Scene, columns: Mapping[str, np.ndarray]) -> np.ndarray:
    """Height (m) of the lowest point of a buoy above the linear wave at its place, at each sample of a run."""
    surface_m = scene.water.depth_m
    if scene.waves is not None:
        with np.errstate(all="ignore"):  # places of a run that blew up
            surface_m = surface_m + elevation_m(scene, *(columns[name] for name in ("time_s", "x_m", "y_m")))
    return scene.anchor.position_m[2] + columns["z_m"] - 0.5 * scene.buoy.diameter_m - surface_m


def _cure(scene: Scene) -> str:
    if scene.waves is None or not scene.waves.irregular:
        return CAP
    return NO_CAP if scene.waves.above_still_water == "zero" else NO_CAP + LEAPS_LEAST
