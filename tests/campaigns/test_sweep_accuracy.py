"""A sweep's own error: two of its runs again, tighter and finer, and what is said of them."""

import csv
from dataclasses import dataclass, replace

import numpy as np
import pytest

from campaigns import buoy_sweep
from campaigns.buoy_sweep.repeats import AS_RUN, COLUMNS, EARLY, FINER, SHARE, TIGHTER, chosen, first_periods, lengths
from campaigns.columns import names
from engine import load_scene
from engine.trajectory import TangentGrowth
from tests.campaigns.conftest import rows_of
from tests.campaigns.fake_engine import FakeEngine, sines

TOLERANCE_M, GRID_M = 0.02, 4.0  # error of r at rtol 1 and with one element, as sines of their own
WORDS = [
    "--steepness",
    "0.016",
    "0.05",
    "0.13",
    "--periods",
    "12",
    "--transient",
    "2",
    "--backend",
    "threading",
    "--no-report",
]


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


@pytest.fixture(scope="module")
def out(tmp_path_factory):
    folder = tmp_path_factory.mktemp("sweep") / "out"
    assert buoy_sweep.main([*WORDS, "--out", str(folder)], simulate=Drifting()) == 0
    return folder


def accuracy_of(folder):
    with open(folder / "accuracy" / "table.csv", newline="") as file:
        return list(csv.DictReader(file))


def test_the_least_and_the_most_violent_run_are_repeated(out):
    rows = accuracy_of(out)
    assert [(row["role"], row["label"]) for row in rows] == 3 * [("regular", "0.016")] + 3 * [("violent", "0.13")]
    assert [row["run"] for row in rows] == 2 * [AS_RUN, TIGHTER, FINER]
    assert {row["periods"] for row in rows} == {str(EARLY)}
    assert set(rows[0]) == set(names(COLUMNS))
    scene = load_scene("tethered_buoy")
    for base, tighter, finer in (rows[:3], rows[3:]):
        assert float(tighter["rtol"]) == pytest.approx(scene.solver.rtol / 10) and tighter["nodes"] == base["nodes"]
        assert int(finer["nodes"]) == 2 * int(base["nodes"]) - 1 and finer["rtol"] == base["rtol"]


def test_errors_are_those_that_were_put_in(out):
    scene = load_scene("tethered_buoy")
    t = np.arange(1001) * 0.05
    rms = np.sqrt(np.mean(np.sin(0.7 * t) ** 2))
    for row in accuracy_of(out):
        nodes = scene.tether.nodes
        expected = {
            AS_RUN: 0.0,
            TIGHTER: 0.9 * TOLERANCE_M * scene.solver.rtol * rms,
            FINER: 0.75 * GRID_M / (nodes - 1) ** 2 * rms,
        }[row["run"]]
        assert float(row["error_early_m"]) == pytest.approx(expected, rel=1e-6, abs=1e-15)


def test_the_table_of_the_sweep_is_its_own(out):
    assert [row["steepness"] for row in rows_of(out)] == ["0.016", "0.05", "0.13"]


def test_again_nothing_is_computed(out, tmp_path):
    before = (out / "accuracy" / "table.csv").read_bytes()
    log = tmp_path / "log"
    killed_within = [out / folder / "trajectories" / ".run.nc.1.tmp" for folder in ("accuracy", "")]
    for path in killed_within:
        path.touch()
    assert buoy_sweep.main([*WORDS, "--out", str(out)], simulate=Drifting(log=str(log))) == 0
    assert not log.exists() and (out / "accuracy" / "table.csv").read_bytes() == before
    assert not any(path.exists() for path in killed_within)


def test_a_sweep_that_leaves_it_out_repeats_nothing(tmp_path):
    assert buoy_sweep.main([*WORDS, "--no-accuracy", "--out", str(tmp_path)], simulate=Drifting()) == 0
    assert not (tmp_path / "accuracy").exists()


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
    scene = load_scene("tethered_buoy", {"output.tangent_vectors": 1})
    run = sines(scene, 40)
    growth = np.arange(40.0)[:, None]
    run = replace(run, tangent=TangentGrowth(5.0, growth, np.eye(40)[3]))
    short = first_periods(run, 10)
    assert len(short.columns["time_s"]) == 1001 and len(short.tangent.growth_nats) == 10
    assert short.statistics["loop_releases"] == 1
    assert short.statistics["wall_s"] == pytest.approx(run.statistics["wall_s"] / 4, rel=1e-3)
    assert first_periods(run, 40) is run
