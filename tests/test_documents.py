"""What the documents name exists, every equation of the paper is told, no host or path of a machine is pinned; every
key of a scene is declared once, and the page, the report and the shipped scenes say the same of it."""

import json
import re
from importlib.util import find_spec
from pathlib import Path

import pytest

from benchmarks import write_tables
from engine import list_scenes, load_scene
from engine.scene.faults import known_fields
from engine.scene.models import Scene
from engine.scene.reference import keys, page, sources
from engine.trajectory import COLUMNS
from tests.pages import ROOT

PAGES = sorted(
    path.relative_to(ROOT).as_posix() for place in (".", "docs", "benchmarks") for path in (ROOT / place).glob("*.md")
)
PACKAGES = "machine_code engine analysis campaigns reports tables benchmarks tests docs/figures".split()
PLACES = "machine_code|engine|analysis|reports|campaigns|docs|tests|benchmarks|\\.ci"


def text(name):
    return (ROOT / name).read_text(encoding="utf-8")


@pytest.mark.parametrize("name", PAGES)
def test_every_file_that_a_page_names_exists(name):
    quoted = re.findall(rf"`((?:{PLACES})/[\w./*-]*)`", text(name))
    quoted += re.findall(r"\bdocs/[a-z_]+\.md\b", text(name))
    linked = [f"{Path(name).parent}/{path}" for path in re.findall(r"\]\((?!http)([\w./-]+)[#)]", text(name))]
    named = [path.replace("NAME", "*") for path in quoted + linked]
    assert [path for path in named if not list(ROOT.glob(path.removeprefix("./")))] == []


def headings(name):
    """Anchors of the headings of a page."""
    return {
        re.sub(r"[^\w -]", "", line).strip().lower().replace(" ", "-")
        for line in re.findall(r"^#+ (.*)", text(name), re.M)
    }


@pytest.mark.parametrize("name", PAGES)
def test_every_heading_that_a_page_links_to_exists(name):
    for path, anchor in re.findall(r"\]\((?!http)([\w./-]*)#([\w-]+)\)", text(name)):
        target = (ROOT / name).parent / path if path else ROOT / name
        assert anchor in headings(target.resolve().relative_to(ROOT)), f"{path}#{anchor}"


def test_every_page_that_the_code_names_exists():
    """Pages in docstrings, messages and data: `docs/trust.md`, `THEORY.md#17-misprints-of-the-paper`."""
    sources = [path for package in PACKAGES for end in ("*.py", "*.toml") for path in (ROOT / package).rglob(end)]
    missing = []
    for path in sources:
        source = path.read_text(encoding="utf-8")
        for page_name, anchor in re.findall(r"\b((?:docs/[a-z_]+|THEORY|NOTATION)\.md)(?:#([\w-]+))?", source):
            if not (ROOT / page_name).exists() or (anchor and anchor not in headings(page_name)):
                missing.append(f"{path.relative_to(ROOT)}: {page_name}#{anchor}")
    assert missing == []


@pytest.mark.parametrize("page_name", PAGES)
def test_every_name_that_a_page_places_in_a_file_is_there(page_name):
    placed = re.findall(r"`([\w.]+)`,? (?:\(|in |of )`([\w/]+\.py)`", " ".join(text(page_name).split()))
    missing = [name for name, path in placed if not re.search(rf"\b{name.split('.')[-1]}\b", text(path))]
    assert missing == []


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
    required = re.findall(r'"([a-z][\w-]+)>=[\d.]+[^"=]*"', text("pyproject.toml"))
    assert required and {name.replace("_", "-").lower() for name in required} - pinned <= {"setuptools"}
    assert "==" not in text("pyproject.toml")


def test_the_page_is_what_the_model_says():
    stale = "stale: python -m engine.scene.reference > docs/scene_keys.md"
    assert text("docs/scene_keys.md") == page(), stale


def test_every_key_is_declared():
    listed = list(keys())
    assert all(key in listed or any(longer.startswith(f"{key}.") for longer in listed) for key in known_fields(Scene))
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
    origins = sources("tethered_buoy")
    assert origins["buoy.mass_kg"] == "Table 1: M" and origins["tether.tension.stiffness_N"].startswith("section 4.2")


TABLES_ON_PAGES = [(name, table) for name in PAGES for table in write_tables.blocks(text(name))]


@pytest.mark.parametrize(("page_name", "block"), TABLES_ON_PAGES, ids=[block.name for _, block in TABLES_ON_PAGES])
def test_a_table_on_a_page_is_what_its_command_wrote(page_name, block):
    """The seal holds; a table that is older than this rule names its commit and its day instead."""
    table = write_tables.TABLES[block.name]
    assert block.command == table.command and find_spec(block.command.split()[2])
    if block.seal:
        assert write_tables.seal_of(block.content) == block.seal, f"{page_name}: {block.name} was changed by hand"
        assert block.content.startswith(write_tables.markdown(table.heads, []))
        assert f"Written by `{table.command}" in block.content
    else:
        assert re.search(r"Computed at commit [0-9a-f]{7} on \d{4}-\d\d-\d\d", block.content)


def test_every_table_has_its_place_on_one_page():
    assert sorted(block.name for _, block in TABLES_ON_PAGES) == sorted(write_tables.TABLES)


def test_a_finished_folder_writes_its_table(tmp_path):
    folder, page_path = tmp_path / "results", tmp_path / "trust.md"
    folder.mkdir()
    provenance = {
        "campaign": "stability",
        "command": ["python", "-m", "campaigns.stability", "--quick", "--out", "results"],
        "finished_utc": "2026-11-23T20:15:46Z",
        "git": {"commit": "68622b16e7b8"},
    }
    (folder / "provenance.json").write_text(json.dumps(provenance))
    heads = "part,about,verdict,how,measured,measured_tension,bar_tension\n"
    cases = "case,stiff,ok,refinement,0.002,0.01,0.03\ncase,stiff,ok,energy,9,0.5,0.03\ncase,stiff,refused,,,,\n"
    (folder / "table.csv").write_text(heads + cases + "fuzz,,ok,outcomes,0.0,,\n")
    page_path.write_text("before\n<!-- table stability: a -->\nold\n<!-- end of table -->\nafter\n")
    assert write_tables.write_folder(folder, tmp_path) == page_path
    written = page_path.read_text()
    assert "| stiff | 3 | 2 | 1 | 0 | 0 | 2.0e-03 | 1.0e-02 | 1 |" in written
    (block,) = write_tables.blocks(written)
    assert write_tables.seal_of(block.content) == block.seal != write_tables.seal_of(block.content.replace("3", "4"))
    assert "Written by `python -m campaigns.stability --quick` on 2026-11-23, commit 68622b1." in block.content
    assert written.startswith("before\n<!-- ") and written.endswith(" -->\nafter\n")
