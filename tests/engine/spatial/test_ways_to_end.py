"""Every way in which a run in space can end is reached, by the scenes of the plane, in the plane and struck across;
each says so in its status. No run raises, or hands out a number that is not finite; samples up to the end are kept.
"""

import numpy as np
import pytest

from engine import load_scene, simulate
from tests.engine.spatial.lines import SPACE
from tests.engine.time.test_ways_to_end import ENDS

BLOW = [0.0, 1e-3, 0.0]
IN_A_PLANE = ["loops without release", "more loops than allowed"]  # struck across, a loop leaves the plane


def cases():
    for name, (overrides, _, _) in ENDS.items():
        yield name, False
        if name not in IN_A_PLANE and "start.buoy_velocity_mps" not in overrides:
            yield name, True


def marked(name, struck):
    """The scenes that take seconds are slow ones."""
    takes_long = name.startswith("the paper's scheme") or (struck and name.startswith("steps far below"))
    return pytest.param(name, struck, marks=[pytest.mark.slow] * takes_long)


@pytest.mark.parametrize("name, struck", [marked(*case) for case in cases()])
def test_a_run_ends_with_its_reason(name, struck):
    overrides, duration_s, allowed = ENDS[name]
    scene = load_scene("tethered_buoy", {**overrides, **SPACE, **({"start.buoy_velocity_mps": BLOW} if struck else {})})
    run = simulate(scene, duration_s=duration_s)
    assert run.status in allowed, (run.status, run.message)
    assert run.message
    samples, end_s = len(run.columns["time_s"]), run.statistics["end_time_s"]
    assert end_s < duration_s
    if run.statistics["steps"] == 0:
        assert samples == 0
    else:
        assert (samples - 1) * scene.sample_step_s() <= end_s < samples * scene.sample_step_s() * (1 + 1e-9)
    for column in run.columns.values():
        assert len(column) == samples and np.all(np.isfinite(column))


def test_a_loop_that_may_leave_the_plane_needs_no_release():
    """Where the planar run ends with turn-unresolved, a blow of 1e-5 m/s across is enough."""
    overrides, duration_s, _ = ENDS["loops without release"]
    scene = {**overrides, **SPACE, "start.buoy_velocity_mps": [0.0, 1e-5, 0.0]}
    run = simulate(load_scene("tethered_buoy", scene), duration_s=duration_s)
    assert run.status == "ok" and run.statistics["loop_releases"] == 0
    assert run.statistics["max_turn_rad"] < np.pi
    assert run.columns["offplane_m"].max() > 0.1


@pytest.mark.parametrize("turns", [1, 10, 100])
def test_a_twist_that_is_too_much_ends_as_a_row_too(turns):
    """Up to 160 N m put within 2 s into a slack line of EI = 0.4: a status and finite samples, whatever it does."""
    end = {"kind": "held", "position_m": [12.0, 3.0, 8.0], "rotation": "clamped"}
    end |= {"twist_rad": 2 * np.pi * turns, "twist_ramp_s": 2.0}
    scene = {"waves": None, "buoy": None, "end": end, "anchor.rotation": "clamped", **SPACE}
    run = simulate(load_scene("tethered_buoy", {**scene, "tether.torsion_stiffness_Nm2": 5.0}), duration_s=3.0)
    assert run.status == "ok" or run.message
    assert turns > 1 or run.status == "ok"
    assert all(np.all(np.isfinite(column)) for column in run.columns.values())
