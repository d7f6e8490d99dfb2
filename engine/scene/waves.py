"""The waves of a scene: one regular wave, or an irregular sea (`engine.physics.sea`), as frozen pydantic models."""

from typing import Annotated, Literal

from pydantic import Field

from engine.scene.faults import Allowed
from engine.scene.values import (
    MOST_COMPONENTS,
    Components,
    CountOrZero,
    NonNegative,
    Number,
    PeakEnhancement,
    Positive,
    Section,
)


class WaveComponent(Section):
    """One linear wave of an irregular sea."""

    period_s: Positive
    amplitude_m: NonNegative
    phase_rad: Number = 0.0
    direction_rad: Number = 0.0


WaveComponents = Annotated[
    tuple[WaveComponent, ...],
    Field(min_length=1, max_length=MOST_COMPONENTS),
    Allowed(f"a list of 1 to {MOST_COMPONENTS} tables of period_s, amplitude_m, phase_rad and direction_rad"),
]


class Jonswap(Section):
    """A sea drawn from the JONSWAP spectrum, its peak at waves.period_s (`engine.physics.jonswap`)."""

    significant_height_m: Positive  # [Hs]
    peak_enhancement: PeakEnhancement = 3.3  # [gamma]; 1: the spectrum of Pierson and Moskowitz
    components: Components = 64
    seed: CountOrZero = 0


class Waves(Section):
    """Linear (Airy) waves: one regular wave with its steepness [kA] or amplitude [A], or an irregular sea.

    period_s is that of the regular wave [Ti]; of a sea, its peak period, in which runs are counted.
    """

    period_s: Positive
    steepness: NonNegative | None = None
    amplitude_m: NonNegative | None = None
    ramp_s: NonNegative = 0.0  # 0: full amplitude from t = 0, as in the paper
    phase_rad: Number = 0.0  # added to k x - omega t
    direction_rad: Number = 0.0  # of travel, from +x
    above_still_water: Literal["extrapolate", "zero", "wheeler"] = "extrapolate"
    components: WaveComponents | None = None
    jonswap: Jonswap | None = None

    @property
    def irregular(self) -> bool:
        """Whether this is a sea of several waves rather than one regular wave."""
        return self.components is not None or self.jonswap is not None
