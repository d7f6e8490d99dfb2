"""Cases of `campaigns.stability` whose input no scene should have: denormal, huge, coincident, zero."""

import math

from campaigns.stability.cases import ABOVE_BAR, DRY, REFUSED, REGULAR, Case, free, held


def inputs() -> list[Case]:
    """Values that no scene should have: denormal, huge, coincident, zero."""
    cases = []

    def refused(name, changes):
        cases.append(Case("input", name, changes, 1.0, "finite", 0.0, (REFUSED,), "", quick=True))

    for value in (5e-324, 1e-310, 1e300, math.inf, math.nan, -1.0, 0.0):
        refused(f"length {value:g} m", {"tether.length_m": value})
    for value in (5e-324, 1e300, math.inf, math.nan, -1.0):
        refused(f"EI {value:g} N m2", {"tether.bending_stiffness_Nm2": value})
    refused(
        "a table with coincident strains",
        {"tether.tension": {"law": "tabulated", "strain": [0.0, 0.1, 0.1], "tension_N": [0.0, 1.0, 2.0]}},
    )
    height = {"law": "profile", "height_m": [0.0, 5.0, 5.0], "velocity_mps": [[0.0, 0.0, 0.0]] * 3}
    refused("a current with coincident heights", {"current": height})
    twice = {"law": "table", "time_s": [0.0, 1.0, 1.0], "displacement_m": [[0.0, 0.0, 0.0]] * 3}
    refused("an end moved with coincident times", {**DRY, **held(0, 0, 20), "end.motion": twice})
    hardly = {**REGULAR, "tether.grid_stretching": 1e-310}
    coincident = "a stretching of 1e-310: no coincident nodes"
    cases.append(Case("input", coincident, hardly, 10.0, "as_fine", 0.02, options={"nodes": 81}, quick=True))
    refused("two nodes", {"tether.nodes": 2})
    refused("a million nodes", {"tether.nodes": 10**6})
    refused("samples every 1e-12 s", {"output.step_s": 1e-12})
    refused("a run of 1e15 steps", {"solver.max_step_s": 1e-15, "solver.min_step_s": 1e-16})
    ends = (
        "statics-failed",
        "newton-failed",
        "not-finite",
        "turn-unresolved",
        "step-limit",
        "strain-below-minus-one",
        "step-underflow",
        ABOVE_BAR,
    )
    words = "sizes that belong to no line: the run ends with what it met first"
    for value in (1e-30, 1e-9, 1e6, 1e30):
        cases.append(
            Case(
                "input",
                f"a line of {value:g} m",
                {"tether.length_m": value},
                1.0,
                "refined",
                0.1,
                ends,
                words,
                quick=True,
            )
        )
    for key in (
        "tether.area_m2",
        "tether.density_kgpm3",
        "buoy.mass_kg",
        "buoy.diameter_m",
        "tether.tension.stiffness_N",
        "tether.bending_stiffness_Nm2",
        "water.depth_m",
        "waves.period_s",
        "tether.drag_normal",
        "tether.added_mass",
    ):
        for value in (1e-30, 1e30):
            cases.append(
                Case(
                    "input",
                    f"{key} = {value:g}",
                    {key: value},
                    1.0,
                    "refined",
                    0.1,
                    (*ends, REFUSED),
                    words,
                    quick=True,
                )
            )
    nothing = {**DRY, **free(0, 0, 1e-30), "gravity_mps2": 0.0}
    cases.append(
        Case("input", "a force of 1e-30 N on a weightless line", nothing, 1.0, "finite", 0.0, ends, words, quick=True)
    )
    return cases
