"""The out-of-plane report: its verdicts follow the table, its pages need nothing else, and gaps are said."""

import json
import math
import re
import shutil
from dataclasses import replace

import pytest

from campaigns import out_of_plane
from reports import build
from reports.out_of_plane.answer import calm_runs, large_runs, verdict
from reports.out_of_plane.comparison import read_pairs
from reports.out_of_plane.report import report
from reports.out_of_plane.runs import read_study
from reports.parts.content import Figure, Notice, Text
from reports.parts.folder import FolderError, read_folder
from tests.campaigns.fake_space import SpaceEngine

WORDS = ["--periods", "80", "--transient", "20", "--backend", "threading", "--jobs", "2"]


def made(place, **engine):
    assert out_of_plane.main([*WORDS, "--no-report", "--out", str(place)], simulate=SpaceEngine(**engine)) == 0
    return place


@pytest.fixture(scope="module")
def bursts(tmp_path_factory):
    return made(tmp_path_factory.mktemp("bursts") / "out")


def verdicts(study) -> list[bool]:
    """Whether the paper's two statements are borne out."""
    return [not word for word in re.findall("is (not )?borne out", verdict(study))]


@pytest.mark.parametrize(
    ("large", "borne_out", "growing"),
    [
        ("bursts", [True, False], False),
        pytest.param("growth", [True, True], True, marks=pytest.mark.slow),
        pytest.param("decay", [True, False], False, marks=pytest.mark.slow),
    ],
)
def test_the_paper_is_borne_out_where_its_large_wave_grows_to_the_size_of_the_motion(
    bursts, tmp_path, large, borne_out, growing
):
    study = read_study(read_folder(bursts if large == "bursts" else made(tmp_path / "out", large=large)))
    assert verdicts(study) == borne_out
    assert all(run.grows() is growing for run in large_runs(study)) and not any(run.grows() for run in calm_runs(study))


def test_what_records_are_too_short_for_is_not_said(bursts):
    """Without a distance of the sections nothing is concluded from them, nor said to agree."""
    pairs = read_pairs(read_study(read_folder(bursts)))
    assert pairs and not any(pair.untold or pair.lacking for pair in pairs)
    short = [replace(pair, across=math.nan) for pair in pairs]
    assert {name for pair in short for name in pair.untold} == {"section"} and not any(pair.lacking for pair in short)


@pytest.mark.slow
def test_same_folder_same_bytes(bursts):
    first = [path.read_bytes() for path in build(bursts)]
    assert [path.read_bytes() for path in build(bursts)] == first
    page = re.sub(r"base64,[A-Za-z0-9+/=]+", "", first[0].decode())
    assert "http" not in page and "<script" not in page
    assert page.count("<figure") == page.count("<figcaption") == page.count("alt=") >= 5


@pytest.mark.slow
def test_what_failed_or_is_lost_is_named_and_the_rest_is_shown(tmp_path):
    place = made(tmp_path / "out", raises=(0.016,), failing=(25.0,))
    items = report(place).items
    lines = [line for item in items if isinstance(item, Notice) for line in item.lines]
    assert any("statics-failed" in line for line in lines) and any("a fault of the code" in line for line in lines)
    assert verdicts(read_study(read_folder(place))) == [False], "nothing is said of the small wave"
    for path in (place / "trajectories").glob("*.nc"):
        path.unlink()
    again = report(place).items
    assert sum(isinstance(item, Figure) for item in again) < sum(isinstance(item, Figure) for item in items)
    assert sum("missing" in line for item in again if isinstance(item, Notice) for line in item.lines) > 10


@pytest.mark.slow
def test_a_base_that_failed_leaves_a_report(tmp_path):
    items = report(made(tmp_path / "out", failing=(21.0, 21.6, 22.0))).items
    assert any("statics-failed" in line for item in items if isinstance(item, Notice) for line in item.lines)


def test_a_folder_without_a_base_is_refused(bursts, tmp_path):
    copy = tmp_path / "copy"
    shutil.copytree(bursts, copy, ignore=shutil.ignore_patterns("*.nc"))
    (copy / "provenance.json").write_text(json.dumps({"campaign": "out_of_plane"}))
    with pytest.raises(FolderError, match="base"):
        build(copy)


@pytest.mark.slow
def test_the_campaign_on_the_engine_itself(tmp_path):
    """Forty periods of every run: no loop is released in three dimensions, and a mirrored push mirrors the motion."""
    out = tmp_path / "out"
    assert out_of_plane.main(["--periods", "40", "--transient", "8", "--out", str(out)]) == 0
    items = report(out).items
    said = " ".join(item.text for item in items if isinstance(item, Text))
    assert said.count("the mirrored push gives the mirrored motion to the last digit") == 2
    study = read_study(read_folder(out))
    assert all(run.ok for run in study.runs) and not any(run["loop_releases"] for run in study.runs if run.pushed)
    assert study.one(seed_direction="along")["rope_lateral_max_m"] == 0.0
