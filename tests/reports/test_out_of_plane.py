"""The out-of-plane report: its statements follow the table, its pages need nothing else, and gaps are said."""

import math
import re
import shutil
from dataclasses import replace

import pytest

from campaigns import out_of_plane
from reports import build
from reports.out_of_plane import runs
from reports.out_of_plane.comparison import comparison_words, read_pairs
from reports.parts.folder import FolderError, read_folder
from tests.campaigns.fake_space import SpaceEngine

WORDS = ["--periods", "80", "--transient", "20", "--backend", "threading", "--jobs", "2"]


def made(place, **engine):
    assert out_of_plane.main([*WORDS, "--no-report", "--out", str(place)], simulate=SpaceEngine(**engine)) == 0
    return place


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    return made(tmp_path_factory.mktemp("bursts") / "out")


def text_of(place):
    html, _ = build(place)
    page = html.read_text(encoding="utf-8")
    return " ".join(re.sub(r"<[^>]+>", " ", re.sub(r"base64,[A-Za-z0-9+/=]+", "", page)).split())


def test_bursts_of_the_rope_over_a_quiet_buoy_do_not_bear_the_paper_out(study):
    text = text_of(study)
    assert "“does not grow” is borne out at kA = 0.016" in text
    assert "“grows exponentially” is not borne out at kA = 0.13" in text
    assert "is not borne out for the buoy" in text and "is not borne out for the rope" in text
    assert "the planar run is good enough" in text
    assert "fig. 20" in text


def test_what_records_are_too_short_for_is_not_said(study):
    """Without a distance of the sections nothing is concluded from them, nor said to agree."""
    pairs = read_pairs(runs.read_study(read_folder(study, runs.COLUMNS, runs.WORDS)))
    assert pairs and not any(pair.untold for pair in pairs) and "good enough there" in comparison_words(pairs)
    short = [replace(pair, across=math.nan) for pair in pairs]
    assert {name for pair in short for name in pair.untold} == {"section"}
    said = comparison_words(short)
    assert "too short to compare section" in said and "good enough for the buoy is not told" in said


@pytest.mark.slow
def test_growth_to_the_size_of_the_motion_in_the_plane_does(tmp_path):
    text = text_of(made(tmp_path / "out", large="growth"))
    assert "“grows exponentially” is borne out" in text
    assert ") is borne out for the buoy" in text and ") is borne out for the rope" in text


@pytest.mark.slow
def test_decay_everywhere_is_said(tmp_path):
    text = text_of(made(tmp_path / "out", large="decay"))
    assert "is not borne out for the buoy" in text
    assert "bits per wave period (fitted over periods" in text


@pytest.mark.slow
def test_same_folder_same_bytes(study):
    first = [path.read_bytes() for path in build(study)]
    assert [path.read_bytes() for path in build(study)] == first
    page = first[0].decode()
    assert "http" not in re.sub(r"base64,[A-Za-z0-9+/=]+", "", page) and "<script" not in page
    assert page.count("<figure") == page.count("<figcaption") == page.count("alt=")


@pytest.mark.slow
def test_what_failed_or_is_lost_is_said_and_the_rest_is_shown(tmp_path):
    place = made(tmp_path / "out", raises=(0.016,), failing=(25.0,))
    text = text_of(place)
    assert "Runs that failed" in text and "statics-failed" in text and "a fault of the code" in text
    assert "“grows exponentially” is not borne out at kA = 0.13" in text and "“does not grow”" not in text
    for path in (place / "trajectories").glob("*.nc"):
        path.unlink()
    text = text_of(place)
    assert "Runs without a trajectory" in text and "cannot be drawn" in text


@pytest.mark.slow
def test_a_base_that_failed_leaves_a_report(tmp_path):
    text = text_of(made(tmp_path / "out", failing=(21.0, 21.6, 22.0)))
    assert "Runs that failed" in text and "No planar run released loops" in text


def test_a_folder_without_a_base_is_refused(study, tmp_path):
    copy = tmp_path / "copy"
    shutil.copytree(study, copy, ignore=shutil.ignore_patterns("*.nc"))
    (copy / "provenance.json").write_text('{"campaign": "out_of_plane"}')
    with pytest.raises(FolderError, match="base"):
        build(copy)


@pytest.mark.slow
def test_the_campaign_on_the_engine_itself(tmp_path):
    """Forty periods of every run: no loop is released in three dimensions, and a mirrored push mirrors the motion."""
    out = tmp_path / "out"
    assert out_of_plane.main(["--periods", "40", "--transient", "8", "--out", str(out)]) == 0
    text = text_of(out)
    assert text.count("the mirrored push gives the mirrored motion to the last digit") == 2
    assert "Runs that failed" not in text and "Loops released in three dimensions" not in text
    assert "leaves y at exactly 0" in text
