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
    from engine.physics.strains import strain_at

    strain = strain_at(pull, scene.tether.tension)
    top_m = scene.anchor.position_m[2] + length * (1.0 + strain) + 0.5 * buoy.diameter_m
    if buoy.submergence == "spherical-cap" and top_m > scene.water.depth_m:
        return None
    slope = stiffness_N(scene, strain)
    if slope <= 0.0:
        return None
    moved = length * (buoy.mass_kg + buoy.added_mass_kg)
    return Modes(pull, strain, math.sqrt(slope / moved), math.sqrt(pull / moved), 2.0 * math.pi / scene.waves.period_s)


def stiffness_N(scene, strain: float) -> float:
    """Slope f' (N) of the tension law of a scene at a strain."""
    from engine.physics.strains import tension_at

    law = scene.tether.tension
    # A central difference: outside its kernels the engine gives f, not f'; the error is of order h^2 f''' (1e-10).
    return (tension_at(strain + _STEP, law) - tension_at(strain - _STEP, law)) / (2.0 * _STEP)


def _stiffness_under(scene, static_N: float) -> float:
    """Slope f' (N) at the strain under a tension."""
    from engine.physics.strains import strain_at

    return stiffness_N(scene, strain_at(static_N, scene.tether.tension))


def axial_period_s(scene, static_N: float) -> float:
    """Longest period (s) of axial ringing of the line at a tension: 2 l/c, c = sqrt(f'/m) in unstretched length.

    m is the mass per length. 0 where the law has no stiffness there.
    """
    slope, tether = _stiffness_under(scene, static_N), scene.tether
    if slope <= 0.0:
        return 0.0
    return 2.0 * tether.length_m * math.sqrt(tether.density_kgpm3 * tether.area_m2 / slope)


def impact_Nspm(scene, static_N: float) -> float | None:
    """sqrt(k (M + M_a)) (N s/m): force per speed of a buoy that its line stops, k = f'/l0 at the static tension.

    None without a buoy, and where the law has no stiffness there.
    """
    slope = _stiffness_under(scene, static_N)
    if scene.buoy is None or slope <= 0.0:
        return None
    return math.sqrt(slope / scene.tether.length_m * (scene.buoy.mass_kg + scene.buoy.added_mass_kg))
