"""Numbers of section 4.2 that no table has: of a snapping run, one by one, and what the scene alone says of eq. (33).

near zero     the top tension is below NEAR_ZERO of the static one, as in fig. 13
a peak        from the end of one interval near zero to the start of the next, if it passes the static tension
turned        r' > 0 where the peak begins and r' < 0 where it ends: the line has stopped the buoy and sent it back
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from campaigns.paper.measures import in_window, largest_line

if TYPE_CHECKING:
    from engine import Scene
    from engine.natural_frequencies import Modes
    from engine.trajectory import Trajectory

NEAR_ZERO = 0.05  # of the static tension: what the paper calls near zero, in numbers
COLUMNS = (
    "near_zero",
    "compressed",
    "compressed_inwards",
    "begun_inwards",
    "turned",
    "peak_periods",
    "apart_periods",
    "radial_line",
    "radial_at",
    "angular_line",
    "angular_at",
)


def snaps(trajectory: Trajectory, transient_periods: int) -> dict[str, float]:
    """COLUMNS of a run; nan where it has none.

    near_zero, compressed   shares of the time after the transient with almost no tension, and with less than none
    compressed_inwards      share of the latter during which r falls
    begun_inwards           share of the intervals near zero at whose start r falls
    turned                  share of the peaks of tension that turn the buoy
    peak_periods, apart_periods   median length of a peak at half its height, and time for each peak, wave periods
    radial_line ... angular_at    `measures.largest_line` of r and theta, where the record has the window of eq. (31)
    """
    columns, scene = trajectory.columns, trajectory.scene
    step_s, period_s = scene.sample_step_s(), scene.waves.period_s
    after = round(transient_periods * period_s / step_s)
    tension, rate = columns["tension_top_N"][after:], columns["radius_rate_mps"][after:]
    found = dict.fromkeys(COLUMNS, math.nan)
    if in_window(trajectory):
        for side, name in (("radial", "radius_m"), ("angular", "angle_rad")):
            found[f"{side}_line"], found[f"{side}_at"] = largest_line(columns[name], step_s, period_s)
    if len(tension) < 2:
        return found
    static = float(columns["tension_top_N"][0])
    near, less = tension < NEAR_ZERO * static, tension < 0.0
    found |= {"near_zero": float(near.mean()), "compressed": float(less.mean())}
    begins, ends = (np.flatnonzero(now[1:] & ~now[:-1]) + 1 for now in (near, ~near))
    found["compressed_inwards"] = _share(rate[less] < 0.0)
    found["begun_inwards"] = _share(rate[begins] < 0.0)
    turned, lengths = [], []
    for first in ends:
        last = begins[np.searchsorted(begins, first)] if first < begins[-1:].max(initial=0) else 0
        peak = tension[first:last]
        if peak.max(initial=0.0) > static:
            turned.append(rate[first] > 0.0 > rate[last])
            lengths.append(np.count_nonzero(peak > 0.5 * peak.max()) * step_s / period_s)
    if turned:
        found["turned"] = _share(np.array(turned))
        found["peak_periods"] = float(np.median(lengths))
        found["apart_periods"] = len(tension) * step_s / period_s / len(turned)
    return found


def _share(which: np.ndarray) -> float:
    return float(which.mean()) if len(which) else math.nan


def scales(scene: Scene, modes: Modes, small: float, large: float) -> dict[str, float]:
    """Closed forms of a scene with a buoy and waves; modes: its natural frequencies; the two slopes kA of section 4.2.

    small_amplitude_m    amplitude A of the wave of the small slope kA, k from the dispersion relation at depth H
    diameter_over_wave   diameter of the buoy over the length of the waves
    frequency, lift, force   omega_i/omega_nr, (B - W)/F0, and amplitude of the wave force along r on the buoy at its
        place of rest over F0, at the large slope; F0 = (M + M_a) omega_nr^2 D: omega, B - W and F of eq. (33)
    """
    from engine.physics.waves import wave_number

    buoy, water, omega = scene.buoy, scene.water, modes.wave_radps
    k = wave_number(scene.waves.period_s, water.depth_m, scene.gravity_mps2)
    unit_N = (buoy.mass_kg + buoy.added_mass_kg) * modes.radial_radps**2 * buoy.diameter_m
    pushed_kg = water.density_kgpm3 * math.pi / 6.0 * buoy.diameter_m**3 + buoy.added_mass_kg
    rest_m = scene.tether.length_m * (1.0 + modes.static_strain)
    # largest vertical acceleration of the water at the buoy's place of rest, along r: A omega^2 sinh kz / sinh kH
    reach = (
        math.exp(k * (rest_m - water.depth_m)) * math.expm1(-2.0 * k * rest_m) / math.expm1(-2.0 * k * water.depth_m)
    )
    return {
        "small_amplitude_m": small / k,
        "diameter_over_wave": buoy.diameter_m * k / (2.0 * math.pi),
        "frequency": omega / modes.radial_radps,
        "lift": modes.static_tension_N / unit_N,
        "force": pushed_kg * large / k * omega**2 * reach / unit_N,
    }
