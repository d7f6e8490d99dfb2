"""Folders that a sweep can leave behind when things go wrong still give a report that says so."""

import json

import pytest

from campaigns.accuracy.rows import COLUMNS as of_accuracy
from campaigns.buoy_sweep.rows import COLUMNS as of_a_buoy
from campaigns.machinery.folder import write_json, write_table
from campaigns.out_of_plane.rows import COLUMNS as of_plane
from engine import load_scene
from reports.__main__ import main
from reports.buoy_sweep.report import report
from reports.parts.content import Explorer, Figure, Notice, Sheet
from reports.parts.folder import read_rows
from tests.reports.conftest import campaign


def content(folder):
    """What a report says in its boxes, its bullets and its sheets, and the number of its figures."""
    items = report(folder).items
    boxes = [line for item in items if isinstance(item, Notice) for line in item.lines]
    sheets = [line for item in items if isinstance(item, Sheet) for line in item.lines]
    return boxes, sheets, sum(isinstance(item, (Figure, Explorer)) for item in items)


def test_runs_that_failed_are_named_with_their_reason_and_message(tmp_path):
    failing = {0.1: ("newton-failed", 0), 0.13: ("statics-failed", 0.004)}
    boxes, sheets, figures = content(campaign(tmp_path / "out", [0.1, 0.13], failing=failing))
    for steepness, (reason, _) in failing.items():
        assert any(f"{steepness}" in line and reason in line and "did not converge" in line for line in boxes)
    assert figures == 0 and sum("did not converge" in line for line in sheets) == 2


def test_a_single_short_run_gives_a_report(tmp_path):
    boxes, _, figures = content(campaign(tmp_path / "out", [0.13], periods=6, transient=2))
    assert figures >= 2 and boxes


@pytest.mark.slow
def test_a_damaged_and_a_missing_trajectory_cost_only_themselves(tmp_path):
    folder = campaign(tmp_path / "out", [0.016, 0.05, 0.13], periods=30, transient=5)
    files = [folder / "trajectories" / f"{row['run_key']}.nc" for row in read_rows(folder / "table.csv")]
    files[0].write_bytes(files[0].read_bytes()[:1000])
    files[1].unlink()
    boxes, sheets, figures = content(folder)
    assert any("0.016" in line and "0.05" in line for line in boxes) and figures >= 4
    assert sum(file.name in line for file in files[:2] for line in sheets) == 2
    assert not any(str(tmp_path) in line for line in boxes + sheets)


def test_thirty_failures_are_summed_up(tmp_path):
    steepness = [round(0.01 + 0.001 * k, 3) for k in range(30)]
    folder = campaign(tmp_path / "out", steepness, failing={value: ("step-limit", 0) for value in steepness})
    boxes, sheets, _ = content(folder)
    assert sum("did not converge" in line for line in boxes) == 1
    assert sum("did not converge" in line for line in sheets) == 30


HEAD = "name,unit,symbol,meaning,digits\n"
PARTS = ("table.csv", "columns.csv", "scene.toml", "provenance.json", "trajectories")


@pytest.mark.parametrize(
    ("part", "content", "said"),
    [
        *((part, None, f"{part} is missing") for part in PARTS),
        ("columns.csv", None, "older version"),
        ("columns.csv", "name,unit\n", "its first line is not name,unit,symbol,meaning,digits"),
        ("columns.csv", HEAD + "a,,,,two\n", "columns.csv cannot be read"),
        ("columns.csv", HEAD + "a,b\n", "columns.csv cannot be read"),
        ("table.csv", "steepness,status\n0.1,ok\n", "columns missing: "),
        ("columns.csv", HEAD + "status,,,,\n", "does not tell of all columns"),
        ("table.csv", "", "table.csv cannot be read"),
        ("scene.toml", "name = 3", "scene.toml cannot be read"),
        ("provenance.json", "{", "provenance.json cannot be read"),
        ("provenance.json", json.dumps({"campaign": "other"}), "names the campaign 'other'"),
    ],
)
def test_a_part_that_cannot_be_used_is_named_and_nothing_is_written(tmp_path, capsys, part, content, said):
    """content: of the file in place of its own, None where it is taken away."""
    folder = campaign(tmp_path / "out", [0.13], periods=5, transient=1)
    if content is None:
        (folder / part).rename(tmp_path / "away")
    else:
        (folder / part).write_text(content, encoding="utf-8")
    before = sorted(folder.iterdir())
    assert main([str(folder)]) == 2
    assert said in capsys.readouterr().err and sorted(folder.iterdir()) == before


@pytest.mark.parametrize(
    ("campaign", "columns", "said"),
    [
        ("accuracy", of_accuracy, "does not describe the works"),
        ("out_of_plane", of_plane, "does not name base and transient"),
        ("sweep", of_a_buoy, "does not name what was varied"),
        ("oscillator", (), "table.csv is missing"),
    ],
)
def test_a_folder_that_does_not_say_what_its_report_needs_is_refused(tmp_path, capsys, campaign, columns, said):
    write_json(tmp_path / "provenance.json", {"campaign": campaign})
    if columns:
        write_table(tmp_path / "table.csv", columns, [{"status": "ok"}])
        (tmp_path / "scene.toml").write_text(load_scene("tethered_buoy").to_toml(), encoding="utf-8")
        (tmp_path / "trajectories").mkdir()
    assert main([str(tmp_path)]) == 2
    assert said in capsys.readouterr().err


def test_an_empty_folder_lists_everything_that_is_missing(tmp_path, capsys):
    assert main([str(tmp_path)]) == 2
    message = capsys.readouterr().err
    assert all(part in message for part in PARTS)
    assert main([str(tmp_path / "nowhere")]) == 2
    assert "no such folder" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []
