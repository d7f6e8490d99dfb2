"""Mistakes of the first hour: each gets an answer that says what to do, exit code 2, no traceback, nothing written."""

import importlib
import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
SWEEP, BREAK, REPORTS = "campaigns.buoy_sweep", "campaigns.breaking_line", "reports.__main__"
FILES = {
    "comma.toml": 'name = "mine"\n[tether]\nlength_m = 20,5\n',
    "bracket.toml": "[tether\nlength_m = 20\n",
    "text.toml": 'name = "mine"\n[water]\ndepth_m = "21,6"\ndensity_kgpm3 = "1027 kg"\n',
    "utf16.toml": 'name = "mine"\n'.encode("utf-16"),
    "latin1.toml": '# Schäkel\nname = "mine"\n'.encode("latin-1"),
    "own/scene.toml": 'name = "mine"\n',
    "a_file": "mine",
    "old/provenance.json": json.dumps({"campaign": "breaking_line"}),
    "broken/provenance.json": "not json",
    "mine/table.csv": "my,own,table\n",
    "part/table.csv": "steepness\n0.1\n",
}

MISTAKES = [
    # a key, a name, an option that is almost right
    (SWEEP, "--set water.depth=21.6", "did you mean 'water.depth_m'?"),
    (SWEEP, "--set tether.node=81", "did you mean 'tether.nodes'?"),
    (SWEEP, "--set depth_m=21", "did you mean 'water.depth_m'?"),
    (SWEEP, "--set tether.stiffness_N=5e4", "did you mean 'tether.tension.stiffness_N'?"),
    (SWEEP, "--set Water.depth_m=21", "did you mean 'water.depth_m'?"),
    (SWEEP, "--set tether.tension.law=rubber", "one of 'linear', 'tabulated', 'tanh'"),
    (SWEEP, "--scene tethered_boy", "did you mean 'tethered_buoy'?"),
    (SWEEP, "--scene nowhere.toml", "there is no scene and no file 'nowhere.toml'"),
    (SWEEP, "--period 5", "did you mean --periods?"),
    ("campaigns.breaking_line", "--cases 5", "one of 1, 2, 3, 4, 1p, 2p, 3p, 4p"),
    # a wrong unit
    (SWEEP, "--set tether.length_m=20000", "at most 20 times water.depth_m"),
    (SWEEP, "--set tether.diameter_m=10", "about 0.01 m, the circle of tether.area_m2 (metres, not millimetres?)"),
    (SWEEP, "--set buoy.diameter_m=1500", "less than water.depth_m, 21 (metres, not millimetres?)"),
    (SWEEP, "--set buoy.mass_kg=1611000", "of water that it displaces, or it sinks"),
    (SWEEP, "--set tether.tension.stiffness_N=50", "newtons, not kN?"),
    (SWEEP, "--set waves.period_s=5000", "seconds, not milliseconds?"),
    (SWEEP, "--dimensions 3 --set waves.direction_rad=90", "radians, not degrees: 1.571?"),
    (SWEEP, "--steepness 13", "a share, not per cent?"),
    (SWEEP, "--steepness 0.1 --set tether.area_m2=314", "m2, not mm2?"),
    (SWEEP, "--steepness 0.1 --set tether.density_kgpm3=1.14", "10 to 30000 (kg/m3, not t/m3 or g/cm3?)"),
    (SWEEP, "--steepness 0.1 --set water.density_kgpm3=1.027", "100 to 20000 (kg/m3, not t/m3 or g/cm3?)"),
    (BREAK, "--cases 1 --set tether.area_m2=1963", "m2, not mm2?"),
    (BREAK, "--cases 1 --set tether.tension.p=[1,2,3,4,5]", "a law that reaches the 4.5e+04 N of end.force_N"),
    # more than any machine does
    (SWEEP, "--steepness 0.1 --periods 1000000000", "at most 1e+09, a longer step or a shorter run"),
    (SWEEP, "--steepness 0.1 --periods 9999999999999", "--periods: given '9999999999999'"),
    (SWEEP, "--steepness 0.1 --set output.step_s=1e-9", "a step of 7.5e-05 s or more, or a shorter run"),
    (SWEEP, "--steepness 0.1 --jobs 1000000000", "1 or above and at most 1024"),
    (SWEEP, "--steepness-range 0.1 0.2 1000000000", "2 or above and at most 10000"),
    ("campaigns.out_of_plane", "--periods 1000000000", "a longer step or a shorter run"),
    (BREAK, "--cases 1 --set output.step_s=1e-12", "a step of 1e-08 s or more, or a shorter run"),
    # what cannot be
    (SWEEP, "--steepness 0.6", "where a wave of 5 s breaks in this depth"),
    (SWEEP, "--set waves.period_s=-5", "a finite number above 0"),
    (SWEEP, "--set tether.nodes=0", "a whole number from 3 to 20000"),
    (SWEEP, "--set tether.nodes=40.5", "a whole number from 3 to 20000"),
    (SWEEP, "--set tether.nodes=many", "a whole number from 3 to 20000"),
    (SWEEP, "--set water.depth_m=21,6", "(with a dot: 21.6)"),
    (SWEEP, "--set water.depth_m='21.6'", "(without quotes: 21.6)"),
    (SWEEP, "--scene text.toml", "(no unit: 1027)"),
    (SWEEP, "--scene comma.toml", "at line 3, column 14): 'length_m = 20,5'; numbers have a dot, not a comma"),
    (SWEEP, "--scene bracket.toml", "at line 1"),
    (SWEEP, "--scene utf16.toml", "not text in UTF-8; allowed: a TOML file, saved as UTF-8"),
    (SWEEP, "--scene latin1.toml", "not text in UTF-8; allowed: a TOML file, saved as UTF-8"),
    (SWEEP, "--scene old", "'old' is a folder; allowed: a scene file"),
    (SWEEP, "--scene breaking_line", "without a buoy in waves; allowed: a scene with a buoy, water and waves"),
    (SWEEP, "--set waves=none", "without a buoy in waves; allowed: a scene with a buoy, water and waves"),
    (SWEEP, "--set tether.tension={law=linear,stiffness_N=5e4}", "in single quotes or the shell takes its double"),
    (SWEEP, "--steepness 0.1 --no-report=yes", "--no-report: given 'yes'; allowed: the option alone"),
    (SWEEP, "--set waterdepth_m", "KEY=VALUE, for instance water.depth_m=21.6"),
    (SWEEP, "--steepness 0,016", "a finite number, 0 or above"),
    (SWEEP, "--steepness-range 0.2 0.1 5", "0 <= LO < HI"),
    (SWEEP, "--jobs 0", "a whole number, 1 or above"),
    (SWEEP, "--periods 0", "a whole number, 1 or above"),
    (SWEEP, "--set waves.jonswap.significant_height_m=1.5", "engine.simulate runs irregular waves"),
    ("campaigns.out_of_plane", "--set waves.jonswap.significant_height_m=1.5", "one regular wave in this campaign"),
    # a place where nothing can be written, or something else is
    (SWEEP, "--out a_file", "a_file is a file; allowed: a folder"),
    (SWEEP, "--out a_file/below", "a_file is a file; allowed: a folder"),
    (SWEEP, "--out old", "which holds breaking_line"),
    (SWEEP, "--out mine", "a table.csv that no campaign wrote"),
    (SWEEP, "--out own", "a scene.toml that no campaign wrote"),
    (REPORTS, "nowhere", "there is no such folder; give the folder that a campaign wrote (its --out)"),
    (REPORTS, "a_file", "it is a file; give the folder that a campaign wrote (its --out)"),
    (REPORTS, ".", "provenance.json is missing"),
    (REPORTS, "part", "scene.toml is missing"),
    (SWEEP, "--out broken", "a provenance.json that no campaign wrote"),
    # options
    (SWEEP, "--steepness", "--steepness: given nothing; allowed: one value or more"),
    (SWEEP, "--steepness nan", "given 'nan'; allowed: a finite number, 0 or above"),
    (SWEEP, "--steepness 0.1 --steepness-range 0 1 3", "given both; allowed: one of them"),
    (SWEEP, "--steepness-range 0.1 0.2 3 4", "LO HI COUNT"),
    (SWEEP, "--periods 5 6", "--periods: given 5 6; allowed: one value"),
    (SWEEP, "--periods 10 --transient 10", "less than --periods"),
    (SWEEP, "--transient 2.5", "given '2.5'; allowed: a whole number, 0 or above"),
    (SWEEP, "--set", "--set: given nothing; allowed: KEY=VALUE"),
    (SWEEP, "--set waves.amplitude_m=1", "this campaign sets it; use --steepness"),
    (SWEEP, "--set end.kind=held end.position_m=[0,0,20] buoy=none", "end.kind"),
    (SWEEP, "--dimensions 4", "--dimensions: given '4'; allowed: one of 2, 3, auto"),
    (SWEEP, "--set motion.dimensions=3", "this campaign sets it; use --dimensions"),
    (SWEEP, "--backend dusk", "one of loky, threading, dask"),
    (SWEEP, "--backend threading --dask-address tcp://a:1", "with --backend dask only"),
    (SWEEP, "--backend dask --dask-address tcp://a", "given 'tcp://a'; allowed: the address of a scheduler"),
    (SWEEP, "--backend dask --dask-address a:99999", "tcp://HOST:PORT"),
    (SWEEP, "stray", "stray: no such option"),
    ("campaigns.__main__", "buoysweep", "no campaign 'buoysweep'; allowed: accuracy, breaking_line, buoy_sweep"),
]


@pytest.fixture
def place(tmp_path, monkeypatch):
    for name, text in FILES.items():
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_bytes(text if isinstance(text, bytes) else text.encode())
    monkeypatch.chdir(tmp_path)
    return tmp_path


def listing(place):
    return sorted((str(path), path.stat().st_mtime_ns) for path in place.rglob("*"))


@pytest.mark.parametrize(("module", "words", "part"), MISTAKES)
def test_the_answer_says_what_to_do(place, capsys, module, words, part):
    before = listing(place)
    main = importlib.import_module(module).main
    assert main(words.split()) == 2
    said = capsys.readouterr()
    assert said.out == "" and part in said.err
    assert listing(place) == before


def test_a_fault_of_every_value_of_a_sweep_is_told_once(place, capsys):
    assert importlib.import_module(SWEEP).main(["--set", "waves="]) == 2
    assert "2 faults" in capsys.readouterr().err  # of 49 scenes


def test_an_empty_name_is_not_the_current_folder(place, capsys):
    """As from --out "$RESULTS" with a variable that is not set."""
    assert importlib.import_module(SWEEP).main(["--out", "", "--steepness", "0.1"]) == 2
    assert "--out: given ''; allowed: a folder" in capsys.readouterr().err


def test_a_campaign_killed_before_its_provenance_goes_on_in_its_folder(tmp_path):
    from campaigns.machinery.cli import fault_of

    (tmp_path / "scene.toml").write_text("as run")
    assert "scene.toml" in fault_of(tmp_path, "buoy_sweep")
    (tmp_path / ".lock").touch()
    assert fault_of(tmp_path, "buoy_sweep") is None


def test_several_mistakes_are_told_at_once(place, capsys):
    words = """--steepness 0.1 -1 x --periods 0 --jobs none --backend dusk --dask-address tcp://a:1 --colour red
        --set buoy.mass_kg=-1 water.dept=3 nonsense waves.steepness=0.1 --out a_file"""
    assert importlib.import_module(SWEEP).main(words.split()) == 2
    said = capsys.readouterr().err
    for part in (
        "'-1'", "'x'", "--periods", "--jobs", "'dusk'", "--dask-address", "buoy.mass_kg", "'nonsense'",
        "did you mean 'water.depth_m'?", "use --steepness", "--colour: no such option", "a_file is a file",
    ):  # fmt: skip
        assert part in said


def test_a_folder_that_may_not_be_written_to(place, capsys, monkeypatch):
    """Asked of the system, which lets root write anywhere: so its answer is put in its mouth."""
    monkeypatch.setattr(os, "access", lambda path, mode: False)
    assert importlib.import_module(SWEEP).main(["--out", "new"]) == 2
    assert "cannot be written to; allowed: a folder that can" in capsys.readouterr().err


def test_a_folder_that_is_gone(tmp_path, monkeypatch, capsys):
    (tmp_path / "gone").mkdir()
    monkeypatch.chdir(tmp_path / "gone")
    (tmp_path / "gone").rmdir()
    assert importlib.import_module(SWEEP).main(["--steepness", "0.1"]) == 2
    assert "the folder that this is run in has been removed" in capsys.readouterr().err


def test_a_missing_package_is_named_with_the_command_that_installs_it(monkeypatch, capsys):
    def missing(*_):
        raise ModuleNotFoundError("No module named 'pydantic'", name="pydantic")

    monkeypatch.setattr("engine.load_scene", missing, raising=False)
    assert importlib.import_module(SWEEP).main([]) == 1
    said = capsys.readouterr().err
    assert "no package 'pydantic'" in said and "pip install -c constraints.txt -e ." in said


def test_ctrl_c_before_anything_runs(place, capsys, monkeypatch):
    def stopped(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr("engine.load_scene", stopped, raising=False)
    assert importlib.import_module(SWEEP).main([]) == 130
    assert "interrupted; nothing was run or written" in capsys.readouterr().err


@pytest.mark.parametrize("package", ["engine", "analysis", "campaigns"])
def test_an_old_python_is_named_with_what_is_needed(package):
    code = f"import sys; sys.version_info = (3, 9, 2, 'final', 0); import {package}"
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 1
    assert "needs Python 3.11 or newer, and this is 3.9.2" in done.stderr.splitlines()[-1]


def test_pip_refuses_an_old_python_and_the_readme_says_which_is_needed():
    import tomllib

    needed = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["requires-python"]
    assert needed == ">=3.11" and "Python 3.11 or newer" in (ROOT / "README.md").read_text()


def test_waves_up_to_the_limit_are_run():
    from campaigns.machinery.plausible import breaking_steepness, doubts
    from engine import load_scene

    scene = load_scene("tethered_buoy")
    limit = breaking_steepness(scene)
    assert limit == pytest.approx(0.446, abs=2e-3)  # deep water: 0.142 pi
    assert list(doubts(load_scene("tethered_buoy", {"waves.steepness": 0.999 * limit}))) == []
    assert len(list(doubts(load_scene("tethered_buoy", {"waves.steepness": 1.001 * limit})))) == 1
