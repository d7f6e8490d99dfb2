"""Rows kept beside their trajectories: used again for the same maker, made anew for any other and after damage."""

import json

import pytest

from campaigns.machinery.folder import keep_row, kept_row, made_by

ROW = {"status": "ok", "radius_max_m": 21.5, "strobed_period": None, "regime": "period-1"}


def test_a_row_comes_back_as_it_was_to_the_maker_it_was_kept_for(tmp_path):
    (tmp_path / "trajectories").mkdir()
    keep_row(tmp_path, "a" * 64, "maker", ROW)
    assert kept_row(tmp_path, "a" * 64, "maker") == ROW
    assert kept_row(tmp_path, "a" * 64, "another maker") is None
    assert kept_row(tmp_path, "b" * 64, "maker") is None


def test_a_damaged_file_is_as_good_as_none(tmp_path):
    (tmp_path / "trajectories").mkdir()
    keep_row(tmp_path, "a" * 64, "maker", ROW)
    (path,) = (tmp_path / "trajectories").iterdir()
    for text in ("", path.read_text()[:-5], json.dumps({"made_by": "maker"}), json.dumps([1])):
        path.write_text(text)
        assert kept_row(tmp_path, "a" * 64, "maker") is None


def test_a_folder_that_cannot_be_written_costs_only_the_row(tmp_path):
    keep_row(tmp_path / "nowhere", "a" * 64, "maker", ROW)
    assert kept_row(tmp_path / "nowhere", "a" * 64, "maker") is None


def test_the_maker_changes_with_settings_and_sources():
    assert made_by({"transient": 100}, "analysis") == made_by({"transient": 100}, "analysis")
    assert made_by({"transient": 100}, "analysis") != made_by({"transient": 50}, "analysis")
    assert made_by({"transient": 100}, "analysis") != made_by(
        {"transient": 100}, "analysis", "campaigns/buoy_sweep/rows.py"
    )


@pytest.mark.parametrize("source", ["campaigns/rows_that_moved.py", "reports/templates"])
def test_a_source_that_is_not_there_is_an_error(source):
    with pytest.raises(FileNotFoundError):
        made_by({}, "engine", source)
