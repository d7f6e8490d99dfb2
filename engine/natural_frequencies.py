"""Closed forms of the tethered buoy at rest: static pull and natural frequencies, from the scene alone."""

import math
from dataclasses import dataclass

_STEP = 1e-5  # of strain


@dataclass(frozen=True)
class Modes:
    """Static state and angular frequencies of small motions of a buoy above its anchor.

    static_tension_N   T_s, buoyancy less weight of the buoy
    static_strain      eps_s, with f(eps_s) = T_s
    radial_radps       omega_r, along the line
    pendulum_radps     omega_theta, across the line
    wave_radps         of the waves
    """

    static_tension_N: float
    static_strain: float
    radial_radps: float
    pendulum_radps: float
    wave_radps: float


def natural_frequencies(scene) -> Modes | None:
    """The paper's estimates (section 4.2.1) from the scene.

        omega_r = sqrt(f'(eps_s)/(l0 (M + M_a))),  omega_theta = sqrt(T_s/(l0 (M + M_a))),  T_s = (rho_w V - M) g

    Mass and added mass of the line are left out, as in the paper. Returns None for a scene without buoy, water or
    waves, for a buoy that sinks, and for a tension law without stiffness at eps_s; also for a spherical cap that rests
    partly out of the water, because its water plane is then a second spring.
    """
    if scene.buoy is None or scene.water is None or scene.waves is None:
        return None
    buoy, length = scene.buoy, scene.tether.length_m
    volume = math.pi / 6.0 * buoy.diameter_m**3
    static_N = (scene.water.density_kgpm3 * volume - buoy.mass_kg) * scene.gravity_mps2
    if static_N <= 0.0:
        return None
    from engine.physics.strains import strain_at

    strain = strain_at(static_N, scene.tether.tension)
    top_m = scene.anchor.position_m[2] + length * (1.0 + strain) + 0.5 * buoy.diameter_m
    if buoy.submergence == "spherical-cap" and top_m > scene.water.depth_m:
        return None
    slope_N = stiffness_N(scene, strain)
    if slope_N <= 0.0:
        return None
    inertia_kgm = length * (buoy.mass_kg + buoy.added_mass_kg)
    radial_radps, pendulum_radps = math.sqrt(slope_N / inertia_kgm), math.sqrt(static_N / inertia_kgm)
    return Modes(static_N, strain, radial_radps, pendulum_radps, 2.0 * math.pi / scene.waves.period_s)


def stiffness_N(scene, strain: float) -> float:
    """Slope f' (N) of the tension law of a scene at a strain."""
    from engine.physics.strains import tension_at

    law = scene.tether.tension
    # A central difference, because outside its kernels the engine gives f and not f'. The error is of order h^2 f'''
    # (1e-10).
    return (tension_at(strain + _STEP, law) - tension_at(strain - _STEP, law)) / (2.0 * _STEP)


def _stiffness_under(scene, static_N: float) -> float:
    """Slope f' (N) of the tension law of a scene at a tension."""
    from engine.physics.strains import strain_at

    return stiffness_N(scene, strain_at(static_N, scene.tether.tension))


def axial_period_s(scene, static_N: float) -> float:
    """Longest period (s) of axial ringing of the line at a tension: 2 l/c, with the wave speed c = sqrt(f'/m).

    Length l and mass per length m are those of the unstretched line. 0 where the law has no stiffness at this tension.
    """
    slope_N, tether = _stiffness_under(scene, static_N), scene.tether
    if slope_N <= 0.0:
        return 0.0
    return 2.0 * tether.length_m * math.sqrt(tether.density_kgpm3 * tether.area_m2 / slope_N)


def impact_Nspm(scene, static_N: float) -> float | None:
    """sqrt(k (M + M_a)) (N s/m): the force of a line that stops a buoy as a spring k would, over the buoy's speed.

    k = f'/l0 at the static tension. None without a buoy, and where the law has no stiffness at this tension.
    """
    slope_N = _stiffness_under(scene, static_N)
    if scene.buoy is None or slope_N <= 0.0:
        return None
    return math.sqrt(slope_N / scene.tether.length_m * (scene.buoy.mass_kg + scene.buoy.added_mass_kg))
