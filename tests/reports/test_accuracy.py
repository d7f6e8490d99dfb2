"""The accuracy report: facts follow the tables, its pages need nothing else, gaps are said."""

import shutil

import numpy as np
import pytest

from campaigns import accuracy
from reports import build
from reports.accuracy.sections import read_study, smooth_series, within, work_items
from reports.figures.work_precision import cheapest
from reports.parts.content import Table
from reports.parts.folder import FolderError
from tests.campaigns.fake_engine import KnownErrors

WORDS = ["--quick", "--backend", "threading", "--jobs", "2", "--no-report"]


def made(place, *words, **engine):
    assert accuracy.main([*WORDS, *words, "--out", str(place)], simulate=KnownErrors(**engine)) == 0
    return place


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return made(tmp_path_factory.mktemp("accuracy") / "out")


def test_an_order_that_is_off_is_not_called_right(folder):
    study = read_study(folder)
    good, count = smooth_series(study)
    assert good == count > 10
    next(row for row in study.orders if row["kind"] == "time" and row["method"] == "trbdf2")["within"] = "0"
    assert smooth_series(study) == (count - 1, count)


def test_the_cheapest_within_a_level_is_the_cheapest(folder):
    timed = read_study(folder).timed("regular")
    for level in (5.0, 1.0):
        best = within(timed, level)
        assert best.error <= level and all(one.wall_s >= best.wall_s for one in timed if one.error <= level)
    assert within(timed, 0.0) is None


def test_the_line_of_a_diagram_joins_what_nothing_cheaper_beats():
    time, error = np.array([1.0, 2.0, 3.0, 4.0]), np.array([5.0, 6.0, 2.0, 2.0])
    assert list(cheapest(time, error)) == [0, 2]


def test_same_folder_same_bytes(folder):
    first = [path.read_bytes() for path in build(folder)]
    assert [path.read_bytes() for path in build(folder)] == first


def test_what_failed_is_said(tmp_path):
    study = read_study(made(tmp_path / "out", "--works", "regular", failing=("midpoint",)))
    rows = [row for item in work_items(study, "regular") if isinstance(item, Table) for row in item.rows]
    assert any(row[0] == "midpoint" and row[-1] == "newton-failed" for row in rows)
    assert not any(one.method == "midpoint" for one in study.timed("regular"))


def test_a_folder_without_works_is_refused(folder, tmp_path):
    copy = shutil.copytree(folder, tmp_path / "copy", ignore=shutil.ignore_patterns("*.nc"))
    (copy / "provenance.json").write_text('{"campaign": "accuracy"}')
    with pytest.raises(FolderError, match="works"):
        build(copy)
