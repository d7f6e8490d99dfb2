"""The report of any sweep comes from its table and its dictionary: one key or two, whatever the columns are called."""

import csv
import json

import numpy as np
import pytest

from engine import load_scene
from reports import build
from reports.parts.columns import HEADER
from reports.parts.content import Figure, Table, plain
from reports.parts.folder import FolderError
from reports.sweep.quantities import measured
from reports.sweep.report import report

DEPTH, MASS = "water.depth_m", "buoy.mass_kg"
DICTIONARY = (
    (DEPTH, "m", "H", "depth of the water", 1),
    (MASS, "kg", "M", "mass of the buoy", 0),
    ("status", "", "", "ok, or why the run ended early", ""),
    ("regime", "", "", "kind of motion", ""),
    ("pull_min_N", "N", "T_min", "least pull", 0),
    ("pull_max_N", "N", "T_max", "greatest pull", 0),
    ("growth_bits", "bits", "σ", "growth", 3),
    ("growth_error", "bits", "", "its standard error", 3),
    ("steps", "", "steps", "time steps", 0),
    ("run_key", "", "", "", ""),
    ("message", "", "", "", ""),
)


def folder(place, keys):
    """Three values of each key; pulls that grow with them, the same steps in all runs, and one run that failed."""
    grids = np.meshgrid(*([1.0, 2.0, 3.0] for _ in keys), indexing="ij")
    rows = []
    for number, values in enumerate(zip(*(grid.ravel() for grid in grids), strict=True)):
        row = dict(zip(keys, values, strict=True)) | {"status": "ok", "regime": "period-1", "steps": 7, "run_key": "k"}
        row |= {"pull_min_N": 100 * sum(values), "pull_max_N": 200 * sum(values), "growth_bits": 0.1 * number}
        rows.append(row | {"growth_error": 0.01})
    rows[-1] = {key: rows[-1][key] for key in keys} | {
        "status": "newton-failed",
        "message": "at t = 3 s",
        "run_key": "x",
    }
    told = [entry for entry in DICTIONARY if entry[0] in keys or "." not in entry[0]]
    for name, head, lines in (
        ("columns.csv", HEADER, [dict(zip(HEADER, entry, strict=True)) for entry in told]),
        ("table.csv", [entry[0] for entry in told], rows),
    ):
        with open(place / name, "w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, head)
            writer.writeheader()
            writer.writerows(lines)
    (place / "trajectories").mkdir()
    (place / "scene.toml").write_text(load_scene("tethered_buoy").to_toml(), encoding="utf-8")
    made = {"campaign": "sweep", "scene": "tethered_buoy", "vary": {key: [1.0, 2.0, 3.0] for key in keys}}
    (place / "provenance.json").write_text(json.dumps(made), encoding="utf-8")
    return place


@pytest.mark.parametrize("keys", [[DEPTH], [DEPTH, MASS]], ids=["one key", "two keys"])
def test_the_report_of_a_sweep_of_any_key(tmp_path, keys):
    items = report(folder(tmp_path, keys)).items
    tables = [item for item in items if isinstance(item, Table)]
    runs = next(table for table in tables[1:] if len(table.rows) == 3 ** len(keys))
    heads = [plain(column.title) for column in runs.columns]
    assert heads[: len(keys)] == ["H", "M"][: len(keys)] and {"Tmin", "Tmax", "σ", "status"} <= set(heads)
    extremes = {row[0]: row for row in tables[0].rows}
    assert set(extremes) == {"least pull", "greatest pull", "growth"}, "what is the same in all runs is no quantity"
    assert extremes["greatest pull"][1:3] == ("N", f"{200 * len(keys)}")
    figures = [item for item in items if isinstance(item, Figure)]
    assert figures and all("σ" in figure.caption for figure in figures)
    html, pdf = build(tmp_path)
    before = html.read_bytes(), pdf.read_bytes()
    assert (build(tmp_path)[0].read_bytes(), pdf.read_bytes()) == before
    assert "newton-failed" in html.read_text(encoding="utf-8")


def test_errors_belong_to_their_quantity_and_ends_of_a_range_share_a_panel(tmp_path):
    from reports.parts.folder import read_folder

    read = read_folder(folder(tmp_path, [DEPTH]))
    shown = measured(read.columns, read.table.to_dict("records"), [DEPTH])
    names = [[(one.name, error and error.name) for one, error in panel.columns] for panel in shown]
    assert names == [[("pull_min_N", None), ("pull_max_N", None)], [("growth_bits", "growth_error")]]


def test_a_folder_that_does_not_say_what_was_varied_is_refused(tmp_path):
    place = folder(tmp_path, [DEPTH])
    (place / "provenance.json").write_text('{"campaign": "sweep"}', encoding="utf-8")
    with pytest.raises(FolderError, match="varied"):
        report(place)
