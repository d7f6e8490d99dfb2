"""The paper's scheme has the limit of the conservation form, at order 2 in space (in time: `time/test_order.py`).
From the outside it is an ordinary trajectory, or a fault of the scene; where it fails it stops and says why.

At kA = 0.016 their difference falls as h^2 and dt^2 together, to micrometres. That takes true accelerations in
Morison's force. Held, moved, released and free ends: in their place, and on the way of the conservation form.
"""

import math

import numpy as np
import pytest

from engine import simulate
from engine.paper_box.driver import MOST_GAP, Record
from engine.paper_box.driver import run as run_boxed
from engine.paper_box.line import B0, U, line_of
from engine.paper_box.nodal import Level
from engine.time.status import OK, SHAPE_LOST
from tests.engine.lines import harmonic, held, line, linear, orders

CALM = {"waves.steepness": 0.016, "water.depth_m": 22.5}
AIR = {"water": None, "waves": None, "tether.bending_stiffness_Nm2": 24.0}
SOFT = {"tether.tension": linear(500.0)}
SHAKEN = harmonic([0.8, 0.0, -0.6], 1.5, phase_rad=0.3, ramp_s=1.0)
MOVED = {  # from rest: the slope of the first piece is zero
    "law": "table",
    "time_s": [0.0, 0.1, 1.3, 3.0],
    "displacement_m": [[0.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.6, 0.0, -0.5], [0.6, 0.0, -0.5]],
}


def run_of(nodes, step_s, *parts, duration_s=1.0, accelerations=False):
    """A run with its line kept: of the paper's scheme, or of the conservation form where step_s is None."""
    solver = {"solver.scheme": "paper-box", "solver.step_s": step_s} if step_s else {"solver.rtol": 1e-5}
    scene = line({"output.profiles": True, "output.step_s": 0.1}, solver, *parts, nodes=nodes)
    if step_s:
        computed = run_boxed(scene, duration_s, accelerations=accelerations)
    else:
        computed = simulate(scene, None, duration_s)
    assert computed.status == "ok", computed.message
    return computed


def places(computed):
    """Nodes (3, samples, n), m."""
    return np.stack([getattr(computed.profiles, f"{axis}_m") for axis in "xyz"])


def calm(nodes, step_s, accelerations=False):
    """Places (3, samples) of the buoy in calm waves."""
    return places(run_of(nodes, step_s, CALM, duration_s=5.0, accelerations=accelerations))[:, :, -1]


@pytest.mark.slow
def test_the_difference_from_the_conservation_form_falls_at_order_two():
    limit, grids = calm(161, None), ((6, 0.1), (11, 0.05), (21, 0.025), (41, 0.0125))
    errors = np.array([np.abs(calm(*grid, True) - limit).max(1)[[0, 2]] for grid in grids])
    assert np.all(np.abs(orders(errors) - 2) < 0.1), errors
    assert errors[0].max() < 1.2e-3 and errors[-1].max() < 2e-5


@pytest.mark.slow
@pytest.mark.parametrize("motion", [SHAKEN, MOVED], ids=["shaken", "moved by a table"])
def test_a_moved_end_shakes_the_line_as_in_the_conservation_form(motion):
    moved = AIR | SOFT | held(12.0, 18.0, motion=motion)
    limit = places(run_of(81, None, moved))
    assert np.ptp(limit[0][:, 40]) > 0.05  # its middle moves
    errors = []
    for nodes, step_s in ((6, 0.02), (11, 0.01), (21, 0.005)):
        computed = places(run_of(nodes, step_s, moved))
        errors.append(np.abs(computed - limit[:, :, :: 80 // (nodes - 1)]).max())
    assert errors[-1] < 0.015
    assert errors[0] / errors[2] > 8, errors  # 16 at order 2, on grids fine enough for the bends at the ends


@pytest.mark.slow
def test_a_released_end_falls_freely():
    """Let go under its own support force nothing happens; without force the line falls, free of moment."""
    still = run_of(21, 0.005, AIR, held(12.0, 15.0), duration_s=0.5)
    T = still.columns["tension_top_N"][0]
    assert np.abs(still.columns["tension_top_N"] - T).max() < 1e-6 * T
    dropped = run_of(21, 0.005, AIR, held(12.0, 15.0, release_s=0.2), duration_s=0.5)
    assert np.abs(dropped.columns["tension_top_N"][:3] - T).max() < 1e-6 * T
    assert np.abs(dropped.columns["z_m"][:3] - 15.0).max() < 1e-6
    assert dropped.columns["z_m"][-1] < 14.9


SMALL = {"solver.scheme": "paper-box", "waves.steepness": 0.016, "tether.nodes": 7, "solver.step_s": 0.05}
SNAP = {"solver.scheme": "paper-box", "waves.steepness": 0.13, "water.depth_m": 21.6}


def small(**overrides):
    return line({**SMALL, **overrides})


def test_progress_is_told_and_every_sample_is_there():
    progress = []
    computed = run_boxed(small(**{"output.profiles": True, "solver.step_s": 0.0125}), 2.0, progress.append)
    assert len(computed.columns["time_s"]) == 41 and computed.profiles.strain.shape == (41, 7)
    assert progress == sorted(progress) and 0 < progress[-1] <= 1
    tight = run_boxed(small(**{"solver.newton_tolerance": 1e-12, "solver.step_s": 0.0125}), 2.0)
    assert tight.statistics["newton_iterations"] > computed.statistics["newton_iterations"]


@pytest.mark.slow
def test_turns_that_the_nodes_do_not_resolve():
    """With the other guard away the turns reach the bound next; both numbers are in the statistics."""
    scene = line({**SNAP, "tether.nodes": 21, "solver.step_s": 0.005})
    computed = run_boxed(scene, 8.0, most_gap=math.inf)
    assert computed.status == "turn-unresolved"
    assert computed.statistics["max_turn_rad"] > math.pi / 2 and computed.statistics["closure_m"] > 0.2
    assert f"{computed.statistics['max_turn_rad']:.3g} rad" in computed.message


@pytest.mark.parametrize(("share", "code"), [(0.0024, OK), (0.0026, SHAPE_LOST)])
def test_the_shape_is_lost_where_it_is_a_four_hundredth_of_the_length_from_the_path_of_its_end(share, code):
    """An upright line stays where it is, while its end is said to move."""
    record, at_rest = Record(line(), line_of(line()), 1.0, MOST_GAP), np.zeros((13, 41))
    at_rest[B0] = 1.0
    moving = at_rest.copy()
    moving[U, -1] = 2 * share * 20.0 / 0.01
    assert record.keep(Level(0.0, at_rest, None, None)) == OK
    assert record.keep(Level(0.01, moving, None, None)) == code
