"""What is simulated, as frozen pydantic models: sections of a scene with their units, defaults and bounds.

Lengths from the anchor, x with the wave, y across, z up; SI units throughout. Every key is declared once, here or in
`sections`: its type and bounds (`values`), default, meaning, symbol, and its place in the paper.
docs/scene_keys.md and the scene table of every report are made from these declarations (`reference`). Rules between
values are in `rules`.
"""

import hashlib
import json
import math
from typing import Literal

import tomli_w
from pydantic import ValidationError, model_validator
from pydantic_core import PydanticCustomError

from engine.scene.faults import TOO_DEEP, SceneError, field_faults, too_deep
from engine.scene.rules import cross_faults
from engine.scene.sections import Anchor, Buoy, Current, End, Floor, Tether, Water, Waves, above_by_default
from engine.scene.values import (
    Count,
    CountOrZero,
    Flag,
    Name,
    NonNegative,
    Positive,
    Section,
    Text,
    Tolerance,
    UnitInterval,
    Vector,
    described,
)


class Motion(Section):
    """How many dimensions the line moves in."""

    dimensions: Literal[2, 3] = described(
        "dimensions of the motion; 2: the plane of x and z, 3: space", 2, paper="section 4.2, (1)-(19)"
    )


class Start(Section):
    """What disturbs the static equilibrium at t = 0; not used by a run that goes on from another (`simulate`)."""

    buoy_velocity_mps: Vector = described(
        "velocity of the buoy at t = 0; along the line in proportion to s", (0.0, 0.0, 0.0), paper="section 4.2"
    )
    buoy_displacement_m: Vector = described(
        "displacement of the buoy at t = 0 from its place at rest, held there in static equilibrium and let go",
        (0.0, 0.0, 0.0),
    )


class ShockViscosity(Section):
    """Internal viscosity confined to shocks (`engine.physics.shocks`): coefficients c_q and c_l."""

    quadratic: NonNegative = described("quadratic coefficient of the shock viscosity", 1.0, symbol="c_q")
    linear: NonNegative = described("linear coefficient of the shock viscosity", 0.2, symbol="c_l")


class Solver(Section):
    """Discretisation in time and its limits."""

    scheme: Literal["conservation", "paper-box"] = described(
        "form of the equations; conservation: fixed axes, paper-box: eq. (28) as printed",
        "conservation",
        paper="(25)-(28)",
    )
    integrator: Literal["esdirk43", "trbdf2", "midpoint", "backward-euler", "generalized-alpha"] = described(
        "time integration method", "esdirk43", paper="section 3"
    )
    rtol: Tolerance = described("tolerance of the step control", 0.03)
    step_s: Positive | None = described(
        "fixed step; by default controlled by rtol, or of methods of fixed steps a 400th of what drives",
        None,
    )
    courant: Positive | None = described(
        "fixed step as this times (shortest element)/(fastest axial wave)", None, paper="(29)"
    )
    shock_viscosity: ShockViscosity | None = described(
        "internal viscosity confined to shocks; by default none", None, paper="section 4.1"
    )
    max_step_s: Positive = described("longest step", 0.1)
    min_step_s: Positive = described("shortest step, below which the run ends as step-underflow", 1e-9)
    newton_tolerance: Tolerance | None = described("tolerance of the scaled Newton update; by default rtol/100", None)
    max_newton_iterations: Count = described("Newton iterations after which a step is cut", 12)
    shortest_period_s: Positive | None = described(
        "axial ringing of shorter periods is damped, and the run says how much; by default a fiftieth of max_step_s",
        None,
    )
    growth_per_step: Positive = described("e-folds that the fastest buckle may grow in one adaptive step", 2.0)
    spectral_radius: UnitInterval = described("spectral radius of generalized-alpha at infinite frequency", 0.5)
    loop_release: Flag = described("release of a loop that is pulled tight in a plane", True)
    max_loop_releases: CountOrZero = described("loop releases after which the run ends", 100000)


class Output(Section):
    """What is kept: even samples, and profiles along the line where asked for."""

    step_s: Positive | None = described("step of the even samples; by default T_i/100, 0.05 s without waves", None)
    profiles: Flag = described("profiles along the line are kept", False)
    profiles_step_s: Positive | None = described("step of the profiles; by default step_s", None)
    energy: Flag = described("energy budget of a dry line is kept", False)
    tangent_vectors: CountOrZero = described("perturbations carried along: as many Lyapunov exponents", 0, paper="(32)")
    lateral_growth: Flag = described("a perturbation across the plane is carried along", False, paper="figure 20")


class Scene(Section):
    """One complete, validated description of what is simulated.

    A section that is None is absent from the physics: no water, no waves, no current, no buoy. `Scene(...)` raises
    pydantic's ValidationError; `load_scene` and `build_scene` raise SceneError, which lists every fault.
    """

    name: Name = described("name of the scene in tables and file names")
    title: Text = described("title of the scene in reports", "")
    gravity_mps2: NonNegative = described("acceleration of gravity", 9.81, symbol="g", paper="(23)")
    tether: Tether
    anchor: Anchor = Anchor()
    end: End = End()
    buoy: Buoy | None = None
    water: Water | None = None
    waves: Waves | None = None
    floor: Floor | None = described("what the bed does to a line that lies on it; by default nothing", None)
    current: Current | None = described("velocity of the current", None, symbol="U_c", paper="(24)")
    motion: Motion = Motion()
    start: Start = Start()
    solver: Solver = Solver()
    output: Output = Output()

    @model_validator(mode="after")
    def _consistent(self) -> "Scene":
        faults = cross_faults(self.model_dump(), set(), type(self))
        if faults:
            raise PydanticCustomError("scene_consistency", "{text}", {"text": "\n".join(faults)})
        return self

    def sample_step_s(self) -> float:
        """The step in seconds of the even output samples: output.step_s, or its default."""
        if self.output.step_s is not None:
            return self.output.step_s
        return self.waves.period_s / 100.0 if self.waves is not None else 0.05

    def as_dict(self) -> dict[str, object]:
        """Every value as plain dicts, lists and numbers; absent options left out, a derived diameter left to be
        derived.
        """
        plain = self.model_dump(mode="json", exclude_none=True)
        if self.tether.diameter_m == math.sqrt(4.0 * self.tether.area_m2 / math.pi):
            del plain["tether"]["diameter_m"]
        return plain

    def to_toml(self) -> str:
        """The scene as TOML text with every default written out that does not follow from other values;
        `scene_from_toml` and `load_scene` give back an equal scene.
        """
        plain = self.as_dict()
        waves = plain.get("waves", {})
        if waves and waves["above_still_water"] == above_by_default(waves):
            del waves["above_still_water"]
        return tomli_w.dumps(plain)

    def key(self) -> str:
        """SHA-256 (hex) of the canonical JSON of every value: equal scenes, equal keys, on any machine."""
        canonical = json.dumps(self.model_dump(mode="json"), sort_keys=True, separators=(",", ":"), allow_nan=False)
        return hashlib.sha256(canonical.encode()).hexdigest()


def build_scene(raw: dict[str, object], extra_faults: tuple[str, ...] = ()) -> Scene:
    """A validated Scene from plain dicts and lists.

    raw: sections as in a scene file. extra_faults: faults found by the caller before, reported together with those
    found here. Raises SceneError listing every fault: those of single values, and those between values wherever the
    values are sound.
    """
    if too_deep(raw):
        raise SceneError((*extra_faults, f"scene: {TOO_DEEP}"))
    try:
        scene = Scene.model_validate(raw)
    except ValidationError as error:
        faults, bad = field_faults(error, Scene)
        raise SceneError((*extra_faults, *faults, *cross_faults(raw, bad, Scene))) from None
    if extra_faults:
        raise SceneError(extra_faults)
    return scene
