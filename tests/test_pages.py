"""Pages, examples and figures: every block is sound (fast), and what a page shows runs as it stands and prints that."""

import importlib
import re
import runpy
import tomllib
from xml.etree import ElementTree

import numpy as np
import pandas
import pytest
from matplotlib.figure import Figure

from engine import list_scenes, load_scene, simulate
from tests.pages import PAGES, ROOT, blocks, cells, commands, compare, file_of, without_numbers

EXAMPLES = sorted(path.stem for path in (ROOT / "docs" / "examples").glob("*.py"))


COMMANDS = {"analysis": "campaigns.time_series", "engine": "engine.__main__"}


def campaign(module):
    return importlib.import_module(COMMANDS.get(module, module))


def ran(name):
    return runpy.run_path(str(ROOT / "docs" / "examples" / f"{name}.py"), run_name="__main__")


@pytest.mark.parametrize("page", PAGES)
def test_every_block_is_sound(page, tmp_path, monkeypatch):
    """Python compiles, TOML parses, and commands are orders without a fault."""
    monkeypatch.chdir(tmp_path)
    for kind, text in blocks(page):
        if kind == "python":
            compile(text, page, "exec")
        elif kind == "toml":
            tomllib.loads(text)
            if name := file_of(text):
                (tmp_path / name).write_text(text)
        elif kind == "sh":
            for module, words in commands(text):
                faults = []
                campaign(module).read_order(words, faults)
                missing = [fault for fault in faults if "no such file" in fault]  # written by a block before it
                assert faults == missing and (module == "analysis" or not faults)
        else:
            assert kind in ("text", "output")


@pytest.mark.slow
@pytest.mark.parametrize("page", PAGES)
def test_the_page_runs_from_top_to_bottom(page, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    names, printed = {"__name__": "page"}, ""
    for kind, text in blocks(page):
        if kind == "text":
            compare(printed, text)
        elif kind == "toml" and (name := file_of(text)):
            (tmp_path / name).write_text(text)
        elif kind == "python":
            capsys.readouterr()
            exec(compile(text, page, "exec"), names)
            printed = capsys.readouterr().out
        elif kind == "sh":
            assert [campaign(module).main(words) for module, words in commands(text)] == [0] * text.count("\n")
    if page == "tutorial":
        rows = pandas.concat(map(pandas.read_csv, tmp_path.glob("results/*/table.csv")))
        assert sum(rows["found_by"] == "rest") == 9 < len(rows) and "undecided" not in set(rows["regime"])


@pytest.mark.slow
def test_the_notebook_shows_what_it_runs(capsys, monkeypatch):
    """Cell by cell, as Jupyter does; words only, because the numbers of a chaotic motion are another machine's own."""
    monkeypatch.setattr("matplotlib.pyplot.figure", lambda **look: Figure(**look))
    names = {"__name__": "notebook"}
    for source, shown in cells("first_run"):
        lines = source.rstrip(";").splitlines()
        exec("\n".join(lines[:-1]), names)
        value = eval(lines[-1], names)
        printed = capsys.readouterr().out
        assert without_numbers(printed or getattr(value, "_repr_html_", str)()) == without_numbers(shown)


@pytest.mark.parametrize("name", EXAMPLES)
def test_each_example_prints_what_its_page_shows(name, capsys):
    ran(name)
    page = (ROOT / "docs" / "scenes.md").read_text(encoding="utf-8")
    shown = re.search(rf"`docs/examples/{name}\.py`.*?```output\n(.*?)\n```\n", page, re.DOTALL)
    assert shown, f"docs/scenes.md does not show what {name}.py prints"
    compare(capsys.readouterr().out, shown[1])


NEEDS_VISCOSITY = "breaking_line"  # and machine code of its own
SCENES = [pytest.param(name, marks=[pytest.mark.slow] * (name == NEEDS_VISCOSITY)) for name in list_scenes()]


@pytest.mark.parametrize("name", SCENES)
def test_every_shipped_scene_runs_as_it_is(name):
    scene = load_scene(name)
    run = simulate(scene, duration_s=20 * scene.sample_step_s())
    table = run.table()
    assert (run.status, run.message) == ("ok", "") and run.statistics["steps"] > 0
    assert len(table) == 21 and np.isfinite(table.to_numpy()).all()
    assert (run.profiles is not None) == scene.output.profiles


def test_the_script_draws_every_figure_of_the_theory(tmp_path):
    drawn = runpy.run_path(str(ROOT / "docs" / "figures" / "theory.py"))["main"](tmp_path)
    shown = re.findall(r"\(docs/figures/(\w+\.svg)\)", (ROOT / "THEORY.md").read_text(encoding="utf-8"))
    assert sorted(path.name for path in drawn) == sorted(shown)
    assert all(ElementTree.parse(path).getroot().tag.endswith("svg") for path in drawn)
