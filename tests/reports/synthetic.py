"""A buoy sweep's folder without a simulation: the campaign with sums of sines for the motion."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from campaigns import buoy_sweep
from engine.scene import load_scene
from tests.campaigns.fake_engine import FakeEngine, sines

MESSAGE = "Newton's method did not converge <at> t = 12 s, #step $x$ 1e-9"


@dataclass(frozen=True)
class Motions(FakeEngine):
    """Period 1 below kA = 0.06, period 2 to 0.1, two incommensurate frequencies above.

    failing: steepness -> (status, periods reached).
    """

    failing: Mapping[float, tuple[str, float]] = field(default_factory=dict)

    def __call__(self, scene, periods=None, duration_s=None):
        kA = scene.waves.steepness
        status, reached = self.failing.get(kA, ("ok", periods or duration_s / scene.waves.period_s))
        message, releases = "" if status == "ok" else MESSAGE, 7 if kA > 0.12 else 0
        run = sines(scene, reached, status, message, tension=(2000.0, 5e4 * kA), releases=releases)
        step_s = scene.sample_step_s()  # one more on both sides, for rates at the ends
        phase = 2.0 * np.pi / scene.waves.period_s * step_s * np.arange(-1, len(run.columns["time_s"]) + 1)
        more = 0.8 * np.sin(0.5 * phase + 0.3) if 0.06 <= kA < 0.1 else 0.0
        more = 0.7 * np.sin(phase / np.pi) * np.cos(phase / np.e) if kA >= 0.1 else more
        r = 20.8 + 12.0 * kA * (np.sin(phase) + more)
        changed = {"radius_m": r[1:-1], "radius_rate_mps": np.gradient(r, step_s)[1:-1]}
        changed["z_m"] = changed["radius_m"] * np.cos(run.columns["angle_rad"])
        return replace(run, columns=run.columns | changed)


def campaign(directory: Path, steepness, periods=80, transient=20, failing=None, overrides=None) -> Path:
    """The folder of a sweep of `Motions`. overrides: of the scene `tethered_buoy`."""
    scene = Path(directory).with_suffix(".toml")
    scene.parent.mkdir(parents=True, exist_ok=True)
    scene.write_text(load_scene("tethered_buoy", overrides or {}).to_toml(), encoding="utf-8")
    length = ["--periods", str(periods), "--transient", str(transient), "--scene", str(scene)]
    how = ["--jobs", "1", "--backend", "threading", "--no-report", "--no-accuracy", "--out", str(directory)]
    swept = ["--steepness", *map(str, steepness), "--set", "output.tangent_vectors=0"]
    assert buoy_sweep.main([*swept, *length, *how], simulate=Motions(failing=failing or {})) in (0, 1)
    return Path(directory)
