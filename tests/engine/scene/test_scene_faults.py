"""A faulty scene is refused with one message that lists every fault: its key, what was given, what is allowed."""

import math
import pickle
import tomllib
from pathlib import Path

import pytest

from engine import SceneError, load_scene
from engine.scene import build_scene

TABLES = tomllib.loads(Path(__file__).with_name("scenes.toml").read_text(encoding="utf-8"))
ROWS = [row for rows in TABLES["refused"].values() for row in rows]


def changes_of(sets: str, changes: dict[str, object]) -> dict[str, object]:
    """Overrides for `load_scene` from the first two entries of a refused row of `scenes.toml`."""
    parts = [TABLES["sets"][name] for name in sets.split()] + [changes]
    return {key: None if value == "none" else value for part in parts for key, value in part.items()}


def faults_of(changes: dict[str, object]) -> tuple[str, ...]:
    with pytest.raises(SceneError) as caught:
        load_scene("tethered_buoy", changes)
    return caught.value.faults


@pytest.mark.parametrize("row", [*ROWS, ["", {"gravity_mps2": 10**400}, "gravity_mps2", "1000", "finite"]])
def test_a_fault_is_named_shown_and_told_what_is_allowed(row):
    sets, changes, key, given, allowed = row
    lines = [line for line in faults_of(changes_of(sets, changes)) if line.startswith(f"{key}: ")]
    assert lines, faults_of(changes)
    told = [line.partition("allowed")[2] if given else line.removeprefix(key) for line in lines if given in line]
    assert any(allowed in words for words in told), lines


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


def test_an_unknown_key_in_a_file_is_told_what_was_probably_meant():
    raw = load_scene("tethered_buoy").as_dict()
    raw["solver"]["integrater"] = raw["wavs"] = 1
    with pytest.raises(SceneError) as caught:
        build_scene(raw)
    assert [line.partition("did you mean ")[2].partition("?")[0] for line in caught.value.faults] == [
        "'solver.integrator'", "'waves'"
    ]  # fmt: skip


@pytest.mark.parametrize("key", ["", "a..b", ".waves", 3])
def test_a_key_that_is_none_is_a_fault(key):
    assert len(faults_of({key: 1})) == 1


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


def test_a_table_of_currents_has_one_velocity_for_each_point():
    table = {"law": "table", "time_s": [0, 1], "height_m": [0, 1, 2], "x_m": [0]}
    good = [[[0.0], [0.0], [0.0]], [[0.0], [0.0], [0.0]]]
    load_scene("tethered_buoy", {"current": {**table, "velocity_x_mps": good, "velocity_z_mps": good}})
    for bad in (good[:1], [good[0], good[1][:2]], [good[0], [[0.0], [0.0, 1.0], [0.0]]]):
        lines = faults_of({"current": {**table, "velocity_x_mps": good, "velocity_z_mps": bad}})
        assert len(lines) == 1 and lines[0].startswith("current.velocity_z_mps") and "2 times x 3 heights" in lines[0]


def test_out_of_the_plane_all_three_components_are_allowed():
    turning = {"end.rotation": "clamped", "end.twist_rad": 6.0, "end.twist_ramp_s": 3.0, "anchor.rotation": "clamped"}
    moving = {"law": "harmonic", "amplitude_m": [1, 2, 3], "period_s": 5}
    block = {f"current.velocity_{axis}_mps": [[[[0.0, 1.0]] * 3]] for axis in "xyz"}
    for sets, changes in (
        ("space", {"start.buoy_velocity_mps": [0, 1e-5, 0], "waves.direction_rad": 1.0}),
        ("space", {"current": {"law": "uniform", "velocity_mps": [1, 1, 0]}}),
        ("space table", {"current.y_m": [0, 1, 2], **block}),
        ("space held", {**turning, "end.motion": moving, "end.release_s": 9.0, "end.force_N": [0, 1, 0]}),
    ):
        load_scene("tethered_buoy", changes_of(sets, changes))


def test_the_keys_of_an_unknown_law_are_not_judged_by_the_rules_of_another():
    for changes in (
        {"current": {"law": "x", "velocity_mps": [0, 1, 0], "y_m": 3}},
        {"current": {"velocity_mps": 5, "height_m": 3}},
        changes_of("held", {"end.motion": {"law": "x", "amplitude_m": 3, "time_s": "no", "displacement_m": 5}}),
    ):
        (fault,) = faults_of(changes)
        assert ".law: " in fault
