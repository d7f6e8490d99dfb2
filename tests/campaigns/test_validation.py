"""The validation campaign: its closed forms have known limits, its measures find what was put in, a verdict is what its
bar says, and a small campaign works to its report and is not done twice."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from campaigns import validation
from campaigns.machinery.cli import Running
from campaigns.validation import families
from campaigns.validation.cases import CASES, HOLDS, JUDGED, MISSES, NOT_RUN, QUICK, TOLD, Case
from campaigns.validation.exact import Catenary, catenary, frequencies
from campaigns.validation.families import Number
from campaigns.validation.judging import verdict
from engine import load_scene
from reports import build
from reports.parts.folder import FolderError
from reports.validation.report import read_study
from tables import write_table
from tests.campaigns.conftest import ran, rows_of

TAUT = Catenary(H=400.0, V=0.0, w=1e-7, EA=1e4, m=0.5, length=10.0)
PERIOD_S = 2.5
BARRED = Case("x", "a case", "peer", "a source", bars={"rms": (1.0, "N")})


def wave(t):
    return np.sin(2 * np.pi * t / PERIOD_S) + 0.3 * np.cos(4 * np.pi * t / PERIOD_S)


def test_a_weightless_catenary_is_a_string_and_a_bar():
    """Frequencies j/(2 L) sqrt(T/((1 + eps) m)) across and j/(2 L) sqrt(EA/m) along, L unstretched."""
    across, along = (np.arange(1, 9) / 20.0 * np.sqrt(force / 0.5) for force in (400.0 / 1.04, 1e4))
    expected = np.sort(np.concatenate([across, along]))[:8]
    assert frequencies(TAUT, 8) == pytest.approx(expected, rel=1e-7)
    assert TAUT.place(np.array([10.0]))[:, 0] == pytest.approx([10.4, 0.0], abs=1e-6)


@pytest.mark.parametrize("gravity_mps2", [3.7, 9.81])
@pytest.mark.parametrize("end", [[14.0, 0.0, 0.0], [12.0, 0.0, 10.0], [22.0, 0.0, -5.0]])
def test_a_catenary_ends_where_the_line_is_held_and_its_ends_carry_its_weight(end, gravity_mps2):
    changes = {"end.position_m": end, "gravity_mps2": gravity_mps2, "tether.tension.stiffness_N": 100.0}
    line = catenary(load_scene("hanging_line", changes))
    places = line.place(np.array([0.0, line.length]))
    assert places.T == pytest.approx(np.array([[0.0, 0.0], [end[0], end[2]]]), abs=1e-8)
    assert line.w * line.length == pytest.approx(1140.0 * 7.85e-5 * gravity_mps2 * 20.0)
    below, above = (math.sqrt(line.tension(s) ** 2 - line.H**2) for s in (0.0, line.length))
    assert above + math.copysign(below, -line.V) == pytest.approx(line.w * line.length, rel=1e-9)


def test_a_shift_in_time_is_found_and_leaves_nothing_over():
    t = np.arange(0.0, 30.0, 0.001)
    steady = families.over_a_period(t, wave(t), PERIOD_S, 4)
    at = np.arange(0.0, 8.0, 0.1)
    ours, shift_s = families.shifted(steady, PERIOD_S, at, wave(at + 0.6))
    assert shift_s == pytest.approx(0.6, abs=PERIOD_S / families.SHIFTS)
    assert families.rms(ours - wave(at + 0.6)) < 5e-3
    with pytest.raises(ValueError, match="12 periods"):
        families.over_a_period(t[:-1], wave(t[:-1]), PERIOD_S, 12)


@pytest.mark.parametrize(("case", "beginning_kN"), [("jumper-4", 0.32), ("jumper-5", 0.15), ("jumper-6", 0.21)])
def test_a_record_in_waves_repeats_from_its_second_period_on(case, beginning_kN):
    """Its second period is like its third, within what digitising costs; its first is not: a run that is the second
    one for ever is near only there.
    """
    rows, t = families.table("lowe_langley.csv"), np.linspace(0.0, 10.0, 201)
    _, time_s, tension_kN = rows[rows[:, 0] == CASES[case].options["record"]].T
    first, second, third = (np.interp(i * 10.0 + t[:198], time_s, tension_kN) for i in range(3))
    assert families.rms(second - first) == pytest.approx(beginning_kN, abs=0.01)
    assert (digitising := families.rms(third - second)) < 0.11
    columns = {"time_s": t, "tension_top_N": 1e3 * np.interp(10.0 + t, time_s, tension_kN)}
    run = SimpleNamespace(scene=CASES[case].jobs()[0].scene, columns=columns)
    whole, later = (number.error for number in families.computed_history(CASES[case], [run]).numbers.values())
    assert later < digitising and later < whole


def test_largest_tensions_a_tenth_above_those_measured_differ_by_ten_per_cent():
    case, runs, t = CASES["lindahl-maxima"], [], np.linspace(0.0, 60.0, 6001)
    measured_N = {(period, radius): largest for period, radius, largest in families.table("lindahl_maxima.csv")}
    for job in case.jobs():
        motion = job.scene.end.motion
        tension_N = np.full_like(t, 1.1 * measured_N[motion.period_s, motion.radius_m])
        columns = {"time_s": t, "tension_top_N": tension_N, "tension_top_high_N": tension_N}
        runs.append(SimpleNamespace(scene=job.scene, columns=columns))
    assert families.measured_maxima(case, runs).numbers["maxima, mean size"].error == pytest.approx(10.0)


def test_the_peak_of_a_sine_is_found_between_the_lines_of_a_spectrum():
    t = np.arange(0.0, 100.0, 0.05)
    power = np.abs(np.fft.rfft(np.hanning(len(t)) * np.sin(2 * np.pi * 0.3137 * t))) ** 2
    assert families.peak_near(np.fft.rfftfreq(len(t), 0.05), power, 0.31) == pytest.approx(0.3137, abs=2e-4)


@pytest.mark.parametrize(
    ("number", "quantity", "word"),
    [
        (Number("1", "2", 1.0), "rms", HOLDS),
        (Number("1", "2", 1.0 + 1e-9), "rms", MISSES),
        (Number("1", "2", np.nan), "rms", MISSES),
        (Number("1", "2", 9.0, "N"), "another", TOLD),
    ],
)
def test_a_verdict_is_what_its_bar_says(number, quantity, word):
    assert verdict(BARRED, quantity, number)["verdict"] == word


def test_every_case_has_a_source_a_bar_and_runs_and_measured_maxima_have_their_conditions():
    for case in CASES.values():
        assert case.source and case.bars and (case.not_run or hasattr(families, case.family)), case.name
        assert case.family == "peer" or case.not_run or case.jobs(), case.name
    runs = [job.scene.end.motion for job in CASES["lindahl-maxima"].jobs()]
    assert sorted((motion.period_s, motion.radius_m) for motion in runs) == sorted(
        (period, radius) for period, radius, _ in families.table("lindahl_maxima.csv")
    )
    assert {"lindahl-1.25", "lindahl-3.5", "moordyn"}.isdisjoint(QUICK)


def judged_rows(folder, *words):
    """The rows of cases.csv of a small campaign."""
    assert validation.main([*words, "--backend", "threading", "--jobs", "1", "--out", str(folder)]) == 0
    return {(row["case"], row["quantity"]): row for row in rows_of(folder, "cases.csv")}


def test_a_small_campaign_judges_its_cases_and_is_not_done_twice(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr("campaigns.accuracy.jobs.version", lambda peer: "")
    words = ["--only", "catenary-slack", "whoi-mine", "whoi-waves", "moordyn"]
    rows = judged_rows(tmp_path / "out", *words)
    assert set(next(iter(rows.values()))) == {column.name for column in JUDGED}
    assert {name for name, row in rows.items() if row["verdict"] == NOT_RUN} == {
        ("whoi-waves", "tension"),
        ("moordyn", "distance, rms"),
    }
    judged = [row for row in rows.values() if row["verdict"] != NOT_RUN]
    assert len(judged) == 4 and all(row["verdict"] == HOLDS for row in judged)
    printed = capsys.readouterr().out
    assert "2 of 4 cases hold" in printed and "moordyn" in printed
    assert set(read_study(tmp_path / "out").points) == {"catenary-slack", "whoi-mine"}
    assert rows == judged_rows(tmp_path / "out", *words)
    assert ": 0 computed, 2 found" in capsys.readouterr().out


def test_a_run_that_ends_early_misses_its_bar_and_a_folder_without_cases_is_refused(tmp_path):
    def stopped(scene, periods=None, duration_s=None):
        raise RuntimeError("no such run")

    ran(validation, tmp_path, "--only", "jumper-rest", simulate=stopped)
    (row,) = rows_of(tmp_path, "cases.csv")
    assert (row["verdict"], row["note"]) == (MISSES, "no result")
    (tmp_path / "cases.csv").write_text("case\n")
    with pytest.raises(FolderError, match=r"cases\.csv"):
        build(tmp_path)


def test_amplitudes_of_a_sum_of_oscillations_are_found():
    t, omega = np.arange(0.0, 300.0, 0.1), np.array([0.7, 1.1, 1.2, 0.0])
    record = 0.3 * np.cos(0.7 * t + 1.0) + 0.02 * np.sin(1.1 * t) + 1.5 * np.cos(1.2 * t) - 4.0
    assert families.amplitudes(t, record, omega) == pytest.approx([0.3, 0.02, 1.5, 4.0])


def test_the_case_nearest_to_its_bar_is_so_by_its_share_of_the_bar(tmp_path):
    """Bars have unlike units."""
    judged = {"quantity": "rms", "unit": "N", "verdict": HOLDS}
    rows = [judged | {"case": name, "error": error, "bar": bar} for name, error, bar in (("a", 9, 90), ("b", 2, 3))]
    write_table(tmp_path / "cases.csv", JUDGED, rows)
    _, nearest = validation.answer(SimpleNamespace(how=Running(tmp_path)), ())
    assert nearest.endswith("b, rms: 2 N, bar 3.")
