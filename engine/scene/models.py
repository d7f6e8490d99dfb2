"""What is simulated, as frozen pydantic models: sections of a scene with their units, defaults and bounds.

Lengths from the anchor, x with the wave, y across, z up; SI units throughout. Symbols of the paper in brackets;
NOTATION.md maps them. Bounds of single values live here and in `scene_values`; rules between values in `scene_rules`.
"""

import hashlib
import json
import math
from typing import Annotated, Literal

from pydantic import Field, ValidationError, model_validator
from pydantic_core import PydanticCustomError

from engine.scene.as_toml import toml_text
from engine.scene.faults import SceneError, field_faults
from engine.scene.rules import cross_faults
from engine.scene.values import (
    Axis,
    Block,
    Count,
    CountOrZero,
    Five,
    Flag,
    Name,
    Nodes,
    NonNegative,
    Number,
    Positive,
    Section,
    Series,
    Stretching,
    Text,
    Tolerance,
    UnitInterval,
    Vector,
    Vectors,
)
from engine.scene.waves import Waves


class LinearTension(Section):
    """T = stiffness_N * eps, in tension and in compression [f(eps) = p1 eps, section 4.2]."""

    law: Literal["linear"]
    stiffness_N: Positive


class TanhTension(Section):
    """T = p1 tanh(p2 eps + p3) + p4 + p5 eps [section 4.1.1]."""

    law: Literal["tanh"]
    p: Five


class TabulatedTension(Section):
    """T interpolated through measured points; strain increasing, tension never falling."""

    law: Literal["tabulated"]
    strain: Series
    tension_N: Series


class Tether(Section):
    """The line [Table 1]: geometry, material, fluid coefficients and its grid."""

    length_m: Positive  # unstretched [l0]
    area_m2: Positive  # unstretched cross-section [A]
    density_kgpm3: Positive  # of the material [rho]; m = rho A
    diameter_m: Positive = Field(default_factory=lambda known: math.sqrt(4.0 * known["area_m2"] / math.pi))  # [d]
    nodes: Nodes = 41
    grid_stretching: Stretching = 0.0  # 0: equal elements; above: finer towards an end
    grid_refined: Literal["both", "lower", "upper"] = "both"  # the end towards which stretching refines
    bending_stiffness_Nm2: NonNegative  # [EI]; without it slack is ill-posed
    torsion_stiffness_Nm2: NonNegative = 0.0  # [GIp]; enters out of a plane only
    drag_normal: NonNegative = 1.0  # [Cdp], on the diameter
    drag_tangential: NonNegative = 0.1  # [Cdt], on pi times the diameter
    added_mass: NonNegative = 1.0  # ma = added_mass * rho_w pi d^2/4, normal to the line
    tension: Annotated[LinearTension | TanhTension | TabulatedTension, Field(discriminator="law")]
    compression_barrier_N: NonNegative = 0.0  # T loses this times (0.5/(1 + eps) - 1)^2 below a strain of -0.5


class Anchor(Section):
    """The lower end: fixed in place; free to rotate, or clamped in a direction (three dimensions only)."""

    rotation: Literal["pinned", "clamped"] = "pinned"
    direction: Vector | None = None  # of the clamped tangent; None: towards a held upper end, upwards otherwise


class HarmonicMotion(Section):
    """A held end is shaken: amplitude_m (r(t) sin(2 pi t/period_s + phase_rad) - its value at t = 0), r the ramp."""

    law: Literal["harmonic"]
    amplitude_m: Vector
    period_s: Positive
    phase_rad: Number = 0.0
    ramp_s: NonNegative = 0.0  # r = sin^2(pi t/(2 ramp_s)) up to there; 0: full motion from t = 0


class TableMotion(Section):
    """A held end is moved through displacements at times, by a monotone cubic (PCHIP) that starts and ends at rest."""

    law: Literal["table"]
    time_s: Series
    displacement_m: Vectors


class End(Section):
    """The upper end: carries the buoy of eq. (30), is held (still, moved, or let go later), or is free under a force.

    The keys of rotation have a meaning in three dimensions only.
    """

    kind: Literal["buoy", "held", "free"] = "buoy"
    position_m: Vector | None = None  # of a held end, from the anchor
    force_N: Vector | None = None  # on a free end; on a held one after its release (None: no force)
    force_decay_s: Positive | None = None  # [tbr]: the force on a free end falls as cos^2(pi t/(2 tbr)) to zero
    motion: Annotated[HarmonicMotion | TableMotion, Field(discriminator="law")] | None = None  # of a held end
    release_s: Positive | None = None  # when a held end is let go; None: never
    rotation: Literal["pinned", "clamped"] = "pinned"  # clamped: held ends only
    direction: Vector | None = None  # of the clamped tangent; None: along the line from the anchor
    twist_rad: Number | None = None  # turn of the upper clamp about its tangent against the lower one
    twist_ramp_s: NonNegative | None = None  # in which the twist is put in, as sin^2; None or 0: there from the start


class Buoy(Section):
    """The sphere of eq. (30) [D, M, Ma, Cd].

    submergence "full": buoyancy, wave load, added mass and drag of the whole sphere at any height; "spherical-cap": of
    the part below the linear wave surface (`engine.physics.submergence`).
    """

    diameter_m: Positive
    mass_kg: Positive
    added_mass_kg: NonNegative
    drag: NonNegative
    submergence: Literal["full", "spherical-cap"] = "full"
    impact_loss: UnitInterval = 0.0  # of a spherical cap: share of von Karman's loss into spray on the way into water


class Water(Section):
    """Still water: depth [H] from bed to surface, density [rho_w]."""

    depth_m: Positive
    density_kgpm3: Positive


class UniformCurrent(Section):
    """The same steady velocity everywhere."""

    law: Literal["uniform"]
    velocity_mps: Vector


class ProfileCurrent(Section):
    """A steady velocity given at heights above the bed."""

    law: Literal["profile"]
    height_m: Series
    velocity_mps: Vectors


class TableCurrent(Section):
    """A velocity given on a grid of time, height above the bed, x and (in three dimensions, where it is given) y.

    An axis of one value is a constant.
    """

    law: Literal["table"]
    x_m: Axis
    y_m: Axis | None = None
    height_m: Axis
    time_s: Axis
    velocity_x_mps: Block
    velocity_y_mps: Block | None = None  # None: zero
    velocity_z_mps: Block


class Motion(Section):
    """How many dimensions the line moves in."""

    dimensions: Literal[2, 3] = 2


class Start(Section):
    """What disturbs the static equilibrium at t = 0."""

    buoy_velocity_mps: Vector = (0.0, 0.0, 0.0)


class ShockViscosity(Section):
    """Internal viscosity confined to shocks (`engine.physics.shocks`): coefficients c_q and c_l."""

    quadratic: NonNegative = 1.0
    linear: NonNegative = 0.2


class Solver(Section):
    """Discretisation in time and its limits."""

    scheme: Literal["conservation", "paper-box"] = "conservation"  # paper-box: eq. (28) as printed
    integrator: Literal["esdirk43", "trbdf2", "midpoint", "backward-euler", "generalized-alpha"] = "esdirk43"
    rtol: Tolerance = 0.03
    step_s: Positive | None = None  # fixed step; None: controlled by rtol, or T/400 for a method of fixed steps
    courant: Positive | None = None  # step as this times (shortest element)/(fastest axial wave), not step_s
    shock_viscosity: ShockViscosity | None = None
    max_step_s: Positive = 0.1
    min_step_s: Positive = 1e-9
    newton_tolerance: Tolerance | None = None  # of the scaled update; None: rtol/100
    max_newton_iterations: Count = 12
    growth_per_step: Positive = 2.0  # e-folds that the fastest buckle may grow in one adaptive step
    spectral_radius: UnitInterval = 0.5  # of generalized-alpha at infinite frequency
    loop_release: Flag = True
    max_loop_releases: CountOrZero = 100000


class Output(Section):
    """What is kept: even samples, and profiles along the line where asked for."""

    step_s: Positive | None = None  # None: a hundredth of the wave period, 0.05 s without waves
    profiles: Flag = False
    profiles_step_s: Positive | None = None  # None: as step_s
    energy: Flag = False  # energy budget of a dry line (`engine.physics.energy`)
    tangent_vectors: CountOrZero = 0  # perturbations carried along: as many Lyapunov exponents
    lateral_growth: Flag = False  # an infinitesimal perturbation across the plane carried along


class Scene(Section):
    """One complete, validated description of what is simulated.

    A section that is None is absent from the physics: no water, no waves, no current, no buoy. `Scene(...)` raises
    pydantic's ValidationError; `load_scene` and `build_scene` raise SceneError, which lists every fault.
    """

    name: Name
    title: Text = ""
    gravity_mps2: NonNegative = 9.81
    tether: Tether
    anchor: Anchor = Anchor()
    end: End = End()
    buoy: Buoy | None = None
    water: Water | None = None
    waves: Waves | None = None
    current: Annotated[UniformCurrent | ProfileCurrent | TableCurrent, Field(discriminator="law")] | None = None
    motion: Motion = Motion()
    start: Start = Start()
    solver: Solver = Solver()
    output: Output = Output()

    @model_validator(mode="after")
    def _consistent(self) -> "Scene":
        faults = cross_faults(self.model_dump(), set())
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
        """The scene as TOML text with every default written out; `scene_from_toml` and `load_scene` give back an equal
        scene.
        """
        return toml_text(self.as_dict())

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
    try:
        scene = Scene.model_validate(raw)
    except ValidationError as error:
        faults, bad = field_faults(error, Scene)
        raise SceneError((*extra_faults, *faults, *cross_faults(raw, bad))) from None
    if extra_faults:
        raise SceneError(extra_faults)
    return scene
