"""The accuracy campaign: known errors come back with their orders, what fails is a row, nothing is done twice;
facts of its report follow the tables."""

import math
from dataclasses import replace

import numpy as np
import pytest

from campaigns import accuracy
from campaigns.accuracy.jobs import side_by_side
from campaigns.accuracy.plan import ADAPTIVE, BY_NAME, FULL, ORDERS, phases
from campaigns.accuracy.rows import COLUMNS, point_row, rms_mm
from campaigns.machinery.plan import Job
from engine import load_scene
from reports.accuracy.report import _settings, cheapest, per_period, read_study, smooth_series, within, work_items
from reports.parts.content import Table
from tables import names
from tests.campaigns.conftest import built_twice, chosen, ran, rows_of
from tests.campaigns.fake_engine import GRID_M, KnownErrors
from tests.reports.conftest import of_kind

OWN = [method for method in ORDERS if method != "paper-box"]


def made(folder, *words, **engine):
    """The rows of a campaign of the fake engine."""
    return ran(accuracy, folder, "--quick", *words, simulate=KnownErrors(**engine))


@pytest.fixture(scope="module")
def out(tmp_path_factory):
    folder = tmp_path_factory.mktemp("accuracy") / "out"
    made(folder)
    return folder


def orders_of(folder):
    return rows_of(folder, "orders.csv")


def test_every_series_shows_the_order_that_was_put_in(out):
    rows = orders_of(out)
    judged = [row for row in rows if row["kind"] in ("time", "space")]
    assert {(row["work"], row["method"]) for row in judged} >= {("regular", method) for method in OWN}
    for row in judged:
        assert row["within"] == "1" and abs(float(row["order"]) - float(row["theory"])) < 0.05, row
    tolerances = {row["method"]: float(row["order"]) for row in chosen(rows, kind="tolerance", work="regular")}
    assert tolerances == pytest.approx(dict.fromkeys(ADAPTIVE, 1.0), abs=0.05)  # the fake's error is rtol itself


def test_the_error_of_a_point_is_that_of_its_grid_against_the_reference(out):
    rows = chosen(rows_of(out), work="regular")
    assert chosen(rows, kind="reference", nodes="641", error="")
    stepped = {"kind": "point", "method": "backward-euler", "setting": "0.00625"}
    coarse, fine = (float(chosen(rows, nodes=nodes, **stepped)[0]["error"]) for nodes in ("11", "41"))
    assert coarse > fine
    tight = chosen(rows, kind="point", method="esdirk43", nodes="11", setting="0.001")[0]
    # far below the first error, that of the step
    assert float(tight["error"]) == pytest.approx(1e3 * GRID_M / 10**2 / math.sqrt(2.0), rel=0.1)


def test_the_same_command_computes_nothing_and_changes_nothing(out, capsys):
    before = {name: (out / name).read_bytes() for name in ("table.csv", "orders.csv", "provenance.json")}
    made(out, failing=tuple(ORDERS))
    assert ": 0 computed" in capsys.readouterr().out
    assert {name: (out / name).read_bytes() for name in before} == before


def test_what_fails_is_a_row_and_has_no_error(tmp_path):
    rows = made(tmp_path / "out", "--works", "regular", "pendulum", failing=("midpoint",), raises=(6, 641))
    broken = [row for row in rows if row["nodes"] in ("6", "641")]
    early = [row for row in chosen(rows, method="midpoint", kind="point") if row not in broken]
    points = [row for row in chosen(rows, kind="point", work="regular") if row not in (*broken, *early)]
    for selected, status in ((broken, "error"), (early, "newton-failed"), (points, "ok")):
        assert selected and all(row["status"] == status and row["error"] == "" for row in selected)
    series = chosen(orders_of(tmp_path / "out"), method="midpoint", kind="time")[0]
    assert series["order"] == "" and "newton-failed" in series["note"]
    run = KnownErrors(failing=("esdirk43",))(load_scene("tethered_buoy"), duration_s=50.0)
    assert set(point_row(run, "regular")) <= {*names(COLUMNS)} - {"error"}


def test_every_setting_of_the_full_campaign_is_a_sound_scene_and_appears_once():
    points = [point for phase in phases(FULL) for point in phase]
    assert len(set(points)) == len(points)
    kinds = {(point.work, point.method.partition(",")[0], point.control): point for point in points}
    for point in kinds.values():
        assert BY_NAME[point.work].made(point.changes()).tether.nodes == point.nodes  # raises for a faulty scene
    timed = {point.work for point in points if point.kind == "point"}
    assert timed == {work.name for work in BY_NAME.values() if work.timed} and len(timed) >= 5
    assert {point.method for point in points} >= set(ORDERS)


def test_rms_of_series_and_of_places():
    t = np.linspace(0.0, 1.0, 1001)
    assert rms_mm(3e-3 + 0 * t, 0 * t) == pytest.approx(3.0)
    assert rms_mm(np.full((5, 3), 1e-3), np.zeros((5, 3))) == pytest.approx(math.sqrt(3.0))
    assert rms_mm(t, t[:-1]) == math.inf


def test_other_codes_run_beside_the_middle_round_of_ours():
    def jobs(kind, rounds):
        return [Job({"work": work, "round": k, "kind": kind}, None) for k in rounds for work in "ab"]

    selected = side_by_side(jobs("ours", range(3)), jobs("theirs", [0]), 3)
    printed = " ".join("{kind}-{work}-{round}".format(**job.labels) for job in selected)
    assert printed == "ours-a-0 ours-b-0 ours-a-1 theirs-a-0 ours-b-1 theirs-b-0 ours-a-2 ours-b-2"


@pytest.mark.slow
def test_every_integrator_shows_its_order_on_a_smooth_work_of_the_engine(tmp_path, monkeypatch):
    """Orders are read from differences of neighbours in a series, which need no reference."""
    series_alone = replace(BY_NAME["pendulum"], duration_s=2.0, reference=None, checks=(), timed=False)
    monkeypatch.setitem(BY_NAME, "pendulum", series_alone)
    out = tmp_path / "out"
    words = ["--works", "pendulum", "--quick", "--no-peers", "--no-report"]
    assert accuracy.main([*words, "--out", str(out)]) == 0
    judged = [row for row in orders_of(out) if row["kind"] in ("time", "space")]
    shown = {(row["work"], row["method"]) for row in chosen(judged, kind="time")}
    assert shown == {("pendulum", method) for method in OWN}
    assert [row for row in judged if row["within"] != "1"] == []


def test_an_order_that_is_off_is_not_called_right(out):
    study = read_study(out)
    good, count = smooth_series(study)
    assert good == count > 10
    next(row for row in study.orders if row["kind"] == "time" and row["method"] == "trbdf2")["within"] = "0"
    assert smooth_series(study) == (count - 1, count)


def test_the_cheapest_within_a_level_is_the_cheapest(out):
    timed = read_study(out).timed("regular")
    for level in (5.0, 1.0):
        best = within(timed, level)
        assert best.error <= level and all(one.wall_s >= best.wall_s for one in timed if one.error <= level)
    assert within(timed, 0.0) is None


def test_a_setting_is_shown_by_the_medians_of_its_rounds():
    row = {"kind": "point", "work": "a", "method": "b", "nodes": 41, "control": "rtol", "setting": 0.03}
    row |= {"status": "ok", "message": "", "error_against_ours": math.nan}
    rounds = [row | {"error": error, "wall_s": 0.1 * error} for error in (1.0, 9.0, 2.0)]
    (shown,) = _settings([*rounds, row | {"status": "newton-failed", "error": math.nan, "wall_s": 77.0}])
    assert (shown.error, shown.wall_s, shown.failed) == (2.0, pytest.approx(0.2), 1)


def test_a_time_of_a_run_is_shown_as_milliseconds_of_a_wave_period_or_of_the_whole_run(out):
    works = {"waves": {"period_s": 5.0, "duration_s": 20.0}, "break": {"period_s": 1.0, "duration_s": 0.12}}
    study = read_study(out)._replace(works=works)
    (of_waves, _), (of_a_break, _) = per_period(study, "waves"), per_period(study, "break")
    assert 2.0 * of_waves == pytest.approx(500.0)  # 2 s for four wave periods
    assert 2.0 * of_a_break == pytest.approx(2000.0)


def test_the_line_of_a_diagram_joins_what_nothing_cheaper_beats():
    time, error = np.array([1.0, 2.0, 3.0, 4.0]), np.array([5.0, 6.0, 2.0, 2.0])
    assert list(cheapest(time, error)) == [0, 2]


@pytest.mark.slow
def test_same_folder_same_report(out):
    built_twice(out)


def test_a_report_says_what_failed(tmp_path):
    made(tmp_path, "--works", "regular", failing=("midpoint",))
    study = read_study(tmp_path)
    rows = [row for table in of_kind(work_items(study, "regular", drawn="regular"), Table) for row in table.rows]
    assert any(row[0] == "midpoint" and row[-1] == "newton-failed" for row in rows)
    assert not any(one.method == "midpoint" for one in study.timed("regular"))
