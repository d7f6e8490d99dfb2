"""Scales of a scene: in what Newton updates and step errors are measured, the fastest wave, the static loads."""

import math
from functools import lru_cache

import numpy as np

from ..physics.strains import strain_at, tension_at, tensions_at
from ..physics.tension import TensionLaw
from ..record import RELEASE_STEPS
from ..scene.models import Scene
from ..scene.sections import End, Tether

STEPS_OF_PERIOD = {"waves.period_s": 8, "end.motion.period_s": 40}  # at least; what shakes an end shakes the tension
TRANSIT_STEPS = 12  # after a loop release in the time that an axial wave takes along the line


def put_scales(record: np.void, scene: Scene, h: np.ndarray) -> None:
    """Inverse scales in which Newton updates and step errors are measured (Table 1: 0.04, 100 N, 1 m/s, 5 rad/m)."""
    length, g, m = scene.tether.length_m, scene.gravity_mps2, float(record["m"])
    stiff = buckling_load(scene.tether, scene.end)
    load = max(abs(float(record["lift"])), abs(float(record["w0"])) * length, stiff, 1e-3)
    if scene.end.force_N is not None:
        load = max(load, math.hypot(*scene.end.force_N))
    strain = strain_at(load, scene.tether.tension)
    if scene.end.kind == "held":
        stretched = math.hypot(*scene.end.position_m) / length - 1
        if stretched > strain:
            strain, load = stretched, max(load, tension_at(stretched, scene.tether.tension))
    stiffness = max(tension_at(strain, scene.tether.tension), 1e-9) / strain  # secant: what the law offers up to there
    pulled = end_speed(scene.end)
    if pulled > 0:  # an end that is pulled away sends out a wave of the force V sqrt(m T/eps)
        load = max(load, pulled * math.sqrt(m * stiffness))
        strain = max(strain, strain_at(load, scene.tether.tension))
    record["per_strain"] = 1 / strain
    transit = length * math.sqrt(m / stiffness)
    record["release_step"] = min(transit / TRANSIT_STEPS, float(record["max_step"]))
    # after a loop release in the time 2/rate, the rate that of the fastest bending wave of the grid
    rate = (math.pi / float(np.mean(h))) ** 2 * math.sqrt(record["EI"] / (record["m"] + record["ma"]))
    gone = max(record["release_step"], 2 / (rate * RELEASE_STEPS) if rate else 0.0)
    record["turn_step"] = min(gone, record["max_step"])
    record["per_force"] = 20 / load
    # the longest axial motion: the heave of a buoy on the line, or the line's own first one
    line = m * length
    held = {"buoy": 0.0, "held": math.pi**-2, "free": 4 * math.pi**-2}[scene.end.kind]
    record["inertia"] = length * (held * line or float(record["M_total"]) + line / 3)
    fastest = min(length * math.sqrt(stiffness / float(record["inertia"])), length / transit)
    record["per_ringing"] = 1 / strain / fastest
    recoil = strain * length / transit if scene.end.force_decay_s else 0.0  # of the end of a line that breaks
    bent = stiff / m
    record["per_speed"] = 1 / max(math.sqrt(max(g * length, bent)) / 14, recoil / 14, pulled, 1e-3)
    record["per_curvature"] = float(np.mean(h)) / 2.5


def fastest_wave(record: np.void, scene: Scene) -> float:
    """Largest axial wave speed sqrt(T'/m), m/s, between no strain and that of the static loads."""
    return math.sqrt(_steepest(scene.tether.tension, 1.0 / float(record["per_strain"])) / float(record["m"]))


@lru_cache
def _steepest(law: TensionLaw, strain: float) -> float:
    """Largest T' (N) of a law up to a strain."""
    strains = np.linspace(0.0, strain, 2001)
    return max(np.diff(tensions_at(strains, law)).max() / strains[1], 1e-300)


def longest_steps(scene: Scene) -> dict[str, float]:
    """What holds an adaptive step: key of the scene -> the longest step (s) that it allows."""
    limits = {"solver.max_step_s": scene.solver.max_step_s}
    for (key, steps), driver in zip(STEPS_OF_PERIOD.items(), (scene.waves, scene.end.motion), strict=True):
        limits[key] = getattr(driver, "period_s", math.inf) / steps
    return limits


def ringing_period(record: np.void, scene: Scene) -> float:
    """Period (s) of the axial motion of the line with what it carries, where the law is steepest up to static loads."""
    return 2 * math.pi * math.sqrt(float(record["inertia"] / record["m"])) / fastest_wave(record, scene)


def wave_beyond(record: np.void, length: float, top_m: float) -> float:
    """Force (N) of a regular wave, at its height top_m (m), on the half of an element (m) to which it does not reach.

    The box takes the forces at both ends for those along the element; those of waves fall as exp(k z).
    """
    k, omega = float(record["k"]), float(record["omega"])
    if k * length <= 2.0:
        return 0.0
    speed = float(record["amplitude"]) * omega * math.exp(min(k * (top_m - float(record["depth"])), 0.0))
    drag = max(float(record["cn"]), float(record["ct"])) * speed**2
    return (drag + float(record["Rw"] + record["ma"]) * omega * speed) * (length / 2 - 1 / k)


def jumps_of(end: End) -> list[tuple[float, float, float]]:
    """Jumps of the velocity at which a held end is moved: time (s), size (m/s), time (s) over which it is spread.

    A harmonic motion without a ramp begins at its full speed. A table that goes on as it begins, or ends as it went on,
    does so with the velocity that the parabola through three rows has there: a jump if it is twice as large as
    any within. The table spreads it between two rows (`physics.ends.table_of`).
    """
    motion = end.motion
    if motion is None or motion.law == "circular":
        return []
    if motion.law == "harmonic":
        if motion.ramp_s > 0 or abs(math.cos(motion.phase_rad)) <= 1e-6:
            return []
        return [(0.0, end_speed(end) * abs(math.cos(motion.phase_rad)), 0.0)]
    times, places = np.asarray(motion.time_s), np.asarray(motion.displacement_m)
    if len(times) < 3:
        return []  # a way from rest to rest
    speeds = np.linalg.norm(np.gradient(places, times, axis=0, edge_order=2), axis=1)
    changes = np.diff(np.diff(places, axis=0) / np.diff(times)[:, None], axis=0)
    within = np.linalg.norm(changes, axis=1).max()
    ends = (times[0], speeds[0], times[1] - times[0]), (times[-1], speeds[-1], times[-1] - times[-2])
    return [end for end in ends if end[1] > 2 * within]


def end_speed(end: End) -> float:
    """Greatest speed (m/s) at which a held end is moved; of a table the greatest between its rows, nearly."""
    motion = end.motion
    if motion is None:
        return 0.0
    if motion.law == "harmonic":
        return 2 * math.pi / motion.period_s * math.hypot(*motion.amplitude_m)
    if motion.law == "circular":
        return 2 * math.pi / motion.period_s * motion.radius_m
    steps = np.diff(motion.displacement_m, axis=0) / np.diff(motion.time_s)[:, None]
    return float(np.linalg.norm(steps, axis=1).max())


def buckling_load(tether: Tether, end: End) -> float:
    """Force (N) of bending and twist, of use where a line has no weight: the greater of the compression at which a
    clamped line buckles, EI (2 pi/L)^2 (Euler), and the tension that M = GIp twist/L overcomes, M^2/(4 EI) (Love).
    """
    EI, L = tether.bending_stiffness_Nm2, tether.length_m
    torque = tether.torsion_stiffness_Nm2 * (end.twist_rad or 0.0) / L
    return max(EI * (2 * math.pi / L) ** 2, torque**2 / (4 * EI)) if EI > 0 else 0.0
