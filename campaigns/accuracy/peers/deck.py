"""The tethered buoy in the input language of MoorDyn, which CableDyn reads too: rope, points and line.

Each code adds its own first lines and its own options.
"""

import math

SYSTEM = """---------------------- LINE TYPES ----------------------
Name   Diam   Mass/m  EA  BA  EI  Cd  Ca  CdAx  CaAx
(-)    (m)    (kg/m)  (N) (N-s) (N-m^2) (-) (-) (-) (-)
rope {diameter!r} {mass!r} {stiffness!r} 0.0 0.0 {drag_normal!r} {added_mass!r} {drag_tangential!r} 0.0
---------------------- POINTS --------------------------
ID Attachment X Y Z Mass Volume CdA Ca
(-) (-) (m) (m) (m) (kg) (m^3) (m^2) (-)
1 Fixed 0 0 {bed!r} 0 0 0 0
2 Free 0 0 {top!r} {buoy_mass!r} {volume!r} {area!r} {buoy_added!r}
---------------------- LINES ---------------------------
ID Type AttachA AttachB Length Segments Outputs
(-) (-) (-) (-) (m) (-) (-)
1 rope 1 2 {length!r} {segments} -
"""


def volume(scene) -> float:
    """Volume of the buoy, m3."""
    return math.pi * scene.buoy.diameter_m**3 / 6


def system(scene, segments: int, bed_m: float, area_m2: float) -> str:
    """Rope, points and line. bed_m: height of the anchor; area_m2: drag area times coefficient of the buoy.

    The buoy stands where a linear rope with half its weight carries its lift. The programs look for the equilibrium
    themselves, but stop short of it, and without damping the rest would ring on.
    """
    tether, buoy, density = scene.tether, scene.buoy, scene.water.density_kgpm3
    stiffness = tether.tension.stiffness_N
    lift = (density * volume(scene) - buoy.mass_kg) * scene.gravity_mps2
    weight = (tether.density_kgpm3 - density) * tether.area_m2 * scene.gravity_mps2 * tether.length_m
    strain = (lift - 0.5 * weight) / stiffness
    return SYSTEM.format(
        diameter=2 * math.sqrt(tether.area_m2 / math.pi), mass=tether.density_kgpm3 * tether.area_m2,
        stiffness=stiffness, drag_normal=tether.drag_normal, drag_tangential=tether.drag_tangential,
        added_mass=tether.added_mass, bed=bed_m, top=bed_m + tether.length_m * (1 + strain),
        buoy_mass=buoy.mass_kg, volume=volume(scene), area=area_m2,
        buoy_added=buoy.added_mass_kg / (density * volume(scene)), length=tether.length_m, segments=segments,
    )  # fmt: skip
