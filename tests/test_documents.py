"""What the documents point at exists, and the notation page knows every equation and every scene key it should."""

import re
from pathlib import Path

import pytest

from engine.scene.faults import known_keys
from engine.scene.models import Scene
from engine.trajectory import COLUMNS

ROOT = Path(__file__).resolve().parents[1]
DOCUMENTS = [
    "README.md",
    "NOTATION.md",
    "CHANGELOG.md",
    "CITATION.cff",
    *(f"docs/{p.name}" for p in sorted((ROOT / "docs").glob("*.md"))),
]
NOTATION = (ROOT / "NOTATION.md").read_text(encoding="utf-8")


@pytest.mark.parametrize("name", DOCUMENTS)
def test_every_file_that_a_document_names_exists(name):
    text = (ROOT / name).read_text(encoding="utf-8")
    paths = re.findall(
        r"`((?:machine_code|engine|analysis|reports|campaigns|docs|tests|benchmarks|\.ci)/[\w./*-]*)`", text
    )
    assert [path for path in paths if not list(ROOT.glob(path.replace("NAME", "*")))] == []


def test_the_design_tells_of_every_part():
    """Each module of engine, analysis and machine_code, each campaign and each report, by its name."""
    text = (ROOT / "docs" / "design.md").read_text(encoding="utf-8")
    modules = [path for package in ("engine", "analysis", "machine_code") for path in (ROOT / package).glob("[!_]*.py")]
    modules = [path.name for path in modules if not path.name.startswith("scene_")]  # told of together
    packages = [
        path.parent
        for place in ("engine", "analysis", "campaigns", "reports")
        for path in (ROOT / place).glob("*/__init__.py")
    ]
    assert [name for name in modules if name not in text] == []
    assert [path for path in packages if f"{path.name}/" not in text] == []


def test_every_scene_key_and_column_named_exists():
    named = set(re.findall(r"`((?:tether|buoy|water|waves|anchor|end|current|solver|output)\.\w+)`", NOTATION))
    assert named and named <= set(known_keys(Scene))
    assert set(COLUMNS) - {"x_m", "y_m", "z_m"} <= set(re.findall(r"`(\w+)`", NOTATION))


def test_the_shipped_scene_states_the_source_of_every_value():
    for path in (ROOT / "engine" / "scenes").glob("*.toml"):
        values = [line for line in path.read_text().splitlines() if re.match(r"^\w+ = ", line)]
        unsourced = [line for line in values if "#" not in line and not re.match(r"^(name|title|profiles) ", line)]
        assert values and not unsourced


def test_no_package_host_or_machine_path_is_pinned():
    text = "".join((ROOT / name).read_text() for name in ("constraints.txt", "pyproject.toml", "README.md", ".ci/run"))
    assert not re.search(r"https?://|file:|index-url|find-links|/home/|/opt/|/root/", text)
