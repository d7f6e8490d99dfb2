"""A sweep in three dimensions, or where the planar run released loops: decided per row, and resumed."""

import json

import pytest

from campaigns import buoy_sweep
from campaigns.buoy_sweep.rows import buoy_row
from campaigns.buoy_sweep.space import SEED_MPS
from engine import load_scene
from tests.campaigns.conftest import finished, rows_of
from tests.campaigns.fake_engine import sines

VALUES = ("0.02", "0.05", "0.13")


def test_without_a_word_every_row_is_planar(sweep):
    _, rows, _ = sweep("--steepness", *VALUES, loops=(0.13,))
    assert [row["dimensions"] for row in rows] == ["2", "2", "2"]
    assert [row["loop_releases"] for row in rows] == ["0", "0", "3"]
    assert all(row["buoy_lateral_max_m"] == row["planar_loop_releases"] == "" for row in rows)


def test_auto_runs_in_space_what_released_loops_and_says_so(sweep):
    code, rows, begun = sweep("--steepness", *VALUES, "--dimensions", "auto", loops=(0.05, 0.13))
    assert code == 0 and begun == [0.02, 0.05, 0.05, 0.13, 0.13]
    assert [row["dimensions"] for row in rows] == ["2", "3", "3"]
    assert [row["planar_loop_releases"] for row in rows] == ["", "3", "3"]
    assert [row["loop_releases"] for row in rows] == ["0", "0", "0"]
    assert rows[1]["planar_radius_max_m"] == rows[1]["radius_max_m"] != ""
    assert rows[1]["buoy_lateral_max_m"] == "0.0" and rows[0]["buoy_lateral_max_m"] == ""


def test_auto_goes_on_from_a_planar_sweep_and_decides_again_from_the_files(sweep):
    sweep("--steepness", *VALUES, loops=(0.13,))
    _, rows, begun = sweep("--steepness", *VALUES, "--dimensions", "auto", loops=(0.13,))
    assert begun == [0.13] and [row["dimensions"] for row in rows] == ["2", "2", "3"]
    files = finished(sweep.out)
    assert len(files) == 4
    assert sweep("--steepness", *VALUES, "--dimensions", "auto", loops=(0.13,)) == (0, rows, [])
    assert finished(sweep.out) == files


def test_without_loops_auto_is_the_planar_sweep(sweep):
    _, planar, _ = sweep("--steepness", *VALUES)
    assert sweep("--steepness", *VALUES, "--dimensions", "auto") == (0, planar, [])


@pytest.mark.parametrize(
    ("words", "push", "added"),
    [([], SEED_MPS, SEED_MPS), (["--set", "start.buoy_velocity_mps=[0,1e-7,0]"], 1e-7, None)],
)
def test_three_pushes_a_scene_that_starts_in_its_plane_and_says_so(sweep, words, push, added):
    _, rows, begun = sweep("--steepness", *VALUES, "--dimensions", "3", *words, loops=(0.13,))
    assert begun == [0.02, 0.05, 0.13] and {row["dimensions"] for row in rows} == {"3"}
    said = json.loads((sweep.out / "provenance.json").read_text())
    assert (said["dimensions"], said["push_mps"]) == ("3", added)
    as_run = load_scene(sweep.out / "scene.toml")
    assert as_run.motion.dimensions == 3 and as_run.start.buoy_velocity_mps == (0.0, push, 0.0)


def test_a_failed_run_in_space_is_a_row_of_three_dimensions(sweep):
    _, rows, _ = sweep("--steepness", "0.05", "--dimensions", "3", raises=(0.05,))
    assert (rows[0]["status"], rows[0]["dimensions"]) == ("error", "3")


def test_a_row_in_space_is_judged_by_its_samples():
    scene = load_scene("tethered_buoy", {"motion.dimensions": 3, "start.buoy_velocity_mps": [0, 1e-5, 0]})
    row = buoy_row(sines(scene, 120), 20)
    assert row["regime"] == "period-1"
    assert row["lyapunov_tangent_bits_per_period"] is None and row["regime_tighter"] is None
    assert "regime" not in buoy_row(sines(scene, 59), 20), "too short for a verdict"


@pytest.mark.slow
def test_a_loop_leaves_the_plane_and_the_range_of_the_buoy_stays(tmp_path):
    """kA = 0.13: the planar run releases loops, the run in three dimensions none; the ranges of r agree to 1 %."""
    words = ["--steepness", "0.016", "0.13", "--periods", "80", "--transient", "20", "--dimensions", "auto"]
    assert buoy_sweep.main([*words, "--jobs", "1", "--backend", "threading", "--out", str(tmp_path)]) == 0
    calm, steep = rows_of(tmp_path)
    assert (calm["dimensions"], steep["dimensions"]) == ("2", "3")
    assert int(steep["planar_loop_releases"]) > 0 and int(steep["loop_releases"]) == 0
    assert 0.1 < float(steep["rope_lateral_max_m"]) < 1.0 and float(steep["buoy_lateral_max_m"]) < 0.02
    spatial, planar = ([float(steep[f"{kind}radius_{end}_m"]) for end in ("min", "max")] for kind in ("", "planar_"))
    assert planar == pytest.approx(spatial, abs=0.01 * (spatial[1] - spatial[0]))
    page = (tmp_path / "report.html").read_text()
    assert "Out of the plane" in page and "push_mps" in page
