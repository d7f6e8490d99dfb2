"""Scenes by name and from files: overrides, round trips, keys, and files that are not scenes."""

import inspect
import math

import numpy as np
import pydantic
import pytest

from engine import Scene, SceneError, list_scenes, load_scene
from engine.scene import parse_assignment, scene_from_toml
from engine.scene.finer import finer
from tests.engine.scene.test_scene_faults import TABLES, changes_of

VARIANTS = [changes_of("", changes) for changes in TABLES["accepted"]]


@pytest.mark.parametrize("changes", VARIANTS)
def test_a_scene_written_and_read_is_the_same_scene(changes, tmp_path):
    scene = load_scene("tethered_buoy", changes)
    path = tmp_path / "scene.toml"
    path.write_text(scene.to_toml(), encoding="utf-8")
    for reread in (load_scene(path), load_scene(str(path)), scene_from_toml(scene.to_toml())):
        assert reread == scene
        assert reread.key() == scene.key()
        assert reread.to_toml() == scene.to_toml()


def test_scenes_that_differ_in_anything_have_different_keys():
    smallest = {"water.depth_m": math.nextafter(21.0, 22.0)}
    keys = {load_scene("tethered_buoy", changes).key() for changes in (*VARIANTS, smallest)}
    assert len(keys) == len(VARIANTS) + 1 and all(len(key) == 64 for key in keys)
    assert load_scene("tethered_buoy", {"water.depth_m": 21}).key() in keys  # the same number, written as a whole one


def test_every_part_of_a_scene_counts_in_its_key():
    floor, current = {"stiffness_Npm3": 1e5}, {"law": "uniform", "velocity_mps": [0.1, 0.0, 0.0]}
    scene = load_scene("tethered_buoy", {"floor": floor, "current": current})
    for name in Scene.model_fields:
        assert scene.model_copy(update={name: None}).key() != scene.key(), name


@pytest.mark.parametrize("changes", [{}, {"solver.integrator": "midpoint", "solver.step_s": 0.02}])
def test_a_finer_scene_has_shorter_elements_and_a_quarter_of_the_step_or_of_the_tolerance(changes):
    scene = load_scene("tethered_buoy", {"tether.nodes": 9, **changes})
    fine = finer(scene, elements=2, steps=4)
    assert fine.tether.nodes == 17  # 16 elements in place of 8
    assert (fine.solver.step_s == 0.005) if changes else (fine.solver.rtol == pytest.approx(scene.solver.rtol / 4))


def test_the_shipped_scene_is_table_1():
    scene = load_scene("tethered_buoy")
    assert [load_scene(name).name for name in list_scenes()] == list_scenes()
    # Table 1 of the paper and section 4.2, as printed there
    assert scene.tether.length_m == 20 and scene.tether.area_m2 == 7.85e-5 and scene.tether.density_kgpm3 == 1140
    assert scene.buoy.diameter_m == 1.5 and scene.buoy.mass_kg == 1611
    assert scene.buoy.added_mass_kg == 907 and scene.buoy.drag == 0.2
    assert scene.tether.tension.stiffness_N == 5e4 and scene.waves.period_s == 5
    # its static strain is "about 0.04", from T_s = B - W
    displaced = scene.water.density_kgpm3 * math.pi * scene.buoy.diameter_m**3 / 6
    lift = (displaced - scene.buoy.mass_kg) * scene.gravity_mps2
    assert lift / scene.tether.tension.stiffness_N == pytest.approx(0.04, abs=5e-4)
    # the added mass of a sphere is half the water it displaces
    assert scene.buoy.added_mass_kg == pytest.approx(displaced / 2, rel=1e-3)


def test_a_scene_cannot_be_changed_in_place():
    scene = load_scene("tethered_buoy")
    with pytest.raises(AttributeError, match="length_m: a scene does not change"):
        scene.tether.length_m = 3.0
    with pytest.raises(TypeError):
        scene.start.buoy_velocity_mps[0] = 1.0
    assert hash(scene) == hash(load_scene("tethered_buoy"))


def test_tab_completes_the_keywords_that_are_taken():
    parameters = inspect.signature(load_scene).parameters
    words = [name for name, entry in parameters.items() if entry.kind == inspect.Parameter.KEYWORD_ONLY]
    assert {"steepness", "depth_m", "nodes"} <= set(words) and "diameter_m" not in words  # of tether and of buoy
    for word in words:
        try:
            load_scene("tethered_buoy", **{word: object()})
        except SceneError as error:
            assert all("no such key" not in fault and "the end of" not in fault for fault in error.faults), word


def test_a_scene_made_directly_obeys_the_same_rules():
    raw = load_scene("tethered_buoy").model_dump()
    assert Scene(**raw) == load_scene("tethered_buoy")
    raw["water"] = None
    with pytest.raises(pydantic.ValidationError, match="waves are given"):
        Scene(**raw)


HEIGHTS = {"amplitude_m": 0.1, "components": [{"period_s": 5.0, "amplitude_m": 0.8}], "jonswap.significant_height_m": 1}


@pytest.mark.parametrize(("name", "value"), HEIGHTS.items())
def test_what_says_how_high_the_waves_are_takes_the_place_of_what_was_inherited(name, value):
    scene = load_scene("tethered_buoy", {f"waves.{name}": value})
    assert scene.waves.steepness is None and getattr(scene.waves, name.partition(".")[0]) is not None
    assert scene_from_toml(scene.to_toml()) == scene
    back = scene_from_toml(scene.to_toml(), {"waves.steepness": 0.2})
    assert back.waves.steepness == 0.2 and not back.waves.irregular and back.waves.amplitude_m is None
    assert back.key() == load_scene("tethered_buoy", {"waves.steepness": 0.2}).key()


@pytest.mark.parametrize("inherited", [
    {"waves.significant_steepness": 0.1, "waves.relative_width": 0.05, "waves.seed": 3, "waves.component_count": 8},
    {"waves.record": "gauge.csv", "waves.record_x_m": 3.0, "waves.components": HEIGHTS["components"]},
])  # fmt: skip
@pytest.mark.parametrize("name", ["amplitude_m", "jonswap.significant_height_m"])
def test_what_only_the_replaced_sea_had_a_use_for_goes_with_it(name, inherited):
    text = load_scene("tethered_buoy", inherited).to_toml()
    replaced = {f"waves.{name}": HEIGHTS[name], "waves.above_still_water": "zero"}
    assert scene_from_toml(text, replaced) == load_scene("tethered_buoy", replaced)


@pytest.mark.parametrize("name", ["components", "jonswap.significant_height_m"])
@pytest.mark.parametrize(("submergence", "treated"), [("full", "zero"), ("spherical-cap", "wheeler")])
def test_the_water_of_a_sea_moves_up_to_a_sphere_that_floats_in_it_and_ends_below_a_whole_one(
    name, submergence, treated
):
    sphere, sea, key = {"buoy.submergence": submergence}, {f"waves.{name}": HEIGHTS[name]}, "waves.above_still_water"
    regular = load_scene("tethered_buoy", sphere)
    drawn = load_scene("tethered_buoy", sphere | sea)
    assert regular.waves.above_still_water == "extrapolate"
    assert drawn.waves.above_still_water == treated
    assert scene_from_toml(regular.to_toml(), sea) == scene_from_toml(drawn.to_toml()) == drawn
    assert scene_from_toml(drawn.to_toml(), {"waves.steepness": 0.1}).waves.above_still_water == "extrapolate"
    for chosen in ("extrapolate", "zero", "wheeler"):
        assert load_scene("tethered_buoy", sphere | sea | {key: chosen}).waves.above_still_water == chosen
        kept = load_scene("tethered_buoy", sphere | {key: chosen})
        # a regular wave's own default is not written into its file
        expected = treated if chosen == "extrapolate" else chosen
        assert scene_from_toml(kept.to_toml(), sea).waves.above_still_water == expected


def test_none_removes_and_a_scalar_creates_its_section():
    calm = load_scene("tethered_buoy", {"waves": None})
    assert calm.waves is None
    with_waves = scene_from_toml(calm.to_toml(), {"waves.period_s": 4.0, "waves.steepness": 0.1})
    waves = with_waves.waves
    assert waves.period_s == 4.0 and waves.steepness == 0.1 and waves.ramp_s == 0
    assert (calm.sample_step_s(), with_waves.sample_step_s()) == (0.05, 0.04)
    assert load_scene("tethered_buoy", {"solver": None}).solver.rtol == Scene.model_fields["solver"].default.rtol
    assert load_scene("tethered_buoy", {"current": None, "waves.ramp_s": None}).waves.ramp_s == 0


def test_a_keyword_is_the_end_of_a_key():
    scene = load_scene("tethered_buoy", {"tether.nodes": 21}, steepness=0.1, depth_m=22.0, waves=None)
    assert scene == load_scene("tethered_buoy", {"tether.nodes": 21, "water.depth_m": 22.0, "waves": None})


@pytest.mark.parametrize(
    ("keywords", "parts"),
    [
        ({"period_s": 4.0}, ["end.motion.period_s", "waves.period_s"]),
        ({"steepnes": 0.1}, ["did you mean 'waves.steepness'"]),
        ({"steepness": 0.1}, ["waves.steepness = 0.2", "one of the two"]),
        (
            {"step_s": 0.1, "nodes": -1, "colour": 1},
            ["3 faults", "solver.step_s, output.step_s", "tether.nodes", "colour"],
        ),
    ],
)
def test_a_keyword_that_is_no_one_key_is_refused_with_the_choices(keywords, parts):
    with pytest.raises(SceneError) as caught:
        load_scene("tethered_buoy", {"waves.steepness": 0.2}, **keywords)
    assert all(part in str(caught.value) for part in parts)


def test_the_diameter_follows_the_area_unless_it_is_given():
    for area in (7.85e-5, 1e-3):
        scene = load_scene("tethered_buoy", {"tether.area_m2": area})
        assert math.pi * scene.tether.diameter_m**2 / 4 == pytest.approx(area, rel=1e-14)
    stored = scene_from_toml(load_scene("tethered_buoy").to_toml(), {"tether.area_m2": 1e-3})
    assert math.pi * stored.tether.diameter_m**2 / 4 == pytest.approx(1e-3, rel=1e-14)
    assert load_scene("tethered_buoy", {"tether.diameter_m": 0.02}).tether.diameter_m == 0.02


def test_numpy_values_and_whole_numbers_are_numbers():
    changes = {"water.depth_m": np.float64(22.5), "tether.nodes": np.int64(81), "tether.length_m": 20}
    scene = load_scene("tethered_buoy", {**changes, "start.buoy_velocity_mps": np.array([0.5, 0.0, 0.0])})
    assert scene.start.buoy_velocity_mps == (0.5, 0.0, 0.0)
    for value in (scene.water.depth_m, scene.tether.length_m, scene.start.buoy_velocity_mps[0]):
        assert type(value) is float
    assert type(scene.tether.nodes) is int and scene.tether.nodes == 81


@pytest.mark.parametrize(("text", "key", "value"), [
    *TABLES["assignments"], ("waves=none", "waves", None), ("waves.steepness=.13", "waves.steepness", 0.13),
    ("water.depth_m=21.", "water.depth_m", 21.0), ("title=v.13", "title", "v.13"),
])  # fmt: skip
def test_an_assignment_is_a_key_and_a_toml_value(text, key, value):
    computed = parse_assignment(text)
    assert computed == (key, value) and type(computed[1]) is type(value)


@pytest.mark.parametrize(
    ("text", "words"),
    [(text, "KEY=VALUE") for text in ("water.depth_m", "=3", "")]
    + [("tether.tension={law=linear, stiffness_N=3}", "in single quotes")],  # whose quotes the shell took
)
def test_an_assignment_without_key_or_value_is_a_fault(text, words):
    with pytest.raises(SceneError, match=words):
        parse_assignment(text)


def test_a_name_that_does_not_exist_is_answered_with_those_that_do(tmp_path):
    for name, words in (
        ("tethered_bouy", "did you mean 'tethered_buoy'"),
        (tmp_path / "none.toml", "one of .*tethered_buoy"),
        ("", "one of .*tethered_buoy"),
        (tmp_path, "is a folder"),
    ):
        with pytest.raises(SceneError, match=words):
            load_scene(name)


@pytest.mark.parametrize(
    "content", [b"name = ", b"\xff\xfe\x00", b"[tether]\n[tether]\n", b"name = 'x'\x00", b"{}", b"a = 1979-05-27", b""]
)
def test_a_file_that_is_no_scene_is_a_scene_error(content, tmp_path):
    path = tmp_path / "scene.toml"
    path.write_bytes(content)
    with pytest.raises(SceneError) as caught:
        load_scene(path)
    if not content:
        assert {line.partition(":")[0] for line in caught.value.faults} == {"name", "tether", "buoy"}


@pytest.mark.parametrize(("mark", "end"), [(b"\xef\xbb\xbf", "\n"), (b"", "\r\n"), (b"\xef\xbb\xbf", "\r")])
def test_a_file_from_any_editor_is_the_same_scene(mark, end, tmp_path):
    """Editors put a mark before UTF-8 and end lines in three ways."""
    scene = load_scene("tethered_buoy")
    (tmp_path / "mine.toml").write_bytes(mark + scene.to_toml().replace("\n", end).encode())
    assert load_scene(tmp_path / "mine.toml") == scene
