"""docs/scene_keys.md is the model in words: every key once, with a meaning, and the page as the model makes it."""

from pathlib import Path

from engine.scene.faults import known_keys
from engine.scene.meanings import MEANINGS
from engine.scene.models import Scene
from engine.scene.reference import UNITS, leaves, page

PAGE = Path(__file__).resolve().parents[1] / "docs" / "scene_keys.md"


def test_the_page_is_what_the_model_says():
    stale = "stale: python -m engine.scene.reference > docs/scene_keys.md"
    assert PAGE.read_text(encoding="utf-8") == page(), stale


def test_every_key_has_a_meaning_and_no_other():
    listed = [key for key, _ in leaves(Scene)]
    assert sorted(listed) == sorted(MEANINGS) and len(set(listed)) == len(listed)
    assert all(key in listed or any(other.startswith(f"{key}.") for other in listed) for key in known_keys(Scene))


def test_a_unit_in_a_name_is_the_unit_on_the_page():
    text = page()
    for key in MEANINGS:
        suffix = key.rpartition("_")[2]
        if suffix in UNITS:
            assert (
                f"| `{key}` |" in text
                and f"| {UNITS[suffix]} |" in text.partition(f"| `{key}` |")[2].partition("\n")[0]
            )
