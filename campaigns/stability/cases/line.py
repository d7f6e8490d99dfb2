"""Cases of `campaigns.stability` in which the line itself is extreme: stiffness, tension law, grid, mass."""

from campaigns.stability.cases import ABOVE_BAR, DRY, REFUSED, REGULAR, SPACE, STILL, VIOLENT, Case

ILL_POSED = "without bending stiffness slack is ill-posed: ever shorter buckles grow ever faster"
UNSTABLE = "statics finds a rest, here a line standing on its lower part, and not always a stable one: it falls over"
COARSE = "loops and folds of the slack rope are far smaller than an element"
COLLAPSE = "the law has no stiffness in compression: a slack line collapses to nothing"
_TABLE = {
    "law": "tabulated",
    "strain": [-0.5, 0.0, 0.03, 0.1, 0.2],
    "tension_N": [-2000.0, 0.0, 1980.0, 2020.0, 6000.0],
}
_NO_PUSH = {"law": "tabulated", "strain": [-0.5, 0.0, 0.5], "tension_N": [0.0, 0.0, 25000.0]}
_CREASE = {"law": "tabulated", "strain": [-0.5, 0.0, 1e-12, 0.5], "tension_N": [-25000.0, 0.0, 1e-6, 25000.0]}


def bending() -> list[Case]:
    """EI from 0 to 1e4 N m2, regular and violent."""
    cases = []
    for EI in (0.0, 1e-8, 1e-4, 0.4, 40.0, 1e4):
        change = {"tether.bending_stiffness_Nm2": EI}
        quick = EI in (0.0, 1e4)
        cases.append(
            Case("EI", f"EI = {EI:g}, regular wave", {**REGULAR, **change}, 15.0, "refined", 0.02, quick=quick)
        )
    for EI in (1e-3, 0.1, 0.4, 4.0, 40.0, 1e4):
        change = {"tether.bending_stiffness_Nm2": EI}
        cases.append(Case("EI", f"EI = {EI:g}, snapping wave", {**VIOLENT, **change}, 20.0, "refined", 0.02))
    none = {**VIOLENT, "tether.bending_stiffness_Nm2": 0.0}
    ends = ("newton-failed", "strain-below-minus-one", "step-limit")
    cases.append(Case("EI", "EI = 0, snapping wave", none, 60.0, "finite", 0.0, ends, ILL_POSED, quick=True))
    cases.append(Case("EI", "EI = 0, snapping wave, in space", {**none, **SPACE}, 60.0, "finite", 0.0, ends, ILL_POSED))
    for EI in (0.0, 0.4, 1e4):
        change = {"tether.bending_stiffness_Nm2": EI, "start.buoy_velocity_mps": [0.0, 0.01, 0.0], **SPACE}
        cases.append(Case("EI", f"EI = {EI:g}, regular wave, in space", {**REGULAR, **change}, 10.0, "refined", 0.02))
    return cases


def stretching() -> list[Case]:
    """EA from 1e-2 to 1e4 times that of Table 1. Depths are raised with the buoy, which floats where the rope ends."""
    cases = []
    for factor, depth_m in ((1e-2, 150.0), (1e-1, 40.0), (1.0, 22.5), (10.0, 22.5), (1e2, 22.5), (1e4, 22.5)):
        change = {"tether.tension.stiffness_N": 5e4 * factor, "water.depth_m": depth_m}
        name = f"EA = {5e4 * factor:g} N"
        cases.append(
            Case("EA", f"{name}, at rest", {**STILL, **change}, 20.0, "rest", 1e-6, quick=factor in (1e-2, 1e4))
        )
        waves = {**REGULAR, **change}
        cases.append(Case("EA", f"{name}, regular wave", waves, 15.0, "refined", 0.02))
        if factor in (1e-2, 1e4):
            cases.append(Case("EA", f"{name}, regular wave, in space", {**waves, **SPACE}, 10.0, "refined", 0.02))
    return cases


def laws() -> list[Case]:
    """f' -> 0: laws that yield near the load, with a plateau at it, or without push."""
    cases = []
    for most in (2500.0, 2010.0, 2000.1, 1990.0):
        law = {"tether.tension": {"law": "tanh", "p": [most, 30.0, 0.0, 0.0, 0.0]}, "water.depth_m": 26.0}
        ends = ("statics-failed",) if most < 2000 else ()
        words = "the law yields below the buoy's lift, so that no strain carries it" if ends else ""
        name = f"T = {most:g} tanh 30 eps under a lift of 2000 N"
        cases.append(Case("f'", f"{name}, at rest", {**STILL, **law}, 10.0, "rest", 1e-5, ends, words, quick=True))
        if not ends:
            cases.append(Case("f'", f"{name}, regular wave", {**REGULAR, **law}, 10.0, "refined", 0.02))
    plateau = {"tether.tension": _TABLE}
    cases += [
        Case("f'", "a table with a plateau at the load, at rest", {**STILL, **plateau}, 10.0, "rest", 1e-5),
        Case("f'", "a table with a plateau at the load, regular wave", {**REGULAR, **plateau}, 10.0, "refined", 0.05),
        Case("f'", "knots 1e-12 apart", {**REGULAR, "tether.tension": _CREASE}, 10.0, "refined", 0.02),
        Case(
            "f'", "no push at all, snapping wave", {**VIOLENT, "tether.tension": _NO_PUSH}, 60.0, "finite", 0.0,
            ("strain-below-minus-one", "step-limit", "newton-failed"), COLLAPSE, quick=True,
        ),
        Case(
            "f'", "no push at all, with a barrier of 1 kN", {
                **VIOLENT, "tether.tension": _NO_PUSH, "tether.compression_barrier_N": 1000.0,
            }, 20.0, "finite", 0.0, ("newton-failed", "step-limit"), COLLAPSE,
        ),
    ]  # fmt: skip
    return cases


def grids() -> list[Case]:
    """3 to 5000 nodes, and grids stretched as far as they can be."""
    cases = []
    for nodes in (3, 5, 11, 41, 161, 641, 2001, 5000):
        change = {**REGULAR, "tether.nodes": nodes}
        options = {"nodes": 81 if nodes != 81 else 161}
        cases.append(
            Case(
                "nodes",
                f"{nodes} nodes, regular wave",
                change,
                10.0,
                "as_fine",
                0.02,
                options=options,
                quick=nodes in (3, 5000),
            )
        )
    for nodes in (3, 5, 11, 321):
        change = {**VIOLENT, "tether.nodes": nodes}
        ends, limit = ((ABOVE_BAR,), COARSE) if nodes < 20 else ((), "")
        name = f"{nodes} nodes, snapping wave"
        cases.append(Case("nodes", name, change, 20.0, "as_fine", 0.02, ends, limit, options={"nodes": 161}))
    for nodes in (3, 1001):
        change = {**REGULAR, **SPACE, "tether.nodes": nodes}
        cases.append(Case("nodes", f"{nodes} nodes, in space", change, 10.0, "as_fine", 0.02, options={"nodes": 41}))
    for where in ("both", "lower", "upper"):
        change = {**REGULAR, "tether.grid_stretching": 5.0, "tether.grid_refined": where, "tether.nodes": 81}
        cases.append(
            Case("nodes", f"81 nodes, stretched by 5 ({where})", change, 10.0, "as_fine", 0.02, options={"nodes": 81})
        )
    return cases


def masses() -> list[Case]:
    """Rope and buoy of extreme density and added mass."""
    cases = []
    for density in (1.0, 1026.999, 1027.0, 7850.0, 1e5, 3e5):
        change = {"tether.density_kgpm3": density}
        name = f"rope of {density:.7g} kg/m3"
        # heavier than the buoy lifts: straight up, its lower part pressed together, it rests but not for long
        check, ends, limit = ("stays", (ABOVE_BAR,), UNSTABLE) if density > 1e5 else ("rest", (), "")
        cases.append(Case("mass", f"{name}, at rest", {**STILL, **change}, 20.0, check, 1e-6, ends, limit))
        cases.append(
            Case("mass", f"{name}, regular wave", {**REGULAR, **change}, 10.0, "refined", 0.02, quick=density == 1027.0)
        )
    for added in (0.0, 1e2, 1e4):
        change = {**REGULAR, "tether.added_mass": added}
        cases.append(Case("mass", f"rope with added mass {added:g}", change, 10.0, "refined", 0.02))
    for mass, added in ((1e-6, 0.0), (1.0, 0.0), (1.0, 907.0), (1611.0, 0.0), (1611.0, 1e6)):
        change = {**REGULAR, "buoy.mass_kg": mass, "buoy.added_mass_kg": added, "water.depth_m": 30.0}
        name = f"buoy of {mass:g} kg, added {added:g} kg"
        cases.append(Case("mass", name, change, 10.0, "refined", 0.02, quick=mass == 1e-6))
    heavy = {**STILL, "buoy.mass_kg": 1e6}
    cases.append(Case("mass", "buoy of 1000 t, hanging below its anchor: no sea floor", heavy, 10.0, "rest", 1e-6))
    dry = {**DRY, "tether.density_kgpm3": 1e-6}
    cases.append(
        Case(
            "mass",
            "a bob on a rope without mass, dry",
            {**dry, "start.buoy_velocity_mps": [2.0, 0.0, 0.0]},
            20.0,
            "energy",
            0.01,
        )
    )
    weightless = {**DRY, "gravity_mps2": 0.0}
    cases.append(Case("mass", "no gravity, dry: nothing pulls, bent", weightless, 5.0, "rest", 1e-6, quick=True))
    unbent = {**weightless, "tether.bending_stiffness_Nm2": 0.0}
    cases.append(
        Case(
            "mass",
            "no gravity, dry, unbent",
            unbent,
            5.0,
            "finite",
            0.0,
            ("statics-failed", REFUSED),
            "nothing gives the line a shape",
        )
    )
    return cases
