"""A finished campaign is only read again where nothing of it has changed: order, code, libraries, files."""

from types import SimpleNamespace

import pytest

from campaigns.machinery import finished
from campaigns.machinery.plan import Summary

VERSIONS = {"numpy": "2.0"}


def order(*keys, report=True):
    return SimpleNamespace(cases=[SimpleNamespace(key=key) for key in keys], how=SimpleNamespace(report=report))


def folder_of(out, statuses=("ok", "newton-failed")):
    (out / "trajectories").mkdir()
    (out / "trajectories" / "a.nc").write_bytes(b"a run")
    (out / "table.csv").write_text("steepness\n0.1\n")
    rows = [{"status": status} for status in statuses]
    finished.keep_finished(out, "key", Summary(rows, 1, 1, 2.0))
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
    usual = finished.order_key(order("a", "b"), {"kicks": 8}, VERSIONS)
    assert usual == finished.order_key(order("a", "b"), {"kicks": 8}, VERSIONS)
    others = [
        finished.order_key(order("a", "c"), {"kicks": 8}, VERSIONS),
        finished.order_key(order("a", "b"), {"kicks": 9}, VERSIONS),
        finished.order_key(order("a", "b"), {"kicks": 8}, {"numpy": "2.1"}),
        finished.order_key(order("a", "b", report=False), {"kicks": 8}, VERSIONS),
    ]
    monkeypatch.setattr(finished, "made_by", lambda settings, *sources: "other code")
    others.append(finished.order_key(order("a", "b"), {"kicks": 8}, VERSIONS))
    assert usual not in others
