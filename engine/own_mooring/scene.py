"""The scene of a mooring: what follows from its lengths, and the commented text.

The buoy is a sphere in sea water at the end of one rope. With the rope stretched by the whole lift it reaches up to
L (1 + lift/EA) + D/2. If this is above the troughs of the waves, the buoy floats; if it is below, it stays submerged.
The water acts on the wetted cap either way: it is the whole sphere until a higher wave leaves a part of it dry.
"""

import math
import re
from dataclasses import dataclass
from pathlib import Path

from engine.own_mooring.ropes import Rope

SEA_KGPM3, GRAVITY_MPS2, VISCOSITY_M2PS = 1025.0, 9.81, 1.2e-6
SURFACE, SUBMERGED = "surface", "submerged"
CRISIS = 3e5  # Reynolds number above which the drag of a smooth sphere falls from 0.5 to 0.2 (Hoerner 1965)
SINK_M = 0.01  # of the rope into the bed, under its weight in air


@dataclass(frozen=True)
class Mooring:
    """Lengths of a mooring, as `python -m engine --new` asks for them.

    mass_kg: of the buoy; None: half of what it displaces. wave: height (crest to trough) and period; a height of 0 is a
    scene without waves, and its period is None.
    """

    buoy_diameter_m: float
    depth_m: float
    rope: Rope
    length_m: float
    wave_height_m: float
    wave_period_s: float | None
    current_mps: float = 0.0
    mass_kg: float | None = None

    @property
    def rope_mm(self) -> float:
        """Diameter of the rope."""
        return 1e3 * self.rope.diameter_m

    @property
    def amplitude_m(self) -> float:
        """Of the waves."""
        return 0.5 * self.wave_height_m

    @property
    def ramp_s(self) -> float:
        """Time in which the waves grow: five periods."""
        return 5.0 * self.wave_period_s

    @property
    def reynolds(self) -> float:
        """Of the sphere: current and motion of the water in the waves, as if it stood still."""
        speed_mps = abs(self.current_mps)
        if self.wave_height_m:
            speed_mps += math.pi * self.wave_height_m / self.wave_period_s
        return speed_mps * self.buoy_diameter_m / VISCOSITY_M2PS

    @property
    def drag(self) -> float:
        """Drag coefficient of a smooth sphere (Hoerner 1965, Fluid-dynamic drag)."""
        return 0.2 if self.reynolds > CRISIS else 0.5

    @property
    def displaced_kg(self) -> float:
        """Sea water that the whole sphere displaces."""
        return SEA_KGPM3 * math.pi * self.buoy_diameter_m**3 / 6.0

    @property
    def buoy_kg(self) -> float:
        """Mass of the buoy."""
        return 0.5 * self.displaced_kg if self.mass_kg is None else self.mass_kg

    @property
    def added_kg(self) -> float:
        """Added mass of a sphere in potential flow."""
        return 0.5 * self.displaced_kg

    @property
    def lift_N(self) -> float:
        """Pull of the buoy on the rope while it is wholly in the water."""
        return (self.displaced_kg - self.buoy_kg) * GRAVITY_MPS2

    @property
    def hanging_N(self) -> float:
        """Weight in sea water of the rope between the bed and the buoy."""
        weight_Npm = (self.rope.density_kgpm3 - SEA_KGPM3) * self.rope.area_m2 * GRAVITY_MPS2
        return weight_Npm * min(self.length_m, self.depth_m)

    @property
    def stretch(self) -> float:
        """Length of the rope under the whole lift, over its length without load."""
        return 1.0 + self.lift_N / self.rope.stiffness_N

    @property
    def reach_m(self) -> float:
        """Height of the top of the buoy above the bed on the upright rope, stretched by the whole lift."""
        return self.length_m * self.stretch + 0.5 * self.buoy_diameter_m

    @property
    def kind(self) -> str:
        """SURFACE where the buoy can reach a trough, else SUBMERGED."""
        return SURFACE if self.reach_m >= self.trough_m else SUBMERGED

    @property
    def trough_m(self) -> float:
        """Height of a trough above the bed."""
        return self.depth_m - self.amplitude_m

    @property
    def longest_submerged_m(self) -> float:
        """Length of rope below which the buoy is SUBMERGED."""
        return (self.trough_m - 0.5 * self.buoy_diameter_m) / self.stretch

    def faults(self, kind: str | None = None) -> list[str]:
        """What cannot be, a line each: a buoy that sinks, also with its rope, or of another kind, a breaking wave."""
        lines = []
        if self.buoy_kg >= self.displaced_kg:
            most = f"less than the {self.displaced_kg:.4g} kg of sea water that the sphere displaces, or it sinks"
            lines.append(f"--buoy-mass: given {self.buoy_kg:g}; allowed: {most}")
        elif self.lift_N <= self.hanging_N:
            lifts = f"a buoy that lifts more than the {self.hanging_N:.4g} N its rope weighs in water; this one lifts"
            lines.append(f"--buoy-diameter: given {self.buoy_diameter_m:g}; allowed: {lifts} {self.lift_N:.4g} N")
        breaking_N = self.rope.breaking_load_N
        if self.kind == SUBMERGED and self.lift_N >= breaking_N:
            bears = f"a rope that bears the {self.lift_N:.4g} N with which the buoy pulls; this one breaks at"
            lines.append(f"--rope-mm: given {self.rope_mm:g}; allowed: {bears} {breaking_N:.4g} N")
        if self.buoy_diameter_m >= self.depth_m:
            lines.append(f"--buoy-diameter: given {self.buoy_diameter_m:g}; allowed: less than the depth")
        if self.wave_height_m:
            from engine.physics.waves import breaking_steepness, wave_number

            k = wave_number(self.wave_period_s, self.depth_m, GRAVITY_MPS2)
            highest = 2.0 * breaking_steepness(k, self.depth_m) / k
            if self.wave_height_m > highest:
                breaks = f"at most {highest:.3g}, where a wave of {self.wave_period_s:g} s breaks in this depth"
                lines.append(f"--wave-height: given {self.wave_height_m:g}; allowed: {breaks}")
        if kind not in (None, self.kind):
            bound, place = ("more", "above") if kind == SURFACE else ("less", "below")
            needs = f"a rope of {self.longest_submerged_m:.4g} m or {bound}, which stretched by the buoy ends {place}"
            lines.append(f"--kind: given {kind!r} with a rope of {self.length_m:g} m; allowed: {needs} the troughs")
        return lines


@dataclass(frozen=True)
class Bed:
    """Springs into which a rope sinks by SINK_M under its weight in air, with critical damping of its mass."""

    rope: Rope

    @property
    def stiffness_Npm3(self) -> float:
        """Per area of contact, which is as wide as the rope."""
        return self.rope.mass_kgpm * GRAVITY_MPS2 / (self.rope.diameter_m * SINK_M)

    @property
    def damping_Nspm3(self) -> float:
        """Of a mass m on a spring k: 2 sqrt(k m), both per length of rope, divided by its width."""
        return 2.0 * math.sqrt(self.stiffness_Npm3 * self.rope.mass_kgpm / self.rope.diameter_m)


def scene_text(mooring: Mooring, name: str) -> str:
    """The scene as TOML by `template.txt`, with the origin of every value in a comment."""
    template = Path(__file__).with_name("template.txt").read_text(encoding="utf-8")
    if not mooring.wave_height_m:
        template = _without("waves", template)
    if not mooring.current_mps:
        template = _without("current", template)
    rope = mooring.rope
    return template.format(name=name, m=mooring, rope=rope, bed=Bed(rope))


def _without(section: str, template: str) -> str:
    return re.sub(rf"\n\[{section}\]\n.*?(?=\n\[|\Z)", "", template, flags=re.DOTALL)
