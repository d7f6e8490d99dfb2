"""The oscillator campaign: the promises of every campaign, and its parts."""

import csv
import subprocess
import sys

import pytest

from campaigns import oscillator
from tests.campaigns.conftest import ROOT

QUICK = ["--effort", "0.005", "--no-report"]


@pytest.fixture(scope="module")
def out(tmp_path_factory):
    folder = tmp_path_factory.mktemp("study") / "out"
    assert oscillator.main([*QUICK, "--out", str(folder)]) == 0
    return folder


def rows(folder):
    with open(folder / "table.csv", newline="") as file:
        return {row["part"]: row for row in csv.DictReader(file)}


def test_every_part_is_a_row_with_its_file(out):
    table = rows(out)
    assert list(table) == [
        "section", "history", "exponents", "orbits", "basins", "grazing", "diagram-force", "diagram-frequency",
    ]  # fmt: skip
    assert all(
        row["status"] == "ok" and (out / "trajectories" / f"{row['run_key']}.nc").exists() for row in table.values()
    )
    assert abs(float(table["grazing"]["grazing_force"]) - 0.20464770309974) < 1e-10


def test_the_same_command_computes_nothing_and_changes_nothing(out, capsys):
    before = (out / "table.csv").read_bytes()
    assert oscillator.main([*QUICK, "--out", str(out)]) == 0
    assert "8: 0 computed, 8 found" in capsys.readouterr().out
    assert (out / "table.csv").read_bytes() == before


def test_a_damaged_part_is_computed_again_with_the_same_numbers(out, capsys):
    row = rows(out)["basins"]
    path = out / "trajectories" / f"{row['run_key']}.nc"
    content = path.read_bytes()
    path.write_bytes(content[: len(content) // 2])
    assert oscillator.main([*QUICK, "--out", str(out)]) == 0
    assert "8: 1 computed, 7 found" in capsys.readouterr().out
    again = rows(out)["basins"]
    assert {**again, "wall_s": ""} == {**row, "wall_s": ""}


def test_another_range_touches_only_its_diagram(out, capsys):
    assert oscillator.main([*QUICK, "--force-range", "0.2", "0.4", "4", "--out", str(out)]) == 0
    assert "8: 1 computed, 7 found" in capsys.readouterr().out


def test_every_fault_is_named_at_once_and_nothing_is_written(tmp_path, capsys):
    words = ["--set", "mass=3", "damping=-1", "--effort", "0", "--force-range", "2", "1", "5", "--bogus"]
    assert oscillator.main([*words, "--out", str(tmp_path / "new")]) == 2
    said = capsys.readouterr().err
    for word in ("mass=3", "damping", "--effort", "--force-range", "--bogus"):
        assert word in said
    assert not (tmp_path / "new").exists()


def test_help_loads_nothing_heavy():
    code = "import sys, campaigns.oscillator as o; o.parser().format_help(); print(*sys.modules)"
    loaded = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    assert not {"numpy", "numba", "pandas", "scipy", "matplotlib"} & set(loaded.split())
