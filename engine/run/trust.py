"""How far the tensions of a finished run hold: sentences for its message, each of one cause."""

import math

import numpy as np

from ..parameters.limits import longest_step
from ..parameters.scales import fastest_wave, jumps_of, ringing_period
from ..record import lengths_of
from ..scene.models import Scene

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
    """Says how far the largest tension holds where ringing was lost, and other and later ones; at most to itself."""
    time_s, high, lost_N = columns["time_s"], columns["tension_top_high_N"], columns["unresolved_N"]
    if not lost_N.any():
        return ""
    most, largest_N = int(high.argmax()), float(np.abs(high).max())
    errors = errors_of_ringing(record, scene, time_s, lost_N)
    errors[:-1] = np.maximum(errors[:-1], errors[1:])  # what a step lost is booked with the sample after it
    errors = np.minimum(errors, largest_N)
    worst, large = int(errors.argmax()), np.flatnonzero(errors > NOTED * largest_N)
    if not len(large):
        return ""
    key, step_s = longest_step(scene)
    what = f"axial ringing of period {ringing_period(record, scene):.2g} s is"
    if record["all_waves"]:
        what = f"axial waves on elements of {lengths_of(record, tables)[-1]:.2g} m are"
    if record["adaptive"]:
        key = "solver.shortest_period_s or solver.max_step_s"
    holds = f"the largest tension, {high[most]:.4g} N at t = {time_s[most]:.4g} s, holds to {errors[most]:.2g} N"
    if errors[worst] > 1.1 * errors[most]:
        holds += f", others to {errors[worst]:.2g} N (t = {time_s[worst]:.4g} s)"
    if (settled := large[-1] + 1) < len(errors):
        holds += f", from t = {time_s[settled]:.4g} s on to {errors[settled:].max():.2g} N"
    return f"{what} not resolved by steps of up to {step_s:.2g} s: {holds}; lower {key}"


def blows(record: np.void, scene: Scene, columns: dict[str, np.ndarray]) -> str:
    """Says where a held end is set in motion or stopped at once, if that makes the largest force.

    A jump of velocity v sends out a wave of the force v sqrt(m T'). Spread over longer than a wave takes along the line
    and back it makes less, because what comes back takes it away. It is told where it makes most of what the largest
    force, of either sign, is above that at rest: until the wave has come back twice.
    """
    wave_mps, told = fastest_wave(record, scene), []
    back_s, sample_s = 2 * scene.tether.length_m / wave_mps, float(record["output_step"])
    high = columns["tension_top_high_N"]
    forces = np.maximum(high, -columns["tension_top_low_N"])
    largest_s, rise_N = columns["time_s"][forces.argmax()], forces.max() - abs(high[0])
    for t, speed, spread_s in jumps_of(scene.end):
        force_N = float(record["m"]) * wave_mps * speed * min(1.0, back_s / max(spread_s, 1e-300))
        soon = t - spread_s <= largest_s <= t + spread_s + 2 * back_s + sample_s
        if soon and 0 < rise_N < 2 * force_N and force_N > NOTED * forces.max():
            told.append(f"by {speed:.2g} m/s at t = {t:.4g} s (about {force_N:.2g} N)")
    jumps = " and ".join(told)
    return jumps and f"the velocity of end.motion jumps {jumps}, a blow on the line: let it begin and end at rest"
