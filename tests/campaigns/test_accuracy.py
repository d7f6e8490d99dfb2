"""The accuracy campaign: known errors come back with their orders, what fails is a row, nothing is done twice."""

import csv
import math

import numpy as np
import pytest

from campaigns import accuracy
from campaigns.accuracy.jobs import side_by_side
from campaigns.accuracy.plan import first_phase, second_phase, third_phase
from campaigns.accuracy.points import ADAPTIVE, FULL, ORDERS, Point
from campaigns.accuracy.rows import COLUMNS, point_row, rms_mm
from campaigns.accuracy.works import BY_NAME, WORKS
from campaigns.columns import names
from campaigns.machinery.plan import Job
from engine import load_scene
from tests.campaigns.conftest import rows_of
from tests.campaigns.fake_methods import GRID_M, KnownErrors

USUAL = ["--quick", "--backend", "threading", "--jobs", "2", "--no-report"]


@pytest.fixture(scope="module")
def out(tmp_path_factory):
    folder = tmp_path_factory.mktemp("accuracy") / "out"
    assert accuracy.main([*USUAL, "--out", str(folder)], simulate=KnownErrors()) == 0
    return folder


def orders_of(folder):
    with open(folder / "orders.csv", newline="") as file:
        return list(csv.DictReader(file))


def test_every_series_shows_the_order_that_was_put_in(out):
    rows = orders_of(out)
    judged = [row for row in rows if row["kind"] in ("time", "space")]
    assert {(row["work"], row["method"]) for row in judged} >= {
        ("regular", method) for method in ORDERS if method != "paper-box"
    }
    for row in judged:
        assert row["within"] == "1" and abs(float(row["order"]) - float(row["theory"])) < 0.05, row


def test_the_error_of_a_point_is_that_of_its_grid_against_the_reference(out):
    rows = [row for row in rows_of(out) if row["work"] == "regular"]
    reference = next(row for row in rows if row["kind"] == "reference")
    assert reference["error"] == "" and reference["nodes"] == "641"
    # far below the first error, that of the step
    points = [row for row in rows if row["kind"] == "point" and row["method"] == "backward-euler"]
    coarse, fine = (
        next(row for row in points if row["nodes"] == n and row["setting"] == "0.00625") for n in ("11", "41")
    )
    assert float(coarse["error"]) > float(fine["error"])
    expected = 1e3 * GRID_M / 10**2 / math.sqrt(2.0)
    tight = next(
        r
        for r in rows
        if r["kind"] == "point" and r["method"] == "esdirk43" and r["nodes"] == "11" and r["setting"] == "0.001"
    )
    assert float(tight["error"]) == pytest.approx(expected, rel=0.1)


def test_errors_of_tolerances_fall_with_the_tolerance(out):
    slopes = {
        row["method"]: float(row["order"])
        for row in orders_of(out)
        if row["kind"] == "tolerance" and row["work"] == "regular"
    }
    assert set(slopes) == set(ADAPTIVE)
    assert all(slope == pytest.approx(1.0, abs=0.05) for slope in slopes.values())  # the fake's error is rtol itself


def test_the_same_command_computes_nothing_and_changes_nothing(out, capsys):
    before = {name: (out / name).read_bytes() for name in ("table.csv", "orders.csv", "provenance.json")}
    assert accuracy.main([*USUAL, "--out", str(out)], simulate=KnownErrors(failing=tuple(ORDERS))) == 0
    assert ": 0 computed" in capsys.readouterr().out
    assert {name: (out / name).read_bytes() for name in before} == before


def test_what_fails_is_a_row_and_has_no_error(tmp_path):
    engine = KnownErrors(failing=("midpoint",), raises=(6,))
    assert (
        accuracy.main([*USUAL, "--works", "regular", "pendulum", "--out", str(tmp_path / "out")], simulate=engine) == 0
    )
    rows = rows_of(tmp_path / "out")
    early = [row for row in rows if row["method"] == "midpoint" and row["kind"] == "point" and row["nodes"] != "6"]
    assert early and all(row["status"] == "newton-failed" and row["error"] == "" for row in early)
    broken = [row for row in rows if row["nodes"] == "6"]
    assert broken and all(row["status"] == "error" for row in broken)
    series = next(row for row in orders_of(tmp_path / "out") if row["method"] == "midpoint" and row["kind"] == "time")
    assert series["order"] == "" and "newton-failed" in series["note"]


def test_a_reference_that_failed_leaves_points_without_errors(tmp_path):
    engine = KnownErrors(raises=(641,))
    assert accuracy.main([*USUAL, "--works", "regular", "--out", str(tmp_path / "out")], simulate=engine) == 0
    points = [row for row in rows_of(tmp_path / "out") if row["kind"] == "point"]
    assert points and all(row["status"] == "ok" and row["error"] == "" for row in points)


def test_every_setting_of_the_full_campaign_is_a_sound_scene_and_appears_once():
    points = [point for phase in (first_phase, second_phase, third_phase) for point in phase(FULL)]
    assert len(set(points)) == len(points)
    kinds = {(point.work, point.method.partition(",")[0], point.control) for point in points}
    for work, method, control in kinds:
        one = next(p for p in points if (p.work, p.method.partition(",")[0], p.control) == (work, method, control))
        scene = BY_NAME[work].made(one.changes())  # raises where the scene is faulty
        assert scene.tether.nodes == one.nodes
    timed = {point.work for point in points if point.kind == "point"}
    assert timed == {work.name for work in WORKS if work.timed} and len(timed) >= 5
    assert {point.method for point in points} >= set(ORDERS)


def test_rounds_differ_by_a_tenth():
    settings = [
        Point("regular", "point", "esdirk43", 41, "rtol", 0.03, round).changes()["solver.rtol"] for round in range(3)
    ]
    assert settings == pytest.approx([0.03, 0.027, 0.033])


def test_rms_of_series_and_of_places():
    t = np.linspace(0.0, 1.0, 1001)
    assert rms_mm(3e-3 + 0 * t, 0 * t) == pytest.approx(3.0)
    assert rms_mm(np.full((5, 3), 1e-3), np.zeros((5, 3))) == pytest.approx(math.sqrt(3.0))
    assert rms_mm(t, t[:-1]) == math.inf


def test_a_run_that_ended_early_has_no_error():
    run = KnownErrors(failing=("esdirk43",))(load_scene("tethered_buoy"), duration_s=50.0)
    row = point_row(run, "regular")
    assert row["status"] == "newton-failed" and "error" not in row and set(row) <= set(names(COLUMNS))


def test_other_codes_run_beside_the_middle_round_of_ours():
    def jobs(kind, rounds):
        return [Job({"work": work, "round": k, "kind": kind}, None) for k in rounds for work in "ab"]

    found = [
        "{kind}-{work}-{round}".format(**job.labels)
        for job in side_by_side(jobs("ours", range(3)), jobs("theirs", [0]), 3)
    ]
    assert found == [
        "ours-a-0", "ours-b-0", "ours-a-1", "theirs-a-0", "ours-b-1", "theirs-b-0", "ours-a-2", "ours-b-2"
    ]  # fmt: skip


@pytest.mark.slow
def test_every_integrator_shows_its_order_on_smooth_works_of_the_engine(tmp_path):
    out = tmp_path / "out"
    words = ["--works", "regular-smooth", "pendulum", "--quick", "--no-peers", "--no-report"]
    assert accuracy.main([*words, "--out", str(out)]) == 0
    judged = [row for row in orders_of(out) if row["kind"] in ("time", "space")]
    shown = {(row["work"], row["method"]) for row in judged if row["kind"] == "time"}
    engine = [method for method in ORDERS if method != "paper-box"]
    assert shown == {(work, method) for work in ("regular-smooth", "pendulum") for method in engine}
    assert [row for row in judged if row["within"] != "1"] == []
    assert (out / "costs.json").exists()
