"""The accuracy report: its statements follow the tables, its pages need nothing else, gaps are said."""

import csv
import re
import shutil

import numpy as np
import pytest

from campaigns import accuracy
from reports import build
from reports.accuracy.sections import within
from reports.accuracy.study import read_study
from reports.figures.work_precision import cheapest
from reports.parts.folder import FolderError
from tests.campaigns.fake_methods import KnownErrors

WORDS = ["--quick", "--backend", "threading", "--jobs", "2", "--no-report"]


def made(place, *words, **engine):
    assert accuracy.main([*WORDS, *words, "--out", str(place)], simulate=KnownErrors(**engine)) == 0
    return place


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return made(tmp_path_factory.mktemp("accuracy") / "out")


def text_of(place):
    html, _ = build(place)
    page = html.read_text(encoding="utf-8")
    return " ".join(re.sub(r"<[^>]+>", " ", re.sub(r"base64,[A-Za-z0-9+/=]+", "", page)).split())


def test_every_work_has_its_diagram_and_orders_are_counted(folder):
    text = text_of(folder)
    for title in ("Regular buoy, kA = 0.016", "Pendulum in three dimensions"):
        assert title in text
    judged = [row for row in read_study(folder).orders if row["kind"] != "tolerance" and row["within"]]
    assert f"Orders: {len(judged)} of {len(judged)} series on smooth works end within 0.15 of theory" in text
    assert "The shipped setting (41 nodes, rtol 0.03) on regular" in text


def test_an_order_that_is_off_is_not_called_right(folder, tmp_path):
    copy = tmp_path / "copy"
    shutil.copytree(folder, copy)
    with open(copy / "orders.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    off = next(row for row in rows if row["kind"] == "time" and row["method"] == "trbdf2")
    off |= {"order": "1.4", "within": "0"}
    with open(copy / "orders.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, rows[0])
        writer.writeheader()
        writer.writerows(rows)
    judged = [row for row in rows if row["kind"] != "tolerance" and row["within"]]
    assert f"On smooth works {len(judged) - 1} of {len(judged)} series end within 0.15" in text_of(copy)


def test_the_cheapest_within_a_level_is_the_cheapest(folder):
    study = read_study(folder)
    timed = study.timed("regular")
    for level in (5.0, 1.0):
        best = within(timed, level)
        assert best.error <= level and all(one.wall_s >= best.wall_s for one in timed if one.error <= level)
    assert within(timed, 0.0) is None


def test_the_line_of_a_diagram_joins_what_nothing_cheaper_beats():
    time, error = np.array([1.0, 2.0, 3.0, 4.0]), np.array([5.0, 6.0, 2.0, 2.0])
    assert list(cheapest(time, error)) == [0, 2]


def test_same_folder_same_bytes_and_nothing_from_outside(folder):
    first = [path.read_bytes() for path in build(folder)]
    assert [path.read_bytes() for path in build(folder)] == first
    page = first[0].decode()
    assert "http" not in re.sub(r"base64,[A-Za-z0-9+/=]+", "", page) and "<script" not in page
    assert page.count("<figure") == page.count("<figcaption") == page.count("alt=")


def test_what_failed_is_said(tmp_path):
    text = text_of(made(tmp_path / "out", "--works", "regular", failing=("midpoint",)))
    assert "Left out because a round ended early: midpoint" in text and "newton-failed" in text
    assert "runs ended early: newton-failed" in text


def test_a_folder_without_works_is_refused(folder, tmp_path):
    copy = tmp_path / "copy"
    shutil.copytree(folder, copy, ignore=shutil.ignore_patterns("*.nc"))
    (copy / "provenance.json").write_text('{"campaign": "accuracy"}')
    with pytest.raises(FolderError, match="works"):
        build(copy)
