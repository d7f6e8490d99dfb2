"""The breaking-line report: its verdicts follow the table, its pages need nothing else, and gaps are said."""

import csv
import re
import shutil

import pytest

from campaigns import breaking_line
from reports import build
from reports.breaking_line.runs import COLUMNS, WORDS, read_lines
from reports.breaking_line.statements import statements_table
from reports.parts.folder import read_folder
from tests.campaigns.test_breaking_line import failing

USUAL = ["--backend", "threading", "--jobs", "2", "--no-report"]
SMALL = ["--no-companions", "--set", "tether.nodes=101"]


def made(place, *words, simulate=None):
    assert breaking_line.main([*words, *USUAL, "--out", str(place)], simulate=simulate) == 0
    return place


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    return made(tmp_path_factory.mktemp("break") / "out", "--cases", "1", "4", "1p", "4p", *SMALL)


@pytest.fixture
def copy(study, tmp_path):
    return shutil.copytree(study, tmp_path / "copy")


def text_of(place):
    return text_in(build(place))


def text_in(files):
    html, pdf = files
    assert pdf.read_bytes()[:4] == b"%PDF"
    page = html.read_text(encoding="utf-8")
    assert not re.search(r"(?:src|href)=\"https?:", page)
    return " ".join(re.sub(r"<[^>]+>", " ", re.sub(r"base64,[A-Za-z0-9+/=]+", "", page)).split())


def change(place, **values):
    """Set columns of the table: column -> {case: value}."""
    with open(place / "table.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    for column, given in values.items():
        for row in rows:
            row[column] = given.get(row["case"], row[column])
    with open(place / "table.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, rows[0])
        writer.writeheader()
        writer.writerows(rows)


def verdicts(place):
    """Statement of the paper -> verdict."""
    return {row[0]: row[2] for row in statements_table(read_lines(read_folder(place, COLUMNS, WORDS))).rows}


SPEED = "The maximum speed does not depend on the fracture time."
KINETIC = "The total kinetic energy depends only on the static tension, not on the fracture time."
FARTHER = "Lines that break at higher tension snap back farther."


@pytest.fixture(scope="module")
def built(study):
    return build(study)


def test_figures_and_answers(built):
    text = text_in(built)
    for figure in range(2, 8):
        assert f"fig. {figure} of the paper" in text
    assert "4 of 4 cases ended as asked" in text
    assert "Case 4 forms a shock, by theory 3.9 m from the broken end" in text
    assert "The kinetic energy does depend on the fracture time" in text
    assert "Case 4 in motion" in text and all(claim in text for claim in (SPEED, FARTHER, KINETIC))


def test_the_page_moves(built):
    assert built[0].read_text(encoding="utf-8").count("data:image/gif") == 1


def test_verdicts_follow_the_table(study, copy):
    found = verdicts(study)
    assert (found[SPEED], found[FARTHER], found[KINETIC]) == ("holds", "holds", "does not hold")
    change(copy, end_speed_mps={"4p": "200.0"}, recoil_120ms_m={"4": "1.0"}, kinetic_largest_J={"1p": "94002.0"})
    found = verdicts(copy)
    assert all(found[claim].startswith("holds if: ") for claim in (SPEED, FARTHER, KINETIC))
    assert found[SPEED].endswith("; not 4 and 4′")
    change(copy, end_speed_mps={"4p": "200.0", "1p": "40.0"}, status=dict.fromkeys(("1", "4"), "newton-failed"))
    assert verdicts(copy)[SPEED] == "–"


@pytest.mark.slow
def test_what_limits_the_runs_is_said(copy):
    with open(copy / "table.csv", newline="") as file:
        key = next(row["run_key"] for row in csv.DictReader(file) if row["case"] == "4")
    (copy / "trajectories" / f"{key}.nc").unlink()
    change(copy, max_turn_rad={"1": "1.5"}, remainder_largest_J={"4": "1e5"})
    text = text_of(copy)
    assert f"its file {key}.nc is missing" in text and "(b) case 4" not in text
    assert "Case 1, 101 nodes turns by 1.50 rad within one element" in text
    assert "The energy budget of case 4 does not close" in text


def test_failed_runs_are_told_with_their_reason(tmp_path):
    text = text_of(made(tmp_path / "out", "--cases", "1", "2", "3", *SMALL, simulate=failing))
    assert "1 of 3 cases ended as asked" in text
    assert "newton-failed: no convergence" in text and "a fault of the code" in text


def test_without_profiles_energies_or_theory_a_report_is_made(tmp_path):
    linear = "tether.tension={law='linear', stiffness_N=2e6}"
    bare = ["output.profiles=false", "output.profiles_step_s=none", "output.energy=false"]
    words = ["--cases", "1", "--no-companions", "--set", "tether.nodes=101", linear, *bare]
    text = text_of(made(tmp_path / "out", *words))
    assert "1 of 1 case ended as asked" in text
    assert "Fronts and shocks" not in text and "fig. 2" not in text


@pytest.mark.slow
def test_the_same_folder_gives_the_same_bytes(study, built):
    first = [path.read_bytes() for path in built]
    assert first == [path.read_bytes() for path in build(study)]
