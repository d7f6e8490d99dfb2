"""A finished campaign is only read again where nothing of it has changed: order, code, libraries, files."""

import math
import os

import pytest

from campaigns import regime_map, sweep
from campaigns.machinery import finished
from campaigns.machinery.plan import Summary
from campaigns.study import Lengths, Measures, Study
from tables import STATUS
from tests.campaigns.conftest import order_of
from tests.pages import ROOT

VERSIONS = {"numpy": "2.0"}
DATA = ".toml", ".csv"


def folder_of(out, statuses=("ok", "newton-failed")):
    (out / "trajectories").mkdir()
    (out / "trajectories" / "a.nc").write_bytes(b"a run")
    (out / "table.csv").write_text("steepness\n0.1\n")
    rows = [{"status": status} for status in statuses]
    finished.keep_finished(out, "key", Summary(rows, 1, 1))
    return rows


def test_a_folder_as_it_was_left_is_not_looked_at_again(tmp_path):
    rows = folder_of(tmp_path)
    (tmp_path / ".lock").write_text("another process")
    summary = finished.finished(tmp_path, "key")
    assert (summary.rows, summary.found, summary.computed) == (rows, 2, 0)
    assert finished.finished(tmp_path, "another key") is None


@pytest.mark.parametrize("name", ["table.csv", "trajectories/a.nc", "trajectories/b.nc"])
def test_a_file_that_is_changed_lost_or_new_has_it_looked_at(name, tmp_path):
    folder_of(tmp_path)
    path = tmp_path / name
    if path.exists():
        content = path.read_bytes()
        path.unlink()
        assert finished.finished(tmp_path, "key") is None
        path.write_bytes(content + b"!")
    else:
        path.write_bytes(b"a run")
    assert finished.finished(tmp_path, "key") is None


def test_a_row_that_another_attempt_may_mend_keeps_it_open(tmp_path):
    folder_of(tmp_path, ("ok", "worker-died"))
    assert finished.finished(tmp_path, "key") is None


def test_the_key_tells_orders_code_and_libraries_apart(monkeypatch):
    requested = {"kicks": 8, "set": ["water.depth_m=25"]}
    usual = finished.order_key("campaigns.sweep", requested, VERSIONS)
    assert usual == finished.order_key("campaigns.sweep", dict(reversed(requested.items())), VERSIONS)
    others = [
        finished.order_key("campaigns.basins", requested, VERSIONS),
        finished.order_key("campaigns.sweep", requested | {"kicks": 9}, VERSIONS),
        finished.order_key("campaigns.sweep", requested | {"set": ["water.depth_m=26"]}, VERSIONS),
        finished.order_key("campaigns.sweep", requested, {"numpy": "2.1"}),
    ]
    monkeypatch.setattr(finished, "made_by", lambda settings, *sources: "other code")
    others.append(finished.order_key("campaigns.sweep", requested, VERSIONS))
    assert usual not in others


@pytest.mark.parametrize("wrapped", [str, lambda path: [path]])
def test_the_key_tells_the_contents_of_files_apart_that_words_name(wrapped, tmp_path):
    path = tmp_path / "scene.toml"
    keys = set()
    for content in ("depth_m = 21.0", "depth_m = 22.0"):
        path.write_text(content)
        keys.add(finished.order_key("campaigns.sweep", {"scene": wrapped(str(path))}, VERSIONS))
    assert len(keys) == 2


def test_a_finished_map_is_printed_again_without_the_scenes_of_its_cells(tmp_path, capsys, monkeypatch):
    words = ["--vary", *"waves.steepness 0.05 0.1 2 water.depth_m 22 23 2".split(), "--out", str(tmp_path)]
    order = order_of(regime_map, *words)
    assert len(order.cases) == 4
    (tmp_path / "answer.txt").write_text("the answer\n")
    finished.keep_finished(tmp_path, order.key, Summary([{"status": "ok"}], 4, 0))
    monkeypatch.setattr(type(order), "scene", None)
    assert regime_map.main(words) == 0
    assert "the answer" in capsys.readouterr().out
    again = [*words, "--starts", "5"]
    monkeypatch.undo()
    assert len(order_of(regime_map, *again).cases) == 4


def test_the_key_tells_the_data_of_campaigns_and_scenes_apart(monkeypatch):
    read = []
    monkeypatch.setattr(finished, "made_by", lambda *sources: read.extend(sources))
    finished.order_key("campaigns.validation", {}, VERSIONS)
    for folder in ("campaigns", "engine/scenes"):
        data = {path.relative_to(ROOT).as_posix() for path in (ROOT / folder).rglob("*.*") if path.suffix in DATA}
        assert data and data <= {*read}


def study_of(calls, module=""):
    """A campaign without an answer whose runs are a row; calls: grows with every time that they are done."""

    def runs(order, plan, jobs):
        calls.append(len(jobs))
        return Summary([{"status": "ok"}], 0, 1)

    return Study(
        name="mine",
        module=module,
        protocol="",
        scene="tethered_buoy",
        lengths=Lengths(2, 1),
        cases=lambda order: [order.case({}, {})],
        measures=lambda order: Measures((STATUS,), None),
        runs=runs,
    )


def test_a_finished_campaign_without_an_answer_is_not_done_again(tmp_path):
    words, calls = ["--out", str(tmp_path / "out"), "--no-report"], []
    assert [study_of(calls).main(words) for _ in range(2)] == [0, 0]
    assert len(calls) == 1


def test_a_campaign_of_ones_own_is_always_looked_at_because_its_code_is_not_known(tmp_path):
    words, calls = ["--out", str(tmp_path / "out"), "--no-report"], []
    for _ in range(2):
        assert study_of(calls, module="mine").main(words) == 0
    assert len(calls) == 2


def test_the_key_tells_the_contents_of_a_measured_sea_apart(tmp_path):
    path, keys = tmp_path / "gauge.csv", set()
    words = ["--vary", *"water.depth_m 22 23 2".split(), "--periods", "2", "--out", str(tmp_path / "out")]
    for height_m in (0.5, 0.6):
        lines = [f"{0.1 * step:.1f},{height_m * math.sin(0.4 * math.pi * 0.1 * step)}" for step in range(1500)]
        path.write_text("\n".join(["time_s,elevation_m", *lines]))
        keys.add(order_of(sweep, *words, "--set", f"waves.record={path}").key)
    assert len(keys) == 2


def test_the_key_tells_the_contents_of_curves_apart(tmp_path):
    path, keys = tmp_path / "orbits" / "curves" / "table.csv", set()
    path.parent.mkdir(parents=True)
    for content in ("curve\n1\n", "curve\n2\n"):
        path.write_text(content)
        keys.add(finished.order_key("campaigns.regime_map", {"curves": str(tmp_path / "orbits")}, VERSIONS))
    assert len(keys) == 2


def test_a_file_that_is_rewritten_at_the_same_size_has_the_folder_looked_at(tmp_path):
    folder_of(tmp_path)
    path = tmp_path / "table.csv"
    written_ns = path.stat().st_mtime_ns
    path.write_text("steepness\n0.2\n")
    os.utime(path, ns=(written_ns + 1, written_ns + 1))
    assert finished.finished(tmp_path, "key") is None


def test_where_runs_are_done_is_not_in_the_key(tmp_path):
    words = ["--vary", *"water.depth_m 22 23 2".split(), "--periods", "2"]
    keys = set()
    for name, jobs, backend in (("a", "1", "loky"), ("b", "2", "threading")):
        keys.add(order_of(sweep, *words, "--jobs", jobs, "--backend", backend, "--out", str(tmp_path / name)).key)
    assert len(keys) == 1
