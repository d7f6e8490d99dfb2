"""The Newton update swept from both ends is the one swept from below, to rounding; odd and even numbers of nodes."""

import numpy as np
import pytest

from engine import load_scene
from engine.parameters import record_of
from engine.planar.node import WIDTH, node_quantities, shape, water
from engine.planar.sweep import WIDTH as SWEEP_WIDTH
from engine.planar.sweep import sweep_both_ways, sweep_from_below

RATE = 20.0  # 1/s
END_HELD = {"buoy": None, "end.kind": "held", "end.position_m": [3.0, 0.0, 19.0]}


@pytest.mark.parametrize("end", [{}, END_HELD], ids=["buoy", "held"])
@pytest.mark.parametrize("nodes", [3, 4, 5, 6, 41, 42])
def test_the_way_does_not_matter(nodes, end):
    scene = load_scene("tethered_buoy", {"tether.nodes": nodes, "waves.steepness": 0.13} | end)
    tables = []
    p = record_of(scene, tables)[0]
    tables = np.concatenate(tables)
    noise = np.random.default_rng(nodes).standard_normal((nodes, 6))
    Y = np.array([0.01, 0.0, 0.0, 0.0, 1.5, 0.0]) + noise * [0.001, 1.0, 1.0, 1.0, 0.1, 0.1]
    X, F, Q, E = (np.zeros((nodes, width)) for width in (2, 4, WIDTH, SWEEP_WIDTH))
    shape(p, tables, Y, Q, X)
    C_tilde = np.column_stack([Q[:, 5:7], Y[:, 2:4]]) + 0.1 * noise[:, :4]
    water(p, tables, 1.0, 1.0, X, F)
    node_quantities(p, tables, RATE, RATE, 1.0, Y, C_tilde, F, Q)
    found = []
    for sweep in (sweep_from_below, sweep_both_ways):
        D = np.zeros((nodes, 6))
        assert sweep(p, tables, 1.0, RATE, RATE, 1.0, Y, C_tilde, F, Q, E, D)
        found.append(D / np.abs(D).max(0))
    assert np.abs(found[0] - found[1]).max() < 1e-11
