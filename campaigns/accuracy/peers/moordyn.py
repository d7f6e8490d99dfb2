"""The buoy scene in MoorDyn (2.7.2 from PyPI), for `campaigns.accuracy`.

How it is made a fair opponent
- Same rope, buoy, water, gravity, start and wave. The rope is a MoorDyn line without bending and without internal
  damping (BA = 0: measured, any damping only adds to its error here), the buoy a free point.
- MoorDyn's points feel no wave acceleration; without it the rope never goes slack and the work is a different, trivial
  one. The water velocity at each point is an input (WaveKin = 1), and the drag of a point is all that it does. So the
  point gets a tiny drag area, and a velocity for which its drag IS the load of eq. (30): drag on the vector relative
  velocity plus (rho V + M_a) dU_w/dt. The load is evaluated half a step ahead, at positions and velocities extrapolated
  from the last two steps, and held over the step: second order in the step.
- Its own kinematics stop at the still water level; here the still level lies far above the buoy and the velocities and
  accelerations of extrapolated Airy waves are handed over at every node: full buoyancy and the same wave everywhere.
- Only the calls that step it are timed. The wave kinematics and the load of the buoy, part of every one of our Newton
  iterations, cost MoorDyn nothing. (With its own kinematics, WaveKin = 7, a step of 10 segments was measured to cost
  2.9 times as much.)
What is left different: no bending and no compression in its rope, so each code is held against its own refined limit.
Where the rope stays taut the two limits agree to 0.04 mm (kA = 0.016).
Schemes: RK4. RK2 and the midpoint scheme with 3 and 5 iterations were off by 0.04 to 0.8 m at similar cost, RK3, Heun
and Adams-Bashforth ended in NaN (all at 10 and 20 segments, without damping).
"""

import math
import os
import tempfile
import time
from contextlib import contextmanager
from pathlib import Path

import numpy as np

from campaigns.accuracy.peers.record import SAMPLE_S, sampled, system, volume
from engine import Scene, Trajectory
from engine.physics.waves import wave_number

BED = -100.0  # m: MoorDyn's still water level is z = 0, far above the buoy
PORT_AREA = 1e-3  # m2, drag area times coefficient of the point that takes the load

INPUT = """--- MoorDyn input ---
tethered buoy
{system}---------------------- OPTIONS -------------------------
0 writeLog
1 disableOutput
1 disableOutTime
RK4 tScheme
{step!r} dtM
{gravity!r} g
{density!r} rho
{depth!r} WtrDpth
1 WaveKin
0.1 dtIC
200 TmaxIC
1e-9 threshIC
---------------------- END -----------------------------
"""


@contextmanager
def silent():
    """MoorDyn greets on the process's own stdout and stderr."""
    saved = [os.dup(1), os.dup(2)]
    with open(os.devnull, "w") as sink:
        for number in (1, 2):
            os.dup2(sink.fileno(), number)
        try:
            yield
        finally:
            for number, copy in zip((1, 2), saved, strict=True):
                os.dup2(copy, number)
                os.close(copy)


def create(scene, segments, step_s):
    """A MoorDyn instance at rest in its static equilibrium."""
    import cmoordyn
    import moordyn

    text = INPUT.format(
        system=system(scene, segments, BED, PORT_AREA), step=step_s, gravity=scene.gravity_mps2,
        density=scene.water.density_kgpm3, depth=-BED + 0.5,
    )  # fmt: skip
    with tempfile.TemporaryDirectory() as folder, silent():
        path = Path(folder, "lines.txt")
        path.write_text(text)
        instance = moordyn.Create(str(path))
        moordyn.SetVerbosity(instance, moordyn.LEVEL_ERR)
        moordyn.Init(instance, [], [])
        cmoordyn.ext_wave_init(instance)
    return instance


def airy(scene):
    """Function (x, z, t) -> U, W, dU/dt, dW/dt of the scene's wave; z above the bed."""
    depth, omega = scene.water.depth_m, 2 * math.pi / scene.waves.period_s
    k = wave_number(scene.waves.period_s, depth, scene.gravity_mps2)
    speed = scene.waves.steepness / k * omega / math.sinh(k * depth)

    def water(x, z, t):
        psi = k * x - omega * t
        u, w = speed * np.cosh(k * z), speed * np.sinh(k * z)
        return u * np.cos(psi), w * np.sin(psi), u * omega * np.sin(psi), -w * omega * np.cos(psi)

    return water


def simulate(scene: Scene, duration_s: float, segments: int, steps_per_period: float) -> Trajectory:
    """A run as the engine's record: a Trajectory of the buoy's places."""
    periods = round(duration_s / scene.waves.period_s)
    with silent(), np.errstate(all="ignore"):  # a run that ends in NaN complains at length
        places, spent = stepped(scene, segments, round(steps_per_period), periods)
    return sampled(scene, duration_s, places, spent, round(steps_per_period) * periods)


def stepped(scene, segments, steps_per_period, periods):
    """x, y, z of the buoy from the anchor (m, 3), m, every SAMPLE_S seconds, and the seconds spent in steps."""
    import cmoordyn
    import moordyn

    period, density = scene.waves.period_s, scene.water.density_kgpm3
    step_s, stride = period / steps_per_period, round(steps_per_period * SAMPLE_S / period)
    assert steps_per_period == stride * round(period / SAMPLE_S)
    drag = 0.5 * density * scene.buoy.drag * math.pi / 4 * scene.buoy.diameter_m**2
    inertia = density * volume(scene) + scene.buoy.added_mass_kg
    port = 0.5 * density * PORT_AREA
    water, instance = airy(scene), create(scene, segments, step_s)
    point, buoy = moordyn.GetPoint(instance, 2), segments + 2  # coordinates: line nodes, anchor, buoy, ground
    places_before = np.array(cmoordyn.ext_wave_coords(instance)).reshape(-1, 3)
    velocity_before = np.array(moordyn.GetPointVel(point))
    kept, spent = [], 0.0
    for i in range(steps_per_period * periods + 1):
        places = np.array(cmoordyn.ext_wave_coords(instance)).reshape(-1, 3)
        velocity = np.array(moordyn.GetPointVel(point))
        if i % stride == 0:
            kept.append((places[buoy, 0], 0.0, places[buoy, 2] - BED))
        ahead = 1.5 * places - 0.5 * places_before
        velocity_ahead = 1.5 * velocity - 0.5 * velocity_before
        places_before, velocity_before = places, velocity
        U, rate = np.zeros_like(places), np.zeros_like(places)
        # the last of the coordinates is the ground body's, at MoorDyn's origin, and takes no load
        U[:-1, 0], U[:-1, 2], rate[:-1, 0], rate[:-1, 2] = water(ahead[:-1, 0], ahead[:-1, 2] - BED, (i + 0.5) * step_s)
        relative = U[buoy] - velocity_ahead
        load = drag * np.linalg.norm(relative) * relative + inertia * rate[buoy]
        U[buoy] = velocity_ahead + load / math.sqrt(port * np.linalg.norm(load))
        cmoordyn.ext_wave_set(instance, U.ravel().tolist(), rate.ravel().tolist(), i * step_s)
        start_s = time.perf_counter()
        cmoordyn.step(instance, [], [], i * step_s, step_s)
        spent += time.perf_counter() - start_s
    moordyn.Close(instance)
    return np.array(kept), spent
