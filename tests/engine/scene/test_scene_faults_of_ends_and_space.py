"""A scene whose ends contradict themselves, or that asks for three dimensions in a plane, is refused key by key."""

import pytest

from engine import load_scene
from tests.engine.scene.test_scene_faults import BLOCK, SPACE, TABLE, faults_of

HELD = {"kind": "held", "position_m": [0, 0, 19]}
OSCILLATION = {"law": "harmonic", "amplitude_m": [1, 0, 0], "period_s": 5}


def ends(end=(), **anchor):
    """Overrides: a held end with more keys, and keys of the anchor."""
    return {"end": {**HELD, **dict(end)}, "buoy": None, **({"anchor": anchor} if anchor else {})}


def table_of(times, displacements):
    return {"motion": {"law": "table", "time_s": times, "displacement_m": displacements}}


CROSS = [
    # what moves and releases a held end
    ({"end.motion": OSCILLATION}, "end.motion", "only with end.kind = 'held'"),
    ({"end.release_s": 3.0}, "end.release_s", "only with end.kind = 'held'"),
    (ends({"force_N": [1, 0, 0]}), "end.force_N", "released"),
    (ends({"motion": {**OSCILLATION, "amplitude_m": [0, 1, 0]}}), "end.motion.amplitude_m", "y = 0"),
    (ends(table_of([0, 1], [[0, 0, 0], [0, 1, 0]])), "end.motion.displacement_m[1]", "y = 0"),
    (ends(table_of([0, 1, 1], [[0, 0, 0]] * 3)), "end.motion.time_s[2]", "increasing"),
    (ends(table_of([-1, 1], [[0, 0, 0]] * 2)), "end.motion.time_s[0]", "0 or above"),
    (ends(table_of([0, 1], [[1, 0, 0]] * 2)), "end.motion.displacement_m[0]", "[0, 0, 0]"),
    (ends(table_of([0, 1, 2], [[0, 0, 0]] * 2)), "end.motion.displacement_m", "one for each time, 3"),
    ({**ends({"release_s": 1.0}), "tether.bending_stiffness_Nm2": 0}, "tether.bending_stiffness_Nm2", "direction"),
    # clamps and twist
    ({"anchor.rotation": "clamped"}, "anchor.rotation", "'pinned' in a plane"),
    (ends({"rotation": "clamped"}), "end.rotation", "'pinned' in a plane"),
    (ends({"twist_rad": 1.0}), "end.twist_rad", "0 in a plane"),
    (ends({"twist_ramp_s": 1.0}), "end.twist_ramp_s", "0 in a plane"),
    ({**SPACE, "end.rotation": "clamped"}, "end.rotation", "'pinned', because end.kind is 'buoy'"),
    ({**SPACE, "anchor.direction": [0, 0, 1]}, "anchor.direction", "anchor.rotation = 'clamped'"),
    ({**SPACE, **ends({"direction": [0, 0, 1]})}, "end.direction", "end.rotation = 'clamped'"),
    ({**SPACE, "anchor": {"rotation": "clamped", "direction": [0, 0, 0]}}, "anchor.direction", "not zero"),
    ({**SPACE, **ends({"twist_rad": 1.0}, rotation="clamped")}, "end.twist_rad", "end.rotation = 'clamped'"),
    ({**SPACE, **ends({"twist_ramp_s": 1.0})}, "end.twist_ramp_s", "twist_rad is 0"),
    (
        {**SPACE, "anchor.rotation": "clamped", "tether.bending_stiffness_Nm2": 0},
        "tether.bending_stiffness_Nm2",
        "anchor.rotation is 'clamped'",
    ),
    (
        {**SPACE, **ends({"rotation": "clamped"}, rotation="clamped"), "tether.torsion_stiffness_Nm2": 0},
        "tether.torsion_stiffness_Nm2",
        "both ends are clamped",
    ),
    # currents across the plane
    ({"current": {**TABLE, "y_m": [0]}}, "current.y_m", "motion.dimensions = 3"),
    ({"current": {**TABLE, "velocity_y_mps": BLOCK}}, "current.velocity_y_mps", "motion.dimensions = 3"),
    ({**SPACE, "current": {**TABLE, "y_m": [0, 0]}}, "current.y_m[1]", "increasing"),
    ({**SPACE, "current": {**TABLE, "y_m": [0]}}, "current.velocity_x_mps[0][0]", "1 places along y x 2 places"),
    ({**SPACE, "current": {**TABLE, "velocity_y_mps": [BLOCK]}}, "current.velocity_y_mps[0][0]", "1 heights x 2"),
    # what one scheme or one number of dimensions does not have
    ({**SPACE, "output.tangent_vectors": 1}, "output.tangent_vectors", "motion.dimensions is 3"),
    ({"solver.scheme": "paper-box", "output.tangent_vectors": 1}, "output.tangent_vectors", "'paper-box'"),
    ({**SPACE, "solver.scheme": "paper-box", "anchor.rotation": "clamped"}, "anchor.rotation", "'paper-box'"),
]


@pytest.mark.parametrize(("changes", "key", "allowed"), CROSS)
def test_values_that_contradict_each_other_are_a_fault(changes, key, allowed):
    assert any(line.startswith(f"{key}: ") and allowed in line for line in faults_of(changes)), faults_of(changes)


def test_out_of_the_plane_all_three_components_are_allowed():
    load_scene("tethered_buoy", {**SPACE, "start.buoy_velocity_mps": [0, 1e-5, 0], "waves.direction_rad": 1.0})
    load_scene("tethered_buoy", {**SPACE, "current": {"law": "uniform", "velocity_mps": [1, 1, 0]}})
    block = [[[[0.0, 1.0]] * 3]]
    velocities = {f"velocity_{axis}_mps": block for axis in "xyz"}
    load_scene("tethered_buoy", {**SPACE, "current": {**TABLE, "y_m": [0, 1, 2], **velocities}})
    twisted = {"rotation": "clamped", "position_m": [1, 2, 19], "twist_rad": 6.0, "twist_ramp_s": 3.0,
               "motion": {**OSCILLATION, "amplitude_m": [1, 2, 3]}, "release_s": 9.0, "force_N": [0, 1, 0]}  # fmt: skip
    load_scene("tethered_buoy", {**SPACE, **ends(twisted, rotation="clamped")})


def test_the_keys_of_an_unknown_law_are_not_judged_by_the_rules_of_another():
    for changes in (
        {"current": {"law": "x", "velocity_mps": [0, 1, 0], "y_m": 3}},
        {"current": {"velocity_mps": 5, "height_m": 3}},
        ends({"motion": {"law": "x", "amplitude_m": 3, "time_s": "no", "displacement_m": 5}}),
    ):
        (fault,) = faults_of(changes)
        assert ".law: " in fault
