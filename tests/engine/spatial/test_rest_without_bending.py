"""Law: a line without bending stiffness rests in space as in the plane, and what its grid does not resolve is told."""

import numpy as np
import pytest

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
