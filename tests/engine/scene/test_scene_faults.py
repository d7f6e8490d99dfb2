"""A faulty scene is refused with one message that lists every fault: its key, what was given, what is allowed.
What no run could do is refused before it starts; a missing equilibrium has its reason.
"""

import pickle
import tomllib
from pathlib import Path

import pytest

from engine import SceneError, load_scene, simulate
from engine.parameters import NOT_STRETCHED, grid
from engine.scene import build_scene, parse_assignment, scene_from_toml
from engine.scene.values import LARGEST, SMALLEST

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
    faults = faults_of(changes_of(sets, changes))
    lines = [line for line in faults if line.startswith(f"{key}: ")]
    assert lines and (row not in TABLES["refused"]["alone"] or len(faults) == 1), faults
    statement = [line.partition("allowed")[2] if given else line.removeprefix(key) for line in lines if given in line]
    assert any(allowed in words for words in statement), lines


def test_every_fault_is_reported_at_once_those_between_values_among_them():
    independent = TABLES["independent"]
    expected = {line for changes in independent for line in faults_of(changes)}
    together = faults_of({key: value for changes in independent for key, value in changes.items()})
    assert len(expected) == len(together) == 12 and set(together) == expected


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


def nested(levels: int) -> list:
    value: list = [1.0]
    for _ in range(levels - 1):
        value = [value]
    return value


@pytest.mark.parametrize("levels", [50, 500, 100_000])
@pytest.mark.parametrize(
    "read",
    [
        lambda n: load_scene("tethered_buoy", dict([parse_assignment(f"tether.tension.p={'[' * n}1{']' * n}")])),
        lambda n: load_scene("tethered_buoy", dict([parse_assignment(f"current={'{a=' * n}1{'}' * n}")])),
        lambda n: load_scene("tethered_buoy", {"tether.tension.p": nested(n)}),
        lambda n: scene_from_toml(f'name = "a"\nx = {"[" * n}1{"]" * n}'),
        lambda n: scene_from_toml(f"x{'.a' * n} = 1"),
        lambda n: scene_from_toml(f"[x{' . a' * n}]"),
        lambda n: build_scene({"name": nested(n)}),
    ],
)
def test_lists_in_lists_without_end_are_refused_in_a_line(levels, read):
    with pytest.raises(SceneError) as caught:
        read(levels)
    (line,) = caught.value.faults
    assert "allowed: at most 32 levels" in line and len(line) < 200


@pytest.mark.parametrize(("changes", "duration_s", "key"), TABLES["runs"])
def test_more_than_any_run_could_do_is_refused(changes, duration_s, key):
    with pytest.raises(ValueError, match=rf"^{key}: .*allowed: at most"):
        simulate(load_scene("tethered_buoy", changes_of("", changes)), duration_s=duration_s)


@pytest.mark.parametrize("value", [5e-324, 1e-310, 0.5 * SMALLEST, 2 * LARGEST, 1e308])
@pytest.mark.parametrize(
    "key", ["tether.length_m", "tether.bending_stiffness_Nm2", "buoy.mass_kg", "waves.period_s", "solver.min_step_s"]
)
def test_numbers_beyond_what_anything_measures_are_refused(key, value):
    with pytest.raises(SceneError, match=rf"{key}: .*allowed: .*1e-30"):
        load_scene("tethered_buoy", {key: value})


def test_zero_is_not_too_small_where_it_is_allowed_and_components_may_be_tiny():
    load_scene("tethered_buoy", {"tether.bending_stiffness_Nm2": 0.0, "tether.drag_normal": -0.0, "waves.ramp_s": 0})
    with pytest.raises(SceneError, match="at most 1e"):
        load_scene("tethered_buoy", {"start.buoy_velocity_mps": [0.0, 0.0, 2 * LARGEST]})


@pytest.mark.parametrize("name", ["", "\n", "a.b", "x y"])
def test_a_name_that_is_no_bare_key_is_shown_in_quotes(name):
    raw = load_scene("tethered_buoy").as_dict()
    for trial in ({**raw, name: 1}, {**raw, "tether": {**raw["tether"], name: 1}}):
        with pytest.raises(SceneError) as caught:
            build_scene(trial)
        (line,) = caught.value.faults
        assert repr(name) in line.partition(": ")[0] and "\n" not in line


@pytest.mark.parametrize(("changes", "words"), TABLES["rests"])
@pytest.mark.parametrize("scheme", ["conservation", "paper-box"])
def test_a_missing_equilibrium_has_its_reason(changes, words, scheme):
    if scheme == "paper-box" and changes.get("tether.bending_stiffness_Nm2") == 0.0:
        return
    scene = load_scene("tethered_buoy", changes_of("", {**changes, "solver.scheme": scheme, "tether.nodes": 11}))
    run = simulate(scene, duration_s=1.0)
    assert run.status == "statics-failed" and all(word in run.message for word in words)


@pytest.mark.parametrize("refined", ["both", "lower", "upper"])
def test_a_grid_has_no_coincident_nodes_and_stretching_sets_in_without_a_jump(refined):
    for stretching in (0.0, 5e-324, 1e-310, 1e-20, 1e-7, 1.01 * NOT_STRETCHED):
        assert grid(20.0, 61, stretching, refined) == pytest.approx(20.0 / 60, rel=1e-9)
    h = grid(20.0, 20000, 5.0, refined)
    assert h.min() > 0 and h.sum() == pytest.approx(20.0, rel=1e-12)


@pytest.mark.parametrize("text", ["2160 cm", "21600 mm", "0.0216 km", "21,6 m", "21.6"])
def test_a_number_with_its_unit_is_given_back_in_the_unit_of_its_key(text):
    (fault,) = faults_of({"water.depth_m": text})
    assert fault.endswith(": 21.6)")
