"""Provenance says what made the results, and stays as it is while they do."""

import json
import platform
import socket
import subprocess

import numpy
import pytest

from campaigns.buoy_sweep.rows import COLUMNS
from campaigns.columns import names
from campaigns.machinery.session import begun, git_state
from engine import load_scene, source_hash
from tests.campaigns.conftest import ROOT

WITH_REPORT = ["--periods", "6", "--no-accuracy"]


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
    record, _ = begun(tmp_path, "any", [], {})
    assert record["git"]["commit"] == git_state(ROOT / "campaigns")["commit"] == head.stdout.strip()


def test_dirty_means_changes_that_are_not_committed_and_outside_a_checkout_there_is_no_commit(tmp_path):
    git = ["git", "-C", str(tmp_path), "-c", "user.name=a", "-c", "user.email=a@b.c", "-c", "core.hooksPath=/dev/null"]
    package = tmp_path / "campaigns"
    assert git_state(package) == {"commit": None, "dirty": None}
    package.mkdir()
    (package / "file").write_text("1")
    for words in (["init", "-q"], ["add", "-A"], ["commit", "-q", "-m", "one"]):
        subprocess.run([*git, *words], check=True)
    assert git_state(package)["dirty"] is False
    (package / "file").write_text("2")
    assert git_state(package)["dirty"] is True


def test_a_run_that_computes_nothing_changes_nothing_and_other_parameters_make_a_new_record(sweep):
    def files():
        return {path.name: path.read_bytes() for path in sweep.out.glob("[!.]*") if path.is_file()}

    sweep("--steepness", "0.02", "0.13")
    before = files()
    sweep("--steepness", "0.02", "0.13", backend="loky", jobs=1)
    assert files() == before
    sweep("--steepness", "0.02")
    assert record(sweep.out)["steepness"] == [0.02]
    assert record(sweep.out)["runs"]["found"] == 1


def test_the_scene_file_can_be_run_again(sweep):
    _, (row,), _ = sweep("--steepness", "0.05", "--set", "water.depth_m=22.5", "tether.nodes=21")
    scene = load_scene(sweep.out / "scene.toml")
    assert (scene.waves.steepness, scene.water.depth_m, scene.tether.nodes) == (0.05, 22.5, 21)
    code, (again,), computed = sweep("--scene", sweep.out / "scene.toml", "--steepness", "0.05")
    assert (code, again["run_key"], computed) == (0, row["run_key"], [])


def test_unknown_is_empty(sweep):
    _, rows, _ = sweep("--steepness", "0.02", "0.05", raises=(0.05,))
    assert list(rows[0]) == list(names(COLUMNS))
    for row in rows:
        assert row["regime"] == ""
        assert all(entry == "" for name, entry in row.items() if "lyapunov" in name or "offplane" in name)
    given = {name for name, entry in rows[1].items() if entry != ""}
    assert given == {"steepness", "dimensions", "status", "message", "run_key"}


@pytest.mark.parametrize("fault", [None, RuntimeError("no ink")])
def test_paths_of_the_report_are_told_and_one_that_fails_leaves_the_results(sweep, monkeypatch, capsys, fault):
    built = []

    def build(out):
        built.append(out)
        if fault:
            raise fault

    monkeypatch.setattr("reports.build", build, raising=False)
    code, rows, _ = sweep("--steepness", "0.02", usual=WITH_REPORT)
    said = capsys.readouterr()
    assert (code, len(rows), built) == (1 if fault else 0, 1, [sweep.out])
    assert all(word in said.out for word in ("table.csv", "compile", "analysis"))
    if fault:
        assert "no ink" in said.err and f"python -m reports {sweep.out}" in said.err
    else:
        assert "report.html" in said.out and "report.pdf" in said.out
