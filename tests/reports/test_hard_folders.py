"""Folders that a sweep can leave behind when things go wrong still give a report that says so."""

import json

import pytest

from reports import build
from reports.__main__ import main
from tests.reports.conftest import Page
from tests.reports.synthetic import campaign


def words(folder) -> str:
    return " ".join(Page(build(folder)[0].read_text(encoding="utf-8")).text.split())


def test_all_runs_failed(tmp_path):
    failing = {0.1: ("newton-failed", 0), 0.13: ("statics-failed", 0.004)}
    text = words(campaign(tmp_path / "out", [0.1, 0.13], failing=failing))
    assert "None ended as asked" in text and "newton-failed" in text and "statics-failed" in text
    assert "did not converge <at> t = 12 s, #step $x$" in text


def test_a_single_short_run(tmp_path):
    text = words(campaign(tmp_path / "out", [0.13], periods=6, transient=2))
    assert "1 run, kA = 0.13" in text and "No spectrum" in text and "too few strobed points" in text
    assert "A verdict takes a run of 42 wave periods or more, 40 of them beyond the transient; the longest" in text


def test_a_damaged_and_a_missing_trajectory_cost_only_themselves(tmp_path):
    folder = campaign(tmp_path / "out", [0.016, 0.05, 0.13], periods=30, transient=5)
    files = sorted((folder / "trajectories").iterdir())
    files[0].write_bytes(files[0].read_bytes()[:1000])
    files[1].unlink()
    text = words(folder)
    assert "cannot be read" in text and "is missing" in text and "kA = 0.13: " in text
    assert str(tmp_path) not in text


def test_a_hundred_failures_are_summed_up(tmp_path):
    steepness = [round(0.01 + 0.001 * k, 3) for k in range(100)]
    folder = campaign(tmp_path / "out", steepness, failing={value: ("step-limit", 0) for value in steepness})
    text, _, sheets = words(folder).partition("One sheet for each row")
    assert text.count("did not converge") < 20 and sheets.count("did not converge") == 100


@pytest.mark.parametrize("missing", ["table.csv", "scene.toml", "provenance.json", "trajectories"])
def test_a_missing_part_is_named_and_nothing_is_written(tmp_path, capsys, missing):
    folder = campaign(tmp_path / "out", [0.13], periods=5, transient=1)
    (folder / missing).rename(tmp_path / "away")
    before = sorted(folder.iterdir())
    assert main([str(folder)]) == 2
    assert missing in capsys.readouterr().err
    assert sorted(folder.iterdir()) == before


def test_an_empty_folder_lists_everything_that_is_missing(tmp_path, capsys):
    assert main([str(tmp_path)]) == 2
    message = capsys.readouterr().err
    assert all(part in message for part in ("table.csv", "scene.toml", "provenance.json", "trajectories"))
    assert main([str(tmp_path / "nowhere")]) == 2
    assert "no such folder" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("part", "content", "said"),
    [
        ("table.csv", "steepness,status\n0.1,ok\n", "columns missing: "),
        ("table.csv", "", "table.csv cannot be read"),
        ("scene.toml", "name = 3", "scene.toml cannot be read"),
        ("provenance.json", "{", "provenance.json cannot be read"),
        ("provenance.json", json.dumps({"campaign": "other"}), "names the campaign 'other'"),
    ],
)
def test_a_part_that_cannot_be_used_is_named(tmp_path, capsys, part, content, said):
    folder = campaign(tmp_path / "out", [0.13], periods=5, transient=1)
    (folder / part).write_text(content, encoding="utf-8")
    assert main([str(folder)]) == 2
    assert said in capsys.readouterr().err
    assert not (folder / "report.html").exists() and not (folder / "report.pdf").exists()
