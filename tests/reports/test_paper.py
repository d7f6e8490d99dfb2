"""The report on the paper from a folder that lacks parts, and what it says of other depths and treatments."""

import re
from itertools import product

import numpy as np
import pytest

from campaigns.paper.dependence import COLUMNS as DEPENDENCE
from campaigns.paper.measured import Results
from campaigns.paper.parts import COLUMNS
from campaigns.paper.statements import claims
from campaigns.statements import write_statements
from reports.figures.line_panels import LinePanel, limits
from reports.paper.index import entries, markdown, named_in
from reports.paper.report import report, short_answer
from reports.parts.content import Links, Table, Text
from reports.parts.html import render_html
from reports.parts.judged import read_statements, statements_table
from tables import FAILS, HOLDS_IF, STATEMENT_COLUMNS
from tests.campaigns.paper.test_statements import deep, world
from tests.pages import ROOT
from tests.reports.conftest import folder_at, of_kind, warned, write


@pytest.fixture(scope="module")
def content(tmp_path_factory):
    """Of a folder as the campaign leaves it where the dependence study was done, and of another part the page alone."""
    row = {"part": "dependence", "status": "ok", "runs": 8, "failed": 0, "run_s": 1.5, "total_s": 90.0}
    folder = folder_at(
        tmp_path_factory.mktemp("paper") / "out", "paper", [row], COLUMNS, command=["python"], quick=False
    )
    write_statements(folder, claims(), Results())
    rows = []
    for kA, H, (under, EI) in product(
        (0.13, 0.016), (21.0, 22.5), (("full", 0.4), ("full", 4.0), ("spherical-cap", 0.4))
    ):
        regime = "chaotic" if (kA, H) == (0.13, 21.0) else "period-1"
        rows.append(deep(kA, H, submergence=under, bending_stiffness_Nm2=EI, regime=regime))
    write(folder / "dependence", [*rows, deep(0.13, 25.0, status="newton-failed")], DEPENDENCE)
    (folder / "buoy").mkdir()
    (folder / "buoy" / "report.html").write_text("")
    return report(folder)


def test_parts_that_are_missing_are_told_and_the_rest_is_there(content):
    lines = warned(content.items)
    assert any("`sweep`" in line for line in lines) and not any("`dependence`" in line for line in lines)
    assert any(row[0] == "eq. (6), C₃₁" for table in of_kind(content.items, Table) for row in table.rows)
    assert any("took 1.5 minutes" in item.text for item in of_kind(content.items, Text))


def test_links_lead_to_the_reports_that_exist(content):
    assert [path for links in of_kind(content.items, Links) for _, path in links.files] == ["buoy/report.html"]
    assert b'href="buoy/report.html"' in render_html(content)


def test_the_dependence_is_told_by_depth_and_treatment(content):
    regimes = next(table for table in of_kind(content.items, Table) if "at kA = 0.13" in table.caption)
    assert [row[0] for row in regimes.rows] == ["21", "22.5", "25"]
    assert regimes.rows[0][1].startswith("chaotic, 0.200") and regimes.rows[2][1:] == ("newton-failed", "–")


def test_the_short_answer_tells_each_statement_that_does_not_simply_hold_once(tmp_path):
    """Conclusions too, where they say what section 4 does not."""
    write_statements(tmp_path, claims(), world(so=False))
    judged = read_statements(tmp_path)
    quoted = [line.partition("“")[2].partition("”")[0] for line in short_answer(judged)[1:]]
    lacking = {row["statement"].rstrip(".") for row in judged if row["verdict"] in (FAILS, HOLDS_IF)}
    assert sorted(quoted) == sorted(lacking) and len(quoted) > 60


def test_a_verdict_stands_with_its_condition_its_rule_and_its_evidence():
    statement = ("7", "4.2", "It jumps.", HOLDS_IF, "H = 21 m; not H = 25 m", "Two.", "at least 1", "doubled grid")
    (cells,) = statements_table([dict(zip(STATEMENT_COLUMNS, statement, strict=True))], "").rows
    assert cells == (*statement[:3], "holds if: H = 21 m; not H = 25 m", "Two.", "at least 1. doubled grid")


def test_tensions_of_fast_and_slow_breaks_have_identical_scales():
    def scales(least):
        forces = enumerate((45e3, 180e3, 315e3, 450e3), 1)
        panels = [LinePanel(f"{k}", N, np.zeros(2), np.array([[least * N, N]]), np.zeros(1)) for k, N in forces]
        return limits(panels, "tension_N")

    assert scales(-0.045) == scales(-0.01)
    assert scales(0.0)[0] == scales(0.0)[1] != scales(0.0)[2] == scales(0.0)[3]
    assert scales(-0.5)[0][0] < -0.5 * 180e3  # nothing is cut off


def test_every_equation_and_every_figure_is_named_in_a_docstring():
    assert [number for kind, number in entries() if kind == "eq."] == list(range(1, 41))
    assert {number for kind, number in entries() if kind == "fig."} == set(range(1, 21)) - {1, 8}


def test_the_notation_page_has_the_equations_of_the_docstrings():
    """Who knows only the paper finds eq. (N): once in the docstrings, and from there in NOTATION.md."""
    page = (ROOT / "NOTATION.md").read_text(encoding="utf-8")
    shown = re.search(r"<!-- equations: begin -->\n(.*)\n<!-- equations: end -->", page, re.DOTALL)
    assert shown and shown[1] == markdown("eq."), "stale: python -m reports.paper.index"


def test_a_paragraph_that_names_neither_is_refused():
    with pytest.raises(ValueError, match="rows 3 to 5"):
        named_in('"""A module.\n\nIn the paper: eq. 7 strain, and more; rows 3 to 5."""\n')
