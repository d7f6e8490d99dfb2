"""Cases of `campaigns.stability` whose input no scene should have: denormal, huge, coincident, zero."""

import math

from campaigns.stability.cases.case import (
    ABOVE_BAR,
    DRY,
    FINITE,
    NOT_STARTED,
    REFUSED,
    REGULAR,
    Case,
    Ending,
    free,
    held,
    over,
)

_WORDS = "sizes that belong to no line: the run ends with what it met first"
_STATUSES = (
    "statics-failed", "newton-failed", "not-finite", "turn-unresolved", "step-limit", "strain-below-minus-one",
    "step-underflow", ABOVE_BAR,
)  # fmt: skip
NO_LINE, NO_LINE_OR_REFUSED = Ending(_STATUSES, _WORDS), Ending((*_STATUSES, REFUSED), _WORDS)

_LENGTH, _EI = "tether.length_m", "tether.bending_stiffness_Nm2"
_LENGTHS, _STIFFNESSES = (
    (5e-324, 1e-310, 1e300, math.inf, math.nan, -1.0, 0.0),
    (5e-324, 1e300, math.inf, math.nan, -1.0),
)
_KNOTS = {"law": "tabulated", "strain": [0.0, 0.1, 0.1], "tension_N": [0.0, 1.0, 2.0]}
_HEIGHTS = {"law": "profile", "height_m": [0.0, 5.0, 5.0], "velocity_mps": [[0.0, 0.0, 0.0]] * 3}
_TIMES = {"law": "table", "time_s": [0.0, 1.0, 1.0], "displacement_m": [[0.0, 0.0, 0.0]] * 3}
_REFUSED = {
    **{f"length {value:g} m": {_LENGTH: value} for value in _LENGTHS},
    **{f"EI {value:g} N m2": {_EI: value} for value in _STIFFNESSES},
    "a table with coincident strains": {"tether.tension": _KNOTS},
    "a current with coincident heights": {"current": _HEIGHTS},
    "an end moved with coincident times": {**DRY, **held(0, 0, 20), "end.motion": _TIMES},
    "two nodes": {"tether.nodes": 2},
    "a million nodes": {"tether.nodes": 10**6},
    "samples every 1e-12 s": {"output.step_s": 1e-12},
    "a run of 1e15 steps": {"solver.max_step_s": 1e-15, "solver.min_step_s": 1e-16},
}
_HARDLY = {**REGULAR, "tether.grid_stretching": 1e-310}
_SIZES, _BOTH = (1e-30, 1e-9, 1e6, 1e30), (1e-30, 1e30)
_KEYS = (
    "tether.area_m2", "tether.density_kgpm3", "buoy.mass_kg", "buoy.diameter_m", "tether.tension.stiffness_N", _EI,
    "water.depth_m", "waves.period_s", "tether.drag_normal", "tether.added_mass",
)  # fmt: skip
_NOTHING = {**DRY, **free(0, 0, 1e-30), "gravity_mps2": 0.0}
_SHORT = {"length_s": 1.0, "bar": 0.1}

CASES = [
    *(Case("input", name, key, 1.0, **FINITE, ending=NOT_STARTED, quick=True) for name, key in _REFUSED.items()),
    Case(
        "input",
        "a stretching of 1e-310: no coincident nodes",
        _HARDLY,
        check="as_fine",
        options={"nodes": 81},
        quick=True,
    ),
    *over("input", "a line of {:g} m", _LENGTH, _SIZES, quick=_SIZES, **_SHORT, ending=NO_LINE),
    *(
        case
        for key in _KEYS
        for case in over("input", f"{key} = {{:g}}", key, _BOTH, quick=_BOTH, **_SHORT, ending=NO_LINE_OR_REFUSED)
    ),
    Case("input", "a force of 1e-30 N on a weightless line", _NOTHING, 1.0, **FINITE, ending=NO_LINE, quick=True),
]
