"""Cases of `campaigns.stability` in which the water, the start, the steps or the input are extreme."""

from campaigns.stability.cases import ABOVE_BAR, CHAOS, DRY, REGULAR, SPACE, STILL, VIOLENT, Case, held

ABOVE = "Airy waves continued far above still water grow without bound"
SEED = (
    "in space a line is straight to rounding only, and rounding grows at the rate of the buckle (1e-17 in 26 e-folds)"
)
_PENDULUM = {**DRY, "tether.bending_stiffness_Nm2": 0.4, "solver.rtol": 1e-3}


def water() -> list[Case]:
    """None, still, currents strong and sheared."""
    bob = {**_PENDULUM, "start.buoy_velocity_mps": [1.0, 0.0, 0.0]}
    cases = [
        Case("water", "no water: a pendulum", bob, 20.0, "energy", 0.01, quick=True),
        Case(
            "water",
            "no water: a pendulum in space",
            {**bob, **SPACE, "start.buoy_velocity_mps": [1.0, 0.5, 0.0]},
            20.0,
            "energy",
            0.01,
        ),
        Case("water", "still water", STILL, 60.0, "rest", 1e-6, quick=True),
        Case("water", "still water, in space", {**STILL, **SPACE}, 20.0, "rest", 1e-6),
    ]
    for speed in (1.0, 5.0, 20.0):
        current = {"current": {"law": "uniform", "velocity_mps": [speed, 0.0, 0.0]}}
        cases.append(Case("water", f"current {speed:g} m/s, at rest", {**STILL, **current}, 20.0, "stays", 1e-4))
        cases.append(
            Case("water", f"current {speed:g} m/s, regular wave", {**REGULAR, **current}, 10.0, "refined", 0.02)
        )
    shear = {
        "law": "profile",
        "height_m": [0.0, 10.0, 22.0],
        "velocity_mps": [[-3.0, 0.0, 0.0], [0.0, 0.0, 0.0], [3.0, 0.0, 0.0]],
    }
    cases.append(Case("water", "shear from −3 to 3 m/s", {**STILL, "current": shear}, 20.0, "stays", 1e-4, quick=True))
    across = {"law": "uniform", "velocity_mps": [0.0, 5.0, 0.0]}
    cases.append(
        Case(
            "water", "5 m/s across the waves, in space", {**REGULAR, **SPACE, "current": across}, 10.0, "refined", 0.02
        )
    )
    return cases


def waves() -> list[Case]:
    """Steepness to 0.4, periods from 0.5 to 60 s."""
    cases = []
    for steepness in (0.05, 0.1, 0.2, 0.3, 0.4):
        ends, limit = ((ABOVE_BAR,), CHAOS) if steepness > 0.1 else ((), "")
        change = {"waves.steepness": steepness}
        cases.append(
            Case("waves", f"kA = {steepness:g}", change, 25.0, "refined", 0.05, ends, limit, quick=steepness == 0.4)
        )
    for law in ("zero", "wheeler"):
        change = {"waves.steepness": 0.4, "waves.above_still_water": law}
        cases.append(
            Case("waves", f"kA = 0.4, above still water: {law}", change, 25.0, "refined", 0.05, (ABOVE_BAR,), CHAOS)
        )
    cases.append(
        Case(
            "waves", "kA = 0.4, in space", {"waves.steepness": 0.4, **SPACE}, 15.0, "refined", 0.05, (ABOVE_BAR,), CHAOS
        )
    )
    for period_s in (0.5, 1.0, 2.0, 10.0, 20.0, 60.0):
        change = {**REGULAR, "waves.period_s": period_s}
        name = f"period {period_s:g} s, kA = 0.016"
        cases.append(
            Case("waves", name, change, max(4 * period_s, 5.0), "refined", 0.02, quick=period_s in (0.5, 60.0))
        )
    for period_s in (0.5, 2.0, 20.0):
        change = {"waves.steepness": 0.3, "waves.period_s": period_s, "water.depth_m": 22.5}
        cases.append(
            Case(
                "waves", f"period {period_s:g} s, kA = 0.3", change, 4 * period_s, "refined", 0.05, (ABOVE_BAR,), CHAOS
            )
        )
    far = {"tether.tension.stiffness_N": 100.0, "waves.period_s": 1.0}
    cases.append(
        Case(
            "waves",
            "a buoy 400 m above the water, period 1 s",
            far,
            5.0,
            "finite",
            0.0,
            ("not-finite",),
            ABOVE,
            quick=True,
        )
    )
    return cases


def starts() -> list[Case]:
    """A blow, slack, horizontal and upside-down starts."""
    cases = []
    for word, kick in (("up", [0, 0, 10]), ("down", [0, 0, -10]), ("sideways", [10, 0, 0])):
        change = {**STILL, "start.buoy_velocity_mps": [float(v) for v in kick]}
        cases.append(Case("start", f"a kick of 10 m/s {word}", change, 10.0, "refined", 0.02, quick=word == "down"))
    across = {**STILL, **SPACE, "start.buoy_velocity_mps": [0.0, 10.0, 0.0]}
    cases.append(Case("start", "a kick of 10 m/s across, in space", across, 10.0, "refined", 0.02))
    for speed in (100.0, 1e3, 1e6):
        change = {**STILL, "start.buoy_velocity_mps": [0.0, 0.0, -speed]}
        ends = ("strain-below-minus-one", "newton-failed", "step-limit")
        cases.append(
            Case(
                "start",
                f"a kick of {speed:g} m/s down",
                change,
                2.0,
                "finite",
                0.0,
                ends,
                "faster than the line's own waves can carry away",
            )
        )
    for share in (0.9, 0.5, 0.1, 1e-3, 0.0):
        slack = {**DRY, **held(20.0 * share, 0, 0)}
        cases.append(
            Case(
                "start",
                f"ends {share:g} of the length apart, hanging",
                slack,
                5.0,
                "stays",
                1e-3,
                quick=share in (0.5, 0.0),
            )
        )
    cases.append(
        Case("start", "ends 0.5 of the length apart, in space", {**DRY, **SPACE, **held(6, 8, 0)}, 5.0, "stays", 1e-3)
    )
    fall = {**DRY, **held(19.9, 0, 0), "end.release_s": 0.01, "output.step_s": 0.01, "output.profiles": True}
    cases.append(Case("start", "horizontal, let go", fall, 2.0, "energy", 0.02, quick=True))
    cases.append(Case("start", "horizontal, let go, in space", {**fall, **SPACE}, 1.5, "energy", 0.02))
    upright = {**DRY, **held(0, 0, 19.99), "end.release_s": 0.01, "output.step_s": 0.01, "output.profiles": True}
    ends = ("newton-failed", "step-limit", "turn-unresolved", "strain-below-minus-one")
    tower = "a heavy line standing on its lower end collapses under its own weight, by symmetry along itself"
    cases.append(
        Case("start", "upside down: upright in air, let go", upright, 1.5, "energy", 0.02, ends, tower, quick=True)
    )
    leaning = {**upright, **held(1.0, 0, 19.96), "end.release_s": 0.01}
    cases.append(Case("start", "upside down, leaning by 3 degrees, let go", leaning, 1.5, "energy", 0.02, ends, tower))
    below = {**STILL, "buoy.mass_kg": 1900.0}
    cases.append(Case("start", "a sinking buoy, hanging below its anchor", below, 10.0, "rest", 1e-6))
    return cases


def snaps() -> list[Case]:
    """Slack taken up at speed: a bob thrown towards its anchor, dry, so that energy is known."""
    cases = []
    for speed in (5.0, 10.0, 20.0):
        thrown = {**DRY, "start.buoy_velocity_mps": [1.0, 0.0, speed], "output.step_s": 0.01, "output.profiles": True}
        time_s = 2 * speed / 9.81 + 2.0
        name = f"a bob thrown at {speed:g} m/s, caught by the rope"
        cases.append(Case("snap", name, {**thrown, "solver.rtol": 1e-3}, time_s, "energy", 0.05, quick=speed == 5.0))
        if speed == 10.0:
            cases.append(
                Case("snap", f"{name}, in space", {**thrown, **SPACE, "solver.rtol": 1e-3}, time_s, "energy", 0.05)
            )
    long = {**VIOLENT}
    cases.append(Case("snap", "four snapping waves, 81 nodes", {**long, "tether.nodes": 81}, 20.0, "refined", 0.02))
    return cases


def compression() -> list[Case]:
    """A straight weightless line pushed together along itself: by symmetry straight for ever, but unstable."""
    line = {
        **DRY, **held(0, 0, 2.0), "gravity_mps2": 0.0, "tether.length_m": 2.0, "tether.nodes": 81,
        "output.step_s": 0.001, "output.profiles": True, "solver.rtol": 1e-4, "solver.max_step_s": 0.001,
    }  # fmt: skip
    pushed = {"law": "table", "time_s": [0.0, 0.01, 1.0], "displacement_m": [[0, 0, 0], [0, 0, -0.002], [0, 0, -0.002]]}
    symmetric = {**line, "end.motion": pushed}
    seeded = {**symmetric, "gravity_mps2": 1e-9, "end.position_m": [0.02, 0.0, 1.9999]}
    return [
        Case("push", "straight, pushed together: stays straight", symmetric, 0.2, "straight", 1e-9, quick=True),
        Case(
            "push",
            "straight, pushed together, in space",
            {**symmetric, **SPACE},
            0.2,
            "straight",
            1e-9,
            (ABOVE_BAR,),
            SEED,
        ),
        Case("push", "nearly straight: growth of the fastest buckle", seeded, 0.2, "buckling", 0.1),
    ]


def steps() -> list[Case]:
    """Fixed steps far from what the motion asks for, every method."""
    cases = []
    for method in ("esdirk43", "trbdf2", "backward-euler", "generalized-alpha", "midpoint"):
        for step_s in (0.5, 1e-4):
            change = {**REGULAR, "solver.integrator": method, "solver.step_s": step_s, "solver.max_step_s": 1.0}
            length_s = 50.0 if step_s > 0.1 else 0.5
            cases.append(
                Case("steps", f"{method}, steps of {step_s:g} s", change, length_s, "bounded", 1.0, quick=step_s > 0.1)
            )
    loose = {**REGULAR, "solver.rtol": 0.9}
    cases.append(Case("steps", "rtol 0.9", loose, 15.0, "refined", 0.1))
    tight = {**REGULAR, "solver.rtol": 1e-9, "solver.newton_tolerance": 1e-12}
    cases.append(
        Case(
            "steps",
            "rtol 1e-9",
            tight,
            1.0,
            "refined",
            0.02,
            ("step-limit", "newton-failed"),
            "the tolerance asks for more digits than doubles hold",
        )
    )
    return cases
