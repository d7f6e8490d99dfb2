"""What the documents name exists, every equation of the paper is told, no host or path of a machine is pinned; every
key of a scene is declared once, and the page, the report and the shipped scenes say the same of it."""

import re
from pathlib import Path

import pytest

from engine import list_scenes, load_scene
from engine.scene.faults import known_fields
from engine.scene.models import Scene
from engine.scene.reference import keys, page, sources
from engine.trajectory import COLUMNS

ROOT = Path(__file__).resolve().parents[1]
PAGES = sorted(
    path.relative_to(ROOT).as_posix() for place in (".", "docs", "benchmarks") for path in (ROOT / place).glob("*.md")
)
PLACES = "machine_code|engine|analysis|reports|campaigns|docs|tests|benchmarks|\\.ci"


def text(name):
    return (ROOT / name).read_text(encoding="utf-8")


@pytest.mark.parametrize("name", PAGES)
def test_every_file_that_a_page_names_exists(name):
    quoted = re.findall(rf"`((?:{PLACES})/[\w./*-]*)`", text(name))
    linked = [f"{Path(name).parent}/{path}" for path in re.findall(r"\]\((?!http)([\w./-]+)\)", text(name))]
    named = [path.replace("NAME", "*") for path in quoted + linked]
    assert [path for path in named if not list(ROOT.glob(path.removeprefix("./")))] == []


@pytest.mark.parametrize("number", range(1, 41))
def test_the_theory_states_every_equation_of_the_paper(number):
    assert re.search(rf"\\tag\{{{number}\}}|eqs?\. [^.]*\({number}\)", text("THEORY.md"))


def test_the_notation_page_has_every_column_of_a_trajectory():
    assert set(COLUMNS) <= set(re.findall(r"`(\w+)`", text("NOTATION.md")))


def test_no_package_host_or_machine_path_is_pinned():
    joined = "".join(map(text, ("constraints.txt", "pyproject.toml", "README.md", "CONTRIBUTING.md", ".ci/run")))
    assert not re.search(r"https?://|file:|index-url|find-links|/home/|/opt/|/root/", joined)


def test_every_tool_has_one_version():
    """pyproject.toml has lower bounds only; what it names is pinned in constraints.txt."""
    pinned = {
        re.sub(r"[-_.]+", "-", name).lower() for name in re.findall(r"^([\w.-]+)==", text("constraints.txt"), re.M)
    }
    asked = re.findall(r'"([a-z][\w-]+)>=[\d.]+[^"=]*"', text("pyproject.toml"))
    assert asked and {name.replace("_", "-").lower() for name in asked} - pinned <= {"setuptools"}
    assert "==" not in text("pyproject.toml")


def test_the_page_is_what_the_model_says():
    stale = "stale: python -m engine.scene.reference > docs/scene_keys.md"
    assert text("docs/scene_keys.md") == page(), stale


def test_every_key_is_declared():
    listed = list(keys())
    assert all(key in listed or any(other.startswith(f"{key}.") for other in listed) for key in known_fields(Scene))
    assert all(key.meaning for key in keys().values())


@pytest.mark.parametrize("scene", list_scenes())
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
