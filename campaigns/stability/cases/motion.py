"""Cases of `campaigns.stability` in which the motion or its time steps are extreme: kicks, snaps, steps."""

from campaigns.stability.cases.case import (
    ABOVE_BAR,
    DRY,
    FINITE,
    REGULAR,
    REST,
    SPACE,
    STILL,
    VIOLENT,
    Case,
    Ending,
    held,
    over,
)

FASTER = Ending(
    ("strain-below-minus-one", "newton-failed", "step-limit"), "faster than the line's own waves can carry away"
)
TOWER = Ending(
    ("newton-failed", "step-limit", "turn-unresolved", "strain-below-minus-one"),
    "a heavy line standing on its lower end collapses under its own weight, by symmetry along itself",
)
SEED = Ending(
    (ABOVE_BAR,),
    "in space a line is straight to rounding only, and rounding grows at the rate of the buckle (1e-17 in 26 e-folds)",
)
DIGITS = Ending(("step-limit", "newton-failed"), "the tolerance asks for more digits than doubles hold")


def _kick(x: float, y: float, z: float) -> dict:
    return {**STILL, "start.buoy_velocity_mps": [float(x), float(y), float(z)]}


# A kick, slack, horizontal and upside-down starts.
_FINE = {"end.release_s": 0.01, "output.step_s": 0.01, "output.profiles": True}
_STAYS, _ENERGY = {"length_s": 5.0, "check": "stays", "bar": 1e-3}, {"check": "energy", "bar": 0.02}
_FALL, _UPRIGHT = {**DRY, **held(19.9, 0, 0), **_FINE}, {**DRY, **held(0, 0, 19.99), **_FINE}
_LEANING = {**DRY, **held(1.0, 0, 19.96), **_FINE}
STARTS = [
    Case("start", "a kick of 10 m/s up", _kick(0, 0, 10)),
    Case("start", "a kick of 10 m/s down", _kick(0, 0, -10), quick=True),
    Case("start", "a kick of 10 m/s sideways", _kick(10, 0, 0)),
    Case("start", "a kick of 10 m/s across, in space", {**_kick(0, 10, 0), **SPACE}),
    *(
        Case("start", f"a kick of {speed:g} m/s down", _kick(0, 0, -speed), 2.0, **FINITE, ending=FASTER)
        for speed in (100.0, 1e3, 1e6)
    ),
    *(
        Case("start", f"ends {share:g} of the length apart, hanging", {**DRY, **held(20.0 * share, 0, 0)}, **_STAYS,
             quick=share in (0.5, 0.0))
        for share in (0.9, 0.5, 0.1, 1e-3, 0.0)
    ),
    Case("start", "ends 0.5 of the length apart, in space", {**DRY, **SPACE, **held(6, 8, 0)}, **_STAYS),
    Case("start", "horizontal, let go", _FALL, 2.0, **_ENERGY, quick=True),
    Case("start", "horizontal, let go, in space", {**_FALL, **SPACE}, 1.5, **_ENERGY),
    Case("start", "upside down: upright in air, let go", _UPRIGHT, 1.5, **_ENERGY, ending=TOWER, quick=True),
    Case("start", "upside down, leaning by 3 degrees, let go", _LEANING, 1.5, **_ENERGY, ending=TOWER),
    *over("start", "a sinking buoy, hanging below its anchor", "buoy.mass_kg", (1900.0,), STILL, **REST),
]  # fmt: skip


# Slack taken up at speed: a bob thrown towards its anchor, dry, so that energy is known.
def _thrown(speed_mps: float) -> dict:
    thrown = {"start.buoy_velocity_mps": [1.0, 0.0, speed_mps], "output.step_s": 0.01, "output.profiles": True}
    return {**DRY, **thrown, "solver.rtol": 1e-3}


def _caught(speed_mps: float) -> dict:
    return {"length_s": 2 * speed_mps / 9.81 + 2.0, "check": "energy", "bar": 0.05}


_THROW = "a bob thrown at {:g} m/s, caught by the rope"
SNAPS = [
    *(Case("snap", _THROW.format(v), _thrown(v), **_caught(v), quick=v == 5.0) for v in (5.0, 10.0, 20.0)),
    Case("snap", f"{_THROW.format(10.0)}, in space", {**_thrown(10.0), **SPACE}, **_caught(10.0)),
    *over("snap", "four snapping waves, {} nodes", "tether.nodes", (81,), VIOLENT, length_s=20.0),
]

# A straight weightless line pushed together along itself: by symmetry straight for ever, but unstable.
_PUSH = {"law": "table", "time_s": [0.0, 0.01, 1.0], "displacement_m": [[0, 0, 0], [0, 0, -0.002], [0, 0, -0.002]]}
_PUSHED = {
    **DRY, **held(0, 0, 2.0), "gravity_mps2": 0.0, "tether.length_m": 2.0, "tether.nodes": 81, "end.motion": _PUSH,
    "output.step_s": 0.001, "output.profiles": True, "solver.rtol": 1e-4, "solver.max_step_s": 0.001,
}  # fmt: skip
_SEEDED = {**_PUSHED, "gravity_mps2": 1e-9, "end.position_m": [0.02, 0.0, 1.9999]}
_STRAIGHT = {"length_s": 0.2, "check": "straight", "bar": 1e-9}
COMPRESSION = [
    Case("push", "straight, pushed together: stays straight", _PUSHED, **_STRAIGHT, quick=True),
    Case("push", "straight, pushed together, in space", {**_PUSHED, **SPACE}, **_STRAIGHT, ending=SEED),
    Case("push", "nearly straight: growth of the fastest buckle", _SEEDED, 0.2, "buckling", 0.1),
]


# Fixed steps far from what the motion asks for, every method, and tolerances far from usual.
def _steps(step_s: float, length_s: float, quick: bool) -> list[Case]:
    fixed = {**REGULAR, "solver.step_s": step_s, "solver.max_step_s": 1.0}
    methods = ("esdirk43", "trbdf2", "backward-euler", "generalized-alpha", "midpoint")
    how = {"length_s": length_s, "check": "bounded", "bar": 1.0}
    name = f"{{}}, steps of {step_s:g} s"
    return over("steps", name, "solver.integrator", methods, fixed, methods if quick else (), **how)


_TIGHT = {**REGULAR, "solver.rtol": 1e-9, "solver.newton_tolerance": 1e-12}
STEPS = [
    *_steps(0.5, 50.0, quick=True),
    *_steps(1e-4, 0.5, quick=False),
    *over("steps", "rtol {:g}", "solver.rtol", (0.9,), REGULAR, length_s=15.0, bar=0.1),
    Case("steps", "rtol 1e-9", _TIGHT, 1.0, ending=DIGITS),
]

CASES = [*STARTS, *SNAPS, *COMPRESSION, *STEPS]
