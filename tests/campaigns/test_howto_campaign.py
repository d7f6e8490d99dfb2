"""docs/howto_campaign.md: its campaign, its column and its sweep, as the page gives them, with a fake engine.

tests/test_pages.py runs the page from top to bottom with the engine.
"""

import re
import sys
import types

import pytest

from campaigns.buoy_sweep import rows
from campaigns.sweep import STUDY
from tests.campaigns.conftest import ROOT, rows_of
from tests.campaigns.fake_engine import FakeEngine
from tests.pages import blocks, commands

PAGE = "howto_campaign"


def dictionary_of(out) -> dict[str, dict[str, str]]:
    return {row["name"]: row for row in rows_of(out, "columns.csv")}


@pytest.fixture
def page():
    """The names of the campaign of the page."""
    names = {"__name__": PAGE}
    exec(compile(next(text for kind, text in blocks(PAGE) if kind == "python"), PAGE, "exec"), names)
    return names


def test_the_campaign_of_the_page_is_complete(tmp_path, page):
    words = ["--periods", "6", "--transient", "2", "--no-report", "--backend", "threading", "--out", str(tmp_path)]
    assert page["STUDY"].main(words, simulate=FakeEngine()) == 0
    table = rows_of(tmp_path)
    assert [float(row["buoy.mass_kg"]) for row in table] == list(page["MASSES_KG"])
    assert all(row["status"] == "ok" and row["radius_max_m"] and row["snaps"] == "0" for row in table)
    assert list(dictionary_of(tmp_path)) == list(table[0])


def test_the_campaign_of_the_page_refuses_every_fault_at_once(tmp_path, monkeypatch, capsys, page):
    monkeypatch.chdir(tmp_path)
    assert page["STUDY"].main("--set buoy.mass_kg=3 water.dept_m=21 --periods 0".split()) == 2
    said = capsys.readouterr().err
    assert all(part in said for part in ("it runs three masses", "did you mean 'water.depth_m'?", "--periods"))
    assert list(tmp_path.iterdir()) == []


def test_the_column_of_the_page_reaches_the_table_and_its_dictionary(sweep, monkeypatch):
    page = (ROOT / "docs" / f"{PAGE}.md").read_text()
    column, line = re.findall(r"^    ((?:Column|row\[).*)$", page, re.MULTILINE)[:2]
    source = (ROOT / "campaigns" / "buoy_sweep" / "rows.py").read_text()
    settled = re.search(r"\n( +)row \|= settled\(.*\n", source)
    patched = source.replace("    STROBED,\n", f"    {column}\n    STROBED,\n")
    patched = patched.replace(settled[0], f"{settled[0]}{settled[1]}{line}\n")
    module = types.ModuleType(rows.__name__)
    exec(compile(patched, "rows.py", "exec"), vars(module))
    monkeypatch.setitem(sys.modules, rows.__name__, module)
    _, (row,), _ = sweep("--steepness", "0.05")
    assert float(row["speed_max_mps"]) == pytest.approx(2 * 3.14159 / 5.0, rel=1e-3)  # of r = 20 + sin(2 pi t/5)
    told = dictionary_of(sweep.out)["speed_max_mps"]
    assert (told["unit"], told["digits"]) == ("m/s", "2")


def test_the_sweep_of_the_page_is_a_command_without_a_fault():
    ((module, words),) = commands(next(text for kind, text in blocks(PAGE) if kind == "sh"))
    order = STUDY.read_order(words, faults := [])
    assert module == "campaigns.sweep" and faults == []
    assert [case.labels["buoy.mass_kg"] for case in order.cases] == [800.0, 1200.0, 1600.0]
    assert [case.scene.buoy.mass_kg for case in order.cases] == [800.0, 1200.0, 1600.0]
