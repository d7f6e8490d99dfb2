"""What other codes are given, and what they gave as the engine's record: places of the upper end, strain of the line.

The tethered buoy is in the input language of MoorDyn, which CableDyn reads too: rope, points and line; each code adds
its own first lines and its own options. What a code does not say is nan in every column, so that nobody takes it for a
result.
"""

import math

import numpy as np

from engine.trajectory import COLUMNS, Profiles, Trajectory

SAMPLE_S = 0.05  # between the samples of codes that are not asked for those of the scene
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


def as_trajectory(scene, status, message, time_s, places_m, statistics, strain=None, s_m=None) -> Trajectory:
    """A Trajectory of what another code computed.

    time_s (m,): even samples; places_m (m, 3): upper end from the anchor, z up; strain (m, n) at the nodes s_m (n,),
    kept at the scene's profile times where it asks for profiles. statistics: numbers, wall_s among them.
    """
    x, y, z = np.asarray(places_m, float).reshape(-1, 3).T
    columns = {name: np.full(len(time_s), np.nan) for name in COLUMNS}
    columns |= {"time_s": np.asarray(time_s, float), "x_m": x, "y_m": y, "z_m": z}
    columns["radius_m"] = np.sqrt(x * x + y * y + z * z)
    end_s = float(time_s[-1]) if len(time_s) else 0.0
    lines = None
    if scene.output.profiles and strain is not None:
        stride = round((scene.output.profiles_step_s or scene.sample_step_s()) / scene.sample_step_s())
        kept = np.asarray(strain)[::stride]
        unknown = np.full_like(kept, np.nan)
        lines = Profiles(columns["time_s"][::stride], s_m, unknown, unknown, unknown, kept, unknown, unknown)
    return Trajectory(scene, status, message, columns, {"end_time_s": end_s, **statistics}, lines)


def sampled(scene, duration_s, places_m, wall_s, steps) -> Trajectory:
    """A Trajectory of places (m, 3) every SAMPLE_S seconds; one with samples missing or not finite is no result."""
    sound = len(places_m) == round(duration_s / SAMPLE_S) + 1 and np.isfinite(places_m).all()
    status, message = ("ok", "") if sound else ("not-finite", "places are missing or not finite")
    statistics = {"wall_s": wall_s, "steps": steps}
    return as_trajectory(scene, status, message, SAMPLE_S * np.arange(len(places_m)), places_m, statistics)


def nothing(scene, status: str, message: str, **statistics: float) -> Trajectory:
    """A Trajectory without a sample, of a run that gave none."""
    return as_trajectory(scene, status, message, np.empty(0), np.empty((0, 3)), statistics)


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
