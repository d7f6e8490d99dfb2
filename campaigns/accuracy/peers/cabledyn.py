"""The buoy scene in CableDyn (0.3.0 from PyPI), for `campaigns.accuracy`: its own program, a deck in, a table out.

Same rope, buoy, water, gravity, start and wave. The rope has no bending (its tension-only elements: finite bending was
not tried), the buoy is a free point with mass, volume, added mass and drag; its implicit generalized-alpha steps line
and point together. What is left different: wave kinematics are stretched after Wheeler, so that `error_against_ours` is
taken against our refined run with the same stretching; the program writes every step to a file, and its time is that of
the whole program less that of a run of two steps.
"""

import math
import subprocess
import tempfile
import time
from pathlib import Path

import numpy as np

from engine.waves import wave_number

SAMPLE = 0.05
NOTES = (
    "no bending and no compression in its rope (tension only); Wheeler stretching of the waves, and the distance "
    "from our limit is taken with the same stretching; its program writes every step to a file, and its time is that "
    "of the program less that of a run of two steps; where the buoy leaps out of the water (violent) the two are "
    "metres apart: eq. (30) keeps its buoyancy and its wave load there (campaigns/accuracy/peers/cabledyn.py)"
)
OURS = {"waves.above_still_water": "wheeler"}
_STEPS = ((5, 0.01), (10, 0.01), (10, 0.005), (20, 0.005), (20, 0.0025), (40, 0.0025))
SETTINGS = dict.fromkeys(("regular", "snap", "violent"), _STEPS)
REFINED = dict.fromkeys(SETTINGS, ((40, 0.00125), (40, 0.0025)))

DECK = """---------------------- CableDyn Input File ----------------------
tethered buoy
---------------------- LINE TYPES ----------------------
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
---------------------- OPTIONS -------------------------
{step!r} dtM
{until!r} TMax
{gravity!r} g
{density!r} rhoW
{depth!r} WtrDpth
airy {height!r} {period!r} 0.0 waves
---------------------- OUTPUTS -------------------------
Point2px
Point2pz
---------------------- END -----------------------------
"""


def simulate(scene, duration_s, segments, step_s):
    """A run as the engine's record: a Trajectory of the buoy's places, or the program's own words where it fails."""
    from campaigns.accuracy.peers.record import as_trajectory

    short = _program(_deck(scene, segments, step_s, 2 * step_s))
    wall_s, fault, table = _program(_deck(scene, segments, step_s, duration_s))
    if fault:
        return as_trajectory(scene, "solver-failed", fault, np.empty(0), np.empty((0, 3)), {"wall_s": wall_s})
    every = round(SAMPLE / step_s)
    time_s, x, z = table[::every].T
    places = np.column_stack([x, 0 * x, z + scene.water.depth_m])
    sound = len(x) == round(duration_s / SAMPLE) + 1 and np.isfinite(places).all()
    status, message = ("ok", "") if sound else ("not-finite", "CableDyn's table is short or not finite")
    statistics = {"wall_s": max(wall_s - short[0], 0.0), "steps": round(duration_s / step_s)}
    return as_trajectory(scene, status, message, SAMPLE * np.arange(len(time_s)), places, statistics)


def _deck(scene, segments, step_s, until_s) -> str:
    tether, buoy, density, depth = scene.tether, scene.buoy, scene.water.density_kgpm3, scene.water.depth_m
    volume = math.pi * buoy.diameter_m**3 / 6
    lift = (density * volume - buoy.mass_kg) * scene.gravity_mps2
    weight = (tether.density_kgpm3 - density) * tether.area_m2 * scene.gravity_mps2 * tether.length_m
    strain = (lift - 0.5 * weight) / tether.tension.stiffness_N
    amplitude = scene.waves.steepness / wave_number(scene.waves.period_s, depth, scene.gravity_mps2)
    return DECK.format(
        diameter=2 * math.sqrt(tether.area_m2 / math.pi), mass=tether.density_kgpm3 * tether.area_m2,
        stiffness=tether.tension.stiffness_N, drag_normal=tether.drag_normal, added_mass=tether.added_mass,
        drag_tangential=tether.drag_tangential, bed=-depth, top=-depth + tether.length_m * (1 + strain),
        buoy_mass=buoy.mass_kg, volume=volume, area=buoy.drag * math.pi / 4 * buoy.diameter_m**2,
        buoy_added=buoy.added_mass_kg / (density * volume), length=tether.length_m, segments=segments, step=step_s,
        until=until_s, gravity=scene.gravity_mps2, density=density, depth=depth, height=2 * float(amplitude),
        period=scene.waves.period_s,
    )  # fmt: skip


def _program(deck: str):
    """(wall seconds, "" or what went wrong, table (m, 3): time, x, z) of one run of the program."""
    import cabledyn

    program = Path(cabledyn.__file__).parent / "bin" / "cabledyn"
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "deck.dat").write_text(deck)
        began = time.perf_counter()
        done = subprocess.run([program, "deck.dat", "out"], cwd=folder, capture_output=True, text=True, check=False)
        wall_s = time.perf_counter() - began
        if done.returncode:
            said = [line for line in done.stderr.splitlines() if line.strip()]
            return wall_s, " ".join(said[:1]) or f"exit code {done.returncode}", None
        return wall_s, "", np.loadtxt(Path(folder, "out.out"), skiprows=2, ndmin=2)
