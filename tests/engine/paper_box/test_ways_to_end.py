"""Where the paper's scheme fails it stops, says why, and keeps finite samples up to there."""

import math

import numpy as np
import pytest

from engine import load_scene, simulate
from engine.paper_box import run

SNAP = {"solver.scheme": "paper-box", "waves.steepness": 0.13, "water.depth_m": 21.6}


def test_usual_steps_end_at_the_first_slack():
    """The other endings are among those of `tests/engine/time/test_ways_to_end.py`."""
    scene = load_scene("tethered_buoy", {**SNAP, "tether.nodes": 21})
    found = simulate(scene, duration_s=8.0)
    assert found.status == "newton-failed" and "conservation" in found.message
    end = found.statistics["end_time_s"]
    assert 5.0 < end < 7.0
    assert f"t = {end + 0.0125:.6g}" in found.message
    table = found.table()
    assert np.isfinite(table.to_numpy()).all()
    assert len(table) == math.floor(end / 0.05 + 1e-9) + 1


@pytest.mark.slow
def test_turns_that_the_nodes_do_not_resolve():
    """With the other guard away the turns reach the bound next; both numbers are in the statistics."""
    scene = load_scene("tethered_buoy", {**SNAP, "tether.nodes": 21, "solver.step_s": 0.005})
    found = run(scene, 8.0, most_gap=math.inf)
    assert found.status == "turn-unresolved"
    assert found.statistics["max_turn_rad"] > math.pi / 2 and found.statistics["closure_m"] > 0.2
    assert f"{found.statistics['max_turn_rad']:.3g} rad" in found.message


@pytest.mark.slow
def test_taut_motion_leaves_the_guards_far_away():
    scene = load_scene("tethered_buoy", {**SNAP, "waves.steepness": 0.016, "tether.nodes": 11})
    found = simulate(scene, duration_s=5.0)
    assert found.status == "ok" and found.message == ""
    assert found.statistics["max_turn_rad"] < 1e-3
    assert found.statistics["closure_m"] < 1e-6
    assert found.statistics["euler_norm_error"] < 1e-8
