"""A scene whose values contradict each other is refused key by key: waves and water, ends, clamps, seas, space."""

import pytest

from engine import load_scene
from tests.engine.physics.caps import CAP
from tests.engine.scene.test_scene_faults import BLOCK, ONE, SEA, SPACE, TABLE, faults_of

HELD = {"kind": "held", "position_m": [0, 0, 19]}
OSCILLATION = {"law": "harmonic", "amplitude_m": [1, 0, 0], "period_s": 5}


def ends(end=(), **anchor):
    """Overrides: a held end with more keys, and keys of the anchor."""
    return {"end": {**HELD, **dict(end)}, "buoy": None, **({"anchor": anchor} if anchor else {})}


def table_of(times, displacements):
    return {"motion": {"law": "table", "time_s": times, "displacement_m": displacements}}


CROSS = [
    ({"water": None}, "water", "waves are given"),
    ({"water": None, "waves": None, "current": {"law": "uniform", "velocity_mps": [1, 0, 0]}}, "water", "current"),
    ({"gravity_mps2": 0}, "gravity_mps2", "waves"),
    ({"waves.steepness": 0.1, "waves.amplitude_m": 0.1}, "waves", "exactly one"),
    ({"waves.steepness": None}, "waves.steepness", "exactly one"),
    ({"waves.amplitude_m": 21.0}, "waves.amplitude_m", "less than water.depth_m"),
    ({"waves.direction_rad": 1.0}, "waves.direction_rad", "0 or pi"),
    ({"buoy": None}, "buoy", "missing"),
    ({"buoy.impact_loss": 0.5}, "buoy.impact_loss", "0, because buoy.submergence is not 'spherical-cap'"),
    ({**CAP, "solver.scheme": "paper-box"}, "buoy.submergence", "'full', because solver.scheme is 'paper-box'"),
    ({**CAP, "water": None, "waves": None}, "buoy.submergence", "'full', because there is no water"),
    ({"end": {"kind": "free", "force_N": [0, 0, 9]}}, "buoy", "none, because end.kind is 'free'"),
    (
        {"end": {"kind": "free", "force_N": [0, 0, 0]}, "buoy": None, "tether.bending_stiffness_Nm2": 0},
        "tether.bending_stiffness_Nm2",
        "direction",
    ),
    ({"end": {"kind": "held"}, "buoy": None}, "end.position_m", "missing"),
    ({"end": {"kind": "free"}, "buoy": None}, "end.force_N", "missing"),
    ({"end.position_m": [0, 0, 20]}, "end.position_m", "'held'"),
    ({"end": {"kind": "free", "force_N": [0, 1, 0]}, "buoy": None}, "end.force_N", "y = 0"),
    ({"start.buoy_velocity_mps": [0, 1e-5, 0]}, "start.buoy_velocity_mps", "y = 0"),
    (
        {"end": {"kind": "held", "position_m": [0, 0, 9]}, "buoy": None, "start.buoy_velocity_mps": [1, 0, 0]},
        "start.buoy_velocity_mps",
        "zero",
    ),
    ({"current": {"law": "uniform", "velocity_mps": [1, 1, 0]}}, "current.velocity_mps", "y = 0"),
    (
        {"current": {"law": "profile", "height_m": [0, 5, 5], "velocity_mps": [[1, 0, 0]] * 3}},
        "current.height_m[2]",
        "increasing",
    ),
    ({"current": {"law": "profile", "height_m": [0, 5], "velocity_mps": [[1, 0, 0]] * 3}}, "current.velocity_mps", "2"),
    (
        {"tether.tension": {"law": "tabulated", "strain": [0, 0.2, 0.1], "tension_N": [0, 1, 2]}},
        "tether.tension.strain[2]",
        "increasing",
    ),
    (
        {"tether.tension": {"law": "tabulated", "strain": [0, 0.2], "tension_N": [0, 1, 2]}},
        "tether.tension.tension_N",
        "one for each of tether.tension.strain, 2",
    ),
    (
        {"tether.tension": {"law": "tabulated", "strain": [0, 0.2], "tension_N": [1, 0]}},
        "tether.tension.tension_N[1]",
        "never falls",
    ),
    (
        {"tether.tension": {"law": "tabulated", "strain": [-1.5, 0.2], "tension_N": [0, 1]}},
        "tether.tension.strain[0]",
        "above -1",
    ),
    ({"tether.tension": {"law": "tanh", "p": [1.0, -2.0, 0.0, 0.0, 1.0]}}, "tether.tension.p", "never falls"),
    ({"solver.min_step_s": 1.0}, "solver.min_step_s", "at most"),
    ({"output.profiles_step_s": 1.0}, "output.profiles_step_s", "output.profiles = true"),
    # what moves and releases a held end
    ({"end.motion": OSCILLATION}, "end.motion", "only with end.kind = 'held'"),
    ({"end.release_s": 3.0}, "end.release_s", "only with end.kind = 'held'"),
    (ends({"force_N": [1, 0, 0]}), "end.force_N", "released"),
    (ends({"motion": {**OSCILLATION, "amplitude_m": [0, 1, 0]}}), "end.motion.amplitude_m", "y = 0"),
    (ends(table_of([0, 1], [[0, 0, 0], [0, 1, 0]])), "end.motion.displacement_m[1]", "y = 0"),
    (ends(table_of([0, 1, 1], [[0, 0, 0]] * 3)), "end.motion.time_s[2]", "increasing"),
    (ends(table_of([-1, 1], [[0, 0, 0]] * 2)), "end.motion.time_s[0]", "0 or above"),
    (ends(table_of([0, 1], [[1, 0, 0]] * 2)), "end.motion.displacement_m[0]", "[0, 0, 0]"),
    (ends(table_of([0, 1, 2], [[0, 0, 0]] * 2)), "end.motion.displacement_m", "one for each of end.motion.time_s, 3"),
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
    # irregular seas
    ({"waves.components": [ONE] * 30}, "waves.components", "less than water.depth_m, 21.0"),
    ({"waves.components": [{**ONE, "direction_rad": 1.0}]}, "waves.components[0].direction_rad", "0 or pi in a plane"),
    ({"waves.components": [ONE], "waves.phase_rad": 1.0}, "waves.phase_rad", "each component has its own"),
    ({**SPACE, "waves.components": [ONE], "waves.direction_rad": 1.0}, "waves.direction_rad", "has its own"),
    ({"waves.jonswap.significant_height_m": 30.0}, "waves.jonswap.significant_height_m", "less than water.depth_m"),
    ({"waves.jonswap": SEA, "waves.phase_rad": 1.0}, "waves.phase_rad", "draws those of its components"),
    ({"waves.jonswap": SEA, "waves.steepness": 0.1}, "waves", "exactly one of them"),
    ({"waves.jonswap": SEA, "waves.components": [ONE]}, "waves", "exactly one of them"),
]


@pytest.mark.parametrize(("changes", "key", "allowed"), CROSS)
def test_values_that_contradict_each_other_are_a_fault(changes, key, allowed):
    assert any(line.startswith(f"{key}: ") and allowed in line for line in faults_of(changes)), faults_of(changes)


def test_a_table_of_currents_has_one_velocity_for_each_point():
    table = {"law": "table", "time_s": [0, 1], "height_m": [0, 1, 2], "x_m": [0]}
    good = [[[0.0], [0.0], [0.0]], [[0.0], [0.0], [0.0]]]
    load_scene("tethered_buoy", {"current": {**table, "velocity_x_mps": good, "velocity_z_mps": good}})
    for bad in (good[:1], [good[0], good[1][:2]], [good[0], [[0.0], [0.0, 1.0], [0.0]]]):
        lines = faults_of({"current": {**table, "velocity_x_mps": good, "velocity_z_mps": bad}})
        assert len(lines) == 1 and lines[0].startswith("current.velocity_z_mps") and "2 times x 3 heights" in lines[0]


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
