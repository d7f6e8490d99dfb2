"""The scene of a mooring: what follows from its lengths, and the commented text.

The buoy is a sphere in sea water at the end of one rope. With the rope stretched by the whole lift it reaches up to
L (1 + lift/EA) + D/2. If this is above the troughs of the waves, the buoy floats, and the water acts on its wetted cap;
if it is below, the buoy stays submerged, and the water acts on the whole sphere.
"""

import math
from dataclasses import dataclass

from engine.own_mooring.ropes import Rope

SEA_KGPM3, GRAVITY_MPS2, VISCOSITY_M2PS = 1025.0, 9.81, 1.2e-6
SURFACE, SUBMERGED = "surface", "submerged"
CRISIS = 3e5  # Reynolds number above which the drag of a smooth sphere falls from 0.5 to 0.2 (Hoerner 1965)
RAMP_PERIODS = 5
SINK_M = 0.01  # of the line into the bed, under its weight in air
MICHE = 0.142  # largest height of a wave / length in deep water (Miche 1944)


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
    def displaced_kg(self) -> float:
        """Sea water that the whole sphere displaces."""
        return SEA_KGPM3 * math.pi * self.buoy_diameter_m**3 / 6.0

    @property
    def buoy_kg(self) -> float:
        """Mass of the buoy."""
        return 0.5 * self.displaced_kg if self.mass_kg is None else self.mass_kg

    @property
    def lift_N(self) -> float:
        """Pull of the buoy on the rope while it is wholly in the water."""
        return (self.displaced_kg - self.buoy_kg) * GRAVITY_MPS2

    @property
    def reach_m(self) -> float:
        """Height of the top of the buoy above the bed on the upright rope, stretched by the whole lift."""
        return self.length_m * (1.0 + self.lift_N / self.rope.stiffness_N) + 0.5 * self.buoy_diameter_m

    @property
    def kind(self) -> str:
        """SURFACE where the buoy can reach a trough, else SUBMERGED."""
        return SURFACE if self.reach_m >= self.trough_m else SUBMERGED

    @property
    def trough_m(self) -> float:
        """Height of a trough above the bed."""
        return self.depth_m - 0.5 * self.wave_height_m

    @property
    def longest_submerged_m(self) -> float:
        """Length of rope below which the buoy is SUBMERGED."""
        stretch = 1.0 + self.lift_N / self.rope.stiffness_N
        return (self.trough_m - 0.5 * self.buoy_diameter_m) / stretch

    def faults(self) -> list[str]:
        """What cannot be: a buoy that sinks, a rope that it tears, a wave that breaks; a line each, with the option."""
        lines = []
        if self.buoy_kg >= self.displaced_kg:
            most = f"less than the {self.displaced_kg:.4g} kg of sea water that the sphere displaces, or it sinks"
            lines.append(f"--buoy-mass: given {self.buoy_kg:g}; allowed: {most}")
        elif self.kind == SUBMERGED and self.lift_N >= self.rope.breaking_load_N:
            broken = f"a rope that bears the {1e-3 * self.lift_N:.4g} kN with which the buoy can pull"
            lines.append(f"--rope-mm: given {1e3 * self.rope.diameter_m:g}, which breaks at "
                         f"{1e-3 * self.rope.breaking_load_N:.4g} kN; allowed: {broken}")  # fmt: skip
        if self.buoy_diameter_m >= self.depth_m:
            lines.append(f"--buoy-diameter: given {self.buoy_diameter_m:g}; allowed: less than the depth")
        if self.wave_height_m > 0.0:
            from engine.physics.waves import wave_number

            k = wave_number(self.wave_period_s, self.depth_m, GRAVITY_MPS2)
            highest = MICHE * 2.0 * math.pi / k * math.tanh(k * self.depth_m)
            if self.wave_height_m > highest:
                breaks = f"at most {highest:.3g}, where a wave of {self.wave_period_s:g} s breaks in this depth"
                lines.append(f"--wave-height: given {self.wave_height_m:g}; allowed: {breaks}")
        return lines

    def kind_fault(self, kind: str | None) -> str:
        """Why the buoy is not of the kind that was asked for, as a fault line; "" where it is, or none was."""
        if kind in (None, self.kind):
            return ""
        bound = f"{self.longest_submerged_m:.4g} m or {'less' if kind == SUBMERGED else 'more'}"
        needs = f"a rope of {bound}, because stretched by the buoy it has to end "
        place = "below the troughs" if kind == SUBMERGED else "above the troughs"
        return f"--kind: given {kind!r} with a rope of {self.length_m:g} m; allowed: {needs}{place}"


def scene_text(mooring: Mooring, name: str) -> str:
    """The scene as TOML, with the origin of every value in a comment."""
    sections = [_head(mooring, name), _tether(mooring), _buoy(mooring), _water(mooring), _floor(mooring)]
    return "\n".join(line for section in sections for line in [*section, ""])


def _line(text: str, origin: str) -> str:
    return f"{text:<46} # {origin}"


def _head(mooring: Mooring, name: str) -> list[str]:
    rope = mooring.rope
    title = f"Sphere of {mooring.buoy_diameter_m:g} m on {mooring.length_m:g} m of rope of {1e3 * rope.diameter_m:g} mm"
    return [
        "# Written by `python -m engine --new`. Every value says where it comes from. A choice is that of the",
        "# programme: vary it, and see whether the answer moves. docs/own_mooring.md goes on from here.",
        f'name = "{name}"',
        f'title = "{title} in {mooring.depth_m:g} m of water"',
    ]


def _tether(mooring: Mooring) -> list[str]:
    rope = mooring.rope
    stiffness = rope.source
    for alternative_N, source in rope.alternatives:
        stiffness += f"; {1e-3 * alternative_N:.4g} kN: {source}"
    return [
        "[tether]",
        _line(f"length_m = {float(mooring.length_m)}", "given: unstretched, anchor to buoy"),
        _line(f"area_m2 = {rope.area_m2:.4g}", f"mass per length, {rope.mass_kgpm:.4g} kg/m, divided by the density"),
        _line(f"density_kgpm3 = {rope.density_kgpm3}", f"{rope.title}: {rope.source}"),
        _line(f"diameter_m = {rope.diameter_m:g}", "given: nominal, on which the drag acts"),
        _line(f"breaking_load_N = {rope.breaking_load_N:.4g}", f"{rope.source}; take that of your certificate"),
        _line(f'tension = {{ law = "linear", stiffness_N = {rope.stiffness_N:.4g} }}', f"EA: {stiffness}"),
        _line(
            f"bending_stiffness_Nm2 = {rope.bending_Nm2:.3g}",
            "EA A/(4 pi): a solid rod. A rope has less; it matters where the rope is slack",
        ),
        _line("drag_normal = 1.0", "Tjavaras et al. (1998), section 2.3; more for a fouled or strumming rope"),
        _line("drag_tangential = 0.1", "Tjavaras et al. (1998), section 2.3"),
        _line("added_mass = 1.0", "a circular cylinder in potential flow"),
        _line("nodes = 41", "choice: compare with 81"),
    ]


def _buoy(mooring: Mooring) -> list[str]:
    diameter_m, origin = mooring.buoy_diameter_m, "given"
    if mooring.mass_kg is None:
        origin = "choice: half of what the sphere displaces. Weigh yours"
    submergence, why = "full", "it stays submerged"
    if mooring.kind == SURFACE:
        submergence, why = "spherical-cap", "it floats"
    speed_mps = abs(mooring.current_mps)
    if mooring.wave_height_m > 0.0:
        speed_mps += math.pi * mooring.wave_height_m / mooring.wave_period_s
    reynolds = speed_mps * diameter_m / VISCOSITY_M2PS
    drag, side = (0.2, "above") if reynolds > CRISIS else (0.5, "below")
    reach = (
        f"on the stretched rope its top reaches {mooring.reach_m:.4g} m, and a trough is at {mooring.trough_m:.4g} m"
    )
    return [
        "[buoy]",
        _line(f"diameter_m = {float(diameter_m)}", "given"),
        _line(f"mass_kg = {mooring.buoy_kg:.5g}", origin),
        _line(
            f"added_mass_kg = {0.5 * mooring.displaced_kg:.5g}",
            "half of the displaced mass: a sphere in potential flow",
        ),
        _line(f"drag = {drag}", f"smooth sphere {side} Re = 3e5 (Hoerner 1965), here about {reynolds:.1g}"),
        _line(f'submergence = "{submergence}"', f"{why}: {reach}"),
    ]


def _water(mooring: Mooring) -> list[str]:
    lines = [
        "[water]",
        _line(f"depth_m = {float(mooring.depth_m)}", "given"),
        _line(f"density_kgpm3 = {SEA_KGPM3}", "sea water"),
    ]
    if mooring.wave_height_m > 0.0:
        period_s, amplitude_m = float(mooring.wave_period_s), 0.5 * mooring.wave_height_m
        ramp = f"choice: {RAMP_PERIODS} periods, so that the start does not snap the rope"
        lines += [
            "",
            "[waves]",
            _line(f"period_s = {period_s}", "given"),
            _line(f"amplitude_m = {amplitude_m}", "half of the given height"),
            _line(f"ramp_s = {RAMP_PERIODS * period_s}", ramp),
        ]
    if mooring.current_mps:
        velocity = f"velocity_mps = [{float(mooring.current_mps)}, 0.0, 0.0]"
        lines += [
            "",
            "[current]",
            _line('law = "uniform"', "choice: the same at every height"),
            _line(velocity, "given"),
        ]
    return lines


def _floor(mooring: Mooring) -> list[str]:
    """Springs into which the line sinks by SINK_M under its weight in air, with critical damping of its mass."""
    rope = mooring.rope
    stiffness = rope.mass_kgpm * GRAVITY_MPS2 / (rope.diameter_m * SINK_M)
    damping = 2.0 * math.sqrt(stiffness * rope.mass_kgpm / rope.diameter_m)
    return [
        "[floor]",
        _line(
            f"stiffness_Npm3 = {stiffness:.3g}",
            f"choice: the line sinks in by {1e3 * SINK_M:g} mm under its weight in air",
        ),
        _line(f"damping_Nspm3 = {damping:.3g}", "choice: critical for the mass of the line"),
    ]
