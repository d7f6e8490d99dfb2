"""Cases of `campaigns.stability` with a buoy partly out of the water, and in irregular seas."""

import math

from campaigns.stability.cases import ABOVE_BAR, CHAOS, SPACE, STILL, Case


def surface() -> list[Case]:
    """A buoy partly out of the water, and irregular seas."""
    cap = {"buoy.submergence": "spherical-cap", "water.depth_m": 21.0}
    cases = [
        Case("surface", "cap, afloat on a slack tether", {**STILL, **cap, "water.depth_m": 19.5}, 20.0, "stays", 1e-4),
        Case("surface", "cap, half out of the water", {**STILL, **cap, "water.depth_m": 20.5}, 20.0, "stays", 1e-4),
    ]
    for steepness, ends, limit in ((0.016, (), ""), (0.13, (ABOVE_BAR,), CHAOS), (0.4, (ABOVE_BAR,), CHAOS)):
        change = {**cap, "waves.steepness": steepness}
        name = f"cap, kA = {steepness:g}"
        cases.append(Case("surface", name, change, 25.0, "refined", 0.05, ends, limit, quick=steepness == 0.4))
    violent = {**cap, "waves.steepness": 0.13}
    cases.append(
        Case("surface", "cap, kA = 0.13, in space", {**violent, **SPACE}, 15.0, "refined", 0.05, (ABOVE_BAR,), CHAOS)
    )
    for word, speed in (("up", 10.0), ("down", -10.0)):
        change = {**STILL, **cap, "start.buoy_velocity_mps": [0.0, 0.0, speed]}
        cases.append(
            Case("surface", f"cap, a kick of 10 m/s {word}", change, 10.0, "refined", 0.02, quick=word == "up")
        )
    for height_m in (0.5, 4.0):
        sea = {"waves": {"period_s": 5.0, "jonswap": {"significant_height_m": height_m}}, "water.depth_m": 22.5}
        ends, limit = ((ABOVE_BAR,), CHAOS) if height_m > 1 else ((), "")
        cases.append(
            Case(
                "surface", f"JONSWAP, Hs = {height_m:g} m", sea, 25.0, "refined", 0.05, ends, limit, quick=height_m < 1
            )
        )
    crossing = [
        {"period_s": 5.0, "amplitude_m": 0.1},
        {"period_s": 7.0, "amplitude_m": 0.2, "direction_rad": 0.5 * math.pi},
    ]
    across = {"waves": {"period_s": 5.0, "components": crossing}, "water.depth_m": 22.5, **SPACE}
    cases.append(Case("surface", "two waves that cross, in space", across, 15.0, "refined", 0.05))
    return cases
