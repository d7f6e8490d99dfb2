"""The lower bounds of pyproject.toml are true: with these versions a scene runs, is drawn, and goes into xarray."""

import os
import subprocess
import sys
import tomllib
import venv
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
UNREACHED = ("NewConnectionError", "ConnectionError", "Temporary failure", "ReadTimeoutError", "Network is unreachable")
QUICKLY = "-q --disable-pip-version-check --no-compile --only-binary :all:"  # only what is imported is compiled
SWEEP = "--steepness 0.05 --periods 5 --transient 1 --no-accuracy --set tether.nodes=9 --jobs 1 --out"


@pytest.mark.slow
def test_a_campaign_runs_and_reports_with_the_lowest_versions_that_are_allowed(tmp_path):
    needed = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["dependencies"]
    venv.create(tmp_path / "venv")
    python, lowest = str(tmp_path / "venv/bin/python"), [bound.replace(">=", "==") for bound in needed]
    pip = [sys.executable, "-m", "pip", "--python", python, "install", *QUICKLY.split(), *lowest]
    installed = subprocess.run(pip, capture_output=True, text=True)
    if installed.returncode and any(word in installed.stderr for word in UNREACHED):
        pytest.skip("no network to install the lowest versions")
    assert installed.returncode == 0, installed.stderr[-2000:]
    words = [python, "-m", "campaigns.buoy_sweep", *SWEEP.split(), str(tmp_path / "out")]
    own = os.environ | {"PYTHONPATH": str(ROOT), "TETHER_CACHE_DIR": str(tmp_path / "cache")}
    done = subprocess.run(words, capture_output=True, text=True, env=own, cwd=tmp_path)
    assert done.returncode == 0, done.stderr[-2000:]
    labelled = "import sys; from engine import Trajectory; print(Trajectory.load(sys.argv[1]).to_xarray().sizes)"
    (run,) = (tmp_path / "out/trajectories").glob("*.nc")
    shown = subprocess.run([python, "-c", labelled, str(run)], capture_output=True, text=True, env=own, cwd=tmp_path)
    assert shown.returncode == 0 and "time" in shown.stdout, shown.stderr[-2000:]
    assert "1 computed" in done.stdout and (tmp_path / "out/report.pdf").read_bytes().startswith(b"%PDF")
