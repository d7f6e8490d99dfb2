"""The close-up of a sweep: the run that goes slack and peaks highest, once more with its line, and never twice."""

import csv
import io
from dataclasses import dataclass, replace

import numpy as np
import pytest
from matplotlib.colors import to_rgb
from PIL import Image

from campaigns import buoy_sweep
from campaigns.buoy_sweep.repeats import FRAMES, PERIODS
from engine import Trajectory
from engine.trajectory import Profiles
from reports.parts.style import VERMILION
from tests.campaigns.fake_engine import FakeEngine, sines

WORDS = ["--steepness", "0.02", "0.05", "0.13", "--periods", "15", "--transient", "3", "--backend", "threading",
         "--jobs", "1", "--no-report", "--no-accuracy"]  # fmt: skip
NODES = 5


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
        return replace(run, profiles=straight_lines(run))


def straight_lines(run) -> Profiles:
    """A straight line from the anchor to the buoy, its tension that at the top."""
    scene = run.scene
    step_s = scene.output.profiles_step_s
    time_s = step_s * np.arange(int(run.columns["time_s"][-1] / step_s) + 1)
    share = np.linspace(0.0, 1.0, NODES)
    x, z, top = (
        np.interp(time_s, run.columns["time_s"], run.columns[name])[:, None] for name in ("x_m", "z_m", "tension_top_N")
    )
    nothing = np.zeros((len(time_s), NODES))
    return Profiles(
        time_s, 20.0 * share, x * share, nothing, z * share, nothing, nothing + top, nothing
    )  # fmt: skip


def close_up_of(out):
    with open(out / "close_up" / "table.csv", newline="") as file:
        return list(csv.DictReader(file))


@pytest.fixture
def sweep(tmp_path):
    def run(**fake):
        log = tmp_path / "log"
        log.unlink(missing_ok=True)
        engine = Slackening(log=str(log), **fake)
        code = buoy_sweep.main([*WORDS, "--out", str(tmp_path / "out")], simulate=engine)
        return code, engine.begun(), tmp_path / "out"

    return run


def test_the_run_that_peaks_highest_is_kept_with_its_line_and_never_twice(sweep):
    code, begun, out = sweep()
    assert (code, begun) == (0, [0.02, 0.05, 0.13, 0.13])
    (row,) = close_up_of(out)
    assert (row["steepness"], row["status"], row["periods"]) == ("0.13", "ok", str(PERIODS))
    kept = Trajectory.load(out / "close_up" / "trajectories" / f"{row['run_key']}.nc")
    assert kept.profiles.time_s == pytest.approx(np.arange(PERIODS * FRAMES + 1) * kept.scene.waves.period_s / FRAMES)
    assert sweep()[:2] == (0, [])
    (out / "close_up" / "trajectories" / f"{row['run_key']}.nc").unlink()
    assert sweep()[:2] == (0, [0.13]), "a sweep killed before its last run does that run alone"


def test_a_sweep_without_slack_has_none_and_empties_that_of_an_earlier_one(sweep):
    _, begun, out = sweep(mean_N=5000.0)
    assert begun == [0.02, 0.05, 0.13] and not (out / "close_up").exists()
    for path in (out / "trajectories").iterdir():
        path.unlink()
    sweep()
    for path in (out / "trajectories").iterdir():
        path.unlink()
    sweep(mean_N=5000.0)
    assert close_up_of(out) == []


def test_a_close_up_that_fails_is_a_row_and_costs_nothing_else(sweep):
    code, _, out = sweep(fails_with_line=True)
    assert code == 0
    assert close_up_of(out)[0]["status"] == "error"


@pytest.mark.slow
def test_the_report_shows_it_moving_and_as_stills_the_same_each_time(sweep):
    from reports.buoy_sweep.close_up import close_up_items

    _, _, out = sweep()
    heading, figure = close_up_items(out)
    assert figure.picture.kind == "svg" and figure.moving.data.startswith(b"GIF89a")
    assert "kA = 0.13" in figure.caption and len(figure.moving.data) < 1e6
    assert close_up_items(out) == [heading, figure]
    with Image.open(io.BytesIO(figure.moving.data)) as moving:
        colours = np.array([colour for _, colour in moving.convert("RGB").getcolors(1 << 20)])
    for wanted in ("#ffffff", VERMILION):  # paper, and the small dot that marks the moment
        off = np.abs(colours - 255 * np.array(to_rgb(wanted))).sum(axis=1)
        assert off.min() < 60, "20 of 256 in each of red, green and blue; brown instead of vermilion is 177 off"
