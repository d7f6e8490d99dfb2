"""The line, its ends and the buoy; water, waves and current: sections of a scene, every key with its meaning."""

import math
from typing import Annotated, Literal

from pydantic import Field

from engine.physics.drag import DragLaw
from engine.physics.tension import TensionLaw
from engine.scene.faults import Allowed
from engine.scene.values import (
    MOST_COMPONENTS,
    Axis,
    Block,
    Components,
    CountOrZero,
    Nodes,
    NonNegative,
    Number,
    PeakEnhancement,
    Positive,
    RelativeWidth,
    Section,
    Series,
    Stretching,
    Text,
    UnitInterval,
    Vector,
    Vectors,
    described,
)


class Tether(Section):
    """The line [Table 1]: geometry, material, fluid coefficients and its grid."""

    length_m: Positive = described("unstretched length", symbol="l_0", paper="Table 1")
    area_m2: Positive = described("unstretched cross-sectional area", symbol="A", paper="Table 1, (10)")
    density_kgpm3: Positive = described(
        "density of the material; density times area is the mass per length m", symbol="rho", paper="Table 1, (9)"
    )
    diameter_m: Positive = described(
        "unstretched diameter; by default the diameter of a circle of area_m2",
        symbol="d",
        paper="(24)",
        default_factory=lambda known: math.sqrt(4.0 * known["area_m2"] / math.pi),
    )
    nodes: Nodes = described("nodes of the grid, both ends included", 41, symbol="n_p", paper="section 3")
    grid_stretching: Stretching = described(
        "stretching of the grid; 0: equal elements; above 0: shorter elements towards an end", 0.0, paper="section 3"
    )
    grid_refined: Literal["both", "lower", "upper"] = described(
        "end towards which stretching refines the grid", "both", paper="section 3"
    )
    bending_stiffness_Nm2: NonNegative = described(
        "bending stiffness; with 0 the equations of a slack line are ill-posed", symbol="EI", paper="(14), (15)"
    )
    torsion_stiffness_Nm2: NonNegative = described(
        "torsion stiffness; has no effect on a motion in a plane", 0.0, symbol="GI_p", paper="(13)"
    )
    drag_normal: NonNegative = described(
        "drag coefficient across the line; the area per length is the diameter", 1.0, symbol="C_dp", paper="(24)"
    )
    drag_tangential: NonNegative = described(
        "drag coefficient along the line; the area per length is pi times the diameter",
        0.1,
        symbol="C_dt",
        paper="(24)",
    )
    drag: DragLaw | None = described(
        "law by which the two drag coefficients above fall with the speed; by default they are constant",
        None,
        paper="(24)",
    )
    added_mass: NonNegative = described("added mass across the line, divided by rho_w pi d^2/4", 1.0, paper="(24)")
    tension: TensionLaw = described("tension as a function of the strain", symbol="T = f(eps)", paper="(20)")
    breaking_load_N: Positive | None = described(
        "breaking load; changes no motion: a run tells the share of it that its largest tension is", None
    )
    compression_barrier_N: NonNegative = described(
        "barrier: T loses P_b (0.5/(1 + eps) - 1)^2 below a strain of -1/2", 0.0, symbol="P_b"
    )
    damping_Ns: NonNegative | None = described("material damping: T gains c times the rate of strain", None, symbol="c")
    damping_critical: NonNegative | None = described(
        "material damping as a share of the critical damping of an element of mean length l: c = share l sqrt(T' m)",
        None,
        symbol="zeta",
    )
    froude_krylov: Literal["normal", "whole"] = described(
        "force of the undisturbed water, rho_w pi d^2/4 U_w,t: only its part across the line, or the whole force",
        "normal",
        paper="(24)",
    )
    submergence: Literal["full", "free-surface"] = described(
        "part of the line on which the water acts: the whole line, or the part below the wave", "full"
    )


class Anchor(Section):
    """The lower end: fixed in place; free to rotate, or clamped in a direction (three dimensions only)."""

    position_m: Vector = described("place of the lower end; z is its height above the bed", (0.0, 0.0, 0.0))
    rotation: Literal["pinned", "clamped"] = described(
        "rotation of the lower end: free, or clamped (three dimensions)", "pinned", paper="section 2.5"
    )
    direction: Vector | None = described(
        "direction of the clamped tangent; by default towards a held end, else upwards", None
    )


class Floor(Section):
    """The bed, z = 0: stiffness and damping of an area of contact as wide as the line, and friction."""

    stiffness_Npm3: Positive = described(
        "stiffness of the bed per area of contact; the contact is as wide as the line", symbol="k"
    )
    damping_Nspm3: NonNegative = described(
        "damping of the bed per area of contact, while the line sinks into the bed", 0.0, symbol="c"
    )
    friction: NonNegative = described("coefficient of Coulomb's friction", 0.0, symbol="mu")
    friction_speed_mps: Positive = described(
        "sliding speed at which friction reaches 71 % of its full size", 0.01, symbol="v_s"
    )


class HarmonicMotion(Section):
    """A held end is shaken: amplitude_m (r(t) sin(2 pi t/period_s + phase_rad) - its value at t = 0), r the ramp."""

    law: Literal["harmonic"] = described("form of the motion of the held end; the other keys depend on it")
    amplitude_m: Vector = described("harmonic: amplitude of r(t) sin(2 pi t/period + phase), less its value at t = 0")
    period_s: Positive = described("harmonic, circular: period")
    phase_rad: Number = described("harmonic, circular: phase", 0.0)
    ramp_s: NonNegative = described(
        "harmonic, circular: duration of the ramp r = sin^2(pi t/(2 ramp)); 0: no ramp (harmonic only)", 0.0
    )


class CircularMotion(Section):
    """A held end goes round a circle in x and z about its place: r(t) (R cos, -R sin)(2 pi t/period_s + phase_rad).

    From +x down; the ramp r begins at the centre. The other keys are described with those of HarmonicMotion.
    """

    law: Literal["circular"]
    radius_m: Positive = described("circular: radius of r(t) (cos, -sin)(2 pi t/period + phase) in x and z", symbol="R")
    period_s: Positive
    phase_rad: Number = 0.0
    ramp_s: Positive


class TableMotion(Section):
    """A held end is moved through displacements at times, by a monotone cubic (PCHIP) that starts and ends at rest."""

    law: Literal["table"]
    time_s: Series = described("table: times, increasing; the end is at rest before the first and after the last")
    displacement_m: Vectors = described(
        "table: displacements at these times, joined by monotone cubics; the first is zero"
    )


class End(Section):
    """The upper end: carries the buoy of eq. (30), is held (still, moved, or let go later), or is free under a force.

    The keys of rotation have a meaning in three dimensions only.
    """

    kind: Literal["buoy", "held", "free"] = described(
        "what the upper end does: it carries the buoy, is held, or is free under a force",
        "buoy",
        paper="(30), section 4.1",
    )
    position_m: Vector | None = described("position of a held end, from the anchor", None)
    force_N: Vector | None = described(
        "force on a free end, or on a held end after its release", None, symbol="F", paper="section 4.1"
    )
    force_decay_s: Positive | None = described(
        "fracture time: the force falls as cos^2(pi t/(2 t_br))", None, symbol="t_br", paper="section 4.1.1"
    )
    motion: Annotated[HarmonicMotion | CircularMotion | TableMotion, Field(discriminator="law")] | None = described(
        "prescribed displacement of a held end", None, symbol="X_e"
    )
    release_s: Positive | None = described(
        "time at which a held end is let go; by default never", None, paper="section 4.1"
    )
    rotation: Literal["pinned", "clamped"] = described(
        "rotation of a held upper end: free, or clamped (three dimensions)", "pinned"
    )
    direction: Vector | None = described(
        "direction of the clamped tangent; by default along the line from the anchor", None
    )
    twist_rad: Number | None = described(
        "turn of the upper clamp about its tangent, relative to the lower clamp", None, symbol="R"
    )
    twist_ramp_s: NonNegative | None = described(
        "time in which the twist grows from zero, as sin^2; 0: the whole twist from t = 0", None
    )


class Buoy(Section):
    """The sphere of eq. (30) [D, M, Ma, Cd].

    submergence "full": buoyancy, wave load, added mass and drag of the whole sphere at any height; "spherical-cap": of
    the part below the linear wave surface (`engine.physics.submergence`).
    """

    diameter_m: Positive = described("diameter of the sphere", symbol="D", paper="Table 1, (30)")
    mass_kg: Positive = described("mass", symbol="M", paper="Table 1, (30)")
    added_mass_kg: NonNegative = described("added mass", symbol="M_a", paper="Table 1, (30)")
    drag: NonNegative = described("drag coefficient; the area is pi D^2/4", symbol="C_d", paper="(30)")
    submergence: Literal["full", "spherical-cap"] = described(
        "part of the buoy on which the water acts: the whole sphere, or the cap below the wave, the default in an "
        "irregular sea",
        "full",
        paper="(30)",
    )
    impact_loss: UnitInterval = described(
        "spherical-cap: share of the energy of an impact on the water that is lost in spray", 0.0, paper="(30)"
    )


class Water(Section):
    """Still water: depth [H] from bed to surface, density [rho_w]."""

    depth_m: Positive = described("depth, from the bed to the still surface", symbol="H", paper="section 4.2")
    density_kgpm3: Positive = described("density of the water", symbol="rho_w", paper="(23), (24)")


class WaveComponent(Section):
    """One linear wave of an irregular sea."""

    period_s: Positive = described("period of this wave")
    amplitude_m: NonNegative = described("amplitude of this wave")
    phase_rad: Number = described("phase of this wave, added to its k x - omega t", 0.0)
    direction_rad: Number = described("direction in which this wave travels, from +x to +y", 0.0)


WaveComponents = Annotated[
    tuple[WaveComponent, ...],
    Field(min_length=1, max_length=MOST_COMPONENTS),
    Allowed(f"a list of 1 to {MOST_COMPONENTS} tables of period_s, amplitude_m, phase_rad and direction_rad"),
]


class Jonswap(Section):
    """A sea drawn from the JONSWAP spectrum, its peak at waves.period_s (`engine.physics.sea`)."""

    significant_height_m: Positive = described("significant height; the sea has the variance H_s^2/16", symbol="H_s")
    peak_enhancement: PeakEnhancement = described(
        "peak enhancement; 1: the spectrum of Pierson and Moskowitz", 3.3, symbol="gamma"
    )
    components: Components = described("number of waves that the sea is made of", 64)
    seed: CountOrZero = described("seed of the random frequencies and phases; the same seed gives the same sea", 0)


def irregular(waves: dict[str, object]) -> bool:
    """Whether the keys of `waves` describe a sea of several waves rather than one regular wave."""
    return any(waves.get(key) is not None for key in ("components", "jonswap", "significant_steepness"))


def above_by_default(waves: dict[str, object], whole_sphere: bool) -> str:
    """waves.above_still_water where it is not given, by the other keys of `waves` and by the buoy.

    whole_sphere: a buoy keeps its whole buoyancy above the water, or there is none. The stretched short waves of an
    irregular sea can throw a whole sphere so far that its run fails. One with a cap floats in crests, where the water
    has to move.
    """
    if not irregular(waves):
        return "extrapolate"
    return "zero" if whole_sphere else "wheeler"


class Waves(Section):
    """Linear (Airy) waves: one regular wave with its steepness [kA] or amplitude [A], or an irregular sea.

    period_s is that of the regular wave [Ti]; of a sea, its peak period, in which runs are counted.
    """

    period_s: Positive = described(
        "period; of an irregular sea the peak period, in which runs are counted", symbol="T_i", paper="section 4.2"
    )
    steepness: NonNegative | None = described(
        "steepness kA of a regular wave; give one of steepness, amplitude_m, significant_steepness, record, components "
        "and jonswap",
        None,
        symbol="kA",
        paper="section 4.2",
    )
    amplitude_m: NonNegative | None = described("amplitude of a regular wave", None, symbol="A", paper="section 4.2.1")
    ramp_s: NonNegative = described("time in which the waves grow from zero, as sin^2; 0: full waves from t = 0", 0.0)
    phase_rad: Number = described("phase, added to k x - omega t", 0.0)
    direction_rad: Number = described("direction of travel, from +x to +y", 0.0, symbol="a", paper="figure 8")
    significant_steepness: NonNegative | None = described(
        "steepness k H_s/2 of a sea with a Gaussian spectrum about period_s, k of period_s; with relative_width",
        None,
        symbol="k H_s/2",
    )
    relative_width: RelativeWidth | None = described(
        "standard deviation of the Gaussian spectrum over its peak frequency; 0: one regular wave of the same energy",
        None,
    )
    component_count: Components = described("number of waves of a Gaussian spectrum", 64)
    seed: CountOrZero = described("seed of the frequencies and phases of a Gaussian spectrum", 0)
    record: Text | None = described(
        "CSV file of a measured sea beside the scene file, columns time_s and elevation_m; kept as components", None
    )
    record_x_m: Number = described("place of the gauge of record", 0.0)
    components: WaveComponents | None = described(
        "an irregular sea as a list of waves, each a table of the four keys below", None
    )
    jonswap: Jonswap | None = described(
        "an irregular sea drawn from the JONSWAP spectrum, with its peak at period_s", None
    )
    above_still_water: Literal["extrapolate", "zero", "wheeler"] = described(
        "motion of the water above still water; by default extrapolate, in an irregular sea wheeler, or zero for a "
        "whole sphere",
        default_factory=lambda waves: above_by_default(waves, whole_sphere=True),
    )

    @property
    def irregular(self) -> bool:
        """Whether this is a sea of several waves rather than one regular wave."""
        return irregular(vars(self))

    @property
    def heading_rad(self) -> float:
        """Direction in which the waves go: that of all, or of listed waves the mean of their energy."""
        if not self.components:
            return self.direction_rad
        along = across = energy = 0.0
        for wave in self.components:
            energy += wave.amplitude_m**2
            along += wave.amplitude_m**2 * math.cos(wave.direction_rad)
            across += wave.amplitude_m**2 * math.sin(wave.direction_rad)
        if energy == 0.0:
            return 0.0
        # without the rounding of sines, which would turn the plane of waves that stand along x
        return math.atan2(round(across / energy, 12), round(along / energy, 12))


class UniformCurrent(Section):
    """The same steady velocity everywhere."""

    law: Literal["uniform"] = described("form of the current; the other keys depend on it", paper="(24)")
    velocity_mps: Vector = described("uniform: one vector; profile: one at each height", paper="(24)")


class ProfileCurrent(Section):
    """A steady velocity given at heights above the bed."""

    law: Literal["profile"]
    height_m: Series = described("profile, table: heights above the bed, increasing", paper="(24)")
    velocity_mps: Vectors


class TableCurrent(Section):
    """A velocity given on a grid of time, height above the bed, x and (in three dimensions, where it is given) y.

    An axis of one value is a constant.
    """

    law: Literal["table"]
    x_m: Axis = described("table: places along x, increasing", paper="(24)")
    y_m: Axis | None = described("table: places along y, increasing (three dimensions)", None, paper="(24)")
    height_m: Axis
    time_s: Axis = described("table: times, increasing", paper="(24)")
    velocity_x_mps: Block = described(
        "table: velocity along x at [time][height][x], or [time][height][y][x]", paper="(24)"
    )
    velocity_y_mps: Block | None = described(
        "table: velocity across (three dimensions); by default zero", None, paper="(24)"
    )
    velocity_z_mps: Block = described("table: velocity upwards", paper="(24)")


Current = Annotated[UniformCurrent | ProfileCurrent | TableCurrent, Field(discriminator="law")]
