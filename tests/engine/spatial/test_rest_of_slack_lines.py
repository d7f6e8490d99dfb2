"""Law: a slack line rests as a catenary, in space as in the plane, and what its grid does not resolve is told."""

import math

import numpy as np
import pytest
from scipy.optimize import brentq

from engine.run.rest import rest_of
from engine.spatial import lift
from tests.engine.lines import DRY, SPACE, STILL, held, line, linear, ran

CHAIN = {"length_m": 91.24, "area_m2": 2.34e-5, "density_kgpm3": 7800.0, "bending_stiffness_Nm2": 0.0}
WATER = STILL | {"water.depth_m": 228.0, "anchor.position_m": [0.0, 0.0, 109.5]}


@pytest.mark.parametrize("nodes", [121, 241])
def test_a_chain_in_space_rests_as_in_the_plane(nodes):
    """On 241 nodes one node stayed folded after four turns: 125.8 N at the top for 124.9."""
    ends = held(43.961, 62.499)
    planar, space = (
        rest_of(line(WATER, ends, keys, tension=linear(33406.0), nodes=nodes, **CHAIN)) for keys in ({}, SPACE)
    )
    assert space.top_N == pytest.approx(planar.top_N, rel=1e-9)
    assert space.turn == pytest.approx(planar.turn, rel=1e-6)


@pytest.mark.parametrize("nodes", [141, 161, 201])
def test_a_stiff_chain_rests_on_any_grid(nodes):
    """From an arc these grids found no rest; on 81 and 121 nodes the top bears 138.97 and 138.90 N."""
    chain = CHAIN | {"length_m": 4.796, "area_m2": 1.7e-3}
    rest = rest_of(line(DRY, held(1.619, -4.419), tension=linear(2.2e7), nodes=nodes, **chain))
    assert rest.status == 0 and rest.top_N == pytest.approx(138.9, abs=0.1)


def top_of_catenary(length_m, x, z, weight_Npm):
    """Tension at the upper of two ends, x and z apart, of a heavy line that does not stretch (Irvine 1981)."""
    shape = math.sqrt(length_m**2 - z**2) / x
    half = brentq(lambda u: math.sinh(u) - shape * u, 1e-6, 20.0)
    return 0.5 * weight_Npm * (length_m / math.tanh(half) + abs(z))


@pytest.mark.parametrize("space", [{}, SPACE])
@pytest.mark.parametrize(("nodes", "density_kgpm3", "bending_Nm2"), [
    (41, 7800.0, 0.0068), (241, 7800.0, 0.0068), (321, 7800.0, 0.0), (121, 150.0, 0.0),
])  # fmt: skip
def test_a_line_between_near_ends_rests_as_a_catenary(nodes, density_kgpm3, bending_Nm2, space):
    """On 41, 241 and 321 nodes it stayed folded within an element, pressed by up to 150 N. A light line rises."""
    area_m2, x, z = 6.77e-4, 0.483, 1.538
    weight_Npm = (density_kgpm3 - 1027.0) * area_m2 * 9.81
    keys = {"length_m": 5.2356, "area_m2": area_m2, "density_kgpm3": density_kgpm3, "nodes": nodes}
    water = STILL | {"water.depth_m": 13.0, "anchor.position_m": [0.0, 0.0, 6.3]}
    up = math.copysign(z, weight_Npm)  # the end that bears most is the top of a heavy line, of a light one the other
    chain = line(water, space, held(x, up), tension=linear(1.4e6), bending_stiffness_Nm2=bending_Nm2, **keys)
    assert rest_of(chain).top_N == pytest.approx(top_of_catenary(5.2356, x, z, abs(weight_Npm)), rel=2e-3)


@pytest.mark.parametrize("current", ["uniform", "profile", "table"])
@pytest.mark.parametrize("speed_mps", [0.05, 0.4, 0.8])
@pytest.mark.parametrize("space", [{}, SPACE])
def test_a_slack_line_under_a_buoy_rests_downstream(space, speed_mps, current):
    """In a current along -x as in its mirror image. Its bight began upstream, and an element kept a whole turn."""
    rope = {"length_m": 109.2, "area_m2": 2.24e-4, "density_kgpm3": 1380.0, "diameter_m": 0.0197, "nodes": 41}
    buoy = {"diameter_m": 1.22, "mass_kg": 487.0, "added_mass_kg": 487.0, "drag": 0.2, "submergence": "spherical-cap"}
    floor = {"stiffness_Npm3": 1.5e4, "damping_Nspm3": 1e3}
    water = STILL | {"water.depth_m": 96.8, "buoy": buoy, "floor": floor} | space
    tensions = []
    for u in (speed_mps, -speed_mps):
        laws = {
            "uniform": {"law": "uniform", "velocity_mps": [u, 0.0, 0.0]},
            "profile": {"law": "profile", "height_m": [0.0, 96.8], "velocity_mps": [[0.0] * 3, [u, 0.0, 0.0]]},
            "table": {
                "law": "table",
                "x_m": [0.0],
                "height_m": [0.0],
                "time_s": [0.0],
                "velocity_x_mps": [[[u]]],
                "velocity_z_mps": [[[0.0]]],
            },
        }
        rest = rest_of(
            line(water, {"current": laws[current]}, tension=linear(4.2e5), bending_stiffness_Nm2=7.5, **rope)
        )
        assert rest.status == 0 and rest.turn < 1.0
        tensions.append(rest.top_N)
    assert tensions[0] == pytest.approx(tensions[1], rel=1e-6)


def test_whole_turns_are_taken_out_of_the_elements():
    angles = np.array([0.1, 0.2, 0.3, 0.4, 0.5])
    Y = np.zeros((5, 13))
    Y[:, lift.BETA] = np.stack([np.cos(angles / 2), 0 * angles, -np.sin(angles / 2), 0 * angles], axis=1)
    wound = Y.copy()
    wound[1:3, lift.BETA] *= -1.0
    lift.unwind(wound)
    assert np.array_equal(wound, Y) and lift.turns(wound) == pytest.approx(0.1)


@pytest.mark.parametrize(("nodes", "told"), [(5, True), (41, False)])
def test_a_fold_that_the_grid_keeps_is_told(nodes, told):
    """A line hangs between two ends: five nodes have none at its bight."""
    hanging = line(WATER, held(20.0, 0.4), tension=linear(33406.0), nodes=nodes, **CHAIN)
    assert ("an element is folded" in ran(hanging, duration_s=0.1).message) == told
