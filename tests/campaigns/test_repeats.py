"""Runs of a sweep once more: two tighter and finer, the most violent one with its line, and none of them twice."""

import io
from dataclasses import dataclass, replace

import numpy as np
import pytest
from matplotlib.colors import to_rgb
from PIL import Image

from campaigns.buoy_sweep.repeats import (
    AS_RUN,
    COLUMNS,
    EARLY,
    FINER,
    FRAMES,
    PERIODS,
    SHARE,
    TIGHTER,
    chosen,
    first_periods,
    lengths,
)
from campaigns.columns import names
from engine import Trajectory, load_scene
from engine.trajectory import TangentGrowth
from reports.parts.style import VERMILION
from tests.campaigns.conftest import forget, rows_of
from tests.campaigns.fake_engine import FakeEngine, shapes, sines

TOLERANCE_M, GRID_M = 0.02, 4.0  # error of r at rtol 1 and with one element, as sines of their own
REPEATED = ["--periods", "12", "--transient", "2", "--no-report"]
SHOWN = ["--periods", "15", "--transient", "3", "--no-report", "--no-accuracy"]


@dataclass(frozen=True)
class Drifting(FakeEngine):
    """A FakeEngine whose r depends on tolerance and grid, and whose tension on the steepness of the wave."""

    def __call__(self, scene, periods=None, duration_s=None):
        run = super().__call__(scene, periods, duration_s)
        t, nodes = run.columns["time_s"], scene.tether.nodes
        off = (TOLERANCE_M * scene.solver.rtol + GRID_M / (nodes - 1) ** 2) * np.sin(0.7 * t)
        columns = run.columns | {"radius_m": run.columns["radius_m"] + off}
        columns["tension_top_high_N"] = columns["tension_top_high_N"] * (1.0 + scene.waves.steepness)
        return replace(run, columns=columns)


@dataclass(frozen=True)
class Slackening(FakeEngine):
    """Tension with an amplitude of 20 kN times the steepness about a mean: slack where that is beyond the mean."""

    mean_N: float = 500.0
    fails_with_line: bool = False

    def __call__(self, scene, periods=None, duration_s=None):
        super().__call__(scene, periods, duration_s)
        length = periods if periods is not None else duration_s / scene.waves.period_s
        run = sines(scene, length, tension=(self.mean_N, 2e4 * scene.waves.steepness))
        if not scene.output.profiles or periods is None:
            return run
        if self.fails_with_line:
            raise ZeroDivisionError("a fault of the code")
        return replace(run, profiles=shapes(run))


@pytest.fixture
def repeated(sweep):
    """repeated() -> exit code, table of the folder accuracy, steepness of the runs begun."""

    def run():
        code, _, begun = sweep("--steepness", "0.016", "0.05", "0.13", usual=REPEATED, kind=Drifting)
        return code, rows_of(sweep.out / "accuracy"), begun

    run.out = sweep.out
    return run


def test_the_least_and_the_most_violent_run_are_repeated_with_the_errors_that_were_put_in(repeated):
    _, rows, _ = repeated()
    assert [row["steepness"] for row in rows_of(repeated.out)] == ["0.016", "0.05", "0.13"], "a table of its own"
    assert [(row["role"], row["label"]) for row in rows] == 3 * [("regular", "0.016")] + 3 * [("violent", "0.13")]
    assert [row["run"] for row in rows] == 2 * [AS_RUN, TIGHTER, FINER]
    assert {row["periods"] for row in rows} == {str(EARLY)}
    assert set(rows[0]) == set(names(COLUMNS))
    scene = load_scene("tethered_buoy")
    nodes, rtol = scene.tether.nodes, scene.solver.rtol
    rms = np.sqrt(np.mean(np.sin(0.7 * np.arange(1001) * 0.05) ** 2))
    expected = {
        AS_RUN: (nodes, rtol, 0.0),
        TIGHTER: (nodes, rtol / 10, 0.9 * TOLERANCE_M * rtol * rms),
        FINER: (2 * nodes - 1, rtol, 0.75 * GRID_M / (nodes - 1) ** 2 * rms),
    }
    for row in rows:
        found = [float(row[name]) for name in ("nodes", "rtol", "error_early_m")]
        assert found == pytest.approx(expected[row["run"]], rel=1e-6, abs=1e-15)


def test_repeated_again_nothing_is_computed(repeated):
    _, rows, _ = repeated()
    killed_within = [repeated.out / folder / "trajectories" / ".run.nc.1.tmp" for folder in ("accuracy", "")]
    for path in killed_within:
        path.touch()
    assert repeated() == (0, rows, [])
    assert not any(path.exists() for path in killed_within)


def test_a_sweep_that_leaves_it_out_repeats_nothing(sweep):
    assert sweep("--steepness", "0.016", "0.05", kind=Drifting)[0] == 0
    assert not (sweep.out / "accuracy").exists()


def test_a_short_sweep_pays_no_more_than_its_share():
    assert lengths(49, 300) == 300
    assert lengths(8, 300) == pytest.approx(300 * SHARE * 8 / 8.6, abs=1)
    assert lengths(2, 300) == EARLY or lengths(2, 300) <= 300 * SHARE * 2 / 8.6
    assert lengths(2, 4) == 4


def test_runs_that_failed_are_not_chosen():
    good = {"status": "ok", "run_key": "a", "tension_top_max_N": 10.0}
    wild = {"status": "newton-failed", "run_key": "b", "tension_top_max_N": 99.0}
    assert chosen([wild]) == [] and chosen([good, wild]) == [("regular", good)]


def test_a_record_cut_short_keeps_its_first_periods():
    run = sines(load_scene("tethered_buoy", {"output.tangent_vectors": 1}), 40)
    run = replace(run, tangent=TangentGrowth(5.0, np.arange(40.0)[:, None], np.eye(40)[3]))
    short = first_periods(run, 10)
    assert len(short.columns["time_s"]) == 1001 and len(short.tangent.growth_nats) == 10
    assert short.statistics["loop_releases"] == 1
    assert short.statistics["wall_s"] == pytest.approx(run.statistics["wall_s"] / 4, rel=1e-3)
    assert first_periods(run, 40) is run


@pytest.fixture
def close_up(sweep):
    """close_up(**fields of Slackening) -> exit code, table of the folder close_up, steepness of the runs begun."""

    def run(**fake):
        values = ("0.02", "0.05", "0.13")
        code, _, begun = sweep("--steepness", *values, jobs=1, usual=SHOWN, kind=Slackening, **fake)
        return code, rows_of(sweep.out / "close_up") if (sweep.out / "close_up").exists() else None, begun

    run.out = sweep.out
    return run


def test_the_run_that_peaks_highest_is_kept_with_its_line_and_never_twice(close_up):
    code, (row,), begun = close_up()
    assert (code, begun) == (0, [0.02, 0.05, 0.13, 0.13])
    assert (row["steepness"], row["status"], row["periods"]) == ("0.13", "ok", str(PERIODS))
    path = close_up.out / "close_up" / "trajectories" / f"{row['run_key']}.nc"
    kept = Trajectory.load(path)
    assert kept.profiles.time_s == pytest.approx(np.arange(PERIODS * FRAMES + 1) * kept.scene.waves.period_s / FRAMES)
    assert close_up() == (0, [row], [])
    path.unlink()
    assert close_up()[2] == [0.13], "a sweep killed before its last run does that run alone"


def test_a_sweep_without_slack_has_none_and_empties_that_of_an_earlier_one(close_up):
    assert close_up(mean_N=5000.0)[1:] == (None, [0.02, 0.05, 0.13])
    forget(close_up.out)
    close_up()
    forget(close_up.out)
    assert close_up(mean_N=5000.0)[1] == []


def test_a_close_up_that_fails_is_a_row_and_costs_nothing_else(close_up):
    code, (row,), _ = close_up(fails_with_line=True)
    assert (code, row["status"]) == (0, "error")


@pytest.mark.slow
def test_the_report_shows_it_moving_and_as_stills_the_same_each_time(close_up):
    from reports.buoy_sweep.close_up import close_up_items

    close_up()
    heading, figure = close_up_items(close_up.out)
    assert figure.picture.kind == "svg" and figure.moving.data.startswith(b"GIF89a")
    assert "kA = 0.13" in figure.caption and len(figure.moving.data) < 1e6
    assert close_up_items(close_up.out) == [heading, figure]
    with Image.open(io.BytesIO(figure.moving.data)) as moving:
        colours = np.array([colour for _, colour in moving.convert("RGB").getcolors(1 << 20)])
    for wanted in ("#ffffff", VERMILION):  # paper, and the small dot that marks the moment
        off = np.abs(colours - 255 * np.array(to_rgb(wanted))).sum(axis=1)
        assert off.min() < 60, "20 of 256 in each of red, green and blue; brown instead of vermilion is 177 off"
