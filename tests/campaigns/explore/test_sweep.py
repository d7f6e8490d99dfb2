"""Law: a sweep has one row a motion, the same whether it ran once or was run again, and says what it cannot have."""

import csv

import pytest

import engine
from campaigns import buoy_sweep
from campaigns.explore import ends, stages
from campaigns.explore.motions import Motions, Search
from campaigns.machinery.cli import Running
from campaigns.machinery.plan import Plan

SMALL = [
    "--set",
    "water.depth_m=25",
    "tether.nodes=9",
    "--starts",
    "2",
    "--budget",
    "200",
    "--no-report",
    "--no-accuracy",
]


def table(folder):
    with open(folder / "table.csv", encoding="utf-8") as file:
        return list(csv.DictReader(file))


@pytest.mark.slow
def test_two_motions_of_one_wave_are_two_rows_and_found_again_from_the_files(tmp_path, capsys):
    """At H = 25 m and kA = .13 and .133 there are a period 1 of 4.2 kN and a period 3 of 5.6 kN, on any grid."""
    words = ["--steepness", "0.13", "0.133", *SMALL, "--out", str(tmp_path)]
    assert buoy_sweep.main(words) == 0
    first = table(tmp_path)
    assert [(row["steepness"], row["motion"]) for row in first] == [(kA, at) for kA in ("0.13", "0.133") for at in "AB"]
    for row in first:
        calm = row["motion"] == "A"
        assert row["regime"] == ("period-1" if calm else "period-3")
        assert float(row["tension_top_max_N"]) == pytest.approx(4205 if calm else 5625, abs=25)
        assert float(row["share_low"]) <= float(row["share"]) <= float(row["share_high"])
    assert {row["found_by"] for row in first} == {"rest", "massless"}
    started = table(tmp_path / "starts")
    assert {row["motion"] for row in started} == {"A", "B"} and {row["status"] for row in started} == {"ok"}
    assert buoy_sweep.main(words) == 0
    assert "4: 0 computed, 4 found" in capsys.readouterr().out
    assert table(tmp_path) == first and table(tmp_path / "starts") == started


def test_kicks_are_as_many_as_fast_and_of_the_seed_as_asked_for(tmp_path, monkeypatch):
    words = ["--steepness", "0.1", "0.12", "--starts", "3", "--kick-speed", "2.5", "--seed", "7"]
    order = buoy_sweep.read_order([*words, "--out", str(tmp_path / "new")], faults := [])
    searches = []
    monkeypatch.setattr(stages, "explore", lambda motions, jobs, search: searches.append(search))
    monkeypatch.setattr(Motions, "write", lambda motions: None)
    monkeypatch.setattr(ends, "find_ends", lambda motions, scenes: None)
    plan = Plan(Running(tmp_path), engine.simulate, None, ())
    buoy_sweep.runs(order)(plan, order.cases)
    assert faults == [] and searches == [Search(order, 3, 2.5, 7)]


@pytest.mark.parametrize(
    "words, fault",
    [
        (["--starts", "3", "--dimensions", "3"], "--starts: given 3; allowed: rest, and a number for a buoy"),
        (["--starts", "-1"], "--starts: given '-1'; allowed: rest, or a whole number"),
        (["--starts", "3", "--start-from", "none.nc"], "--starts: given 3 with --start-from; allowed: one of them"),
        (["--start-from", "none.nc"], "--start-from: none.nc: cannot be read: No such file"),
    ],
)
def test_what_cannot_be_started_is_told(words, fault, tmp_path, capsys):
    assert buoy_sweep.main(["--steepness", "0.1", *words, "--out", str(tmp_path / "none")]) == 2
    assert fault in capsys.readouterr().err
    assert not (tmp_path / "none").exists()
