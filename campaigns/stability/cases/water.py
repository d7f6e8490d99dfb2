"""Cases of `campaigns.stability` in which the water is extreme: none, currents, steep waves, a buoy half out, seas."""

import math

from campaigns.stability.cases.case import CHAOS, DRY, FINITE, REGULAR, REST, SPACE, STILL, Case, Ending, over

ABOVE = Ending(("not-finite",), "Airy waves continued far above still water grow without bound")


def _uniform(*velocity_mps: float) -> dict:
    return {"current": {"law": "uniform", "velocity_mps": list(velocity_mps)}}


# None, still, currents strong and sheared.
_PENDULUM = {**DRY, "tether.bending_stiffness_Nm2": 0.4, "solver.rtol": 1e-3}
_THROWN, _ACROSS = {"start.buoy_velocity_mps": [1.0, 0.0, 0.0]}, {"start.buoy_velocity_mps": [1.0, 0.5, 0.0]}
_ENERGY = {"length_s": 20.0, "check": "energy", "bar": 0.01}
_STAYS = {"length_s": 20.0, "check": "stays", "bar": 1e-4}
_SHEAR = {
    "law": "profile",
    "height_m": [0.0, 10.0, 22.0],
    "velocity_mps": [[-3.0, 0.0, 0.0], [0.0, 0.0, 0.0], [3.0, 0.0, 0.0]],
}
_SPEEDS = (1.0, 5.0, 20.0)
WATER = [
    Case("water", "no water: a pendulum", {**_PENDULUM, **_THROWN}, **_ENERGY, quick=True),
    Case("water", "no water: a pendulum in space", {**_PENDULUM, **SPACE, **_ACROSS}, **_ENERGY),
    Case("water", "still water", STILL, 60.0, **REST, quick=True),
    Case("water", "still water, in space", {**STILL, **SPACE}, 20.0, **REST),
    *(Case("water", f"current {v:g} m/s, at rest", {**STILL, **_uniform(v, 0.0, 0.0)}, **_STAYS) for v in _SPEEDS),
    *(Case("water", f"current {v:g} m/s, regular wave", {**REGULAR, **_uniform(v, 0.0, 0.0)}) for v in _SPEEDS),
    Case("water", "shear from −3 to 3 m/s", {**STILL, "current": _SHEAR}, **_STAYS, quick=True),
    Case("water", "5 m/s across the waves, in space", {**REGULAR, **SPACE, **_uniform(0.0, 5.0, 0.0)}),
]

# Steepness to 0.4, periods from 0.5 to 60 s.
_KA, _PERIOD = "waves.steepness", "waves.period_s"
_LONG = {"length_s": 25.0, "bar": 0.05}
_LIMITS = {**_LONG, "ending": CHAOS}
_SLOW = {"waves.steepness": 0.3, "water.depth_m": 22.5}
_FAR = {"tether.tension.stiffness_N": 100.0, "waves.period_s": 1.0}
WAVES = [
    *over("waves", "kA = {:g}", _KA, (0.05, 0.1), **_LONG),
    *over("waves", "kA = {:g}", _KA, (0.2, 0.3, 0.4), quick=(0.4,), **_LIMITS),
    *over(
        "waves",
        "kA = 0.4, above still water: {}",
        "waves.above_still_water",
        ("zero", "wheeler"),
        {_KA: 0.4},
        **_LIMITS,
    ),
    Case("waves", "kA = 0.4, in space", {_KA: 0.4, **SPACE}, 15.0, bar=0.05, ending=CHAOS),
    *(
        Case("waves", f"period {T:g} s, kA = 0.016", {**REGULAR, _PERIOD: T}, max(4 * T, 5.0), quick=T in (0.5, 60.0))
        for T in (0.5, 1.0, 2.0, 10.0, 20.0, 60.0)
    ),
    *(
        Case("waves", f"period {T:g} s, kA = 0.3", {**_SLOW, _PERIOD: T}, 4 * T, bar=0.05, ending=CHAOS)
        for T in (0.5, 2.0, 20.0)
    ),
    Case("waves", "a buoy 400 m above the water, period 1 s", _FAR, 5.0, **FINITE, ending=ABOVE, quick=True),
]

# A buoy partly out of the water, and irregular seas.
_CAP = {"buoy.submergence": "spherical-cap", "water.depth_m": 21.0}


def _kicked(speed_mps: float) -> dict:
    return {**STILL, **_CAP, "start.buoy_velocity_mps": [0.0, 0.0, speed_mps]}


def _jonswap(height_m: float) -> dict:
    return {"waves": {"period_s": 5.0, "jonswap": {"significant_height_m": height_m}}, "water.depth_m": 22.5}


_CROSSING = [
    {"period_s": 5.0, "amplitude_m": 0.1},
    {"period_s": 7.0, "amplitude_m": 0.2, "direction_rad": 0.5 * math.pi},
]
_CROSSED = {"waves": {"period_s": 5.0, "components": _CROSSING}, "water.depth_m": 22.5, **SPACE}
SURFACE = [
    Case("surface", "cap, afloat on a slack tether", {**STILL, **_CAP, "water.depth_m": 19.5}, **_STAYS),
    Case("surface", "cap, half out of the water", {**STILL, **_CAP, "water.depth_m": 20.5}, **_STAYS),
    *over("surface", "cap, kA = {:g}", _KA, (0.016,), _CAP, **_LONG),
    *over("surface", "cap, kA = {:g}", _KA, (0.13, 0.4), _CAP, quick=(0.4,), **_LIMITS),
    Case("surface", "cap, kA = 0.13, in space", {**_CAP, _KA: 0.13, **SPACE}, 15.0, bar=0.05, ending=CHAOS),
    Case("surface", "cap, a kick of 10 m/s up", _kicked(10.0), quick=True),
    Case("surface", "cap, a kick of 10 m/s down", _kicked(-10.0)),
    Case("surface", "JONSWAP, Hs = 0.5 m", _jonswap(0.5), **_LONG, quick=True),
    Case("surface", "JONSWAP, Hs = 4 m", _jonswap(4.0), **_LIMITS),
    Case("surface", "two waves that cross, in space", _CROSSED, 15.0, bar=0.05),
]

CASES = [*WATER, *WAVES, *SURFACE]
