"""Who knows only the paper finds fig. N and eq. (N): once in the docstrings, and from there in NOTATION.md."""

import re
from pathlib import Path

import pytest

from reports.paper.index import entries, markdown, named_in

NOTATION = (Path(__file__).resolve().parents[1] / "NOTATION.md").read_text(encoding="utf-8")
SKETCHES = {1, 8}


def test_every_equation_and_every_figure_is_named_in_a_docstring():
    assert [number for kind, number in entries() if kind == "eq."] == list(range(1, 41))
    assert {number for kind, number in entries() if kind == "fig."} == set(range(1, 21)) - SKETCHES


def test_the_notation_page_has_the_equations_of_the_docstrings():
    shown = re.search(r"<!-- equations: begin -->\n(.*)\n<!-- equations: end -->", NOTATION, re.DOTALL)
    assert shown and shown[1] == markdown("eq."), "stale: python -m reports.paper.index"


def test_a_paragraph_that_names_neither_is_refused():
    with pytest.raises(ValueError, match="rows 3 to 5"):
        named_in('"""A module.\n\nIn the paper: eq. 7 strain, and more; rows 3 to 5."""\n')
