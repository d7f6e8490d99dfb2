"""Linear waves, and the sphere partly in the water, from geometry and mechanics, for tests that trust no kernel.

Complex arguments pass, so that a complex step differentiates everything to rounding. Lengths m, SI units.
"""

import math

import numpy as np

from engine import load_scene
from engine.physics.waves import wave_number

CAP = {"buoy.submergence": "spherical-cap"}


def afloat(changes=None, depth_m=20.0, **tether):
    """The shipped buoy in still water without drag, on a line so soft and light that it only ties it down."""
    soft = {"tether.density_kgpm3": 1027.0, "tether.tension.stiffness_N": 40.0, "tether.nodes": 5}
    still = {"waves": None, "water.depth_m": depth_m, "buoy.drag": 0.0, "tether.drag_normal": 0.0}
    still |= {"tether.drag_tangential": 0.0, "tether.diameter_m": 1e-3}
    of_tether = {f"tether.{key}": value for key, value in tether.items()}
    return load_scene("tethered_buoy", CAP | soft | still | of_tether | (changes or {}))


def clipped(h, D):
    """h between 0 and D, for complex numbers too."""
    return 0.0 * h if h.real <= 0 else 0.0 * h + D if h.real >= D else h


def volume(h, D):
    """Volume (m3) of a cap h high: pi h^2 (3R - h)/3."""
    h = clipped(h, D)
    return math.pi * h**2 * (1.5 * D - h) / 3


def section(h, D):
    """Area (m2) of the part of a circle below a chord h above its lowest point."""
    h, R = clipped(h, D), D / 2
    cosine = 1 - h / R
    return R**2 * (np.arccos(cosine) - cosine * np.sqrt(1 - cosine**2))


def depth_of_lowest_point(scene, place, t):
    """h (m) before it is clipped; place (x, y, z)."""
    wave, depth = scene.waves, scene.water.depth_m
    k = wave_number(wave.period_s, depth, scene.gravity_mps2)
    along = math.cos(wave.direction_rad) * place[0] + math.sin(wave.direction_rad) * place[1]
    eta = wave.steepness / k * np.cos(k * along - 2 * math.pi / wave.period_s * t + wave.phase_rad)
    return depth + eta - place[2] + scene.buoy.diameter_m / 2


def condition(scene, t, place, V, V_t, N, U, U_t):
    """Eq. (30) with the wetted cap: what must vanish, (3,).

    The force of the water on a body of added mass m(h) in water that moves with U is that of Lagrange's equations,
    -d/dt[m (V - U)] + |V - U|^2/2 grad m, and rho V_wet (U_t + g) of the undisturbed pressure. Gradient and rate of m
    are taken by differences of 1e-20 in the complex plane.
    """
    buoy, rho = scene.buoy, scene.water.density_kgpm3
    D, place, V = buoy.diameter_m, np.asarray(place), np.asarray(V)
    share = lambda h: volume(h, D) / volume(D, D)  # noqa: E731
    h = depth_of_lowest_point(scene, place, t)
    added = buoy.added_mass_kg * share(h)
    step = 1e-20j
    by_place = [depth_of_lowest_point(scene, place + step * axis, t).imag / 1e-20 for axis in np.eye(3)]
    by_time = np.imag(depth_of_lowest_point(scene, place, t + step)) / 1e-20
    slope = buoy.added_mass_kg * 6 * (clipped(h, D) / D) * (1 - clipped(h, D) / D) / D
    gradient, rate = slope * np.array(by_place), slope * (by_time + np.array(by_place) @ V)
    v = V - U
    drag = 0.5 * rho * buoy.drag * section(h, D) * np.sqrt(v @ v) * v
    wet = rho * volume(h, D)
    lift = np.array([0.0, 0.0, 1.0]) * (wet - buoy.mass_kg) * scene.gravity_mps2
    inertia = buoy.mass_kg * V_t + added * (V_t - U_t) + rate * v - 0.5 * (v @ v) * gradient
    sinking = by_time + np.array(by_place) @ V
    if sinking > 0:  # what spray takes: a force against the gradient whose power is that share of - m' h_t^3/2
        inertia = inertia + 0.5 * buoy.impact_loss * sinking**2 * gradient
    return N + inertia + drag - wet * U_t - lift


def potential(scene, z):
    """Gravity of buoy and buoyancy (J): M g z + rho g times the integral of the volume from 0 to h."""
    buoy, rho, g = scene.buoy, scene.water.density_kgpm3, scene.gravity_mps2
    D = buoy.diameter_m
    h = scene.water.depth_m - z + D / 2
    inside = min(max(h, 0.0), D)
    below = math.pi * inside**3 * (D / 6 - inside / 12) + volume(D, D) * max(h - D, 0.0)
    return buoy.mass_kg * g * z + rho * g * below


def linear_waves(rows, depth, t, X):
    """Water velocity and local acceleration (n, 4) or (n, 6) at X (n, 2) or (n, 3) of the sum of linear waves, in long
    doubles; below the bed as on it. rows: k, omega, amplitude, phase, cosine and sine of the direction; quotients as
    they stand, so kH below some 10000."""
    if X.shape[1] == 2:
        return linear_waves(rows, depth, t, np.insert(X, 1, 0.0, axis=1))[:, [0, 2, 3, 5]]
    x, y, z = np.asarray(X, np.longdouble).T
    z, total = np.maximum(z, 0.0), np.zeros((6, len(X)), np.longdouble)
    for k, omega, amplitude, phase, cosine, sine in np.asarray(rows, np.longdouble):
        psi = k * (cosine * x + sine * y) - omega * t + phase
        speed = amplitude * omega / np.sinh(k * depth)
        along, up = speed * np.cosh(k * z), speed * np.sinh(k * z)
        level, rate = along * np.cos(psi), omega * along * np.sin(psi)
        total += [level * cosine, level * sine, up * np.sin(psi), rate * cosine, rate * sine, -omega * up * np.cos(psi)]
    return total.T
