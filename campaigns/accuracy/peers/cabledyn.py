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

from campaigns.accuracy.peers.record import SAMPLE_S, nothing, sampled, system
from engine import Scene, Trajectory
from engine.physics.waves import wave_number

DECK = """---------------------- CableDyn Input File ----------------------
tethered buoy
{system}---------------------- OPTIONS -------------------------
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


def simulate(scene: Scene, duration_s: float, segments: int, step_s: float) -> Trajectory:
    """A run as the engine's record: a Trajectory of the buoy's places, or the program's own words where it fails."""
    short = _program(_deck(scene, segments, step_s, 2 * step_s))
    wall_s, fault, table = _program(_deck(scene, segments, step_s, duration_s))
    if fault:
        return nothing(scene, "solver-failed", fault, wall_s=wall_s)
    _, x, z = table[:: round(SAMPLE_S / step_s)].T
    places = np.column_stack([x, 0 * x, z + scene.water.depth_m])
    return sampled(scene, duration_s, places, max(wall_s - short[0], 0.0), round(duration_s / step_s))


def _deck(scene, segments, step_s, until_s) -> str:
    buoy, density, depth = scene.buoy, scene.water.density_kgpm3, scene.water.depth_m
    amplitude = scene.waves.steepness / wave_number(scene.waves.period_s, depth, scene.gravity_mps2)
    return DECK.format(
        system=system(scene, segments, -depth, buoy.drag * math.pi / 4 * buoy.diameter_m**2), step=step_s,
        until=until_s, gravity=scene.gravity_mps2, density=density, depth=depth, height=2 * float(amplitude),
        period=scene.waves.period_s,
    )  # fmt: skip


def _program(deck: str):
    """(wall seconds, "" or what went wrong, table (m, 3): time, x, z) of one run of the program."""
    import cabledyn

    program = Path(cabledyn.__file__).parent / "bin" / "cabledyn"
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "deck.dat").write_text(deck)
        start_s = time.perf_counter()
        process = subprocess.run([program, "deck.dat", "out"], cwd=folder, capture_output=True, text=True, check=False)
        wall_s = time.perf_counter() - start_s
        if process.returncode:
            errors = [line for line in process.stderr.splitlines() if line.strip()]
            return wall_s, " ".join(errors[:1]) or f"exit code {process.returncode}", None
        return wall_s, "", np.loadtxt(Path(folder, "out.out"), skiprows=2, ndmin=2)
