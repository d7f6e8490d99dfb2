"""A buoy sweep's folder without a simulation: sums of sines for the motion, so that reports are tested alone."""

import csv
import json
import math
from pathlib import Path

import numpy as np

from campaigns.buoy_sweep.rows import COLUMNS, buoy_row
from campaigns.columns import dictionary, names
from engine.scene import load_scene
from engine.trajectory import Trajectory


def campaign(directory: Path, steepness, periods=80, transient=20, failing=None, overrides=None) -> Path:
    """Write a folder as `campaigns.buoy_sweep` does.

    failing: steepness -> (status, periods reached). The motion has period 1 below kA = 0.06, period 2 to 0.1, and two
    incommensurate frequencies above. Returns the folder.
    """
    directory = Path(directory)
    (directory / "trajectories").mkdir(parents=True)
    rows = []
    for index, value in enumerate(steepness):
        status, reached = (failing or {}).get(value, ("ok", periods))
        scene = load_scene("tethered_buoy", {**(overrides or {}), "waves.steepness": value})
        run = motion(scene, value, status, reached)
        key = f"{index:064x}"
        run.save(directory / "trajectories" / f"{key}.nc")
        rows.append({"steepness": value, **buoy_row(run, transient), "run_key": key})
    (directory / "columns.csv").write_bytes(dictionary(COLUMNS))
    with open(directory / "table.csv", "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, names(COLUMNS), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    base = load_scene("tethered_buoy", overrides or {})
    (directory / "scene.toml").write_text(base.to_toml(), encoding="utf-8")
    provenance = {
        "campaign": "buoy_sweep",
        "command": ["python", "-m", "campaigns.buoy_sweep", "--steepness-range", "0.01", "0.16", "8"],
        "versions": {"python": "3.11.0", "numpy": "2.4.6"},
        "git": {"commit": "0" * 40, "dirty": True},
        "seed": None,
        "periods": periods,
        "transient": transient,
        "strobe_tolerance": 0.005,
        "longest_period": 16,
        "steepness": list(steepness),
        "timing": {"compile_s": 6.1, "run_s": 20.5, "analysis_s": 0.8},
    }
    (directory / "provenance.json").write_text(json.dumps(provenance), encoding="utf-8")
    return directory


def motion(scene, kA: float, status: str, periods: float) -> Trajectory:
    """A trajectory of forced, subharmonic and decaying sines, with the tension a linear tether would have."""
    wave = 2 * math.pi / scene.waves.period_s
    n = max(round(periods * scene.waves.period_s / scene.sample_step_s()) + 1, 0) if periods > 0 else 0
    t = scene.sample_step_s() * np.arange(-1, n + 1)  # one more on both sides, for rates at the ends
    second = 0.4 * np.sin(0.5 * wave * t + 0.3) if 0.06 <= kA < 0.1 else 0.0
    third = 0.7 * np.sin(wave * t / math.pi) * np.cos(wave * t / math.e) if kA >= 0.1 else 0.0
    swing = 12 * kA * (np.sin(wave * t) + second + third + np.exp(-t / 20) * np.sin(0.996 * t))
    radius = 20.8 + swing
    angle = 2.0 * kA * (np.cos(wave * t) + np.exp(-t / 25) * np.sin(0.199 * t) + 0.3 * third)
    rate, turn = (np.gradient(x, t)[1:-1] for x in (radius, angle))
    t, radius, angle = t[1:-1], radius[1:-1], angle[1:-1]
    tension = np.maximum(scene.tether.tension.stiffness_N * (radius / 20.0 - 1.0), -5.0)
    zero = np.zeros(n)
    columns = {
        "time_s": t,
        "x_m": radius * np.sin(angle),
        "y_m": zero,
        "z_m": radius * np.cos(angle),
        "radius_m": radius,
        "radius_rate_mps": rate,
        "angle_rad": angle,
        "angle_rate_radps": turn,
        "offplane_m": zero,
        "tension_top_N": tension,
        "tension_min_N": tension - 3.0,
        "tension_top_low_N": tension - 0.02 * abs(tension),
        "tension_top_high_N": tension + 0.03 * abs(tension),
    }
    statistics = {
        "steps": 40 * n,
        "rejected_steps": n // 9,
        "newton_iterations": 130 * n,
        "newton_failures": 0,
        "loop_releases": 7 if kA > 0.12 and n else 0,
        "max_turn_rad": min(30 * kA, 3.3),
        "min_strain": -0.001,
        "end_time_s": float(t[-1]) if n else 0.0,
        "wall_s": 0.0004 * n,
    }
    message = "" if status == "ok" else "Newton's method did not converge <at> t = 12 s, #step $x$ 1e-9"
    return Trajectory(scene, status, message, columns, statistics)
