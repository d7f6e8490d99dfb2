"""Cases of `campaigns.stability` in which the line itself is extreme: stiffness, tension law, grid, mass."""

from campaigns.stability.cases.case import (
    ABOVE_BAR,
    DRY,
    FINITE,
    REFUSED,
    REGULAR,
    REST,
    SPACE,
    STILL,
    VIOLENT,
    Case,
    Ending,
    over,
)

ILL_POSED = Ending(
    ("newton-failed", "strain-below-minus-one", "step-limit"),
    "without bending stiffness slack is ill-posed: ever shorter buckles grow ever faster",
)
UNSTABLE = Ending(
    (ABOVE_BAR,),
    "statics finds a rest, here a line standing on its lower part, and not always a stable one: it falls over",
)
COARSE = Ending((ABOVE_BAR,), "loops and folds of the slack rope are far smaller than an element")
YIELDS = Ending(("statics-failed",), "the law yields below the buoy's lift, so that no strain carries it")
SHAPELESS = Ending(("statics-failed", REFUSED), "nothing gives the line a shape")
_COLLAPSE = "the law has no stiffness in compression: a slack line collapses to nothing"
COLLAPSE = Ending(("strain-below-minus-one", "step-limit", "newton-failed"), _COLLAPSE)
BARRED = Ending(("newton-failed", "step-limit"), _COLLAPSE)

# Bending stiffness from 0 to 1e4 N m2, regular and violent.
_EI = "tether.bending_stiffness_Nm2"
_LIMP = {**VIOLENT, _EI: 0.0}
_KICKED = {**REGULAR, **SPACE, "start.buoy_velocity_mps": [0.0, 0.01, 0.0]}
_REGULAR_EI, _VIOLENT_EI = (0.0, 1e-8, 1e-4, 0.4, 40.0, 1e4), (1e-3, 0.1, 0.4, 4.0, 40.0, 1e4)
BENDING = [
    *over("EI", "EI = {:g}, regular wave", _EI, _REGULAR_EI, REGULAR, quick=(0.0, 1e4), length_s=15.0),
    *over("EI", "EI = {:g}, snapping wave", _EI, _VIOLENT_EI, VIOLENT, length_s=20.0),
    Case("EI", "EI = 0, snapping wave", _LIMP, 60.0, **FINITE, ending=ILL_POSED, quick=True),
    Case("EI", "EI = 0, snapping wave, in space", {**_LIMP, **SPACE}, 60.0, **FINITE, ending=ILL_POSED),
    *over("EI", "EI = {:g}, regular wave, in space", _EI, (0.0, 0.4, 1e4), _KICKED),
]

# EA from 1e-2 to 1e4 times that of Table 1; the buoy floats where the rope ends, so a soft rope needs deeper water.
_EA = "tether.tension.stiffness_N"
_DEPTH_M = {5e2: 150.0, 5e3: 40.0, 5e4: 22.5, 5e5: 22.5, 5e6: 22.5, 5e8: 22.5}
_ENDS = (5e2, 5e8)
STRETCHING = [
    case
    for EA, depth_m in _DEPTH_M.items()
    for case in (
        *over(
            "EA", "EA = {:g} N, at rest", _EA, (EA,), {**STILL, "water.depth_m": depth_m}, _ENDS, length_s=20.0, **REST
        ),
        *over("EA", "EA = {:g} N, regular wave", _EA, (EA,), {**REGULAR, "water.depth_m": depth_m}, length_s=15.0),
    )
] + [
    case
    for EA in _ENDS
    for case in over(
        "EA", "EA = {:g} N, regular wave, in space", _EA, (EA,), {**REGULAR, **SPACE, "water.depth_m": _DEPTH_M[EA]}
    )
]

# Tension laws whose slope f' vanishes: laws that yield near the load, with a plateau at it, or without push.
_TABLE = {
    "law": "tabulated",
    "strain": [-0.5, 0.0, 0.03, 0.1, 0.2],
    "tension_N": [-2000.0, 0.0, 1980.0, 2020.0, 6000.0],
}
_NO_PUSH = {"law": "tabulated", "strain": [-0.5, 0.0, 0.5], "tension_N": [0.0, 0.0, 25000.0]}
_CREASE = {"law": "tabulated", "strain": [-0.5, 0.0, 1e-12, 0.5], "tension_N": [-25000.0, 0.0, 1e-6, 25000.0]}
_PLATEAU = {"tether.tension": _TABLE}
_UNPUSHED = {**VIOLENT, "tether.tension": _NO_PUSH}


def _yielding(most_N: float) -> dict:
    return {"tether.tension": {"law": "tanh", "p": [most_N, 30.0, 0.0, 0.0, 0.0]}, "water.depth_m": 26.0}


def _load(most_N: float) -> str:
    return f"T = {most_N:g} tanh 30 eps under a lift of 2000 N"


_CARRIED = (2500.0, 2010.0, 2000.1)
_CARRIED_REST = {"check": "rest", "bar": 1e-5, "quick": True}
LAWS = [
    *(Case("f'", f"{_load(most)}, at rest", {**STILL, **_yielding(most)}, **_CARRIED_REST) for most in _CARRIED),
    *(Case("f'", f"{_load(most)}, regular wave", {**REGULAR, **_yielding(most)}) for most in _CARRIED),
    Case("f'", f"{_load(1990.0)}, at rest", {**STILL, **_yielding(1990.0)}, **_CARRIED_REST, ending=YIELDS),
    Case("f'", "a table with a plateau at the load, at rest", {**STILL, **_PLATEAU}, check="rest", bar=1e-5),
    Case("f'", "a table with a plateau at the load, regular wave", {**REGULAR, **_PLATEAU}, bar=0.05),
    Case("f'", "knots 1e-12 apart", {**REGULAR, "tether.tension": _CREASE}),
    Case("f'", "no push at all, snapping wave", _UNPUSHED, 60.0, **FINITE, ending=COLLAPSE, quick=True),
    *over("f'", "no push at all, with a barrier of 1 kN", "tether.compression_barrier_N", (1000.0,), _UNPUSHED,
          length_s=20.0, **FINITE, ending=BARRED),
]  # fmt: skip


# 3 to 5000 nodes, and grids stretched as far as they can be, each held against a run on that many even nodes.
def _as_fine(nodes: int) -> dict:
    return {"check": "as_fine", "options": {"nodes": nodes}}


_N = "tether.nodes"
_STRETCHED = {**REGULAR, _N: 81, "tether.grid_stretching": 5.0}
_GRADED = "81 nodes, stretched by 5 ({})"
GRIDS = [
    *over(
        "nodes", "{} nodes, regular wave", _N, (3, 5, 11, 41, 161, 641, 2001, 5000), REGULAR, (3, 5000), **_as_fine(81)
    ),
    *over("nodes", "{} nodes, snapping wave", _N, (3, 5, 11), VIOLENT, length_s=20.0, **_as_fine(161), ending=COARSE),
    *over("nodes", "{} nodes, snapping wave", _N, (321,), VIOLENT, length_s=20.0, **_as_fine(161)),
    *over("nodes", "{} nodes, in space", _N, (3, 1001), {**REGULAR, **SPACE}, **_as_fine(41)),
    *over("nodes", _GRADED, "tether.grid_refined", ("both", "lower", "upper"), _STRETCHED, **_as_fine(81)),
]

# Rope and buoy of extreme density and added mass. A rope heavier than the buoy lifts stands on its lower part.
_RHO, _ADDED = "tether.density_kgpm3", "tether.added_mass"
_LIGHT = (1.0, 1026.999, 1027.0, 7850.0, 1e5)
_BUOYS = ((1e-6, 0.0), (1.0, 0.0), (1.0, 907.0), (1611.0, 0.0), (1611.0, 1e6))
_BOB = {**DRY, _RHO: 1e-6, "start.buoy_velocity_mps": [2.0, 0.0, 0.0]}
_WEIGHTLESS = {**DRY, "gravity_mps2": 0.0}
MASSES = [
    *over("mass", "rope of {:.7g} kg/m3, at rest", _RHO, _LIGHT, STILL, length_s=20.0, **REST),
    *over("mass", "rope of {:.7g} kg/m3, at rest", _RHO, (3e5,), STILL, length_s=20.0, check="stays", bar=1e-6,
          ending=UNSTABLE),
    *over("mass", "rope of {:.7g} kg/m3, regular wave", _RHO, (*_LIGHT, 3e5), REGULAR, quick=(1027.0,)),
    *over("mass", "rope with added mass {:g}", _ADDED, (0.0, 1e2, 1e4), REGULAR),
    *(
        Case("mass", f"buoy of {mass:g} kg, added {added:g} kg", {
            **REGULAR, "buoy.mass_kg": mass, "buoy.added_mass_kg": added, "water.depth_m": 30.0,
        }, quick=mass == 1e-6)
        for mass, added in _BUOYS
    ),
    *over("mass", "buoy of 1000 t, hanging below its anchor: no sea floor", "buoy.mass_kg", (1e6,), STILL, **REST),
    Case("mass", "a bob on a rope without mass, dry", _BOB, 20.0, "energy", 0.01),
    Case("mass", "no gravity, dry: nothing pulls, bent", _WEIGHTLESS, 5.0, **REST, quick=True),
    *over("mass", "no gravity, dry, unbent", _EI, (0.0,), _WEIGHTLESS, length_s=5.0, **FINITE, ending=SHAPELESS),
]  # fmt: skip

CASES = [*BENDING, *STRETCHING, *LAWS, *GRIDS, *MASSES]
