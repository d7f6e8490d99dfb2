"""A scene as frozen pydantic models: its sections, with the unit, the default and the bounds of every key.

Places are measured from the anchor: x in the direction of the waves, y across, z up. All units are SI. Every key is
declared once, here or in `sections`, with its type and bounds (`values`), default, meaning, symbol, and place in the
paper. docs/scene_keys.md and the scene table of every report are made from these declarations (`reference`). Rules
that connect several keys are in `rules`.
"""

import hashlib
import json
import math
from pathlib import Path
from typing import Literal

import tomli_w
from pydantic import ValidationError, model_validator
from pydantic_core import PydanticCustomError

from engine.scene.faults import TOO_DEEP, SceneError, field_faults, too_deep
from engine.scene.measured_sea import with_measured_sea
from engine.scene.rules import cross_faults
from engine.scene.sections import Anchor, Buoy, Current, End, Floor, Tether, Water, Waves, above_by_default, irregular
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
    """The disturbance of the static equilibrium at t = 0. A run that goes on from another run does not use it."""

    buoy_velocity_mps: Vector = described(
        "velocity of the buoy at t = 0; that of the line is in proportion to s", (0.0, 0.0, 0.0), paper="section 4.2"
    )
    buoy_displacement_m: Vector = described(
        "displacement of the buoy from its place at rest; there it is held in equilibrium, and let go at t = 0",
        (0.0, 0.0, 0.0),
    )


class ShockViscosity(Section):
    """Internal viscosity confined to shocks (`engine.physics.shocks`): coefficients c_q and c_l."""

    quadratic: NonNegative = described("quadratic coefficient of the shock viscosity", 1.0, symbol="c_q")
    linear: NonNegative = described("linear coefficient of the shock viscosity", 0.2, symbol="c_l")


class Solver(Section):
    """The discretisation in time, and its limits."""

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
        "fixed step; by default rtol controls the step; a method that needs fixed steps takes 1/400 of the shortest "
        "period of waves and moved end",
        None,
    )
    courant: Positive | None = described(
        "fixed step as a multiple of (shortest element)/(speed of the fastest axial wave)", None, paper="(29)"
    )
    shock_viscosity: ShockViscosity | None = described(
        "internal viscosity confined to shocks; by default none", None, paper="section 4.1"
    )
    max_step_s: Positive = described("longest step", 0.1)
    min_step_s: Positive = described("shortest step, below which the run ends as step-underflow", 1e-9)
    newton_tolerance: Tolerance | None = described("tolerance of the scaled Newton update; by default rtol/100", None)
    max_newton_iterations: Count = described("number of Newton iterations after which a step is shortened", 12)
    shortest_period_s: Positive | None = described(
        "axial ringing of shorter periods is damped, and `message` says how much; by default max_step_s/50",
        None,
    )
    growth_per_step: Positive = described("e-folds by which the fastest buckle may grow in one adaptive step", 2.0)
    spectral_radius: UnitInterval = described("spectral radius of generalized-alpha at infinite frequency", 0.5)
    loop_release: Flag = described("whether a loop that is pulled tight in a plane is released", True)
    max_loop_releases: CountOrZero = described("loop releases after which the run ends", 100000)


class Output(Section):
    """The results that a run keeps: even samples and, if wanted, profiles along the line."""

    step_s: Positive | None = described("step of the even samples; by default T_i/100, 0.05 s without waves", None)
    profiles: Flag = described("whether profiles along the line are kept", False)
    profiles_step_s: Positive | None = described("step of the profiles; by default step_s", None)
    energy: Flag = described("whether the energy budget of a dry line is kept", False)
    tangent_vectors: CountOrZero = described(
        "number of perturbations that a run carries; each gives a Lyapunov exponent", 0, paper="(32)"
    )
    lateral_growth: Flag = described("whether a run carries a perturbation across the plane", False, paper="figure 20")


class Scene(Section):
    """The complete, validated description of a run.

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
    floor: Floor | None = described("forces of the bed on a line that lies on it; by default none", None)
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

    def profile_step_s(self) -> float:
        """The step in seconds of the profiles: output.profiles_step_s, or that of the samples; 0 without profiles."""
        if not self.output.profiles:
            return 0.0
        return self.output.profiles_step_s or self.sample_step_s()

    def with_values(self, section: str, **values: object) -> "Scene":
        """The scene with other values in one of its sections, which are not checked."""
        return self.model_copy(update={section: getattr(self, section).model_copy(update=values)})

    def as_dict(self) -> dict[str, object]:
        """Every value as plain dicts, lists and numbers, without absent options and without a derived diameter."""
        plain = self.model_dump(mode="json", exclude_none=True)
        if self.tether.diameter_m == math.sqrt(4.0 * self.tether.area_m2 / math.pi):
            del plain["tether"]["diameter_m"]
        return plain

    def to_toml(self) -> str:
        """The scene as TOML text, with all defaults except those that follow from other values.

        `scene_from_toml` and `load_scene` make an equal scene of it.
        """
        plain = self.as_dict()
        waves = plain.get("waves", {})
        if waves and waves["above_still_water"] == above_by_default(waves, _whole_sphere(plain.get("buoy", {}))):
            del waves["above_still_water"]
        return tomli_w.dumps(plain)

    def key(self) -> str:
        """SHA-256 (hex) of the canonical JSON of every value. Equal scenes have equal keys on every machine."""
        canonical = json.dumps(self.model_dump(mode="json"), sort_keys=True, separators=(",", ":"), allow_nan=False)
        return hashlib.sha256(canonical.encode()).hexdigest()


def _whole_sphere(buoy: dict[str, object]) -> bool:
    """Whether a buoy of these keys keeps its whole buoyancy above the water; also without a buoy."""
    return buoy.get("submergence") in (None, "full")


def _with_sea_defaults(raw: dict[str, object]) -> dict[str, object]:
    """The raw scene with the defaults of an irregular sea: a buoy's wetted cap, and the motion above still water.

    With the paper's scheme, which has no cap, the sphere stays whole.
    """
    sections = [raw.get(name) for name in ("waves", "buoy", "solver")]
    waves, buoy, solver = (section if isinstance(section, dict) else {} for section in sections)
    if not irregular(waves):
        return raw
    if buoy and buoy.get("submergence") is None and solver.get("scheme") != "paper-box":
        buoy = buoy | {"submergence": "spherical-cap"}
        raw = raw | {"buoy": buoy}
    if waves.get("above_still_water") is None:
        raw = raw | {"waves": waves | {"above_still_water": above_by_default(waves, _whole_sphere(buoy))}}
    return raw


def build_scene(raw: dict[str, object], extra_faults: tuple[str, ...] = (), folder: Path = Path()) -> Scene:
    """A validated Scene from plain dicts and lists.

    raw: sections as in a scene file. extra_faults: faults that the caller has already found; they are reported together
    with those of the scene. folder: in which the path of waves.record begins. Raises SceneError with every fault of a
    single value, and with every contradiction between values that are sound by themselves.
    """
    if too_deep(raw):
        raise SceneError((*extra_faults, f"scene: {TOO_DEEP}"))
    raw, unfit = with_measured_sea(raw, folder)
    raw = _with_sea_defaults(raw)
    extra_faults = (*extra_faults, *unfit)
    try:
        scene = Scene.model_validate(raw)
    except ValidationError as error:
        faults, bad = field_faults(error, Scene)
        raise SceneError((*extra_faults, *faults, *cross_faults(raw, bad, Scene))) from None
    if extra_faults:
        raise SceneError(extra_faults)
    return scene
