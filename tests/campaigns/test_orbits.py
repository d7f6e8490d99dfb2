"""`campaigns.orbits`: the orbits under motions, along a key; where orbits say that a motion ends."""

from dataclasses import replace

import numpy as np
import pytest

from campaigns import orbits
from campaigns.explore.grid import varied
from campaigns.explore.motions import MOTION
from campaigns.explore.tracing import Line, Scenes, line_task, work
from campaigns.machinery.cli import Running
from campaigns.machinery.plan import Plan
from campaigns.orbits import main
from campaigns.orbits.tree import _on, _same
from engine import load_scene, simulate
from engine.scene.finer import finer
from reports.orbits.report import report
from reports.parts.content import Figure, Table
from tables import RUN_KEY, write_table
from tests.campaigns.conftest import finished, order_of, rows_of
from tests.reports.conftest import of_kind

QUICK = ["--set", "tether.nodes=9", "water.depth_m=25", "--vary", "waves.steepness", "0.1", "0.12", "--values", "2"]


def key_of(name):
    return varied([name, "1", "50", "2"], [])


def loops(line, *given):
    raise ArithmeticError("a loop is released")


def doubles(line, value):
    return {"reason": "", "value": 2.0 * value}, [np.array([[value]])]


def test_a_result_is_kept_under_a_key_of_all_that_it_rests_on(tmp_path):
    scene = load_scene("tethered_buoy", {"tether.nodes": 9})
    line = Line(Scenes(scene, key_of("waves.steepness")), 0.1, 0.2, 0.1, Digest(), 0.1)
    plan = Plan(Running(tmp_path, 1, "threading"), None, None, ())
    task = line_task(doubles, line, (0.3,))

    def result_of(task):
        ((pair,), reused) = work(plan, tmp_path / "kept", "doubling", [task])
        return pair, reused

    assert result_of(task) == (({"reason": "", "value": 0.6}, [[[0.3]]]), 0)
    assert result_of(task) == (({"reason": "", "value": 0.6}, [[[0.3]]]), 1)
    assert result_of(line_task(loops, line, (0.3,))) == (({"reason": "a loop is released"}, []), 0)
    lines = [replace(line, **{name: 0.15}) for name in ("low", "high", "size", "value", "rtol")]
    lines += [replace(line, nodes=17), replace(line, scenes=Scenes(finer(scene, 2), line.scenes.key))]
    lines += [replace(line, scenes=Scenes(scene, key_of("water.depth_m")))]
    keys = {line_task(doubles, other, (0.3,)).key for other in (line, *lines)}
    assert len(keys | {line_task(doubles, line, (0.4,)).key}) == len(lines) + 2, "a key has all that a result rests on"


class Digest:
    """Stands for a state."""

    def digest(self):
        return "of a state"


def test_scenes_along_a_key_and_along_an_element_of_a_list():
    scene = load_scene("tethered_buoy")
    assert Scenes(scene, key_of("water.depth_m"))(23.5).water.depth_m == 23.5
    kicked = Scenes(scene, key_of("start.buoy_velocity_mps[2]"))
    assert kicked(1.5).start.buoy_velocity_mps == (0.0, 0.0, 1.5)
    assert Scenes(scene, key_of("tether.nodes"))(20.5) is None


def test_an_orbit_lies_on_a_branch_begun_at_any_strobe():
    begin = np.array([[20.0, 1.0], [21.0, 2.0], [22.0, 3.0]])
    chord = [{"seen": begin + share, "value": 0.1 + 0.1 * share} for share in (0.0, 1.0)]
    seen = np.roll(begin + 0.5, 2, axis=0)
    assert _on(chord, 0.15, seen, 0.1) and not _on(chord, 0.25, seen, 0.1)
    assert not _on(chord, 0.15, seen + 1.0, 0.1) and not _on(chord, 0.15, seen[:1], 0.1)
    assert _same(seen, begin + 0.5) and not _same(seen, begin) and not _same(seen, seen[:1])


def test_a_letter_that_no_search_of_the_same_runs_has_given_is_refused(tmp_path):
    words = [*QUICK, "--out", tmp_path]
    jobs = order_of(orbits, *words).cases

    def found(*run_keys):
        (tmp_path / "motions").mkdir(exist_ok=True)
        rows = [{"run_key": key, "motion": letter} for key, letter in zip(run_keys, "CA", strict=True)]
        write_table(tmp_path / "motions" / "table.csv", (RUN_KEY, MOTION), rows)

    def faults_of(letter):
        orbits.read_order([*map(str, words), "--motion", letter], faults := [])
        return faults

    (fault,) = faults_of("C")
    assert fault.endswith("there now: none")
    found(*(job.key for job in jobs))
    assert faults_of("C") == []
    (fault,) = faults_of("B")
    assert fault.endswith("there now: A, C")
    found(jobs[0].key, "of another scene")
    assert len(faults_of("C")) == 1


@pytest.mark.slow
def test_the_orbits_of_a_small_range_are_found_followed_and_not_computed_again(tmp_path, capsys):
    """41 nodes give |μ| = .92 and .91 at kA = 0.10 and 0.12, with the pair that the runs' exponents show."""
    words = [*QUICK, "--no-accuracy", "--no-report", "--out", str(tmp_path)]
    assert main(words) == 0
    rows, (branch,) = rows_of(tmp_path), rows_of(tmp_path, "branches/table.csv")
    assert (branch["branch"], branch["motion"], branch["status"]) == ("1", "A", "ok")
    assert all(branch[side].startswith("reaches the end of the range") for side in ("begins", "ends"))
    values = [float(row["waves.steepness"]) for row in rows]
    assert min(values) == 0.1 and max(values) == 0.12 and sorted(values) in (values, values[::-1])
    modulus = [float(row["multiplier_modulus"]) for row in rows]
    assert all(0.88 < value_of < 0.95 for value_of in modulus) and all(row["unstable"] == "0" for row in rows)
    assert max(float(row["gap"]) for row in rows) < 1e-6
    (orbit,) = rows_of(tmp_path, "orbits/table.csv")
    assert 0.0 < float(orbit["multiplier_1_error"]) < 0.02 and (tmp_path / "orbits" / "1_0.csv").exists()
    assert {row["status"] for row in rows_of(tmp_path, "motions/table.csv")} == {"ok"}
    files = finished(tmp_path, "branches/*.json")
    (tmp_path / "table.csv").unlink()
    capsys.readouterr()
    assert main(words) == 0 and finished(tmp_path, "branches/*.json") == files
    assert rows_of(tmp_path) == rows and "0 computed" in capsys.readouterr().out
    assert main([*words, "--motion", "B"]) == 2 and "there now: A\n" in capsys.readouterr().err
    assert main([*words, "--motion", "A"]) == 0 and rows_of(tmp_path) == rows
    items = report(tmp_path).items
    assert of_kind(items, Figure) and of_kind(items, Table)
    run = next((tmp_path / "motions" / "trajectories").glob("*.nc"))
    value_of = ["--vary", "waves.steepness", "0.1", "0.12", "--start-from", str(run), "--orbits", "1"]
    assert main([*value_of, "--no-accuracy", "--no-report", "--out", str(tmp_path / "one")]) == 0
    assert len(rows_of(tmp_path / "one")) <= 3


def test_a_run_that_goes_on_late_begins_orbits_by_its_own_second_half(tmp_path):
    """Its second half begins after the middle of the time that has passed since the earlier run began."""
    scene = load_scene("tethered_buoy", {"waves.steepness": 0.08, "tether.nodes": 7})
    simulate(scene, periods=40, start=simulate(scene, periods=100)).save(tmp_path / "late.nc")
    words = ["--vary", "waves.steepness", "0.07", "0.09", "--start-from", str(tmp_path / "late.nc")]
    order = order_of(orbits, *words)
    ((_, steepness, period, state),) = orbits._under_file(order, order.cases[0])
    assert (steepness, period) == (0.08, 3) and state.time_s == 0.0


@pytest.mark.slow
def test_a_sweep_has_a_row_for_each_motion_with_multipliers_and_the_fold_at_which_it_ends(tmp_path, capsys):
    """H = 25 m: the period 3 is an island that begins at a fold at kA = 0.12087 (81 nodes: the same to 2e-4)."""
    from campaigns.buoy_sweep import main as sweep

    words = ["--set", "water.depth_m=25", "--steepness", "0.12", "0.13", "--no-report"]
    words += ["--starts", "2", "--out", str(tmp_path)]
    assert sweep(words) == 0
    rows, starts = rows_of(tmp_path), rows_of(tmp_path, "starts/table.csv")
    assert [(row["steepness"], row["motion"]) for row in rows] == [("0.12", "A"), ("0.13", "A"), ("0.13", "B")]
    assert all(float(row["share_low"]) <= float(row["share"]) <= float(row["share_high"]) for row in rows)
    assert {row["motion"] for row in starts} == {"A", "B"} and {row["status"] for row in starts} == {"ok"}
    assert sweep(words) == 0 and "3: 0 computed, 3 found" in capsys.readouterr().out
    assert rows_of(tmp_path) == rows and rows_of(tmp_path, "starts/table.csv") == starts
    _, value_of, three = rows
    assert (value_of["regime"], three["regime"]) == ("period-1", "period-3")
    for row, pull_N in ((value_of, 4205), (three, 5625)):
        assert float(row["tension_top_max_N"]) == pytest.approx(pull_N, abs=25)
    assert float(value_of["multiplier_modulus"]) == pytest.approx(
        0.9005, abs=float(value_of["multiplier_error"]) + 5e-3
    )
    assert float(three["multiplier_angle_rad"]) == pytest.approx(np.pi)
    # 21 meshes, at seven tolerances from .003 to .0005, give .735 with a standard deviation of .03
    assert float(three["multiplier_modulus"]) == pytest.approx(0.735, abs=float(three["multiplier_error"]) + 0.03)
    assert "leading multiplier -0.7" in three["regime_reason"]
    (end,) = (row for row in rows_of(tmp_path, "ends/table.csv") if row["motion"] == three["motion"])
    assert end["kind"] == "fold" and float(end["steepness_end"]) == pytest.approx(0.12087, abs=2e-4)


@pytest.mark.slow
def test_a_large_motion_has_an_orbit_through_the_releases_of_its_loops(tmp_path):
    """H = 21 m, kA = 0.142: one release in six periods. Steps over six periods shrink from 0.0226 of the motion to
    0.0004 in 90 periods of a run from rest, so that |mu| = 0.764."""
    from campaigns.buoy_sweep import main as sweep

    words = ["--set", "water.depth_m=21", "--steepness", "0.142", "--no-accuracy", "--no-report"]
    assert sweep([*words, "--starts", "rest", "--out", str(tmp_path)]) == 0
    (row,) = rows_of(tmp_path)
    assert row["regime"] == "period-6" and float(row["loop_releases"]) > 20
    assert float(row["multiplier_modulus"]) == pytest.approx(0.764, abs=float(row["multiplier_error"]) + 0.02)
