"""Every key of a scene is declared once, and the page, the report and the shipped scenes say the same of it."""

from pathlib import Path

import pytest

from engine import load_scene
from engine.scene import known_scenes
from engine.scene.faults import known_fields
from engine.scene.models import Scene
from engine.scene.reference import keys, page, sources

PAGE = Path(__file__).resolve().parents[1] / "docs" / "scene_keys.md"


def test_the_page_is_what_the_model_says():
    stale = "stale: python -m engine.scene.reference > docs/scene_keys.md"
    assert PAGE.read_text(encoding="utf-8") == page(), stale


def test_every_key_is_declared():
    listed = list(keys())
    assert all(key in listed or any(other.startswith(f"{key}.") for other in listed) for key in known_fields(Scene))
    assert all(key.meaning for key in keys().values())


@pytest.mark.parametrize("scene", known_scenes())
def test_sources_are_of_keys_that_the_scene_has(scene):
    values = load_scene(scene).as_dict()
    for name in sources(scene):
        at = values
        for part in name.split("."):
            assert part in at, name
            at = at[part]


def test_the_values_of_the_papers_table_have_their_source():
    found = sources("tethered_buoy")
    assert found["buoy.mass_kg"] == "Table 1: M" and found["tether.tension.stiffness_N"].startswith("section 4.2")
