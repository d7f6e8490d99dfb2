"""Closed forms of the tethered buoy at rest: static pull and natural frequencies, from the scene alone."""

import math
from dataclasses import dataclass

_STEP = 1e-5  # of strain


@dataclass(frozen=True)
class Modes:
    """Static state and small-motion frequencies of a buoy above its anchor.

    `static_tension_N` T_s = B - W, `static_strain` with f(strain) = T_s; angular frequencies in rad/s.
    """

    static_tension_N: float
    static_strain: float
    radial_radps: float
    pendulum_radps: float
    wave_radps: float


def natural_frequencies(scene) -> Modes | None:
    """The paper's estimates (section 4.2.1) from the scene.

        omega_r = sqrt(f'(eps_s)/(l0 (M + M_a))),  omega_theta = sqrt(T_s/(l0 (M + M_a))),  T_s = (rho_w V - M) g

    Returns None where they do not exist: no buoy, no water, no waves, a buoy that sinks, one that rests partly out of
    the water (a spherical cap: the water plane is then a spring too), or a law without stiffness there. The rope's own
    mass and added mass are left out, as in the paper.
    """
    if scene.buoy is None or scene.water is None or scene.waves is None:
        return None
    buoy, length = scene.buoy, scene.tether.length_m
    volume = math.pi / 6.0 * buoy.diameter_m**3
    pull = (scene.water.density_kgpm3 * volume - buoy.mass_kg) * scene.gravity_mps2
    if pull <= 0.0:
        return None
    from engine.physics.strains import strain_at, tension_at

    law = scene.tether.tension
    strain = strain_at(pull, law)
    top_m = scene.anchor.position_m[2] + length * (1.0 + strain) + 0.5 * buoy.diameter_m
    if buoy.submergence == "spherical-cap" and top_m > scene.water.depth_m:
        return None
    # A central difference: outside its kernels the engine gives f, not f'; the error is of order h^2 f''' (1e-10).
    slope = (tension_at(strain + _STEP, law) - tension_at(strain - _STEP, law)) / (2.0 * _STEP)
    if slope <= 0.0:
        return None
    moved = length * (buoy.mass_kg + buoy.added_mass_kg)
    return Modes(pull, strain, math.sqrt(slope / moved), math.sqrt(pull / moved), 2.0 * math.pi / scene.waves.period_s)
