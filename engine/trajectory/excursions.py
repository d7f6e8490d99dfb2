"""Where a run left what its laws are made for, in words: a sphere out of the water, a line below the bed.

A sphere counts as in the air where its lowest point is above the linear wave: nothing of its constant buoyancy,
eq. (30), is there. A sphere that is partly out of the water has too much buoyancy, too. This can spoil the tension as
much: with two thirds of a buoy of 4 m dry, a sea of H_s = 6 m pulled with 308 kN in place of 447 kN (docs/scenes.md).
"""

import math
from collections.abc import Iterator

import numpy as np

from ..scene.models import Scene
from .columns import Columns

AIR = (
    "the sphere was in the air for {share:.2g} % of the time from t = {first:.5g} to {last:.5g} s, its lowest point up "
    "to {most:.2g} m above the water, and kept its whole buoyancy there (buoy.submergence = 'full'): "
)
PART = (
    "the sphere was up to {share:.0f} % of its diameter out of the water, and kept its whole buoyancy "
    "(buoy.submergence = 'full'): "
)
CAP = "'spherical-cap' loads what is below the wave"
BED = (
    "the line was up to {most:.2g} m below the bed (first at t = {first:.5g} s), because the scene has no floor: "
    "floor.stiffness_Npm3 = 1e5 adds one"
)
SINKS = (
    "the buoy is up to {most:.2g} m under the bed (first at t = {first:.5g} s), because it sinks: it has a mass of "
    "{mass:.5g} kg and displaces {displaced:.5g} kg of water; lower buoy.mass_kg"
)
STOPS = (
    "the middle of the sphere was above still water for {share:.0f} % of the time, where 'zero' stops the water: "
    "compare waves.above_still_water = 'wheeler', which may double the tension"
)
OFTEN = 0.05  # share of the time above still water from which waves that end there decide the load
EMERGES = 0.05  # share of its diameter by which a sphere is out of the water: 0.7 % of its volume


def with_excursions(own_message: str, scene: Scene, columns: Columns, status: str) -> tuple[str, str]:
    """The message of a run, and the part of it that tells where the run left the water or went below the bed.

    own_message: what the engine says of the run, "event" or "event: advice". A run that failed with its sphere in the
    air says so in place of advice on steps, because such advice helps nowhere there.
    """
    excursions = "; ".join(excursions_of(scene, columns))
    if not excursions:
        return own_message, ""
    if status != "ok" and height_above_wave(scene, columns)[-1] > 0.0:
        event = own_message.rpartition(": ")[0] or own_message
        return f"{event}: {excursions}", excursions
    return "; ".join(filter(None, (own_message, excursions))), excursions


def named_end(status: str, scene: Scene, columns: Columns) -> str:
    """The status of a run; `left-the-water` where the numerics failed in a sea with the sphere in the air.

    Up there it keeps all its buoyancy, and the first pull of the line after that means nothing.
    """
    irregular = scene.waves is not None and scene.waves.irregular
    if status == "ok" or not irregular or not len(columns["time_s"]):
        return status
    return "left-the-water" if height_above_wave(scene, columns)[-1] > 0.0 else status


def excursions_of(scene: Scene, columns: Columns) -> Iterator[str]:
    """A sentence for each way in which a run left what its laws are made for."""
    time_s = columns["time_s"]
    if scene.water is None or not len(time_s):
        return
    height = height_above_wave(scene, columns)
    flying, share = height > 0.0, _share_out(scene, height)
    if flying.any():
        first, last = time_s[flying][[0, -1]]
        words = AIR.format(share=100.0 * flying.mean(), first=first, last=last, most=height[flying].max())
        yield words + CAP
    elif share is not None and share > EMERGES:
        yield PART.format(share=100.0 * share) + CAP
    buoy, waves = scene.buoy, scene.waves
    if buoy is not None and waves is not None and waves.irregular and waves.above_still_water == "zero":
        above = float(np.mean(scene.anchor.position_m[2] + columns["z_m"] > scene.water.depth_m))
        if above > OFTEN:
            yield STOPS.format(share=100.0 * above)
    if buoy is not None:
        displaced_kg = scene.water.density_kgpm3 * math.pi * buoy.diameter_m**3 / 6.0
        below = -scene.anchor.position_m[2] - columns["z_m"]
        hanging = below > 0.5 * buoy.diameter_m
        if buoy.mass_kg > displaced_kg and hanging.any():
            masses = {"mass": buoy.mass_kg, "displaced": displaced_kg}
            yield SINKS.format(most=below[hanging].max(), first=time_s[hanging][0], **masses)
            return
    depth = -scene.anchor.position_m[2] - columns["line_lowest_m"]
    buried = depth > scene.tether.diameter_m
    if scene.floor is None and buried.any():
        yield BED.format(most=depth[buried].max(), first=time_s[buried][0])


def emergence(scene: Scene, columns: Columns) -> float | None:
    """Largest share of the diameter of a sphere without a cap above the linear wave, 1 in the air; None without one."""
    if scene.water is None or not len(columns["time_s"]):
        return None
    return _share_out(scene, height_above_wave(scene, columns))


def _share_out(scene, height):
    """`emergence` from the heights of `height_above_wave`."""
    highest_m = float(height.max())
    if highest_m == -np.inf:
        return None
    return max(0.0, 1.0 + highest_m / scene.buoy.diameter_m)


def height_above_wave(scene: Scene, columns: Columns) -> np.ndarray:
    """Height (m) of the lowest point of a buoy without a cap above the linear wave at its place; -inf without one."""
    if scene.buoy is None or scene.buoy.submergence != "full":
        return np.full(len(columns["time_s"]), -np.inf)
    lowest_m = scene.anchor.position_m[2] + columns["z_m"] - 0.5 * scene.buoy.diameter_m - scene.water.depth_m
    if scene.waves is None:
        return lowest_m
    from ..physics.sea import elevation_m

    with np.errstate(all="ignore"):  # places of a run that blew up
        x_m, y_m = (scene.anchor.position_m[axis] + columns[name] for axis, name in enumerate(("x_m", "y_m")))
        return lowest_m - elevation_m(scene, columns["time_s"], x_m, y_m)
