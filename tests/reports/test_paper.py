"""The report on the paper from a folder that lacks parts, and what it says of other depths and treatments."""

import csv
import json

import pytest

from engine import load_scene
from reports.paper.report import COLUMNS, report
from reports.paper.results import DEPENDENCE_COLUMNS
from reports.parts.content import Figure, Heading, Links, Notice, Table, Text
from reports.parts.html import render_html
from reports.parts.pdf import typst_source
from tests.reports.paper_world import deep

OTHER = {(0.13, 21.0): "chaotic"}


def write(path, columns, rows):
    path.parent.mkdir(parents=True, exist_ok=True)
    with open(path, "w", newline="") as file:
        writer = csv.DictWriter(file, columns)
        writer.writeheader()
        writer.writerows(rows)


@pytest.fixture(scope="module")
def found(tmp_path_factory):
    """Of a folder as the campaign leaves it where the dependence study was done, and of another part the page alone."""
    folder = tmp_path_factory.mktemp("paper")
    (folder / "trajectories").mkdir()
    (folder / "provenance.json").write_text(json.dumps({"campaign": "paper", "command": ["python"], "quick": False}))
    (folder / "scene.toml").write_text(load_scene("tethered_buoy").to_toml())
    row = {"part": "dependence", "status": "ok", "runs": 8, "failed": 0, "run_s": 1.5, "total_s": 90.0}
    write(folder / "table.csv", COLUMNS, [row])
    rows = [
        deep(kA, H, submergence=under, bending_stiffness_Nm2=EI, regime=OTHER.get((kA, H), "period-1"))
        for kA in (0.13, 0.016)
        for under in ("full", "spherical-cap")
        for H in (21.0, 22.5)
        for EI in ((0.4, 4.0) if under == "full" else (0.4,))
    ]
    rows.append(deep(0.13, 25.0, status="newton-failed"))
    rows = [{name: row.get(name) for name in DEPENDENCE_COLUMNS} | {"run_key": "key"} for row in rows]
    write(folder / "dependence" / "table.csv", DEPENDENCE_COLUMNS, rows)
    (folder / "buoy").mkdir()
    (folder / "buoy" / "report.html").write_text("")
    return report(folder)


def items_of(found, kind):
    return [item for item in found.items if isinstance(item, kind)]


def test_parts_that_are_missing_are_told_and_the_rest_is_there(found):
    told = [line for notice in items_of(found, Notice) for line in notice.lines]
    assert any("`sweep`" in line and "there is no such folder" in line for line in told)
    assert any("`buoy`" in line and "table.csv is missing" in line for line in told)
    assert any(row[0] == "eq. (6), C₃₁" for table in items_of(found, Table) for row in table.rows)
    text = " ".join(item.text for item in items_of(found, Text | Heading))
    assert "Where to find what" in text and "Misprints" in text and "took 1.5 minutes" in text
    assert "What the paper leaves out" in typst_source(found)[0]


def test_links_lead_to_the_reports_that_exist(found):
    assert [path for links in items_of(found, Links) for _, path in links.files] == ["buoy/report.html"]
    assert b'href="buoy/report.html"' in render_html(found)


def test_the_dependence_is_told_by_depth_treatment_and_stiffness(found):
    depths, stiffness = items_of(found, Figure)
    assert "At kA = 0.13 2 chaotic and 2 periodic of 4 runs. Exponents two errors above zero" in depths.caption
    assert "H = 21 and 22.5 m" in depths.caption and "At kA = 0.016 4 periodic of 4 runs" in depths.caption
    assert "bending stiffness" in stiffness.caption
    regimes = next(table for table in items_of(found, Table) if "at kA = 0.13" in table.caption)
    assert [row[0] for row in regimes.rows] == ["21", "22.5", "25"]
    assert regimes.rows[0][1].startswith("chaotic, 0.200") and regimes.rows[1][2].startswith("period-1")
    assert regimes.rows[2][1:] == ("newton-failed", "–")
