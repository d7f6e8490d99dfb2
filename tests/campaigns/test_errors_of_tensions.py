"""How far a sweep's largest tension holds (`campaigns.explore.errors`): the rule, and where rows say so."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from campaigns.explore import errors
from campaigns.explore.errors import (
    GROWTH,
    GROWTH_AT_ORBIT,
    REPEATING,
    SLACK_COARSE,
    companion_row,
    error_N,
    slack_error,
    slack_shares,
    words_of_growth,
)
from campaigns.explore.starts import settled_of
from campaigns.machinery.store import Store
from campaigns.sweep import main as sweep_command
from engine import load_scene, simulate
from tables import JOINED, OTHER_GROWTH, OTHER_MOTION, TANGENT_ERROR, TANGENT_EXPONENT, UNSETTLED
from tests.campaigns.conftest import rows_of
from tests.campaigns.fake_engine import sines


def test_the_error_of_a_largest_tension_is_of_grid_steps_ringing_and_what_stands_above_the_usual():
    row = {"tension_top_max_N": 105.0, "unresolved_ringing_N": 0.5}
    companion = {"status": "ok", "outcome": JOINED, "tension_usual_max_N": 99.5}
    assert error_N(row, 101.0, companion) == (7.5, ["the largest tension holds to 7 % only"])
    assert error_N(row | {"tension_top_max_N": 102.0}, 101.0, companion) == (4.5, [])
    alike = {"status": "ok", "outcome": JOINED, "tension_usual_max_N": 4000.0}
    assert error_N({"tension_top_max_N": 4000.0}, 4000.0, alike) == (2.0, []), "no less than 5e-4 of it"
    _, (of_another, _) = error_N(row, 101.0, companion | {"outcome": UNSETTLED})
    assert OTHER_MOTION in of_another
    unknown, (ended,) = error_N(row, 101.0, companion | {"status": "newton-failed"})
    assert np.isnan(unknown) and "newton-failed" in ended


@pytest.mark.parametrize("bias", [0.0, 0.04])
def test_the_error_of_a_slack_fraction_covers_its_distance_from_the_limit(bias):
    """Stretches scatter about a share that is off by `bias`; the companion, of two stretches, by a quarter of that."""
    generator, limit, covered = np.random.default_rng(1), 0.5, 0
    for _ in range(400):
        shares = limit + bias + 0.03 * generator.standard_normal(6)
        finer = limit + 0.25 * bias + 0.03 * generator.standard_normal(2).mean()
        error, words = slack_error(shares, {"slack_fraction": finer}, 0.0)
        covered += abs(shares.mean() - limit) < error
        assert error > SLACK_COARSE or not words
    assert covered > 0.9 * 400
    assert np.isnan(slack_error(shares, {"status": "newton-failed"}, 0.0)[0])


def test_a_slack_fraction_that_the_companion_moves_is_told_and_chance_is_not():
    companion, scattered = np.full(4, 0.65), np.array([0.58, 0.72, 0.66, 0.64])
    assert slack_error(companion, {"slack_fraction": 0.71}, 0.005) == (
        pytest.approx(0.08),
        ["the slack fraction holds to 0.08 only"],
    )
    error, words = slack_error(scattered, {"slack_fraction": 0.71}, 0.005)
    assert error > 0.08 and not words
    assert slack_error(companion, {"slack_fraction": 0.65}, 0.005) == (0.005, []), "no less than half a sample"


@pytest.mark.parametrize(("transient", "period"), [(30, None), (30, 1), (0, 4)])
def test_stretches_of_a_record_have_its_slack_fraction(transient, period):
    """Of a tension that is above the threshold over two of five samples, again and again."""
    run = sines(load_scene("tethered_buoy"), 90)
    high_N = np.where(np.arange(len(run.columns["time_s"])) % 5 < 2, 2e3, -2e3)
    run.columns["tension_top_N"][:] = high_N
    shares = slack_shares(run, transient, period)
    assert len(shares) == (90 - transient) // {None: 15, 1: 5, 4: 8}[period]
    assert np.ptp(shares) < 1e-12 and shares.mean() == pytest.approx(0.6, abs=1e-12)


@pytest.mark.parametrize(("swing_m", "outcome"), [(1.0, JOINED), (4.0, UNSETTLED)])
def test_a_companion_that_leaves_the_motion_of_its_row_says_so(swing_m, outcome):
    scene = load_scene("tethered_buoy")
    motion = settled_of(sines(scene, 90), Store(None))
    row = companion_row(sines(scene, REPEATING, radius=(20.0, swing_m)), period=1, motion=motion)
    assert row["outcome"] == outcome
    assert row["tension_usual_max_N"] == pytest.approx(2510.0, abs=1e-9)  # of a sine, as in test_rows.py


@pytest.mark.parametrize(
    ("regime", "finer", "told"),
    [
        ("chaotic", (0.21, 0.1), False),
        ("chaotic", (0.19, 0.1), True),
        ("chaotic", (-0.3, 0.1), True),
        ("chaotic", (0.16, 0.04), False),
        ("chaotic", (0.14, 0.04), True),
        ("chaotic", (1.50, 0.04), False),
        ("period-1", (0.09, 0.1), False),
        ("period-1", (0.11, 0.1), True),
        ("period-1", (-0.3, 0.1), False),
        ("chaotic", (np.nan, np.nan), False),
        (None, (0.2, 0.1), False),
    ],
)
def test_growth_on_a_finer_grid_that_speaks_against_a_regime_is_told(regime, finer, told):
    """Chaos takes growth by two errors that is no less by two errors; one error of growth makes a period doubtful."""
    names = TANGENT_EXPONENT, TANGENT_ERROR
    row = {"regime": regime} | dict(zip(names, (0.25, 0.03), strict=True))
    words = words_of_growth(row, dict(zip(names, finer, strict=True)))
    assert [OTHER_GROWTH in sentence for sentence in words] == [True] * told
    if told:
        assert f"by {finer[0]:+.2f} ± {finer[1]:.2f} bits a wave" in words[0]


def test_a_companion_tells_how_a_perturbation_grows():
    run = sines(load_scene("tethered_buoy", {"output.tangent_vectors": 1}), GROWTH)
    growth_nats = np.full((GROWTH, 1), 0.3 * np.log(2.0))
    growth_nats[: GROWTH // 4] = 1.0
    row = companion_row(replace(run, tangent=SimpleNamespace(growth_nats=growth_nats)))
    assert row[TANGENT_EXPONENT] == pytest.approx(0.3), "without the periods in which the grid is forgotten"


def companion_of(run, regime, monkeypatch, **entries):
    """The last state of a run, and what follows it."""
    state = SimpleNamespace(at_zero=lambda: state, digest=lambda: "of a state")
    monkeypatch.setattr(errors, "run_of", lambda *_: replace(run, final_state=state))
    row = {"run_key": "of the run", "regime": regime, "transient_periods": 30, "periods": 180.0}
    return state, errors._companion(SimpleNamespace(out=None), row | entries)


@pytest.mark.parametrize(("regime", "compared"), [("transient", False), ("undecided", True), ("period-1", True)])
def test_a_companion_of_a_motion_that_still_changes_is_not_called_another_motion(regime, compared, monkeypatch):
    """The motion changes on its own grid too."""
    _, companion = companion_of(sines(load_scene("tethered_buoy"), 180), regime, monkeypatch)
    described = companion.job.describe(sines(load_scene("tethered_buoy"), REPEATING, radius=(20.0, 4.0)))
    assert (described.get("outcome") == UNSETTLED) == compared


@pytest.mark.parametrize(
    ("regime", "exponent", "slack", "periods"),
    [
        ("period-2", np.nan, 0.0, 12),
        ("period-6", np.nan, 0.0, 18),
        ("period-2", np.nan, 0.1, GROWTH_AT_ORBIT),
        ("quasi-periodic", 0.0, 0.1, 40),
        ("period-2", -0.5, 0.1, GROWTH),
        ("chaotic", 0.2, 0.1, GROWTH),
    ],
)
def test_a_companion_goes_on_with_twice_the_elements_at_a_quarter_of_the_tolerance(
    regime, exponent, slack, periods, monkeypatch
):
    """It carries a perturbation where one has decided the regime of its row, or where an orbit goes slack."""
    run = sines(load_scene("tethered_buoy", {"output.tangent_vectors": 1, "waves.ramp_s": 25.0}), 90)
    state, companion = companion_of(run, regime, monkeypatch, **{TANGENT_EXPONENT: exponent, "slack_fraction": slack})
    job = companion.job
    assert job.scene.tether.nodes - 1 == 2 * (run.scene.tether.nodes - 1)
    assert job.scene.solver.rtol == pytest.approx(run.scene.solver.rtol / 4.0)
    assert job.scene.waves.ramp_s == 0.0, "the waves of its last state have grown"
    assert job.scene.output.tangent_vectors == (periods > 40) and job.labels == {"of_run": "of the run"}
    assert job.going(job.scene, None, None, {})[:3] == (job.scene, periods, state)


@pytest.mark.parametrize(
    ("changes", "followed"),
    [
        ({"floor.stiffness_Npm3": 1e5}, True),
        ({"output.profiles": True}, True),
        ({"motion.dimensions": 3}, False),
    ],
)
def test_the_companion_of_a_run_in_a_plane_needs_no_lanes(changes, followed, monkeypatch):
    run = sines(load_scene("tethered_buoy", changes), 90)
    _, companion = companion_of(run, "chaotic", monkeypatch, slack_fraction=0.1)
    assert (companion is not None) == followed


@pytest.mark.slow
def test_a_violent_stiff_snap_whose_largest_tension_moves_with_the_steps_says_so(tmp_path):
    """On 41 nodes at EA = 1e7 N largest tensions of default and tighter steps differ by more than 5 %."""
    stiff = ["water.depth_m=21.6", "tether.tension.stiffness_N=1e7"]
    words = ["--vary", "waves.steepness", "0.016", "0.13", "2", "--periods", "60", "--transient", "20", "--no-report"]
    assert sweep_command([*words, "--set", *stiff, "--out", str(tmp_path)]) == 0
    _, row = rows_of(tmp_path)
    largest_N, error = float(row["tension_top_max_N"]), float(row["tension_top_max_error_N"])
    assert error > 0.05 * largest_N and "largest tension holds to" in row["message"]
    assert f"numerical error is {100 * error / largest_N:.0f} %" in (tmp_path / "answer.txt").read_text()
    scene = load_scene("tethered_buoy", {"waves.steepness": 0.13, "water.depth_m": 21.6, "solver.rtol": 0.003,
                                         "tether.tension.stiffness_N": 1e7})  # fmt: skip
    high = simulate(scene, periods=60).columns["tension_top_high_N"]
    assert abs(high[20 * len(high) // 60 :].max() - largest_N) < error
