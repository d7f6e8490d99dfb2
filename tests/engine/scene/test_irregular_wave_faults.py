"""What makes no sea is refused with its key and what is allowed; a sea and a regular wave take each other's place."""

import pytest

from engine import SceneError, load_scene
from engine.scene import scene_from_toml

ONE = {"period_s": 5.0, "amplitude_m": 0.8}
SEA = {"significant_height_m": 1.0}


@pytest.mark.parametrize(
    ("changes", "parts"),
    [
        ({"waves.components": []}, ["waves.components: given []", "a list of 1 to 2000 tables"]),
        ({"waves.components": 3}, ["waves.components: given 3", "a list of 1 to 2000 tables"]),
        ({"waves.components": [{"period_s": 5.0}]}, ["waves.components[0].amplitude_m: missing"]),
        ({"waves.components": [ONE, {**ONE, "amplitude_m": -1.0}]}, ["waves.components[1].amplitude_m: given -1.0"]),
        ({"waves.components": [{**ONE, "period_s": 0.0}]}, ["waves.components[0].period_s", "above 0"]),
        ({"waves.components": [{**ONE, "hight_m": 1.0}]}, ["waves.components[0].hight_m: unknown key"]),
        ({"waves.components": [ONE] * 30}, ["amplitudes of 24 m in all", "less than water.depth_m, 21.0"]),
        ({"waves.components": [{**ONE, "direction_rad": 1.0}]}, ["direction_rad: given 1.0", "0 or pi in a plane"]),
        ({"waves.components": [ONE], "waves.phase_rad": 1.0}, ["each component has its own"]),
        ({"waves.components": [ONE], "motion.dimensions": 3, "waves.direction_rad": 1.0}, ["waves.direction_rad"]),
        ({"waves.jonswap": {**SEA, "seed": -1}}, ["waves.jonswap.seed", "0 to 1000000000"]),
        ({"waves.jonswap": {**SEA, "peak_enhancement": 0.5}}, ["a number from 1 to 10"]),
        ({"waves.jonswap": {**SEA, "components": 0}}, ["a whole number from 1 to 2000"]),
        ({"waves.jonswap": {**SEA, "gamma": 3.3}}, ["waves.jonswap.gamma: unknown key", "peak_enhancement"]),
        ({"waves.jonswap.seed": 3}, ["waves.jonswap.significant_height_m: missing"]),
        ({"waves.jonswap.significant_height_m": 30.0}, ["less than water.depth_m, 21.0"]),
        ({"waves.jonswap": SEA, "waves.phase_rad": 1.0}, ["draws those of its components"]),
        ({"waves.jonswap": SEA, "waves.steepness": 0.1}, ["exactly one of them"]),
        ({"waves.jonswap": SEA, "waves.components": [ONE]}, ["exactly one of them"]),
        ({"waves.steepness": None}, ["waves.steepness, waves.amplitude_m, waves.components, waves.jonswap"]),
    ],
)
def test_faults(changes, parts):
    with pytest.raises(SceneError) as refused:
        load_scene("tethered_buoy", changes)
    for part in parts:
        assert part in str(refused.value)


@pytest.mark.parametrize("changes", [{"waves.components": [ONE]}, {"waves.jonswap.significant_height_m": 1.0}])
def test_what_is_given_takes_the_place_of_what_was_inherited(changes):
    scene = load_scene("tethered_buoy", changes)
    assert scene.waves.irregular and scene.waves.steepness is None
    assert scene_from_toml(scene.to_toml()) == scene
    back = scene_from_toml(scene.to_toml(), {"waves.amplitude_m": 0.2})
    assert not back.waves.irregular and back.waves.amplitude_m == 0.2
    assert back.key() == load_scene("tethered_buoy", {"waves.amplitude_m": 0.2}).key()
