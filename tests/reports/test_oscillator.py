"""The report of the snap oscillator: made from its folder alone, the same twice, and honest about what is missing."""

import re

import pytest

from campaigns import oscillator
from reports import build
from reports.parts.folder import FolderError


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    out = tmp_path_factory.mktemp("oscillator") / "out"
    assert oscillator.main(["--effort", "0.01", "--out", str(out)]) == 0
    return out


@pytest.mark.slow
def test_same_folder_same_bytes(study):
    first = [path.read_bytes() for path in build(study)]
    assert [path.read_bytes() for path in build(study)] == first


@pytest.mark.slow
def test_page_needs_nothing_else_and_names_the_figure_of_the_paper(study):
    page = (study / "report.html").read_text(encoding="utf-8")
    text = re.sub(r"base64,[A-Za-z0-9+/=]+", "", page)
    assert "http" not in text and "<script" not in text
    assert "figure 19(b)" in text and "0.204647703" in text
    assert text.count("<figure") == text.count("<figcaption") == 7


@pytest.mark.slow
def test_a_lost_part_is_said_and_the_rest_is_shown(study):
    import csv
    import shutil

    copy = study.parent / "copy"
    shutil.copytree(study, copy)
    with open(copy / "table.csv", newline="") as file:
        key = next(row["run_key"] for row in csv.DictReader(file) if row["part"] == "basins")
    (copy / "trajectories" / f"{key}.nc").unlink()
    html, _ = build(copy)
    text = html.read_text(encoding="utf-8")
    assert "Parts without results" in text and "There are no basins" in text and "figure 19(b)" in text


def test_a_folder_that_is_no_study_is_refused(study, tmp_path):
    (tmp_path / "provenance.json").write_text('{"campaign": "oscillator"}')
    with pytest.raises(FolderError, match=r"table\.csv is missing"):
        build(tmp_path)
