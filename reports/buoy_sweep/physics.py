"""The water surface over the buoy, computed from the scene."""

from __future__ import annotations

import math

import numpy as np

from engine.natural_frequencies import Modes, natural_frequencies

__all__ = ["Modes", "natural_frequencies", "water_surface_m"]


def water_surface_m(scene, x_m: np.ndarray, time_s: np.ndarray) -> np.ndarray:
    """Height of the wave's surface above the bed (m) at x (n,) and time (n,): H + A cos(kx cos d - omega t + phase).

    The wave is taken at full amplitude; during a ramp the surface lies closer to H.
    """
    from engine.physics.waves import wave_number

    waves, depth = scene.waves, scene.water.depth_m
    k = wave_number(waves.period_s, depth, scene.gravity_mps2)
    amplitude = waves.amplitude_m if waves.amplitude_m is not None else waves.steepness / k
    phase = k * np.asarray(x_m) * math.cos(waves.direction_rad) + waves.phase_rad
    return depth + amplitude * np.cos(phase - 2.0 * math.pi / waves.period_s * np.asarray(time_s))
