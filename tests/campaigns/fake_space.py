"""A stand-in for engine.simulate in three dimensions: in-plane sines, and a lateral motion of known answer.

Small waves decay; what large ones do is chosen: "bursts" (a rope that bursts over a quiet buoy), "growth" (exponential
growth of both up to the motion in the plane) or "decay". All is linear in the push until it saturates.
"""

from dataclasses import dataclass, replace

import numpy as np

from campaigns.out_of_plane import LOOPING_DEPTHS_M, SMALL
from tests.campaigns.fake_engine import FakeEngine, shapes

SWING = 0.2  # rad/s
SMALL_RATE, LARGE_RATE = -0.04, {"growth": 0.08, "decay": -0.05}  # nats/s
BURST_PERIODS, BURST_M, SATURATED_M = 6, 0.3, 4.0


@dataclass(frozen=True)
class SpaceEngine(FakeEngine):
    """As FakeEngine; failing: depths at which a run in three dimensions ends at once."""

    large: str = "bursts"
    failing: tuple[float, ...] = ()

    def __call__(self, scene, periods=None, duration_s=None):
        run = super().__call__(scene, periods, duration_s)
        if scene.motion.dimensions == 2:
            looped = scene.waves.steepness != SMALL and scene.water.depth_m in LOOPING_DEPTHS_M
            return replace(run, statistics=run.statistics | {"loop_releases": 4 if looped else 0})
        if scene.water.depth_m in self.failing:
            empty = {name: values[:0] for name, values in run.columns.items()}
            return replace(run, status="statics-failed", message="not found", columns=empty)
        buoy, rope = lateral(run.columns["time_s"], scene, self.large)
        columns = run.columns | {"y_m": buoy, "offplane_m": np.abs(rope)}
        return replace(run, columns=columns, profiles=shapes(run) if scene.output.profiles else None)


def lateral(t, scene, large):
    """y of the buoy and the rope's largest, (n,) each, for the push of the scene."""
    push = scene.start.buoy_velocity_mps[1]
    kind = "decay" if scene.waves.steepness == SMALL else large
    swing = push / SWING * np.sin(SWING * t)
    if kind == "bursts":
        phase = (t / scene.waves.period_s) % BURST_PERIODS - 0.5 * BURST_PERIODS
        buoy = 2.0 * swing
        return buoy, np.abs(buoy) + np.sign(abs(push)) * BURST_M * np.exp(-((phase / 0.1) ** 2))
    rate = SMALL_RATE if scene.waves.steepness == SMALL else LARGE_RATE[kind]
    grown = swing * np.exp(rate * t)
    grown = grown / np.sqrt(1.0 + (grown / SATURATED_M) ** 2)
    return grown, grown
