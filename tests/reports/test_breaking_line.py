"""The breaking-line report: it says what limits the runs, needs nothing but its folder, and is the same each time."""

import csv
import re
import shutil

import pytest

from campaigns import breaking_line
from reports import build
from tests.campaigns.breaking_line.test_campaign import failing
from tests.campaigns.conftest import rows_of

SMALL = ["--no-companions", "--backend", "threading", "--jobs", "2", "--no-report", "--set", "tether.nodes=101"]


def made(place, *words, simulate=None):
    assert breaking_line.main([*words, "--out", str(place)], simulate=simulate) == 0
    return place


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    return made(tmp_path_factory.mktemp("break") / "out", "--cases", "1", "4", "1p", "4p", *SMALL)


def text_of(folder):
    """The words of its report."""
    page, pdf = (path.read_bytes() for path in build(folder))
    assert not re.search(rb"(?:src|href)=\"https?:", page) and pdf[:4] == b"%PDF"
    return " ".join(re.sub(r"<[^>]+>", " ", re.sub(r"base64,[A-Za-z0-9+/=]+", "", page.decode())).split())


def test_the_papers_figures_its_statements_and_the_animation_are_there(study):
    text = text_of(study)
    assert all(f"fig. {figure} of the paper" in text for figure in range(2, 8)) and "Fronts and shocks" in text
    judged = {row["statement"]: row["verdict"] for row in rows_of(study, "statements.csv")}
    assert all(statement in text for statement in judged)
    assert judged["The maximum speed does not depend on the fracture time."] == "holds"
    assert judged["In slow breaks the kinetic energy is more uniformly distributed."] == "does not hold"
    assert (study / "report.html").read_text(encoding="utf-8").count("data:image/gif") == 1


@pytest.mark.slow
def test_what_limits_the_runs_is_said(study, tmp_path):
    copy = shutil.copytree(study, tmp_path / "copy")
    rows = {row["case"]: row for row in rows_of(copy)}
    (copy / "trajectories" / f"{rows['4']['run_key']}.nc").unlink()
    rows["1"]["max_turn_rad"], rows["4"]["remainder_largest_J"] = "1.5", "1e5"
    with open(copy / "table.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, rows["1"])
        writer.writeheader()
        writer.writerows(rows.values())
    text = text_of(copy)
    assert f"its file {rows['4']['run_key']}.nc is missing" in text and "(b) case 4" not in text
    assert [path.read_bytes() for path in build(copy)] == [path.read_bytes() for path in build(copy)]
    assert "Case 1, 101 nodes turns by 1.50 rad" in text and "budget of case 4 does not close" in text


@pytest.mark.slow
def test_failed_runs_are_told_with_their_reason(tmp_path):
    text = text_of(made(tmp_path / "out", "--cases", "1", "2", "3", *SMALL, simulate=failing))
    assert "newton-failed: no convergence" in text and "a fault of the code" in text


@pytest.mark.slow
def test_without_profiles_energies_or_theory_a_report_is_made(tmp_path):
    bare = ["output.profiles=false", "output.profiles_step_s=none", "output.energy=false"]
    linear = "tether.tension={law='linear', stiffness_N=2e6}"
    folder = made(tmp_path / "out", "--cases", "1", *SMALL, linear, *bare)
    text = text_of(folder)
    assert "motion of a breaking line" not in text and "Energy at the end" not in text
    assert not (folder / "exact.nc").exists()
