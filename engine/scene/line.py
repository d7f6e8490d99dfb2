"""The line, its two ends and the buoy: sections of a scene, every key with its meaning (`values.described`)."""

import math
from typing import Annotated, Literal

from pydantic import Field

from engine.physics.tension import TensionLaw
from engine.scene.values import (
    Nodes,
    NonNegative,
    Number,
    Positive,
    Section,
    Series,
    Stretching,
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
        "density of the material; m = density times area", symbol="rho", paper="Table 1, (9)"
    )
    diameter_m: Positive = described(
        "unstretched diameter; by default that of a circle of the area",
        symbol="d",
        paper="(24)",
        default_factory=lambda known: math.sqrt(4.0 * known["area_m2"] / math.pi),
    )
    nodes: Nodes = described("nodes of the grid, both ends included", 41, symbol="n_p", paper="section 3")
    grid_stretching: Stretching = described(
        "stretching of the grid; 0: equal elements, above: finer towards an end", 0.0, paper="section 3"
    )
    grid_refined: Literal["both", "lower", "upper"] = described(
        "end towards which stretching refines the grid", "both", paper="section 3"
    )
    bending_stiffness_Nm2: NonNegative = described(
        "bending stiffness; with 0 a slack line is ill-posed", symbol="EI", paper="(14), (15)"
    )
    torsion_stiffness_Nm2: NonNegative = described(
        "torsion stiffness; has no effect on a motion in a plane", 0.0, symbol="GI_p", paper="(13)"
    )
    drag_normal: NonNegative = described("normal drag coefficient, on the diameter", 1.0, symbol="C_dp", paper="(24)")
    drag_tangential: NonNegative = described(
        "tangential drag coefficient, on pi times the diameter", 0.1, symbol="C_dt", paper="(24)"
    )
    added_mass: NonNegative = described("normal added mass over rho_w pi d^2/4", 1.0, paper="(24)")
    tension: TensionLaw = described("tension law", symbol="T = f(eps)", paper="(20)")
    compression_barrier_N: NonNegative = described(
        "barrier: T loses P_b (0.5/(1 + eps) - 1)^2 below a strain of -1/2", 0.0, symbol="P_b"
    )


class Anchor(Section):
    """The lower end: fixed in place; free to rotate, or clamped in a direction (three dimensions only)."""

    rotation: Literal["pinned", "clamped"] = described(
        "rotation of the lower end: free, or clamped (three dimensions)", "pinned", paper="section 2.5"
    )
    direction: Vector | None = described(
        "direction of the clamped tangent; by default towards a held end, else upwards", None
    )


class HarmonicMotion(Section):
    """A held end is shaken: amplitude_m (r(t) sin(2 pi t/period_s + phase_rad) - its value at t = 0), r the ramp."""

    law: Literal["harmonic"] = described("form of the motion of the held end; the other keys depend on it")
    amplitude_m: Vector = described("harmonic: amplitude of r(t) sin(2 pi t/period + phase), less its value at t = 0")
    period_s: Positive = described("harmonic: period")
    phase_rad: Number = described("harmonic: phase", 0.0)
    ramp_s: NonNegative = described("harmonic: time of the ramp r = sin^2(pi t/(2 ramp)); 0: no ramp", 0.0)


class TableMotion(Section):
    """A held end is moved through displacements at times, by a monotone cubic (PCHIP) that starts and ends at rest."""

    law: Literal["table"]
    time_s: Series = described("table: times, increasing; at rest before the first and after the last")
    displacement_m: Vectors = described("table: displacements at these times, joined by monotone cubics")


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
    motion: Annotated[HarmonicMotion | TableMotion, Field(discriminator="law")] | None = described(
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
        "turn of the upper clamp about its tangent against the lower clamp", None, symbol="R"
    )
    twist_ramp_s: NonNegative | None = described(
        "time in which the twist is put in, as sin^2; 0: there from the start", None
    )


class Buoy(Section):
    """The sphere of eq. (30) [D, M, Ma, Cd].

    submergence "full": buoyancy, wave load, added mass and drag of the whole sphere at any height; "spherical-cap": of
    the part below the linear wave surface (`engine.physics.submergence`).
    """

    diameter_m: Positive = described("diameter of the sphere", symbol="D", paper="Table 1, (30)")
    mass_kg: Positive = described("mass", symbol="M", paper="Table 1, (30)")
    added_mass_kg: NonNegative = described("added mass", symbol="M_a", paper="Table 1, (30)")
    drag: NonNegative = described("drag coefficient, on pi D^2/4", symbol="C_d", paper="(30)")
    submergence: Literal["full", "spherical-cap"] = described(
        "part on which the water acts: the whole sphere, or its cap below the wave", "full", paper="(30)"
    )
    impact_loss: UnitInterval = described(
        "spherical-cap: share of the energy of an impact on the water lost in spray", 0.0, paper="(30)"
    )
