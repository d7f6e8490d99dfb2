"""Stand-ins for engine.simulate: sine waves at once, and on request every way a run can go wrong; known errors; a
lateral motion of known answer.

Steepness chooses the run, so that a campaign can be told which of its runs shall fail and how.

    python -m tests.campaigns.fake_engine ...      the buoy sweep with one; its fields as JSON in the variable FAKE
"""

import json
import os
import signal
import sys
import time
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from campaigns.out_of_plane import LOOPING_DEPTHS_M
from engine import Trajectory
from engine.trajectory import COLUMNS, Profiles
from tables import SMALL

STATISTICS = {"steps": 7, "rejected_steps": 1, "newton_iterations": 21, "newton_failures": 0, "loop_releases": 0}
ORDER = {"esdirk43": 4, "trbdf2": 2, "generalized-alpha": 2, "midpoint": 2, "backward-euler": 1}
GRID_M, STEP_M = 0.3, 0.2  # error of one element; of a step of one second
SWING = 0.2  # rad/s
SMALL_RATE, LARGE_RATE = -0.04, {"growth": 0.08, "decay": -0.05}  # nats/s
BURST_PERIODS, BURST_M, SATURATED_M = 6, 0.3, 4.0


@dataclass(frozen=True)
class FakeEngine:
    """Called like engine.simulate. log: file that gets a line for each run begun, the compile run excepted."""

    log: str | None = None
    sleep_s: float = 0.0
    raises: tuple[float, ...] = ()
    exits: tuple[float, ...] = ()
    breaks: tuple[float, ...] = ()  # ends early with status newton-failed, after two periods
    dies: tuple[float, ...] = ()  # takes its process with it, every time
    dies_once: tuple[float, ...] = ()  # the first time only
    no_space: tuple[float, ...] = ()
    loops: tuple[float, ...] = ()  # where planar runs release loops

    def __call__(self, scene, periods=None, duration_s=None, start=None):
        steepness = scene.waves.steepness
        if start is not None:  # a run goes on
            later = sines(scene, periods)
            later.columns["time_s"] += start.columns["time_s"][-1]
            return later
        if periods is None:
            return sines(scene, duration_s / scene.waves.period_s)
        begun = self.begun().count(steepness)
        if self.log:
            with open(self.log, "a") as log:
                log.write(f"{steepness!r}\n")
        time.sleep(self.sleep_s)
        if steepness in self.dies or (steepness in self.dies_once and begun == 0):
            os.kill(os.getpid(), signal.SIGKILL)
        if steepness in self.raises:
            raise ZeroDivisionError("a fault of the code")
        if steepness in self.exits:
            sys.exit(3)
        if steepness in self.no_space:
            raise OSError(28, "No space left on device")
        if steepness in self.breaks:
            return sines(scene, 2, status="newton-failed", message="no convergence")
        looped = steepness in self.loops and scene.motion.dimensions == 2
        return sines(scene, periods, releases=3 if looped else 0)

    def each(self, scenes, periods, duration_s, starts, then):
        """Called like engine.simulate_each; no run goes on."""
        for number, (scene, length) in enumerate(zip(scenes, periods, strict=True)):
            run = self(scene, length, duration_s)
            assert then(number, run) is None
            yield number, run

    def begun(self) -> list[float]:
        """Steepness of every run begun so far."""
        if not self.log or not Path(self.log).exists():
            return []
        return [float(line) for line in Path(self.log).read_text().split()]


def sines(
    scene, periods, status="ok", message="", harmonic=1.0, radius=(20.0, 1.0), tension=(2000.0, 500.0), releases=0
):
    """A trajectory whose radius, angle and tension are sines of `harmonic` times the wave frequency."""
    step = scene.sample_step_s()
    t = step * np.arange(round(periods * scene.waves.period_s / step) + 1)
    omega = harmonic * 2.0 * np.pi / scene.waves.period_s
    r = radius[0] + radius[1] * np.sin(omega * t)
    angle = 0.3 * np.sin(omega * t)
    force = tension[0] + tension[1] * np.sin(omega * t)
    columns = {
        "time_s": t,
        "x_m": r * np.sin(angle),
        "y_m": np.zeros_like(t),
        "z_m": r * np.cos(angle),
        "radius_m": r,
        "radius_rate_mps": radius[1] * omega * np.cos(omega * t),
        "angle_rad": angle,
        "angle_rate_radps": 0.3 * omega * np.cos(omega * t),
        "offplane_m": np.zeros_like(t),
        "tension_top_N": force,
        "tension_min_N": force,
        "tension_top_low_N": force - 10.0,
        "tension_top_high_N": force + 10.0,
        "loop_releases": np.where(t > 0.5 * t[-1], releases, 0.0),
        "unresolved_N": np.zeros_like(t),
        "line_lowest_m": np.zeros_like(t),
        "tension_anchor_N": force - 20.0,
        "tension_anchor_high_N": force - 10.0,
        "tension_max_N": force,
        "tension_max_s_m": np.full_like(t, scene.tether.length_m),
    }
    statistics = STATISTICS | {"max_turn_rad": 0.1, "min_strain": 0.01, "end_time_s": float(t[-1]), "wall_s": 0.5}
    statistics["loop_releases"] = releases
    return Trajectory(scene, status, message, columns, statistics)


def shapes(run):
    """Profiles of a run: nodes on a half sine about the line to the buoy, in the plane and across it; its tension."""
    scene, columns = run.scene, run.columns
    t = np.arange(0.0, columns["time_s"][-1] + 1e-9, scene.output.profiles_step_s)
    s = np.linspace(0.0, scene.tether.length_m, scene.tether.nodes)
    along, arch = s / s[-1], np.sin(np.pi * s / s[-1])
    names = ("x_m", "z_m", "tension_top_N")
    x, z, tension = (np.interp(t, columns["time_s"], columns[name])[:, None] for name in names)
    y = 0.1 * np.abs(np.sin(0.1 * t))[:, None]
    nothing = np.zeros((len(t), len(s)))
    return Profiles(t, s, x * along + 0.5 * arch, y * arch, z * along, nothing, nothing + tension, nothing)


@dataclass(frozen=True)
class KnownErrors:
    """Errors are known: order 2 in the grid, the integrator's order in time.

    failing: integrators whose runs end early; raises: nodes at which it breaks.
    """

    failing: tuple[str, ...] = ()
    raises: tuple[int, ...] = ()

    def __call__(self, scene, periods=None, duration_s=None):
        solver, nodes = scene.solver, scene.tether.nodes
        if nodes in self.raises and duration_s > 1.0:
            raise ZeroDivisionError("a fault of the code")
        order = ORDER[solver.integrator]
        step_s = solver.step_s or solver.rtol ** (1.0 / order)
        t = scene.sample_step_s() * np.arange(round(duration_s / scene.sample_step_s()) + 1)
        off = GRID_M * np.sin(t) / (nodes - 1) ** 2 + STEP_M * np.cos(t) * step_s**order
        radius = 20.8 + 0.5 * np.sin(1.3 * t) + off
        columns = {name: np.zeros_like(t) for name in COLUMNS}
        columns |= {"time_s": t, "radius_m": radius, "x_m": radius, "tension_min_N": 1000.0 * np.cos(0.1 * t)}
        work = {"newton_iterations": 10 * round(duration_s / step_s), "wall_s": 1e-4 * nodes / step_s}
        statistics = STATISTICS | work | {"max_turn_rad": 0.1, "min_strain": 0.01, "end_time_s": duration_s}
        run = Trajectory(scene, "ok", "", columns, statistics)
        if solver.integrator in self.failing:
            half = {name: values[: len(t) // 2] for name, values in columns.items()}
            run = replace(run, status="newton-failed", message="no convergence", columns=half)
        return run


@dataclass(frozen=True)
class SpaceEngine(FakeEngine):
    """In three dimensions: in-plane sines, and a lateral motion of known answer, linear in the push until it saturates.

    Small waves decay. large: what large ones do, "bursts" (a rope that bursts over a quiet buoy), "growth" (exponential
    growth of both up to the motion in the plane) or "decay"; failing: depths at which a run in space ends at once.
    """

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


if __name__ == "__main__":
    from campaigns import buoy_sweep
    from tests.campaigns.fake_engine import FakeEngine as Engine  # workers know it by this name

    fields = json.loads(os.environ.get("FAKE", "{}"))
    fields = {name: tuple(entry) if isinstance(entry, list) else entry for name, entry in fields.items()}
    sys.exit(buoy_sweep.main(simulate=Engine(**fields)))
