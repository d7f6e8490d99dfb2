"""How far the tensions of a finished run hold: sentences for its message, each of one cause."""

import math

import numpy as np

from .record import lengths_of
from .scales import fastest_wave, jumps_of, ringing_period
from .scene.models import Scene
from .scene.size_limits import longest_step

NOTED = 0.05  # of the largest tension: what is less is not told


def errors_of_ringing(record: np.void, scene: Scene, time_s: np.ndarray, lost_N: np.ndarray) -> np.ndarray:
    """Error (N) of the tension at each sample, from ringing that was lost until then.

    What was lost would ring on until drag has taken it away, a' = -beta a^2, 1/a = 1/a_0 + beta (t - t_0): of a mass M
    on the line, and of the line itself, beta = 4 C/(3 pi omega M^2), C |v| v the drag.
    """
    length = scene.tether.length_m
    moved = float(record["inertia"]) / length
    line = (moved - float(record["M_total"])) / float(record["m"])  # length that moves as its end does
    drag = float(record["C_buoy"]) + float(record["ct"]) * line
    omega = 2 * math.pi / ringing_period(record, scene)
    beta = 4 * drag / (3 * math.pi * omega * moved**2)
    with np.errstate(divide="ignore"):
        return 1 / (beta * time_s + np.minimum.accumulate(1 / lost_N - beta * time_s))


def unresolved(record: np.void, tables: np.ndarray, scene: Scene, columns: dict[str, np.ndarray]) -> str:
    """Says how far the largest tension holds, and the least and later ones, where ringing was lost."""
    time_s, low, high = (columns[name] for name in ("time_s", "tension_top_low_N", "tension_top_high_N"))
    lost_N = columns["unresolved_N"]
    if not lost_N.any():
        return ""
    errors = errors_of_ringing(record, scene, time_s, lost_N)
    errors[:-1] = np.maximum(errors[:-1], errors[1:])  # what a step lost is booked with the sample after it
    most, least = int(high.argmax()), int(low.argmin())
    largest_N = max(abs(high[most]), abs(low[least]))
    if errors.max() <= NOTED * largest_N:
        return ""
    key, step_s = longest_step(scene)
    what = f"axial ringing of period {ringing_period(record, scene):.2g} s is"
    if record["all_waves"]:
        what = f"axial waves on elements of {lengths_of(record, tables)[-1]:.2g} m are"
    if record["adaptive"]:
        key = "solver.shortest_period_s or solver.max_step_s"
    held = [f"the largest tension, {high[most]:.4g} N at t = {time_s[most]:.4g} s, holds to {errors[most]:.2g} N"]
    if errors[least] > NOTED * largest_N:
        held.append(f"the least, {low[least]:.4g} N at t = {time_s[least]:.4g} s, to {errors[least]:.2g} N")
    worst = int(errors.argmax())
    if errors[worst] > max(errors[most], errors[least]):
        held.append(f"others to {errors[worst]:.2g} N (t = {time_s[worst]:.4g} s)")
    settled = np.flatnonzero(errors > NOTED * largest_N)[-1] + 1
    if settled < len(errors):
        held.append(f"from t = {time_s[settled]:.4g} s on to {errors[settled:].max():.2g} N")
    return f"{what} not resolved by steps of up to {step_s:.2g} s: {', '.join(held)}; lower {key}"


def blows(record: np.void, scene: Scene, columns: dict[str, np.ndarray]) -> str:
    """Says where a held end is set in motion or stopped at once, if that makes a force worth telling.

    A jump of velocity v sends out a wave of the force v sqrt(m T'). Spread over longer than a wave takes along the line
    and back it makes less, because what comes back takes it away. Of a harmonic motion, whose ramp is a choice, it is
    told where it makes an extreme: before a wave has come back twice.
    """
    wave_mps, told = fastest_wave(record, scene), []
    impedance, back_s = float(record["m"]) * wave_mps, 2 * scene.tether.length_m / wave_mps
    time_s, low, high = (columns[name] for name in ("time_s", "tension_top_low_N", "tension_top_high_N"))
    extremes_s = time_s[[high.argmax(), low.argmin()]]
    harmonic = scene.end.motion is not None and scene.end.motion.law == "harmonic"
    for t, speed, spread_s in jumps_of(scene.end):
        force_N = impedance * speed * min(1.0, back_s / max(spread_s, 1e-300))
        if force_N <= NOTED * np.abs(high).max() or t > time_s[-1] or (harmonic and extremes_s.min() > 2 * back_s):
            continue
        told.append(f"by {speed:.2g} m/s at t = {t:.4g} s (about {force_N:.2g} N)")
    if not told:
        return ""
    cure = "give it an end.motion.ramp_s" if harmonic else "let it begin and end at rest"
    return f"the velocity of end.motion jumps {' and '.join(told)}, which is a blow on the line: {cure}"
