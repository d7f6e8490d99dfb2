"""Law: a line on the bed rests, at the default settings; what friction holds creeps as its regularisation says.

Below the speed v_s friction is a viscosity mu w/v_s a metre, so that an axial wave of the lying line dies out at the
slower rate s of m s^2 - (mu w/v_s) s + EA k^2 = 0. At rest the only force left is the rounding of tensions, EA 2^-52 an
element: this is the speed v_s EA 2^-52/(h mu w), the bound of the creep here.
"""

import math

import numpy as np
import pytest

from engine import simulate
from engine.run.rest import rest_of
from engine.time.status import OK
from tests.engine.lines import DRY, STILL, Motion, by_table, equilibrium, harmonic, held, line, linear, ran
from tests.engine.physics.test_bed import CHAIN, EA, WEIGHT, G

MU, V_S = 0.4, 0.01
WIDTH = math.sqrt(4e-4 / math.pi)


def bed(stiffness, critical, friction):
    damping = critical * 2 * math.sqrt(stiffness * WEIGHT / G / WIDTH)
    return {"stiffness_Npm3": stiffness, "damping_Nspm3": damping, "friction": friction, "friction_speed_mps": V_S}


BEDS = [bed(stiffness, critical, mu) for stiffness in (1e5, 3e9) for critical in (0.0, 1.0) for mu in (0.0, MU)]


@pytest.mark.parametrize("dimensions, EI, floor", [*((2, 0.0, floor) for floor in BEDS[::3]), (3, 1.0, BEDS[-1])])
def test_a_line_laid_down_rests(dimensions, EI, floor):
    duration_s = 500.0
    changes = {"floor": floor, "motion.dimensions": dimensions, "tether.tension": linear(EA)}
    output = {"output.step_s": duration_s / 50, "output.profiles": True}
    scene = line(STILL, held(18.6, 5.0), changes, output, nodes=21, **CHAIN | {"bending_stiffness_Nm2": EI})
    run = ran(scene, duration_s=duration_s)
    bound = V_S * EA * 2**-52 / (1.0 * MU * WEIGHT) * duration_s
    for place in (run.profiles.x_m, run.profiles.z_m):
        assert np.abs(place - place[0]).max() < bound


def test_a_chain_on_the_bed_rests_without_a_whole_turn_in_an_element():
    """Without bending a direction and the same one a turn further are one: it is no fold, and no loop to release."""
    chain = {"length_m": 21.0, "area_m2": 1.12e-5, "density_kgpm3": 7800.0, "bending_stiffness_Nm2": 0.0}
    bedded = held(16.68, 11.36) | {"water.depth_m": 32.0, "floor": {"stiffness_Npm3": 3.6e7}}
    rest = rest_of(line(STILL, bedded, tension=linear(16281.0), nodes=81, **chain))
    assert rest.status == OK and rest.turn < math.pi


def test_what_friction_holds_creeps_as_its_regularisation_says(dimensions):
    length, changes = CHAIN["length_m"], {"floor": bed(1e5, 1.0, MU), "motion.dimensions": dimensions}
    scene = line(DRY, held(1.001 * length, 0.0), changes, {"tether.tension": linear(EA)}, nodes=41, **CHAIN)
    rest = equilibrium(scene)
    wave = 1e-6 * np.cos(math.pi * rest.s / length)
    start = rest.Y.copy()
    start[:, 0] += wave
    motion = Motion(scene, 0.2, start=start)
    computed = [(t, (Y[:, 0] - rest.Y[:, 0]) @ wave / (wave @ wave)) for t, Y in motion.states()]
    (t0, first_amplitude), (t1, last_amplitude) = computed[1], computed[-1]
    m, c, stiff = WEIGHT / G, MU * WEIGHT / V_S, EA * (math.pi / length) ** 2
    rate = (c - math.sqrt(c**2 - 4 * m * stiff)) / (2 * m)
    assert math.log(first_amplitude / last_amplitude) / (t1 - t0) == pytest.approx(rate, rel=0.02)


@pytest.mark.parametrize("floor", BEDS[4:])
def test_a_line_laid_down_again_comes_to_rest(floor):
    """Lifted by 0.4 m and laid down within 8 s: no landing makes energy, also where steps are long for the bed."""
    times = np.linspace(0.0, 8.0, 81)
    way = np.sin(math.pi * times / 8.0) ** 2
    motion = by_table(times.tolist(), [[0.2 * f, 0.0, 0.4 * f] for f in way])
    slack = {"law": "tabulated", "strain": [-0.5, 0.0, 1e-5, 0.1], "tension_N": [0.0, 0.0, 1.0, 1e4]}
    changes = {"floor": floor, "tether.tension": slack, "output.profiles": True}
    run = ran(line(STILL, held(18.6, 5.0, motion=motion), changes, nodes=41, **CHAIN), duration_s=16.0)
    late = run.profiles.time_s > 12.0
    assert run.profiles.speed_mps[late].max() < 0.25 * run.profiles.speed_mps[~late].max()


@pytest.mark.parametrize(
    ("place", "law", "rho", "stiffness"),
    [
        ((16.0, 4.0), 5e4, 1140.0, 1e4),
        ((18.0, 1.0), 1e7, 7800.0, 1e5),
        ((18.0, 1.0), 5e4, 7800.0, 1e9),
    ],
)
def test_a_line_that_folds_back_on_itself_is_no_rest(place, law, rho, stiffness):
    """Pressed by a kilonewton such a line is in balance too; what lies and hangs is pulled by less than its weight."""
    motion = harmonic([0.0, 0.0, 0.5], 3.0)
    changes = {"output.profiles": True, "floor.stiffness_Npm3": stiffness, "floor.friction": 0.3}
    scene = line(STILL, held(*place, motion=motion), changes, density_kgpm3=rho, tension=linear(law))
    weight = (rho - scene.water.density_kgpm3) * scene.tether.area_m2 * scene.gravity_mps2 * scene.tether.length_m
    tension = simulate(scene, duration_s=0.05).profiles.tension_N[0]
    assert -0.1 * weight < tension.min() and tension.max() < 0.2 * weight
