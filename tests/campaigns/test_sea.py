"""A campaign of seas: what is run, what is refused, the folds between motions, and that nothing is done twice."""

from types import SimpleNamespace

import numpy as np
import pytest

from campaigns import sea
from campaigns.machinery.cli import Running
from campaigns.machinery.plan import Plan
from campaigns.machinery.runner import groups_of
from campaigns.sea import rows as sea_rows
from campaigns.sea.cells import _scatter
from campaigns.sea.regular import design_loads, folds_of, regular_order
from engine import load_scene
from reports import build
from tables import Column
from tests.campaigns.conftest import built_twice, finished, order_of, ran, rows_of

SMALL = "water.depth_m=23 buoy.submergence=full waves.jonswap.components=4 tether.nodes=5"
SHORT = ["--set", *SMALL.split(), "--no-regular", "--hours", "0.03", "--transient", "5", "--most-hours", "0"]
WORDS = [*SHORT, "--set", f"{sea.HEIGHT}=1"]


@pytest.fixture(scope="module")
def small(tmp_path_factory):
    out = tmp_path_factory.mktemp("sea")
    return out, ran(sea, out, *WORDS, "--seeds", 2, "--starts", 3)


def test_every_start_runs_in_every_sea_and_one_run_is_finer(small):
    _, rows = small
    plain = [(row["sea"], row["start"]) for row in rows if not row["solver"]]
    assert plain == [(str(seed), str(start)) for seed in (1, 2) for start in (0, 1, 2)]
    assert [row["sea"] for row in rows if row["solver"]] == ["1"]
    assert {row["status"] for row in rows} == {"ok"}


@pytest.mark.parametrize(("dimensions", "heading"), [(2, np.pi), (3, 0.5 * np.pi)])
def test_regular_waves_go_where_most_of_the_sea_goes(tmp_path, dimensions, heading):
    """In a current the load depends on it."""
    waves = []
    for amplitude_m, towards in ((0.5, heading), (0.4, heading), (0.3, heading - np.pi)):
        waves.append({"period_s": 5.0 + amplitude_m, "amplitude_m": amplitude_m, "direction_rad": towards})
    changes = {"waves": {"period_s": 5.0, "components": waves}, "motion.dimensions": dimensions}
    (tmp_path / "listed.toml").write_text(load_scene("tethered_buoy", changes).to_toml())
    order = order_of(sea, "--scene", tmp_path / "listed.toml", "--hours", 0.1, "--out", tmp_path / "new")
    regular = regular_order(order)
    assert not order.faults and not regular.faults
    for case in regular.cases:
        assert np.exp(1j * case.scene.waves.direction_rad) == pytest.approx(np.exp(1j * heading))


def test_seas_that_go_elsewhere_have_no_regular_waves_in_common(tmp_path):
    waves = "waves.components=[{period_s=5,amplitude_m=0.3,direction_rad=0},{period_s=6,amplitude_m=0.2}]"
    words = "--set", waves, "--no-regular", "--hours", 0.1, "--out", tmp_path / "new"
    key = "waves.components[0]."
    assert regular_order(order_of(sea, *words, "--vary", f"{key}amplitude_m", 0.3, 0.4, 2)) is not None
    assert regular_order(order_of(sea, *words, "--vary", f"{key}direction_rad", 0, np.pi, 2)) is None


@pytest.mark.parametrize("height_m", [1.2, 1.2e-3, 1.6e-4])
def test_among_the_regular_waves_is_that_of_the_significant_height_on_any_scale(tmp_path, height_m):
    changes = "--set", f"{sea.HEIGHT}={height_m}", "--seeds", 1, "--hours", 0.1
    regular = regular_order(order_of(sea, *changes, "--out", tmp_path / "new"))
    amplitudes_m = np.array([case.scene.waves.amplitude_m for case in regular.cases])
    assert np.abs(amplitudes_m / (0.5 * height_m) - 1.0).min() < 1e-4
    (column,) = regular.options.grid.columns
    cells = {column.cell({column.name: amplitude_m}) for amplitude_m in amplitudes_m}
    assert len(cells) == len(set(amplitudes_m))  # each in print differs


@pytest.mark.parametrize(
    ("hours", "most_hours", "carrying", "finer"),
    [
        (0.2, 0, 8, [0.2]),
        (0.5, 0, 4, [0.25] * 2),
        (3, 0, 3, [0.25] * 3),
        (3, 12, 4, [0.25] * 4),
        (3, 13, 5, [0.25] * 4),
    ],
)
def test_long_runs_carry_perturbations_for_the_hours_that_are_needed_and_few_are_finer(
    tmp_path, hours, most_hours, carrying, finer
):
    words = ["--seeds", 8, "--starts", 1, "--hours", hours, "--most-hours", most_hours, "--transient", 0]
    order = order_of(sea, *map(str, words), "--out", tmp_path / "new")
    plain = [case for case in order.cases if not case.labels["solver"]]
    refined = [case for case in order.cases if case.labels["solver"]]
    assert sum(case.scene.output.tangent_vectors for case in plain) == carrying
    assert {case.duration_s for case in plain} == {3600 * hours}
    assert [case.duration_s / 3600 for case in refined] == finer
    assert all(case.scene.output.tangent_vectors for case in refined)


def test_listed_waves_are_one_sea_and_no_other_is_drawn(tmp_path):
    waves = "waves.components=[{period_s=5,amplitude_m=0.3},{period_s=6,amplitude_m=0.2}]"
    order = order_of(sea, "--set", waves, "--no-regular", "--out", tmp_path / "new")
    plain = [(case.labels["sea"], case.labels["start"]) for case in order.cases if not case.labels["solver"]]
    assert plain == [(1, start) for start in range(4)] and order.options.most_hours == 0.0


def test_regular_waves_that_cannot_be_run_end_the_command_before_the_runs_in_the_sea(tmp_path, capsys):
    """The sea may be run, but regular waves of 1.86 times its height are no longer linear."""
    words = [word for word in SHORT if word != "--no-regular"]
    code = sea.main([*words, "--set", f"{sea.HEIGHT}=4", "waves.period_s=20", "--out", str(tmp_path)])
    error = capsys.readouterr().err
    assert code == 1 and not finished(tmp_path)
    assert error.count("Hedges") == 1 and "more with other numbers" in error and "--no-regular" in error


@pytest.mark.parametrize(("workers", "together"), [(2, 4), (3, 4), (4, 3)])
def test_runs_that_share_lanes_go_to_one_worker_and_every_worker_gets_runs(tmp_path, workers, together):
    """together: of the four runs that share lanes, those of one worker."""
    words = "--seeds 12 --starts 1 --hours 3 --most-hours 12".split()
    cases = order_of(sea, *words, "--out", tmp_path / "new").cases
    plan = Plan(Running(tmp_path, workers), None, None, (), simulate_each=print)
    *groups, finer = groups_of(plan, cases)
    assert [case.labels["solver"] for case in finer] == 4 * ["finer"]
    assert len(groups) == workers and all(groups)
    shared = [case.key for group in groups for case in group]
    assert len(set(shared)) == len(shared) == 12
    carrying = []
    for group in groups:
        carrying.append(sum(case.scene.output.tangent_vectors for case in group if not case.labels["solver"]))
    assert (sum(carrying), max(carrying)) == (4, together)


def test_all_starts_of_a_sea_have_the_same_waves(small):
    from engine import Trajectory
    from engine.physics.sea import components_of

    out, rows = small
    waves = {}
    for row in rows:
        scene = Trajectory.load(out / "trajectories" / f"{row['run_key']}.nc").scene
        waves.setdefault(row["sea"], []).append(np.concatenate(components_of(scene)))
    for first, *repeats in waves.values():
        assert all(np.array_equal(first, repeat) for repeat in repeats)
    assert not np.array_equal(waves["1"][0], waves["2"][0])


def test_the_row_of_the_sea_says_what_its_runs_say(small):
    out, rows = small
    (cell,) = rows_of(out, "cells/table.csv")
    from_rest = [row for row in rows if row["start"] == "0" and not row["solver"]]
    assert float(cell["snaps_per_hour"]) == pytest.approx(np.mean([float(row["snaps_per_hour"]) for row in from_rest]))
    assert float(cell["largest_N"]) == pytest.approx(max(float(row["tension_top_max_N"]) for row in from_rest))
    assert float(cell["significant_height_m"]) == pytest.approx(1.0)
    history = rows_of(out, "history/table.csv")
    assert {row["responses"] for row in history} <= {"1", "2", "3"}


def test_snaps_an_hour_of_a_row_are_those_of_its_run(small):
    from engine import Trajectory

    out, rows = small
    counted = 0
    for row in rows:
        run = Trajectory.load(out / "trajectories" / f"{row['run_key']}.nc")
        transient_s = 5.0 * run.scene.waves.period_s
        snaps = run.snaps(transient_s=transient_s)
        hours = (run["time_s"][-1] - transient_s) / 3600.0
        assert float(row["snaps_per_hour"]) == pytest.approx(len(snaps) / hours, rel=1e-2)
        counted += len(snaps)
    assert counted


def test_the_same_command_computes_nothing_again(small):
    out, rows = small
    runs = finished(out)
    assert ran(sea, out, *WORDS, "--seeds", 2, "--starts", 3) == rows and finished(out) == runs
    assert len(ran(sea, out, *WORDS, "--seeds", 1, "--starts", 2)) == 3 and finished(out) == runs


def test_the_report_of_a_sea_is_the_same_when_it_is_drawn_again(small):
    page, _ = built_twice(small[0])
    assert b"Top: distance of the buoy from its anchor" in page and b"Every sea over the whole record" in page


def test_one_start_has_no_picture_of_responses(tmp_path):
    ran(sea, tmp_path, *WORDS, "--seeds", 1, "--starts", 1)
    page = build(tmp_path)[0].read_bytes()
    assert b"Top: distance of the buoy from its anchor" in page and b"Every sea over the whole record" not in page


@pytest.mark.parametrize("second_key", [[], ["waves.jonswap.peak_enhancement", 1, 5, 2]], ids=["a row", "a map"])
def test_every_state_of_a_map_has_a_row(tmp_path, second_key):
    ran(sea, tmp_path, *SHORT, "--seeds", 1, "--starts", 1, "--vary", sea.HEIGHT, 0.5, 1.5, 2, *second_key)
    cells = rows_of(tmp_path, "cells/table.csv")
    assert [float(cell["significant_height_m"]) for cell in cells] == pytest.approx(
        sorted([0.5, 1.5] * (len(cells) // 2))
    )
    build(tmp_path)


def run_from_rest(seed, value, error, **entries):
    row = {"waves.period_s": 5.0, "sea": seed, "start": 0, "solver": "", "status": "ok"}
    return row | {sea_rows.TANGENT[0].name: value, sea_rows.TANGENT[1].name: error} | entries


def test_an_exponent_within_three_errors_of_zero_is_unclear():
    """By the errors of the seas, or by the scatter of three; a kicked and a finer run do not count."""
    (key,) = sea_rows.columns_of((Column("waves.period_s", "s", "T", "period"),))[:1]

    def unclear(*values_and_errors):
        rows = [run_from_rest(seed, *pair) for seed, pair in enumerate(values_and_errors)]
        rows += [run_from_rest(0, 9.0, 0.1, start=1), run_from_rest(0, 9.0, 0.1, solver="finer")]
        return sea_rows.unclear_places(rows, [key]) == {(5.0,)}

    assert not unclear((0.29, 0.09)) and unclear((0.26, 0.09)) and unclear((-0.26, 0.09))
    assert not unclear((0.2, 0.09), (0.2, 0.09)) and unclear((0.18, 0.09), (0.18, 0.09))
    assert unclear((0.1, 0.001), (0.3, 0.001), (0.5, 0.001)) and not unclear((0.2, 0.001), (0.3, 0.001), (0.4, 0.001))
    assert unclear((None, None), (0.1, 0.09)) and not unclear((None, None))


def test_a_state_without_a_clear_sign_gets_twice_as_many_seas_from_rest_and_a_second_call_computes_nothing(
    tmp_path, monkeypatch, capsys
):
    monkeypatch.setattr(sea_rows, "CLEAR", 1e9)
    longer = "--hours 0.06 --most-hours 0.42 --seeds 2 --starts 2"
    words = [*SHORT, *longer.split(), "--vary", sea.HEIGHT, 0.5, 1.5, 2]
    rows = ran(sea, tmp_path, *words)
    assert "18: 18 computed, 0 found" in capsys.readouterr().out
    runs = [(float(row[sea.HEIGHT]), int(row["sea"]), int(row["start"])) for row in rows]
    seeds = [(seed, start) for seed in (1, 2) for start in (0, 1)] + [(seed, 0) for seed in range(3, 8)]
    assert sorted(runs) == sorted((height, *pair) for height in (0.5, 1.5) for pair in seeds)
    assert [cell["seas"] for cell in rows_of(tmp_path, "cells/table.csv")] == ["7", "7"]
    files = finished(tmp_path)
    assert ran(sea, tmp_path, *words) == rows and finished(tmp_path) == files


def test_a_key_of_the_spectrum_alone_leaves_the_usual_height():
    usual, fewer = (order_of(sea, *words) for words in ([], ["--set", "waves.jonswap.components=8"]))
    heights = {order.cases[0].scene.waves.jonswap.significant_height_m for order in (usual, fewer)}
    assert len(heights) == 1 and fewer.cases[0].scene.waves.jonswap.components == 8


def motion(amplitude, letter, tension):
    lengths = {"radius_min_m": 20.0, "radius_max_m": 21.0, "angle_min_rad": -0.1, "angle_max_rad": 0.1}
    return {"waves.amplitude_m": amplitude, "motion": letter, "status": "ok", "tension_top_max_N": tension, **lengths}


FOLDED = [motion(a, "A", 1000.0 * (1 + a)) for a in (0.2, 0.4, 0.6, 0.8)]
FOLDED += [motion(a, "B", 4000.0 * (1 + a)) for a in (0.6, 0.8, 1.0, 1.2)]


def test_folds_lie_where_the_motions_end():
    folds = folds_of(FOLDED, ())
    ends = pytest.approx(0.5, abs=2e-3), pytest.approx(0.9, abs=2e-3)
    assert (folds.jump(False), folds.jump(True)) == ends
    assert folds.is_large(np.array([0.6, 0.6, 0.1]), np.array([3190.0, 3210.0, 3210.0])).tolist() == [False, True, True]
    end = {"motion": "A", "end": "upper", "waves.amplitude_m_end": 0.83, "leads_to": "B"}
    folds = folds_of(FOLDED, [end])
    assert folds.jump(True) == pytest.approx(0.83, abs=2e-3)
    follows = folds.forecast(np.array([0.3, 0.7, 0.95, 0.7, 0.45]), False)
    assert follows.tolist() == [False, False, True, True, False]


def test_waves_of_one_motion_have_no_folds():
    assert folds_of(FOLDED[:4], ()) is None
    assert folds_of([*FOLDED[:4], motion(0.4, "B", 1450.0)], ()) is None


def test_a_design_wave_between_two_waves_of_the_sweep_bears_what_lies_between():
    assert design_loads(FOLDED, 0.61) == [("A", 1600.0), ("B", 6400.0)]
    assert design_loads(FOLDED, 0.7) == [("A", pytest.approx(1700.0)), ("B", pytest.approx(6800.0))]
    assert design_loads(FOLDED, 0.52) == [("A", pytest.approx(1520.0)), ("B", 6400.0)]
    assert design_loads(FOLDED, 0.48) == [("A", pytest.approx(1480.0))]
    # lengths have no scale of their own
    small = [row | {"waves.amplitude_m": 0.1 * row["waves.amplitude_m"]} for row in FOLDED]
    assert design_loads(small, 0.052) == [("A", pytest.approx(1520.0)), ("B", 6400.0)]
    assert design_loads(FOLDED, 1.5) == design_loads((), 0.5) == []


def test_a_map_over_steepness_and_width_draws_every_state_anew_by_its_seed_and_a_single_wave_once():
    words = "--vary waves.significant_steepness 0.05 0.1 2 --vary waves.relative_width 0 0.05 2 --seeds 2 --starts 1"
    drawn = []
    for case in order_of(sea, *words.split()).cases:
        waves = case.scene.waves
        drawn.append((waves.significant_steepness, waves.relative_width, case.labels["sea"], waves.seed))
    states = [(0.0, 1, 0), (0.05, 1, 1), (0.05, 2, 2)]
    assert drawn == [(steepness, *state) for steepness in (0.05, 0.1) for state in states]


def test_runs_in_the_same_waves_scatter_over_the_length_of_the_shortest():
    """Largest tensions of 3 and 2 up to there; a sea of one run does not count."""
    tensions_N = (1, [1.0, 3.0, 2.0, 9.0]), (1, [1.0, 2.0]), (2, [7.0, 8.0])
    runs = [SimpleNamespace(row={"sea": sea}, high_N=np.array(values_N)) for sea, values_N in tensions_N]
    assert _scatter(runs) == pytest.approx(1.0 / 2.5)
