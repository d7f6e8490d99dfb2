"""--help tells every option and loads nothing heavy, the defaults are what it promises, and the list of campaigns."""

import subprocess
import sys

import pytest

from campaigns.__main__ import main as every_campaign
from campaigns.buoy_sweep import STEEPNESS, STUDY
from tests.campaigns.conftest import ROOT

OPTIONS = "--steepness --steepness-range --periods --transient --scene --set --jobs --backend --out --no-report"


def test_help_tells_every_option():
    words = [sys.executable, "-m", "campaigns.buoy_sweep", "--help"]
    done = subprocess.run(words, cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0
    for option in OPTIONS.split():
        assert option in done.stdout
    assert "loky|threading|dask" in done.stdout
    assert "[--" in done.stdout
    assert "[N ...]" not in done.stdout


@pytest.mark.parametrize("name", ["buoy_sweep", "out_of_plane", "sweep"])
def test_help_loads_nothing_heavy(name):
    code = f"import sys, campaigns.{name} as b; b.parser().format_help(); print(*sys.modules)"
    loaded = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    assert not {"numpy", "numba", "pandas", "pydantic", "joblib", "matplotlib", "dask"} & set(loaded.split())


def test_default_sweep_meets_the_papers_two_values():
    assert {0.016, 0.13} <= set(STEEPNESS)
    assert sorted(set(STEEPNESS)) == list(STEEPNESS)


def test_no_argument_is_a_complete_order():
    faults = []
    order = STUDY.read_order([], faults)
    assert faults == []
    assert [case.labels["steepness"] for case in order.cases] == list(STEEPNESS)
    assert all(case.scene.waves.steepness == case.labels["steepness"] for case in order.cases)
    assert order.transient < order.periods
    assert order.how.out.as_posix() == "results/buoy_sweep"


@pytest.mark.parametrize("words", [[], ["--help"]])
def test_the_list_of_campaigns_is_no_mistake(capsys, words):
    assert every_campaign(words) == 0
    said = capsys.readouterr().out
    assert "buoy_sweep     Sweep of wave steepness" in said and "sweep          Sweep of any number" in said


def test_a_campaign_is_run_by_its_name_too(capsys):
    with pytest.raises(SystemExit) as ended:
        every_campaign(["sweep", "--help"])
    assert ended.value.code == 0 and "--vary" in capsys.readouterr().out
