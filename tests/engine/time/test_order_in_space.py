"""The box is of second order in the element length: nodes doubled, the whole line compared, slope within 0.1 of 2.

Every node of a grid is a node of the next, also of a stretched one. Steps in time are the same on all grids.
Caps of the first difference, on 1 m elements: of size h^2/8 times the curvature, which is below 0.01 /m where the line
is taut (1 mm) and about 0.5 /m where it is slack (0.1 m).
Where a current bends the line, its moment-free ends have layers of length sqrt(EI/T): none without bending, 1.6 m
with EI = 5000 N m2. Those of the shipped EI = 0.4 N m2, 14 mm, are not resolved by any of these grids: nodes next to
the ends then converge at no order (by micrometres), while the upper end keeps order 2.
"""

from itertools import pairwise

import numpy as np
import pytest

from engine import load_scene, simulate
from tests.engine.lines import STILL, held

SHEAR = {"law": "profile", "height_m": [0.0, 30.0], "velocity_mps": [[0.2, 0.0, 0.0], [1.5, 0.0, 0.0]]}
SMALL_WAVES = {"waves.steepness": 0.016, "water.depth_m": 22.5, "waves.ramp_s": 5.0}
CURRENT = {"waves": None, "current": SHEAR}
UNBENT, STIFF = {"tether.bending_stiffness_Nm2": 0.0}, {"tether.bending_stiffness_Nm2": 5e3}
SLACK = STILL | held(14.0, 6.0) | {"tether.bending_stiffness_Nm2": 24.0}
SCENES = {  # overrides, run length (s), largest difference of positions between the two coarsest grids (m)
    "static line in a sheared current": ({**CURRENT, **UNBENT}, 0.0, 1e-3),
    "the same, stiff in bending": ({**CURRENT, **STIFF}, 0.0, 1e-3),
    "slack line between two points": (SLACK, 0.0, 0.1),
    "small waves": (SMALL_WAVES, 10.0, 1e-3),
    "small waves in a sheared current, without bending": ({**SMALL_WAVES, "current": SHEAR, **UNBENT}, 10.0, 1e-3),
}


def line_at_end(overrides, end_s, nodes, stretching):
    """x, z (m), tension (N) at every node; r, theta, tension of the upper end."""
    scene = load_scene(
        "tethered_buoy",
        {
            **overrides,
            "tether.nodes": nodes,
            "tether.grid_stretching": stretching,
            "solver.step_s": 0.01,
            "solver.newton_tolerance": 1e-14,
            "solver.max_newton_iterations": 50,
            "output.step_s": end_s or 0.01,
            "output.profiles": True,
        },
    )
    run = simulate(scene, duration_s=end_s or 0.01)
    assert run.status == "ok", run.message
    at = -1 if end_s else 0
    line = np.stack([run.profiles.x_m[at], run.profiles.z_m[at], run.profiles.tension_N[at]])
    return line, np.array([run.columns[name][at] for name in ("radius_m", "angle_rad", "tension_top_N")])


@pytest.mark.parametrize("stretching", [0.0, 1.5])
@pytest.mark.parametrize("name", SCENES)
def test_second_order_in_space(name, stretching):
    overrides, end_s, cap_m = SCENES[name]
    found = [line_at_end(overrides, end_s, nodes, stretching) for nodes in (21, 41, 81, 161)]
    along, top = [], []
    for (coarse, coarse_top), (fine, fine_top) in pairwise(found):
        difference = np.abs(fine[:, ::2] - coarse)
        along.append([np.hypot(*difference[:2]).max(), difference[2].max()])
        top.append(np.abs(fine_top - coarse_top))
    assert along[0][0] < cap_m
    assert np.all(np.abs(np.log2(np.divide(along[:-1], along[1:])) - 2) < 0.1), along
    if overrides is not SLACK:  # r and theta of a held end are given
        assert np.all(np.abs(np.log2(np.divide(top[:-1], top[1:])) - 2) < 0.1), top
