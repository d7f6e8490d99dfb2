"""The report of any sweep comes from its table and its dictionary: one key or two, whatever the columns are called."""

from itertools import product

import pytest

from campaigns.columns import Column
from campaigns.machinery.folder import Table as Rows
from campaigns.machinery.folder import write_json
from engine import load_scene
from reports import build
from reports.parts.content import Figure, Table, plain
from reports.parts.folder import FolderError, read_folder
from reports.sweep.quantities import measured
from reports.sweep.report import report

DEPTH, MASS = "water.depth_m", "buoy.mass_kg"
KEYS = {
    DEPTH: Column(DEPTH, "m", "H", "depth of the water", 1),
    MASS: Column(MASS, "kg", "M", "mass of the buoy", 0),
}
COLUMNS = (
    Column("status", meaning="ok, or why the run ended early"),
    Column("regime", meaning="kind of motion"),
    Column("pull_min_N", "N", "T_min", "least pull", 0),
    Column("pull_max_N", "N", "T_max", "greatest pull", 0),
    Column("growth_bits", "bits", "σ", "growth", 3),
    Column("growth_error", "bits", "", "its standard error", 3),
    Column("steps", "", "steps", "time steps", 0),
    Column("run_key"),
    Column("message"),
)


def folder(place, keys):
    """Three values of each key; pulls that grow with them, the same steps in all runs, and one run that failed."""
    table = Rows(place / "table.csv", (*(KEYS[key] for key in keys), *COLUMNS), [])
    for number, values in enumerate(product((1.0, 2.0, 3.0), repeat=len(keys))):
        row = dict(zip(keys, values, strict=True)) | {"status": "ok", "regime": "period-1", "steps": 7, "run_key": "k"}
        row |= {"pull_min_N": 100 * sum(values), "pull_max_N": 200 * sum(values)}
        row |= {"growth_bits": 0.1 * number, "growth_error": 0.01}
        if number == 3 ** len(keys) - 1:
            row = {key: row[key] for key in keys}
            row |= {"status": "newton-failed", "message": "at t = 3 s", "run_key": "x"}
        table.keys.append(str(number))
        table.rows[str(number)] = row
    table.write()
    (place / "trajectories").mkdir()
    (place / "scene.toml").write_text(load_scene("tethered_buoy").to_toml(), encoding="utf-8")
    vary = {key: [1.0, 2.0, 3.0] for key in keys}
    write_json(place / "provenance.json", {"campaign": "sweep", "scene": "tethered_buoy", "vary": vary})
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
    read = read_folder(folder(tmp_path, [DEPTH]))
    shown = measured(read.columns, read.table.to_dict("records"), [DEPTH])
    names = [[(one.name, error and error.name) for one, error in panel] for panel in shown]
    assert names == [[("pull_min_N", None), ("pull_max_N", None)], [("growth_bits", "growth_error")]]


def test_a_folder_that_does_not_say_what_was_varied_is_refused(tmp_path):
    place = folder(tmp_path, [DEPTH])
    (place / "provenance.json").write_text('{"campaign": "sweep"}', encoding="utf-8")
    with pytest.raises(FolderError, match="varied"):
        report(place)
