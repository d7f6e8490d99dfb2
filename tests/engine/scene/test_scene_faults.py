"""A faulty scene is refused with one message that lists every fault: its key, what was given, what is allowed."""

import copy
import math
import pickle
import tomllib

import pytest

from engine import SceneError, load_scene
from engine.scene import build_scene
from tests.engine.physics.caps import CAP

SPACE = {"motion.dimensions": 3}
BLOCK = [[[0.0, 0.0]]]
TABLE = {
    "law": "table", "time_s": [0], "height_m": [0], "x_m": [0, 1], "velocity_x_mps": BLOCK, "velocity_z_mps": BLOCK
}  # fmt: skip
ONE = {"period_s": 5.0, "amplitude_m": 0.8}
SEA = {"significant_height_m": 1.0}
BASE = tomllib.loads(load_scene("tethered_buoy").to_toml())


def faults_of(changes: dict[str, object]) -> tuple[str, ...]:
    with pytest.raises(SceneError) as caught:
        load_scene("tethered_buoy", changes)
    return caught.value.faults


# One fault of each kind: the change, the key of its line, what was given, a word of what is allowed.
SINGLE = [
    ({"tether.length_m": -1.0}, "tether.length_m", "-1.0", "above 0"),
    ({"tether.length_m": 0}, "tether.length_m", "0", "above 0"),
    ({"tether.length_m": "20"}, "tether.length_m", "'20'", "number"),
    ({"tether.length_m": True}, "tether.length_m", "true", "number"),
    ({"tether.length_m": math.nan}, "tether.length_m", "nan", "finite"),
    ({"gravity_mps2": math.inf}, "gravity_mps2", "inf", "finite"),
    ({"gravity_mps2": 10**400}, "gravity_mps2", "1000", "finite"),
    ({"tether.length_m": [1.0]}, "tether.length_m", "[1.0]", "number"),
    ({"tether.nodes": 41.0}, "tether.nodes", "41.0", "whole number from 3 to 20000"),
    ({"tether.nodes": 2}, "tether.nodes", "2", "from 3"),
    ({"tether.nodes": 20001}, "tether.nodes", "20001", "to 20000"),
    ({"tether.nodes": True}, "tether.nodes", "true", "whole number"),
    ({"tether.drag_normal": -0.1}, "tether.drag_normal", "-0.1", "0 or above"),
    ({"tether.grid_stretching": 5.5}, "tether.grid_stretching", "5.5", "from 0 to 5"),
    ({"tether.density_kgpm3": None}, "tether.density_kgpm3", "missing", "above 0"),
    ({"tether.tension.law": "cubic"}, "tether.tension.law", "'cubic'", "'linear', 'tabulated', 'tanh'"),
    ({"tether.tension": {"stiffness_N": 5e4}}, "tether.tension.law", "missing", "'tanh'"),
    ({"tether.tension": 5e4}, "tether.tension", "50000.0", "table"),
    ({"tether.tension": {"law": "tanh", "p": [1, 2, 3]}}, "tether.tension.p", "[1, 2, 3]", "5 finite numbers"),
    ({"tether.tension": {"law": "tanh", "p": [1, 2, 3, 4, "x"]}}, "tether.tension.p[4]", "'x'", "5 finite numbers"),
    ({"tether.tension": {"law": "tabulated", "strain": [], "tension_N": []}}, "tether.tension.strain", "[]", "least 2"),
    ({"buoy.mass_kg": -1611.0}, "buoy.mass_kg", "-1611.0", "above 0"),
    ({"buoy.submergence": "half"}, "buoy.submergence", "'half'", "one of 'full', 'spherical-cap'"),
    ({**CAP, "buoy.impact_loss": 1.5}, "buoy.impact_loss", "1.5", "a number from 0 to 1"),
    ({"buoy": 5}, "buoy", "5", "table"),
    ({"end.kind": "loose"}, "end.kind", "'loose'", "'buoy', 'held', 'free'"),
    ({"water.depth_m": 0.0}, "water.depth_m", "0.0", "above 0"),
    ({"waves.above_still_water": "stretch"}, "waves.above_still_water", "'stretch'", "'wheeler'"),
    ({"current": {"velocity_mps": [1.0, 0.0, 0.0]}}, "current.law", "missing", "'uniform', 'profile', 'table'"),
    ({"current": {"law": "uniform", "velocity_mps": [1.0, 0.0]}}, "current.velocity_mps", "[1.0, 0.0]", "3 finite"),
    ({"current": {"law": "profile", "height_m": [0, 9], "velocity_mps": []}}, "current.velocity_mps", "[]", "vectors"),
    ({"motion.dimensions": 4}, "motion.dimensions", "4", "2, 3"),
    ({"motion.dimensions": "3"}, "motion.dimensions", "'3'", "2, 3"),
    ({"anchor.rotation": "glued"}, "anchor.rotation", "'glued'", "'pinned', 'clamped'"),
    ({"anchor.direction": [0, 1]}, "anchor.direction", "[0, 1]", "3 finite"),
    ({"end.motion": {"law": "circle"}}, "end.motion.law", "'circle'", "'harmonic', 'table'"),
    ({"end.motion": {"amplitude_m": [1, 0, 0]}}, "end.motion.law", "missing", "'harmonic', 'table'"),
    ({"end.motion": {"law": "harmonic", "amplitude_m": [1, 0, 0]}}, "end.motion.period_s", "missing", "above 0"),
    ({"end.motion": {"law": "table", "time_s": [0], "displacement_m": []}}, "end.motion.time_s", "[0]", "at least 2"),
    ({"end.release_s": 0}, "end.release_s", "0", "above 0"),
    ({"end.twist_ramp_s": -1.0}, "end.twist_ramp_s", "-1.0", "0 or above"),
    ({"current": {**TABLE, "velocity_x_mps": 7}}, "current.velocity_x_mps", "7", "[time][height][x]"),
    ({"current": {**TABLE, "velocity_x_mps": [[[0, "a"]]]}}, "current.velocity_x_mps[0][0][1]", "'a'", "nested lists"),
    (
        {**SPACE, "current": {**TABLE, "y_m": [0], "velocity_x_mps": [[[[0, "a"]]]]}},
        "current.velocity_x_mps[0][0][0][1]",
        "'a'",
        "[time][height][y][x]",
    ),
    ({"solver.scheme": "box"}, "solver.scheme", "'box'", "'conservation', 'paper-box'"),
    ({"start.buoy_velocity_mps": [0, math.nan, 0]}, "start.buoy_velocity_mps[1]", "nan", "finite"),
    ({"solver.integrator": "rk4"}, "solver.integrator", "'rk4'", "'esdirk43'"),
    ({"solver.rtol": 0.0}, "solver.rtol", "0.0", "above 0 and below 1"),
    ({"solver.spectral_radius": 1.5}, "solver.spectral_radius", "1.5", "from 0 to 1"),
    ({"solver.loop_release": 1}, "solver.loop_release", "1", "true or false"),
    ({"output.profiles": "yes"}, "output.profiles", "'yes'", "true or false"),
    ({"output.step_s": 0}, "output.step_s", "0", "above 0"),
    ({"waves.components": []}, "waves.components", "[]", "a list of 1 to 2000 tables"),
    ({"waves.components": 3}, "waves.components", "3", "a list of 1 to 2000 tables"),
    ({"waves.components": [{"period_s": 5.0}]}, "waves.components[0].amplitude_m", "missing", "0 or above"),
    ({"waves.components": [ONE, {**ONE, "amplitude_m": -1.0}]}, "waves.components[1].amplitude_m", "-1.0", "0 or"),
    ({"waves.components": [{**ONE, "period_s": 0.0}]}, "waves.components[0].period_s", "0.0", "above 0"),
    ({"waves.components": [{**ONE, "hight_m": 1.0}]}, "waves.components[0].hight_m", "unknown key", ""),
    ({"waves.jonswap": {**SEA, "seed": -1}}, "waves.jonswap.seed", "-1", "0 to 1000000000"),
    ({"waves.jonswap": {**SEA, "peak_enhancement": 0.5}}, "waves.jonswap.peak_enhancement", "0.5", "from 1 to 10"),
    ({"waves.jonswap": {**SEA, "components": 0}}, "waves.jonswap.components", "0", "a whole number from 1 to 2000"),
    ({"waves.jonswap": {**SEA, "gamma": 3.3}}, "waves.jonswap.gamma", "unknown key", "peak_enhancement"),
    ({"waves.jonswap.seed": 3}, "waves.jonswap.significant_height_m", "missing", "above 0"),
    ({"name": "../evil name"}, "name", "'../evil name'", "letters"),
    ({"title": 3}, "title", "3", "text"),
]


@pytest.mark.parametrize(("changes", "key", "given", "allowed"), SINGLE)
def test_a_value_at_fault_is_named_shown_and_told_what_is_allowed(changes, key, given, allowed):
    lines = [line for line in faults_of(changes) if line.startswith(f"{key}: ")]
    assert lines, faults_of(changes)
    assert any(given in line and allowed in line.partition("allowed")[2] for line in lines)


def test_every_fault_is_reported_at_once_those_between_values_among_them():
    # Independent faults in every section: the list for all together is the union of the lists one by one.
    independent = [
        {"tether.length_m": -1.0},
        {"tether.nodes": 2.5},
        {"buoy.drag": "smooth"},
        {"water.density_kgpm3": 0.0},
        {"waves.steepness": 0.1, "waves.amplitude_m": 0.2},
        {"waves.period_s": math.nan},
        {"current": {"law": "profile", "height_m": [3, 2], "velocity_mps": [[1, 0, 0], [1, 0, "x"]]}},
        {"start.buoy_velocity_mps": [0, 1, 0]},
        {"solver.min_step_s": 1.0},
        {"output.profiles_step_s": 1.0},
        {"wavs.steepness": 0.1},
    ]
    expected = {line for changes in independent for line in faults_of(changes)}
    together = faults_of({key: value for changes in independent for key, value in changes.items()})
    assert len(expected) == 12, "\n".join(sorted(expected))
    assert set(together) == expected
    assert len(together) == len(expected)


@pytest.mark.parametrize(
    ("key", "meant"),
    [
        ("tether.lenght_m", "tether.length_m"),
        ("steepness", "waves.steepness"),
        ("wavs", "waves"),
        ("solver.integrater", "solver.integrator"),
        ("tether.stiffness_N", "tether.tension.stiffness_N"),
    ],
)
def test_an_unknown_key_is_told_what_was_probably_meant(key, meant):
    expected = f"did you mean '{meant}'"
    assert any(line.startswith(f"{key}: unknown key") and expected in line for line in faults_of({key: 1}))
    # and the same in a file
    raw = copy.deepcopy(BASE)
    section, _, last = key.rpartition(".")
    (raw[section] if section else raw)[last] = 1
    with pytest.raises(SceneError, match="did you mean"):
        build_scene(raw)


def test_a_key_of_another_law_is_not_suggested_as_what_it_already_is():
    lines = faults_of({"tether.tension.law": "tanh"})
    stray = [line for line in lines if line.startswith("tether.tension.stiffness_N")]
    assert len(stray) == 1 and "law = 'tanh' does not have" in stray[0]


@pytest.mark.parametrize("key", ["", "a..b", ".waves", 3])
def test_a_key_that_is_none_is_a_fault(key):
    assert len(faults_of({key: 1})) == 1


def test_removing_a_key_that_no_scene_has_is_a_fault():
    assert "unknown key" in faults_of({"wavs": None})[0]


def test_the_message_holds_every_line_and_survives_the_way_between_processes():
    with pytest.raises(SceneError) as caught:
        load_scene("tethered_buoy", {"tether.length_m": -1, "buoy.mass_kg": -1})
    error = caught.value
    assert isinstance(error, ValueError)
    assert len(error.faults) == 2 and all(line in str(error) for line in error.faults)
    again = pickle.loads(pickle.dumps(error))
    assert again.faults == error.faults and str(again) == str(error)


def test_a_very_long_value_does_not_drown_the_message():
    (line,) = faults_of({"title": list(range(10000))})
    assert len(line) < 200
