"""docs/own_mooring.md: its commands run from top to bottom, and its table of heights is what they compute."""

import importlib
import re

import pandas
import pytest

from tests.pages import ROOT, assert_complete, blocks, commands

MODULES = {"engine": "engine.__main__"}
ROW = re.compile(r"^\| (\d) \| ([\d.]+) \| ([\d.]+) % \| ([\d.]+) \|$", re.MULTILINE)


@pytest.mark.slow
def test_the_page_runs_and_its_table_is_what_it_computes(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    for kind, text in blocks("own_mooring"):
        assert kind == "sh"
        for module, words in commands(text):
            assert importlib.import_module(MODULES.get(module, module)).main(words) == 0
    for name in ("heights", "sea"):
        assert_complete(tmp_path / name)
    printed = capsys.readouterr().out
    assert "period-1" in printed and "% of tether.breaking_load_N" in printed
    page = (ROOT / "docs" / "own_mooring.md").read_text(encoding="utf-8")
    stated = [[float(cell) for cell in row] for row in ROW.findall(page)]
    table = pandas.read_csv("heights/table.csv")
    assert len(stated) == len(table) == 5
    for (height_m, tension_kN, per_cent, slack), (_, row) in zip(stated, table.iterrows(), strict=True):
        assert height_m == 2 * row["waves.amplitude_m"] and row["regime"] == "period-1"
        assert tension_kN == pytest.approx(1e-3 * row["tension_top_max_N"], abs=0.1)
        assert per_cent == pytest.approx(100 * row["utilisation"], abs=0.1)
        assert slack == pytest.approx(row["slack_fraction"], abs=0.02)
