"""Law: the condition of a buoy partly in the water is Lagrange's equation of the wetted cap, in a plane and in space,
and its derivatives are those of the condition; a sphere in the water is the whole sphere, to the last bit. It rests
where it displaces what it carries.

Law: in still water without drag the sphere on its soft line keeps its energy through the air and under water,

    (M + s M_a) |V|^2/2 + M g z + rho g int V_wet dh + the stretching of its line.
"""

import numpy as np
import pytest

from engine import simulate
from engine.arrays import Stage
from engine.physics.sea_series import WIDTH, sea_in_plane
from engine.physics.submergence import cap_across, cap_end, cap_end_3d
from tests.engine.kernels import parameters_of, upper_end_of
from tests.engine.lines import STILL, Motion, equilibrium, forces, kick, line, mean, positions
from tests.engine.physics.caps import CAP, afloat, condition, potential, volume

RNG = np.random.default_rng(11)
D, DEPTH, CV, CQ, T = 1.5, 21.0, 80.0, 120.0, 1.7
SPACE = {"motion.dimensions": 3, "waves.direction_rad": 0.7}
SEA = {"waves.jonswap": {"significant_height_m": 1.2, "components": 11, "seed": 2}, "waves.ramp_s": 4.0}
WAVES = [{}, SEA]  # T lies within the ramp
HEADINGS = [(2, 0.0), (2, np.pi), (3, 0.7)]
HEIGHTS = [DEPTH + 0.7 * step for step in (-2.5, -1.5, -0.6, 0.1, 0.9, 1.8, 3.0)]  # from under water to the air


def sea_at(p, tables, place):
    """Work.sea of a line whose upper end is at a place (2,); None in a regular wave."""
    if not p["sea_n"]:
        return None
    sea = np.zeros((3, WIDTH))
    sea_in_plane(p, tables, T, np.array([[0.0, 0.0], place]), np.zeros((2, 4)), None, sea)
    return sea


def total(p, tables, in_motion, place, V, V_tilde, N, F):
    """e and D of the end with its cap."""
    e, _, whole = upper_end_of(p, tables, T, CV, in_motion, N, V, V_tilde, F)
    stage = Stage(T, in_motion, CQ, CV)
    if len(V) == 3:
        of_cap, rows = cap_end_3d(p, tables, stage, tuple(place), tuple(V), tuple(V_tilde), F)
    else:
        computed = cap_end(p, stage, tuple(place), tuple(V), tuple(V_tilde), F, sea_at(p, tables, place))
        of_cap, rows = computed[:2], (computed[2:4], computed[4:])
    return e + of_cap, whole + rows


def drawn(axes):
    """V, V~, N, and the water's velocity and acceleration."""
    V, U, U_t = 3 * RNG.normal(size=(3, axes))
    return V, V + 0.1 * RNG.normal(size=axes), 900 * RNG.normal(size=axes), np.concatenate([U, U_t])


@pytest.mark.parametrize("axes, heading", HEADINGS)
@pytest.mark.parametrize("loss", [0.0, 0.7])
@pytest.mark.parametrize("height", HEIGHTS)
def test_it_is_lagranges_equation(height, loss, axes, heading):
    waves = {"motion.dimensions": axes, "waves.direction_rad": heading, "waves.phase_rad": 0.4}
    scene = line(CAP, waves, {"buoy.impact_loss": loss})
    p, tables = parameters_of(scene)
    for _ in range(5):
        place = np.append(RNG.normal(size=axes - 1), height)
        V, V_tilde, N, F = drawn(axes)
        e, _ = total(p, tables, 1.0, place, V, V_tilde, N, F)
        given = place, V, CV * (V - V_tilde), N, F[:axes], F[axes:]
        exact = condition(scene, T, *(part if axes == 3 else np.insert(part, 1, 0.0) for part in given))
        assert e == pytest.approx(exact if axes == 3 else exact[[0, 2]], rel=1e-11, abs=1e-9 * np.abs(exact).max())


@pytest.mark.parametrize("in_motion", [1.0, 0.0])
@pytest.mark.parametrize("height", HEIGHTS)
@pytest.mark.parametrize("waves", WAVES, ids=["regular", "sea"])
@pytest.mark.parametrize("axes", [2, 3])
def test_the_derivatives_are_those_of_the_condition(axes, waves, height, in_motion):
    """By velocity, with which the place moves by dV/cq: central differences."""
    p, tables = parameters_of(line(CAP, {"buoy.impact_loss": 0.7}, SPACE if axes == 3 else {}, waves))
    place = np.append([0.3, 0.2][: axes - 1], height)
    V, V_tilde, N, F = drawn(axes)
    if in_motion == 0.0:
        F[axes:] = 0.0
    D = total(p, tables, in_motion, place, V, V_tilde, N, F)[1]
    for j, d in enumerate(1e-4 * np.eye(axes)):
        ahead, behind = (total(p, tables, in_motion, place + d * s / CQ, V + d * s, V_tilde, N, F)[0] for s in (1, -1))
        assert (ahead - behind) / 2e-4 == pytest.approx(D[:, j], rel=1e-6, abs=1e-3)


@pytest.mark.parametrize("height", HEIGHTS)
def test_across_the_plane_it_is_the_condition_in_space(height):
    """To first order in a velocity across the plane of motion: `engine.perturbations.lateral`."""
    (flat, tables), (space, _) = (parameters_of(line(CAP, {"motion.dimensions": axes})) for axes in (2, 3))
    V, V_tilde, _, F = drawn(2)
    Y = np.array([0.0, 0.0, *V, 0.0, 0.0])
    factor, known = cap_across(flat, T, CV, np.array([0.4, height]), Y, F, 0.3, None)
    place, v, water = (0.4, 0.0, height), (V[0], 0.0, V[1]), np.insert(F, [1, 3], 0.0)
    e, rows = cap_end_3d(space, tables, Stage(T, 1.0, 1e30, CV), place, v, (V_tilde[0], 0.3, V_tilde[1]), water)
    assert factor == pytest.approx(rows[1][1], rel=1e-12, abs=1e-9)
    assert known == pytest.approx(e[1], rel=1e-12, abs=1e-9)


NEUTRAL = {"tether.density_kgpm3": 1027.0}  # as heavy as the water: held in a bow by its bending, with 0.01 N
STIFF = {
    "buoy.diameter_m": 0.2, "buoy.mass_kg": 1.6, "buoy.added_mass_kg": 2.0, "water.depth_m": 1.0, "tether.length_m": 1.1
}  # fmt: skip
# least and greatest pull of the line (N): taut; slack without weight; with weight, of which half and more hangs on the
# buoy; so stiff that upright it could bear the sphere's weight, but would tip over about its pinned end; too heavy
RESTS = [
    *(({"water.depth_m": depth}, 10.0, 2000.0) for depth in (21.5, 20.5)),
    *((NEUTRAL | {"water.depth_m": depth}, -0.1, 0.1) for depth in (20.4, 20.33, 20.1, 20.0, 12.0)),
    *(({"water.depth_m": depth}, 0.8, 1.8) for depth in (20.33, 18.0)),
    *((STIFF | {"tether.bending_stiffness_Nm2": EI}, 0.038, 0.105) for EI in (0.1, 1.0, 10.0)),
    ({"buoy.mass_kg": 2500.0, "water.depth_m": 60.0}, -6800.0, -6600.0),
]


@pytest.mark.parametrize("changes, low, high", RESTS)
def test_at_rest_the_line_pulls_with_the_weight_of_the_displaced_water_less_the_buoys(changes, low, high, dimensions):
    """Archimedes: N = (rho pi h^2 (3R - h)/3 - M) g z."""
    scene = line(CAP, STILL, changes, {"motion.dimensions": dimensions})
    motion, buoy = equilibrium(scene), scene.buoy
    h = scene.water.depth_m - positions(motion.Y, motion.h)[-1, -1] + buoy.diameter_m / 2
    lift = (scene.water.density_kgpm3 * volume(h, buoy.diameter_m) - buoy.mass_kg) * scene.gravity_mps2
    assert forces(motion.Y, scene.tether.tension)[-1] == pytest.approx([0.0, 0.0, lift], abs=2e-3)
    assert low < lift < high


def test_a_buoy_that_stays_under_water_moves_as_the_whole_sphere(dimensions):
    """Bit for bit, in small waves over 25 m of water: its top stays below the troughs."""
    deep = {"water.depth_m": 25.0, "waves.steepness": 0.08, "tether.nodes": 21, "motion.dimensions": dimensions}
    run, other = simulate(line(deep, CAP), periods=6), simulate(line(deep), periods=6)
    assert run.status == other.status == "ok" and np.ptp(run.columns["x_m"]) > 1.0
    assert run.columns["z_m"].max() + 0.75 < 25.0 - 0.08 / 0.16
    for key, values in other.columns.items():
        assert np.array_equal(run.columns[key], values), key
    assert run.statistics["newton_iterations"] == other.statistics["newton_iterations"]


def drift(rtol):
    """Largest change of the energy over its kinetic part at the start, and h (m), of a sphere that floats half in the
    water, is thrown up so that it leaves it by two diameters, falls back, goes under by three, and so on; the line,
    twice its length, is so soft that it ties the sphere down with 100 N and is never slack."""
    scene = afloat(
        {**kick(2.5, 0.0, 7.0), "output.step_s": 0.02, "tether.added_mass": 0.0,
         "water.depth_m": 40.0, "buoy.mass_kg": 900.0, "solver.rtol": rtol, "solver.newton_tolerance": 3e-4 * rtol},
        area_m2=1e-6, **{"tension.stiffness_N": 100.0},
    )  # fmt: skip
    motion, buoy, D = Motion(scene, 12.0), scene.buoy, scene.buoy.diameter_m
    rows = []
    for _, Y in motion.states():
        z = positions(Y, motion.h)[-1, 1]
        h = scene.water.depth_m - z + D / 2
        mass = buoy.mass_kg + buoy.added_mass_kg * volume(h, D) / volume(D, D)
        stretching = 0.5 * scene.tether.tension.stiffness_N * np.sum(motion.h * mean(Y[:, 0] ** 2))
        kinetic = 0.5 * mass * np.sum(Y[-1, 2:4] ** 2)
        rows.append([kinetic, potential(scene, z), stretching, h])
    assert motion.time_s >= 12.0
    *energies, h = np.array(rows).T
    total = np.sum(energies, axis=0)
    return np.abs(total - total[0]).max() / energies[0][0], h


def test_energy_is_kept_to_the_tolerance():
    """The forces have kinks at both ends of a passage: the error falls by less than the order of the method."""
    drifts = []
    for rtol in (3e-3, 3e-4, 3e-5):
        change, h = drift(rtol)
        assert np.sum((h[1:] - 0.75) * (h[:-1] - 0.75) < 0) >= 6 and h.min() < -3.0 and h.max() > 4.5
        drifts.append(change)
    assert drifts[0] < 2e-2 and drifts[1] < 2e-3 and drifts[2] < 2e-4
    assert drifts[2] < drifts[0] / 50
