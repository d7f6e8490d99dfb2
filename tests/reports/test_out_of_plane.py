"""The out-of-plane report: verdicts of its folder, pages that need nothing else, gaps that are said."""

import json
import shutil

import numpy as np
import pytest

from campaigns import out_of_plane
from campaigns.machinery.folder import trajectory_path
from engine import Trajectory
from reports import build
from reports.out_of_plane.report import report
from reports.out_of_plane.runs import read_study
from reports.parts.content import Figure, Notice
from reports.parts.folder import FolderError, read_rows
from reports.parts.judged import read_statements
from tests.campaigns.fake_engine import SpaceEngine

WORDS = ["--periods", "80", "--transient", "20", "--backend", "threading", "--jobs", "2"]


def made(place, **engine):
    assert out_of_plane.main([*WORDS, "--no-report", "--out", str(place)], simulate=SpaceEngine(**engine)) == 0
    return place


@pytest.fixture(scope="module")
def bursts(tmp_path_factory):
    return made(tmp_path_factory.mktemp("bursts") / "out")


def verdicts(place) -> list[str]:
    """Does the small wave not grow, and the large one grow, to the size of the motion?"""
    return [row["verdict"] for row in read_statements(place)][:3]


def warned(items) -> list[str]:
    return [line for item in items if isinstance(item, Notice) for line in item.lines]


@pytest.mark.parametrize(
    ("large", "grows"),
    [
        ("bursts", "does not hold"),
        pytest.param("growth", "holds", marks=pytest.mark.slow),
        pytest.param("decay", "does not hold", marks=pytest.mark.slow),
    ],
)
def test_the_paper_is_borne_out_where_its_large_wave_grows_to_the_size_of_the_motion(bursts, tmp_path, large, grows):
    place = bursts if large == "bursts" else made(tmp_path / "out", large=large)
    assert verdicts(place) == ["holds", grows, grows]
    pairs = read_rows(place / "pairs.csv")
    assert [row["depth_m"] for row in pairs] == ["21.0", "21.6", "22.0"]
    assert all(row[name] == "1" for row in pairs for name in row if name.startswith("same_"))


@pytest.mark.slow
def test_same_folder_same_bytes(bursts):
    first = [path.read_bytes() for path in build(bursts)]
    assert [path.read_bytes() for path in build(bursts)] == first
    assert first[0].count(b"<figure") == first[0].count(b"<figcaption") >= 5


@pytest.mark.slow
def test_what_failed_or_is_lost_is_named_and_the_rest_is_shown(tmp_path):
    place = made(tmp_path / "out", raises=(0.016,), failing=(25.0,))
    items = report(place).items
    assert any("statics-failed" in line for line in warned(items))
    assert any("a fault of the code" in line for line in warned(items))
    assert verdicts(place)[0] == "–", "nothing is said of the small wave"
    for path in (place / "trajectories").glob("*.nc"):
        path.unlink()
    again = report(place).items
    assert sum(isinstance(item, Figure) for item in again) < sum(isinstance(item, Figure) for item in items)
    assert sum("missing" in line for line in warned(again)) > 10


@pytest.mark.slow
def test_a_base_that_failed_leaves_a_report(tmp_path):
    items = report(made(tmp_path / "out", failing=(21.0, 21.6, 22.0))).items
    assert any("statics-failed" in line for line in warned(items))


def test_a_folder_without_a_base_is_refused(bursts, tmp_path):
    copy = shutil.copytree(bursts, tmp_path / "copy", ignore=shutil.ignore_patterns("*.nc"))
    (copy / "provenance.json").write_text(json.dumps({"campaign": "out_of_plane"}))
    with pytest.raises(FolderError, match="base"):
        build(copy)


@pytest.mark.slow
def test_the_campaign_on_the_engine_itself(tmp_path):
    """Forty periods of every run: no loop is released in three dimensions, and a mirrored push mirrors the motion."""
    out = tmp_path / "out"
    assert out_of_plane.main(["--periods", "40", "--transient", "8", "--out", str(out)]) == 0
    study = read_study(out)
    assert all(run.ok for run in study.runs) and not any(run["loop_releases"] for run in study.runs if run.pushed)
    assert study.select(seed_direction="along")[0]["rope_lateral_max_m"] == 0.0
    for steepness in study.steepnesses:
        runs = [study.select(steepness=steepness, seed_direction=word)[0] for word in ("lateral", "mirrored")]
        y, mirrored = (Trajectory.load(trajectory_path(out, run["run_key"])).columns["y_m"] for run in runs)
        assert np.array_equal(y, -mirrored)
