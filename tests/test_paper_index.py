"""Who knows only the paper finds fig. N and eq. (N) in the notation page, in the code and in the report on it."""

import re
from pathlib import Path

import pytest

from reports.paper.figures import NUMBERS
from reports.paper.index import EQUATIONS, FIGURES, index_items
from reports.parts.content import Table

ROOT = Path(__file__).resolve().parents[1]
NOTATION = (ROOT / "NOTATION.md").read_text(encoding="utf-8")
LISTED = [*EQUATIONS, *FIGURES]


def test_every_equation_and_every_figure_is_listed_once_and_in_order():
    assert [where for where, *_ in EQUATIONS] == [f"eq. ({number})" for number in range(1, 41)]
    assert [where for where, *_ in FIGURES] == [f"fig. {number}" for number in NUMBERS]


@pytest.mark.parametrize(("where", "what", "code", "more"), LISTED, ids=[where for where, *_ in LISTED])
def test_the_notation_page_leads_to_the_code(where, what, code, more):
    rows = [line for line in NOTATION.splitlines() if line.startswith(f"| {where} |")]
    assert len(rows) == 1 and f"| `{code}` |" in rows[0] and more in rows[0].replace("`", "")
    named = [code, *re.findall(r"(?:engine|analysis|docs)/[\w./]+\w", more)]
    assert [path for path in named if not (ROOT / path).exists()] == []


@pytest.mark.parametrize(("where", "code"), [(where, code) for where, _, code, _ in EQUATIONS])
def test_the_code_says_which_equation_it_is(where, code):
    assert where in (ROOT / code).read_text(encoding="utf-8").lower()


def test_the_sketches_are_found_too():
    told = NOTATION + " ".join(item.caption for item in index_items() if isinstance(item, Table))
    assert told.count("fig. 1 (") == told.count("fig. 8 (") == 2


def test_the_report_has_the_same_list():
    rows = [row for item in index_items() if isinstance(item, Table) for row in item.rows]
    assert {row[0] for row in rows} == {where for where, *_ in LISTED}


def test_no_other_equation_is_listed():
    found = re.findall(r"^\| (eq\. \(\d+\)|fig\. \d+) \|", NOTATION, flags=re.MULTILINE)
    assert set(found) == {where for where, *_ in LISTED}
