"""Water, waves and current: sections of a scene, every key with its meaning (`values.described`)."""

from typing import Annotated, Literal

from pydantic import Field

from engine.scene.faults import Allowed
from engine.scene.values import (
    MOST_COMPONENTS,
    Axis,
    Block,
    Components,
    CountOrZero,
    NonNegative,
    Number,
    PeakEnhancement,
    Positive,
    Section,
    Series,
    Vector,
    Vectors,
    described,
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
    seed: CountOrZero = described("seed of frequencies and phases: the same seed gives the same sea", 0)


class Waves(Section):
    """Linear (Airy) waves: one regular wave with its steepness [kA] or amplitude [A], or an irregular sea.

    period_s is that of the regular wave [Ti]; of a sea, its peak period, in which runs are counted.
    """

    period_s: Positive = described(
        "period; of an irregular sea the peak period, in which runs are counted", symbol="T_i", paper="section 4.2"
    )
    steepness: NonNegative | None = described(
        "steepness kA of a regular wave; this, or amplitude_m, components or jonswap",
        None,
        symbol="kA",
        paper="section 4.2",
    )
    amplitude_m: NonNegative | None = described("amplitude of a regular wave", None, symbol="A", paper="section 4.2.1")
    ramp_s: NonNegative = described("time in which the waves grow, as sin^2; 0: full from t = 0", 0.0)
    phase_rad: Number = described("phase, added to k x - omega t", 0.0)
    direction_rad: Number = described("direction of travel, from +x to +y", 0.0, symbol="a", paper="figure 8")
    above_still_water: Literal["extrapolate", "zero", "wheeler"] = described(
        "meaning of the linear kinematics above the still water level", "extrapolate"
    )
    components: WaveComponents | None = described(
        "an irregular sea as a list of waves, each a table of the four keys below", None
    )
    jonswap: Jonswap | None = described(
        "an irregular sea drawn from the JONSWAP spectrum, with its peak at period_s", None
    )

    @property
    def irregular(self) -> bool:
        """Whether this is a sea of several waves rather than one regular wave."""
        return self.components is not None or self.jonswap is not None


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
