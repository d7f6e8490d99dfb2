"""The campaign of the breaking line: what it runs, what a row says, what a failure does; its report."""

import re
from dataclasses import replace

import pytest

from campaigns import breaking_line
from campaigns.breaking_line import CASES, LENGTHS_S
from engine import Trajectory, load_scene
from reports import build
from tests.campaigns.conftest import built_twice, order_of, ran, rows_of


def made(place, *words, simulate=None):
    """The folder of cases, and of more words; on a coarse grid."""
    coarse = ["tether.nodes=101"] if "--set" in words else ["--set", "tether.nodes=101"]
    ran(breaking_line, place, "--no-companions", "--cases", *words, *coarse, simulate=simulate)
    return place


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    return made(tmp_path_factory.mktemp("break"), "1", "4", "1p", "4p")


@pytest.fixture(scope="module")
def rows(study):
    return {row["case"]: row for row in rows_of(study)}


@pytest.fixture(scope="module")
def run_1(study, rows):
    """The run of case 1."""
    return Trajectory.load(study / "trajectories" / f"{rows['1']['run_key']}.nc")


def runs_of(*words):
    return order_of(breaking_line, *words).cases


def of_kind(runs, *kinds):
    return [run for run in runs if run.labels["kind"] in kinds]


@pytest.mark.slow
def test_no_argument_is_the_papers_study():
    runs = runs_of()
    cases = {run.labels["case"]: run for run in of_kind(runs, "case")}
    assert list(cases) == list(CASES)
    for case, run in cases.items():
        force_N = {"1": 45e3, "2": 180e3, "3": 315e3, "4": 450e3}[case[0]]
        assert (run.scene.end.force_decay_s, run.scene.end.force_N[0]) == (0.05 if "p" in case else 0.005, force_N)
        assert run.duration_s == LENGTHS_S[case[0]] and run.scene.water is None
    assert len({run.scene.key() for run in runs}) == len(runs)
    assert {run.labels["case"] for run in of_kind(runs, "straight")} == {"3", "4", "4p"}  # where a shock forms
    assert all(run.scene.gravity_mps2 == 0.0 for run in of_kind(runs, "straight", "series"))


@pytest.mark.slow
def test_both_ends_start_at_one_level(run_1):
    weight_N = 1140.0 * 1.964e-3 * 9.81 * 60.0
    assert run_1.scene.end.force_N[2] == pytest.approx(0.5 * weight_N)
    z_m = run_1.profiles.z_m[0]
    assert abs(z_m[-1]) < 1e-3 * abs(z_m).max()


def test_a_law_without_theory_has_no_straight_lines():
    runs = runs_of("--cases", "4", "--set", "tether.tension={law='linear', stiffness_N=2e6}")
    assert {run.labels["kind"] for run in runs} == {"case", "doubled", "stiffness"}


@pytest.mark.slow
def test_rows(rows):
    assert list(rows) == ["1", "4", "1p", "4p"] and all(row["status"] == "ok" for row in rows.values())
    assert float(rows["1"]["end_speed_mps"]) == pytest.approx(43.16, rel=0.003)
    assert float(rows["4p"]["shock_birth_theory_m"]) == pytest.approx(39.32, abs=0.01)
    assert rows["1"]["shock_birth_theory_m"] == rows["1"]["shock_birth_m"] == ""
    for row in rows.values():
        parts = ("kinetic_J", "strain_J", "gravity_J", "bending_J", "viscous_J", "scheme_space_J", "scheme_time_J")
        total = sum(float(row[name]) for name in parts) + float(row["remainder_J"])
        assert total == pytest.approx(float(row["stored_J"]) + float(row["end_work_J"]), rel=1e-9)
        work, exact = float(row["end_work_J"]), float(row["end_work_theory_J"])
        assert work == pytest.approx(exact, rel=0.25)  # 5 ms: coarse steps


@pytest.mark.slow
def test_failures_are_rows_with_reasons(run_1, tmp_path, capsys):
    """Of three cases the first runs, the second breaks the code, and the third ends early."""

    def failing(scene, periods=None, duration_s=None):
        force_N = round(scene.end.force_N[0])
        if force_N == 180_000:
            raise ZeroDivisionError("a fault of the code")
        if force_N == 315_000:
            return replace(run_1, scene=scene, status="newton-failed", message="no convergence")
        return run_1

    rows = {row["case"]: row for row in rows_of(made(tmp_path, "1", "2", "3", simulate=failing))}
    assert rows["1"]["status"] == "ok"
    assert rows["3"]["status"] == "newton-failed" and rows["3"]["message"] == "no convergence"
    assert rows["3"]["end_speed_mps"] == "" and rows["3"]["end_speed_theory_mps"] != ""
    assert rows["2"]["status"] not in ("ok", "") and "a fault of the code" in rows["2"]["message"]
    assert "failed   2" in capsys.readouterr().out
    text = text_of(tmp_path)
    assert "newton-failed: no convergence" in text and "a fault of the code" in text


def test_the_shipped_scene_is_case_4():
    shipped = load_scene("breaking_line")
    (case,) = runs_of("--cases", "4", "--no-companions")
    assert shipped.end.force_N[2] == pytest.approx(case.scene.end.force_N[2], rel=1e-6)
    assert shipped.end.force_decay_s == case.scene.end.force_decay_s
    assert shipped.tether == case.scene.tether and shipped.solver == case.scene.solver


def text_of(folder):
    """The words of its report."""
    page, _ = build(folder)
    without_pictures = re.sub(r"base64,[A-Za-z0-9+/=]+", "", page.read_text(encoding="utf-8"))
    return " ".join(re.sub(r"<[^>]+>", " ", without_pictures).split())


@pytest.mark.slow
def test_the_papers_figures_its_statements_and_the_animation_are_there(study):
    page, pdf = built_twice(study)
    assert not re.search(rb"(?:src|href)=\"https?:", page) and pdf[:4] == b"%PDF"
    text = text_of(study)
    assert all(f"fig. {figure} of the paper" in text for figure in range(2, 8)) and "Fronts and shocks" in text
    judged = {row["statement"]: row["verdict"] for row in rows_of(study, "statements.csv")}
    assert all(statement in text for statement in judged)
    assert judged["The maximum speed does not depend on the fracture time."] == "holds"
    assert judged["In slow breaks the kinetic energy is more uniformly distributed."] == "does not hold"
    assert (study / "report.html").read_text(encoding="utf-8").count("data:image/gif") == 1


@pytest.mark.slow
def test_without_profiles_energies_or_theory_a_report_is_made(run_1, tmp_path):
    def bare_run(scene, periods=None, duration_s=None):
        return replace(run_1, scene=scene, profiles=None, energy=None)

    bare = ["output.profiles=false", "output.profiles_step_s=none", "output.energy=false"]
    linear = "tether.tension={law='linear', stiffness_N=2e6}"
    folder = made(tmp_path, "1", "--set", linear, *bare, simulate=bare_run)
    text = text_of(folder)
    assert "motion of a breaking line" not in text and "Energy at the end" not in text
    assert not (folder / "exact.nc").exists()
