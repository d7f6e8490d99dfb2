"""Laws of a massless tether with a point buoy: the equations of motion, order 4, rest, symmetry, and known motions.

The reference is the same mechanics in plain NumPy, integrated by DOP853 at rtol 1e-12: the sphere of eq. (30), whole or
cut by the wave, on a spring that pulls and does not push. It shares no formula of motion with the kernels: the force of
a cap's added mass comes from Lagrange's equations of its energy by complex steps.
"""

import cmath
import math
from functools import cache

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from engine import massless_covers, massless_rest, massless_runs
from engine.physics.waves import wave_number
from tests.engine.lines import SEA, line, orders, uniform

DEEP = {"water.depth_m": 25.0, "waves.steepness": 0.13}
CAP = {"water.depth_m": 21.0, "waves.steepness": 0.10, "buoy.submergence": "spherical-cap"}
AFLOAT = {"buoy.submergence": "spherical-cap", "water.depth_m": 19.0}
TANH = {"tether.tension": {"law": "tanh", "p": [3000.0, 20.0, 0.0, 0.0, 2e4]}}
TABLE = {"tether.tension": {"law": "tabulated", "strain": [0.0, 0.03, 0.08, 0.2], "tension_N": [0, 1500, 5000, 2e4]}}
CURRENT, AGAINST = uniform(0.8, w=0.5), uniform(-0.8, w=0.5)
MIRROR = np.array([-1.0, 1.0, -1.0, 1.0])
KICKS = np.array([[0.0, 0.0], [4.0, 0.0], [-3.0, 5.0], [1.0, -6.0]])


def starts_of(scene, kicks=KICKS):
    """(k, 4): at the place of rest with these velocities."""
    return np.column_stack([np.tile(massless_rest(scene), (len(kicks), 1)), kicks])


def gradient(function, *at):
    """Partial derivatives by complex steps."""
    return [function(*[v + 1e-30j * (i == j) for j, v in enumerate(at)]).imag / 1e-30 for i in range(len(at))]


class Reference:
    """The mechanics of a scene with a linear law and waves at full height."""

    def __init__(self, scene):
        self.buoy, self.H, self.rho = scene.buoy, scene.water.depth_m, scene.water.density_kgpm3
        self.g = scene.gravity_mps2
        self.k = wave_number(scene.waves.period_s, self.H, self.g)
        self.A, self.omega = scene.waves.steepness / self.k, 2 * math.pi / scene.waves.period_s
        self.l0, self.EA = scene.tether.length_m, scene.tether.tension.stiffness_N
        self.volume = math.pi / 6 * self.buoy.diameter_m**3

    def water(self, t, x, z):
        psi, over = self.k * x - self.omega * t, self.A * self.omega / math.sinh(self.k * self.H)
        cosine_part, less = over * math.cosh(self.k * z), over * math.sinh(self.k * z)
        c, s = math.cos(psi), math.sin(psi)
        return np.array([cosine_part * c, less * s]), self.omega * np.array([cosine_part * s, -less * c])

    def wet(self, t, x, z):
        """Share of the volume in the water, and its share of the section."""
        if self.buoy.submergence == "full":
            return 1.0, 1.0
        h = self.H + self.A * cmath.cos(self.k * x - self.omega * t) - z + self.buoy.diameter_m / 2
        share = h / self.buoy.diameter_m
        if not 0 < share.real < 1:
            return complex(share.real >= 1), float(share.real >= 1)
        angle = math.acos(1 - 2 * share.real)
        return share**2 * (3 - 2 * share), (angle - math.sin(angle) * math.cos(angle)) / math.pi

    def rates(self, t, y):
        x, z, *V = y
        b, (U, dU), (s, a) = self.buoy, self.water(t, x, z), self.wet(t, x, z)
        s = s.real
        v, r = np.array(V) - U, math.hypot(x, z)
        C = 0.5 * self.rho * b.drag * math.pi / 4 * b.diameter_m**2
        force = (s * self.rho * self.volume + s * b.added_mass_kg) * dU - a * C * math.hypot(*v) * v
        force[1] += (s * self.rho * self.volume - b.mass_kg) * self.g
        force -= max(self.EA * (r / self.l0 - 1), 0) / r * np.array([x, z])
        if b.submergence != "full":  # d/dt(s Ma v) - grad(s) Ma v^2/2
            s_t, s_x, s_z = gradient(lambda *at: self.wet(*at)[0], t, x, z)
            force -= b.added_mass_kg * ((s_t + s_x * V[0] + s_z * V[1]) * v - 0.5 * (v @ v) * np.array([s_x, s_z]))
        return np.array([*V, *force / (b.mass_kg + s * b.added_mass_kg)])

    def state_after(self, start, duration_s):
        return solve_ivp(self.rates, (0, duration_s), start, "DOP853", rtol=1e-12, atol=1e-12).y[:, -1]


@cache
def compared(submergence, count):
    """A scene, starts, and where the reference is after ten periods, (k, 4)."""
    scene = line(CAP if submergence == "spherical-cap" else DEEP)
    starts = starts_of(scene, KICKS[:count])
    return scene, starts, np.array([Reference(scene).state_after(start, 50.0) for start in starts])


def test_ten_periods_of_a_cap_follow_the_equations_of_motion():
    scene, starts, expected = compared("spherical-cap", 2)
    result = massless_runs(scene, starts, 10, 960)
    assert (result.measures[:, :, 0].min(1) < scene.tether.length_m).all()  # slack, and taut again
    assert np.abs(result.strobed[:, -1] - expected).max() < 1e-6


@pytest.mark.parametrize("changes", [DEEP, CAP, {}])
def test_usual_steps_are_within_a_millimetre_for_nine_of_ten_kicks(changes):
    scene = line(changes)
    starts = starts_of(scene, np.random.default_rng(0).uniform(-6, 6, (100, 2)))
    usual, fine = (massless_runs(scene, starts, 10, n).strobed[:, -1, :2] for n in (None, 500))
    assert np.quantile(np.abs(usual - fine).max(1), 0.9) < 1e-3


def test_a_stiff_line_has_as_many_steps_as_its_own_period_asks_for():
    """40 in 2 pi sqrt(l0 (M + M_a)/EA)."""
    scene, EA = line(DEEP, {"tether.tension.stiffness_N": 1e6}), 1e6
    ringing_s = 2 * math.pi * math.sqrt(20.0 * (1611.0 + 907.0) / EA)
    usual, explicit = (massless_runs(scene, starts_of(scene), 2, n) for n in (None, math.ceil(40 * 5.0 / ringing_s)))
    assert np.array_equal(usual.strobed, explicit.strobed)


def test_order_four_through_slack_and_taut():
    scene, starts, expected = compared("full", 4)
    errors = [np.abs(massless_runs(scene, starts, 10, n).strobed[:, -1] - expected).sum() for n in (60, 120, 240)]
    assert orders(errors) == pytest.approx(4.0, abs=0.2) and errors[-1] < 1e-6


def test_range_of_a_period_is_that_of_its_whole_course():
    scene, starts, _ = compared("full", 4)
    coarse, fine = (massless_runs(scene, starts, 10, n).measures for n in (60, 6000))
    np.testing.assert_allclose(coarse[:, :, :2], fine[:, :, :2], atol=1e-3)
    T = scene.tether.tension.stiffness_N * (fine[:, :, 1] / scene.tether.length_m - 1)
    np.testing.assert_allclose(fine[:, :, 2], np.maximum(T, 0), atol=1e-6)


@pytest.mark.parametrize("changes", [{}, TANH, TABLE, CURRENT, {"buoy.submergence": "spherical-cap"}, AFLOAT])
def test_the_rest_is_a_rest(changes):
    scene = line({"waves.steepness": 0.0}, changes)
    start = starts_of(scene, KICKS[:1])
    np.testing.assert_allclose(massless_runs(scene, start, 3).strobed[0], np.tile(start, (4, 1)), atol=1e-9)


def test_a_wave_from_the_other_side_is_a_mirror():
    scene, mirrored = line(DEEP, CURRENT), line(DEEP, AGAINST, {"waves.direction_rad": math.pi})
    starts = starts_of(scene)
    original, reflected = massless_runs(scene, starts, 10), massless_runs(mirrored, starts * MIRROR, 10)
    np.testing.assert_allclose(original.strobed, reflected.strobed * MIRROR, atol=1e-8)


def test_a_table_of_a_straight_law_is_that_law():
    law = {"law": "tabulated", "strain": [-0.5, 0.0, 1.0], "tension_N": [-2.5e4, 0.0, 5e4]}
    straight = line(DEEP, {"tether.tension": law})
    scene = line(DEEP)
    runs = [massless_runs(variant, starts_of(scene), 10).strobed for variant in (scene, straight)]
    np.testing.assert_allclose(*runs, atol=1e-8)


def test_going_on_is_not_stopping():
    scene = line(DEEP, {"waves.ramp_s": 23.0, "waves.phase_rad": 0.7})
    uninterrupted = massless_runs(scene, starts_of(scene), 10)
    first = massless_runs(scene, starts_of(scene), 4)
    second = massless_runs(scene, first.strobed[:, -1], 6, first_period=4)
    assert np.array_equal(uninterrupted.strobed, np.concatenate([first.strobed, second.strobed[:, 1:]], axis=1))
    assert np.array_equal(uninterrupted.measures, np.concatenate([first.measures, second.measures], axis=1))


def test_a_start_that_flies_off_is_not_a_number_and_disturbs_no_other():
    scene = line(DEEP)
    starts = starts_of(scene)
    wild = starts.copy()
    wild[1] = 0.0, 1e6, 0.0, 1e6
    calm, result = massless_runs(scene, starts, 5), massless_runs(scene, wild, 5)
    assert np.isnan(result.measures[1]).all() and np.isnan(result.strobed[1, 1:]).all()
    assert np.array_equal(result.strobed[[0, 2, 3]], calm.strobed[[0, 2, 3]])


@pytest.mark.parametrize("changes", [{"motion.dimensions": 3}, SEA, {"buoy.mass_kg": 2e3}, CAP | CURRENT])
def test_a_scene_that_it_does_not_cover_is_refused(changes):
    scene = line(changes)
    assert massless_covers(line()) and not massless_covers(scene)
    for call in (lambda: massless_rest(scene), lambda: massless_runs(scene, np.zeros((1, 4)), 1)):
        with pytest.raises(ValueError, match="does not cover this scene"):
            call()


@pytest.mark.parametrize(
    "bad", [{"starts": np.zeros(4)}, {"periods": 0}, {"steps_per_period": 0}, {"first_period": -1}]
)
def test_a_bad_argument_is_refused(bad):
    arguments = {"starts": np.zeros((1, 4)), "periods": 1} | bad
    with pytest.raises(ValueError, match=next(iter(bad))):
        massless_runs(line(), **arguments)
