"""The report on the paper from folders that lack parts, and what it says of other depths and treatments."""

import csv
import json

import pytest

from engine import load_scene
from reports.paper.dependence import dependence_items
from reports.paper.report import COLUMNS, report
from reports.paper.results import DEPENDENCE_COLUMNS, read_results
from reports.parts.content import Figure, Heading, Links, Notice, Table, Text
from reports.parts.html import render_html
from reports.parts.pdf import typst_source
from tests.reports.paper_world import deep


def write(path, columns, rows):
    path.parent.mkdir(parents=True, exist_ok=True)
    with open(path, "w", newline="") as file:
        writer = csv.DictWriter(file, columns)
        writer.writeheader()
        writer.writerows(rows)


@pytest.fixture
def folder(tmp_path):
    """As the campaign leaves it where only the dependence study was asked for."""
    (tmp_path / "trajectories").mkdir()
    (tmp_path / "provenance.json").write_text(json.dumps({"campaign": "paper", "command": ["python"], "quick": False}))
    (tmp_path / "scene.toml").write_text(load_scene("tethered_buoy").to_toml())
    row = {"part": "dependence", "status": "ok", "runs": 8, "failed": 0, "run_s": 1.5, "total_s": 2.0, "run_key": "key"}
    write(tmp_path / "table.csv", COLUMNS, [row])
    rows = [
        deep(
            kA, H, submergence=under, bending_stiffness_Nm2=EI, regime="chaotic" if H < 22 and kA > 0.1 else "period-1"
        )
        for kA in (0.13, 0.016)
        for under in ("full", "spherical-cap")
        for H in (21.0, 22.5)
        for EI in ((0.4, 4.0) if under == "full" else (0.4,))
    ]
    rows = [dict.fromkeys(DEPENDENCE_COLUMNS) | row | {"run_key": "key"} for row in rows]
    write(tmp_path / "dependence" / "table.csv", DEPENDENCE_COLUMNS, rows)
    return tmp_path


def text_of(items):
    return " ".join(item.text for item in items if isinstance(item, Text | Heading))


def test_parts_that_are_missing_are_told_and_the_rest_is_there(folder):
    found = report(folder)
    notices = [item for item in found.items if isinstance(item, Notice)]
    assert any("`buoy`" in line and "there is no such folder" in line for one in notices for line in one.lines)
    tables = [item for item in found.items if isinstance(item, Table)]
    assert {"(6), C₃₁" in row[0] for table in tables for row in table.rows} == {True, False}
    assert "Where to find what" in text_of(found.items) and "Misprints" in text_of(found.items)
    assert not [item for item in found.items if isinstance(item, Links)]
    assert "What the paper leaves out" in typst_source(found)[0]


def test_links_lead_to_the_reports_that_exist(folder):
    (folder / "buoy").mkdir()
    (folder / "buoy" / "report.html").write_text("")
    found = report(folder)
    links = [item for item in found.items if isinstance(item, Links)]
    assert [path for _, path in links[0].files] == ["buoy/report.html"]
    assert b'href="buoy/report.html"' in render_html(found)


def test_the_dependence_is_told_by_depth_treatment_and_stiffness(folder):
    items = dependence_items(read_results(folder))
    figures = [item for item in items if isinstance(item, Figure)]
    assert len(figures) == 2
    assert "At kA = 0.13 2 chaotic and 2 periodic of 4 runs. Exponents two errors above zero" in figures[0].caption
    assert "H = 21 and 22.5 m" in figures[0].caption and "At kA = 0.016 4 periodic of 4 runs" in figures[0].caption
    tables = [item for item in items if isinstance(item, Table)]
    regimes = next(table for table in tables if "at kA = 0.13" in table.caption)
    assert [row[0] for row in regimes.rows] == ["21", "22.5"]
    assert regimes.rows[0][1].startswith("chaotic, 0.200") and regimes.rows[1][2].startswith("period-1")


def test_a_run_that_failed_is_a_cell_and_no_point(folder):
    path = folder / "dependence" / "table.csv"
    path.write_text(path.read_text().replace(",ok,", ",newton-failed,", 1))
    items = dependence_items(read_results(folder))
    cells = [cell for item in items if isinstance(item, Table) for row in item.rows for cell in row]
    assert "newton-failed" in cells
