"""Provenance says what made the results, and stays as it is while they do."""

import json
import platform
import socket
import subprocess

import numpy
import pytest

from campaigns import buoy_sweep
from campaigns.buoy_sweep.rows import COLUMNS
from campaigns.columns import names
from campaigns.machinery import session as provenance
from engine import load_scene, source_hash
from tests.campaigns.conftest import ROOT, USUAL, rows_of
from tests.campaigns.fake_engine import FakeEngine


def record(out):
    return json.loads((out / "provenance.json").read_text())


def test_what_is_recorded(sweep):
    sweep("--steepness", "0.02", "0.13", "--set", "water.depth_m=22.5", raises=(0.13,))
    found = record(sweep.out)
    assert found["campaign"] == "buoy_sweep"
    assert found["command"][:4] == ["python", "-m", "campaigns.buoy_sweep", "--steepness"]
    assert found["versions"]["python"] == platform.python_version()
    assert found["versions"]["numpy"] == numpy.__version__
    assert found["host"] == socket.gethostname()
    assert found["engine_source_hash"] == source_hash()
    assert (found["steepness"], found["periods"], found["transient"]) == ([0.02, 0.13], 6, 2)
    assert found["set"] == {"water.depth_m": 22.5}
    assert found["runs"] == {"total": 2, "found": 0, "computed": 2, "failed": 1}
    assert set(found["timing"]) >= {"compile_s", "run_s", "analysis_s"}
    assert all(seconds >= 0.0 for seconds in found["timing"].values())
    assert found["started_utc"] <= found["finished_utc"]


def test_git_state_is_that_of_the_checkout(tmp_path):
    head = subprocess.run(["git", "rev-parse", "HEAD"], cwd=ROOT, capture_output=True, text=True)
    if head.returncode != 0:
        pytest.skip("not a checkout")
    assert provenance.git_state(ROOT / "campaigns")["commit"] == head.stdout.strip()
    assert provenance.begun(tmp_path, "any", [], {})[0]["git"]["commit"] == head.stdout.strip(), (
        "so say the records of campaigns too"
    )


def test_outside_a_checkout_there_is_no_commit(tmp_path):
    assert provenance.git_state(tmp_path / "campaigns") == {"commit": None, "dirty": None}


def test_dirty_means_changes_that_are_not_committed(tmp_path):
    git = ["git", "-C", str(tmp_path), "-c", "user.name=a", "-c", "user.email=a@b.c", "-c", "core.hooksPath=/dev/null"]
    package = tmp_path / "campaigns"
    package.mkdir()
    (package / "file").write_text("1")
    subprocess.run([*git, "init", "-q"], check=True)
    subprocess.run([*git, "add", "-A"], check=True)
    subprocess.run([*git, "commit", "-q", "-m", "one"], check=True)
    assert provenance.git_state(package)["dirty"] is False
    (package / "file").write_text("2")
    assert provenance.git_state(package)["dirty"] is True


def test_run_that_computes_nothing_changes_nothing(sweep):
    sweep("--steepness", "0.02", "0.13")
    before = {path.name: path.read_bytes() for path in sweep.out.iterdir() if path.is_file() and path.name != ".lock"}
    sweep("--steepness", "0.02", "0.13", backend="loky", jobs=1)
    after = {path.name: path.read_bytes() for path in sweep.out.iterdir() if path.is_file() and path.name != ".lock"}
    assert after == before


def test_other_parameters_make_a_new_record(sweep):
    sweep("--steepness", "0.02", "0.13")
    sweep("--steepness", "0.02")
    assert record(sweep.out)["steepness"] == [0.02]
    assert record(sweep.out)["runs"]["found"] == 1


def test_scene_file_can_be_run_again(sweep, tmp_path):
    sweep("--steepness", "0.05", "--set", "water.depth_m=22.5", "tether.nodes=21")
    scene = load_scene(sweep.out / "scene.toml")
    assert (scene.waves.steepness, scene.water.depth_m, scene.tether.nodes) == (0.05, 22.5, 21)
    words = ["--scene", str(sweep.out / "scene.toml"), "--steepness", "0.05", *USUAL, "--out", str(tmp_path / "again")]
    assert buoy_sweep.main(words, simulate=FakeEngine()) == 0
    assert rows_of(tmp_path / "again")[0]["run_key"] == rows_of(sweep.out)[0]["run_key"]


def test_unknown_is_empty(sweep):
    _, rows, _ = sweep("--steepness", "0.02", "0.05", raises=(0.05,))
    assert list(rows[0]) == list(names(COLUMNS))
    for row in rows:
        assert row["regime"] == ""
        assert all(entry == "" for name, entry in row.items() if "lyapunov" in name or "offplane" in name)
    given = {name for name, entry in rows[1].items() if entry != ""}
    assert given == {"steepness", "dimensions", "status", "message", "run_key"}


def test_report_that_fails_leaves_the_results_and_says_so(tmp_path, monkeypatch, capsys):
    def broken(_):
        raise RuntimeError("no ink")

    monkeypatch.setattr("reports.build", broken, raising=False)
    words = ["--steepness", "0.02", "--periods", "6", "--backend", "threading", "--out", str(tmp_path)]
    assert buoy_sweep.main(words, simulate=FakeEngine()) == 1
    captured = capsys.readouterr()
    assert "no ink" in captured.err
    assert f"python -m reports {tmp_path}" in captured.err
    assert len(rows_of(tmp_path)) == 1


def test_paths_of_the_report_are_told(tmp_path, monkeypatch, capsys):
    built = []
    monkeypatch.setattr("reports.build", built.append, raising=False)
    words = ["--steepness", "0.02", "--periods", "6", "--backend", "threading", "--out", str(tmp_path)]
    assert buoy_sweep.main(words, simulate=FakeEngine()) == 0
    output = capsys.readouterr().out
    assert built == [tmp_path]
    for word in ("report.html", "report.pdf", "table.csv", "compile", "analysis"):
        assert word in output
