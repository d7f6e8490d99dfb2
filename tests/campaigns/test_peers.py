"""Other codes: scipy on the engine's own equations agrees with the engine, and what is not installed is said."""

import math
from dataclasses import replace

import numpy as np
import pytest

from campaigns.accuracy import jobs
from campaigns.accuracy.peers import scipy as peer_scipy
from campaigns.accuracy.peers.record import as_trajectory
from campaigns.accuracy.plan import BY_NAME, FULL, PEERS
from campaigns.accuracy.rows import _judged, rms_mm, samples_of
from engine import load_scene, simulate


@pytest.mark.slow
def test_the_resolvent_gives_the_equations_of_the_engine():
    """Two integrators, one grid, tight tolerances: the motions differ by their errors in time alone."""
    work, nodes, duration_s = BY_NAME["regular"], 6, 5.0
    scene = work.made({"tether.nodes": nodes, "solver.rtol": 1e-6})
    ours = simulate(scene, duration_s=duration_s)
    theirs = peer_scipy.simulate(scene, duration_s, nodes, 1e-5, "Radau")
    assert theirs.status == "ok" and theirs.statistics["newton_failures"] == 0
    theirs_m, expected = samples_of(work, theirs), samples_of(work, ours)
    assert np.ptp(expected, axis=0).max() > 0.05
    assert rms_mm(theirs_m, expected) < 0.005


@pytest.mark.slow
def test_a_breaking_line_comes_back_with_its_strain():
    scene = jobs.scene_of(PEERS[0], "break-1-slow", 21)
    run = peer_scipy.simulate(scene, 0.02, 21, 1e-3, "Radau")
    assert run.status == "ok" and run.profiles.strain.shape == (5, 21)
    assert run.profiles.strain[0] == pytest.approx(run.profiles.strain[0, 0], rel=1e-9)
    assert run.profiles.strain[-1, -1] < 0.9 * run.profiles.strain[0, -1]


def test_a_code_that_is_not_installed_is_a_row(tmp_path, monkeypatch):
    monkeypatch.setattr(jobs.importlib.util, "find_spec", lambda name: None if name != "scipy" else object())
    effort = replace(FULL, works=("snap", "pendulum"))
    *untimed, timed = jobs.phases(tmp_path, effort, False, True)
    assert not any(job.labels["kind"].startswith("peer") for phase in untimed for job in phase)
    missing = [job for job in timed if job.labels.get("peer_version") == ""]
    assert {job.labels["method"] for job in missing} == {"MoorDyn", "CableDyn"}
    for job in missing:
        row = job.describe(job.simulate(job.scene, duration_s=1.0))
        assert row["status"] == "not-installed" and "pip install" in row["message"] and "error" not in row


def test_every_version_and_setting_of_another_code_is_a_run_of_its_own(monkeypatch):
    keys = set()
    for version in ("1.0", "1.1"):
        monkeypatch.setattr(jobs, "version", lambda peer, version=version: version)
        for setting in ((10, 200.0), (10, 400.0), (20, 200.0)):
            keys |= {jobs.peer_job(PEERS[-1], "regular", kind, setting, {}).key for kind in (jobs.TIMED, jobs.CHECK)}
    assert len(keys) == 12


def test_what_another_code_raises_is_its_record(monkeypatch):
    monkeypatch.setattr(jobs, "version", lambda peer: "1.0")
    run = jobs.other_code(load_scene("tethered_buoy"), duration_s=1.0, peer=PEERS[-1], settings=(0, 0.0))
    assert run.status == "solver-failed" and "Error" in run.message


def test_a_foreign_record_invents_nothing():
    places = np.array([[3.0, 0.0, 4.0], [0.0, 0.0, 5.0]])
    run = as_trajectory(load_scene("tethered_buoy"), "ok", "", np.array([0.0, 0.05]), places, {"wall_s": 1.0})
    assert run.columns["radius_m"] == pytest.approx([5.0, 5.0])
    assert np.isnan(run.columns["tension_top_N"]).all()


@pytest.mark.parametrize(
    ("slopes", "within"),
    [((2.1, 1.9, 2.0), 1), ((3.5, 0.2, 2.0), 0), ((2.0, 2.0, 1.7), 0), ((2.0, 2.0, math.inf), 1), ((), "")],
)
def test_an_order_is_that_of_theory_where_no_slope_of_its_series_jumps_about(slopes, within):
    errors_mm = [1.0, *np.cumprod(0.5 ** np.array(slopes))]
    row = {"work": "regular", "method": "trbdf2", "setting": 0.01, "nodes": 41, "status": "ok"}
    judged = _judged("time", 2, [row] * len(errors_mm), errors_mm)
    assert judged["within"] == within
    assert judged["order"] == (pytest.approx([slope for slope in slopes if slope < math.inf][-1]) if slopes else "")
