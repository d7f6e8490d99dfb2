"""Slowly damped motions of the cable and of the massless tether are told by the orbit that they come nearer to."""

import cmath
import math
from types import SimpleNamespace

import numpy as np
import pytest

from analysis import Settled
from analysis.looks import OUTLASTS, longer_decides
from campaigns.explore import proposals
from campaigns.explore.multipliers import OrbitUnder, orbit_ahead, orbit_of_twice
from campaigns.explore.proposals import SCREENED, _motions
from campaigns.explore.starts import Request, Start, settled_of, start_job
from campaigns.machinery.store import Store
from engine import Trajectory, load_scene, simulate
from tests.campaigns.conftest import judged_row


def at(steepness, depth_m=21.0):
    return load_scene("tethered_buoy", {"waves.steepness": steepness, "water.depth_m": depth_m})


def largest_N(run, periods):
    samples = round(periods * run.scene.waves.period_s / run.scene.sample_step_s())
    return run.columns["tension_top_high_N"][-samples:].max()


@pytest.mark.parametrize(
    ("steepness", "modulus", "periods", "truth"),
    [(0.02, 0.970, 135, 400), pytest.param(0.037, 0.9978, 465, 3000, marks=pytest.mark.slow)],
)
def test_the_row_of_a_run_that_rings_is_that_of_its_orbit(
    steepness, modulus, periods, truth, tmp_path, monkeypatch, capsys
):
    run = simulate(at(steepness), periods=periods)
    orbits = Store(tmp_path / "orbits")
    row = judged_row(run, orbits=orbits)
    assert row["regime"] == "period-1" and row["strobed_period"] == 1 and "in the limit" in row["regime_reason"]
    assert row["multiplier_modulus"] == pytest.approx(modulus, abs=5e-4)
    states = periods + 1  # once a wave period, the first one included
    judged = states - periods // 3
    assert row["transient_periods"] == states - judged // 3, "the last third of what is judged"
    later = simulate(run.scene, periods=truth - periods, start=run)
    exact_N = largest_N(later, 5)
    assert row["tension_top_max_N"] == pytest.approx(exact_N, rel=1e-3 if steepness == 0.037 else 1e-4)
    assert largest_N(run, periods // 3) > exact_N + 5.0 * abs(row["tension_top_max_N"] - exact_N), "the run rings"
    (path,) = orbits.folder.iterdir()
    path.write_bytes(path.read_bytes()[:-9])
    assert judged_row(run, orbits=orbits) == row and "damaged" in capsys.readouterr().err
    run.save(tmp_path / "run.nc")
    monkeypatch.setattr("campaigns.explore.multipliers._computed", lambda *_: pytest.fail("computed again"))
    loaded = Trajectory.load(tmp_path / "run.nc")
    assert judged_row(loaded, orbits=orbits) == row
    motion = settled_of(loaded, orbits)
    assert motion.period == 1 and motion.measures[:, 2].max() == pytest.approx(row["tension_top_max_N"], abs=1e-6)


@pytest.mark.slow
def test_a_run_that_spirals_to_a_torus_beyond_its_birth_is_not_told_by_the_orbit_within():
    """At kA = 0.039 the multiplier is 1.007."""
    run = simulate(at(0.039), periods=465)
    ahead = orbit_ahead(run, Store(None))
    assert ahead is None or not ahead[1].passed
    assert judged_row(run)["regime"] != "period-1"


def from_rest(steepness, depth_m):
    """The motion to which a massless tether goes from rest."""
    motions = _motions(np.zeros((SCREENED + 1, 2)), at(steepness, depth_m))["motions"]
    return next(motion for motion in motions if motion["rest"])


@pytest.mark.parametrize(("steepness", "depth_m"), [(0.012, 26.0), (0.016, 25.0), (0.037, 22.0), (0.0415, 22.0)])
def test_a_massless_tether_in_calm_waves_repeats_every_wave(steepness, depth_m):
    """Leading multipliers .979 to .994: none has settled in 80 periods."""
    assert from_rest(steepness, depth_m)["period"] == 1


@pytest.mark.parametrize(("steepness", "depth_m"), [(0.037, 20.8), (0.045, 22.0), (0.16, 22.0)])
def test_tori_and_chaos_of_a_massless_tether_have_no_period(steepness, depth_m):
    """Multipliers 1.008 of the orbit within the tori."""
    assert from_rest(steepness, depth_m)["period"] is None


def test_a_run_on_an_orbit_that_attracts_is_judged_after_60_periods_by_extremes_of_its_own():
    run = simulate(at(0.1), periods=60)
    row = judged_row(run)
    assert row["regime"] == "period-2" and row["strobed_period"] == 2 and "lies on it" in row["regime_reason"]
    assert row["multiplier_modulus"] + row["multiplier_error"] < 1.0
    assert row["tension_top_max_N"] == largest_N(run, 60 - row["transient_periods"])
    assert judged_row(simulate(at(0.1), periods=45))["regime"] == "undecided", "too short for an orbit"


@pytest.mark.parametrize(
    ("modulus", "error", "caveat"),
    [(0.9, 0.01, ""), *((size, 0.01, "not known to be stable") for size in (0.995, 1.005)), (1.02, 0.01, "NOT stable")],
)
def test_a_leading_multiplier_outside_the_unit_circle_has_its_caveat(modulus, error, caveat):
    for angle_rad in (0.0, 0.5, math.pi):
        multipliers = np.array([cmath.rect(modulus, angle_rad)])
        words = OrbitUnder(1, multipliers, np.array([error]), None).words()
        assert caveat in words and ("stable" in words) == bool(caveat)


@pytest.mark.parametrize(
    ("first", "of_twice", "word"),
    [(-1.2, None, "undecided"), (-1.2, 0.5, "period-2"), (-1.005, None, "period-1"), (0.9, 0.5, "period-1")],
)
def test_no_motion_stays_on_an_unstable_orbit(first, of_twice, word, monkeypatch):
    """A run that repeats beside one has twice its period, or none that is known."""
    run = simulate(at(0.06), periods=135)

    def orbit(period, multiplier):
        return OrbitUnder(period, np.array([complex(multiplier)]), np.array([0.01]), run)

    doubled = None if of_twice is None else orbit(2, of_twice)
    monkeypatch.setattr("campaigns.explore.judgement.orbit_under", lambda *_: orbit(1, first))
    monkeypatch.setattr("campaigns.explore.judgement.orbit_of_twice", lambda *_: doubled)
    row = judged_row(run)
    assert row["regime"] == word and OUTLASTS not in row["regime_reason"]


@pytest.mark.parametrize(("multiplier", "asked"), [(-1.2, True), (-6.2, False), (1.2, False)])
def test_twice_the_period_is_asked_just_beyond_a_flip(multiplier, asked, monkeypatch):
    """Further away the two branches are no longer nearer than the tolerance; at 1 there is no flip."""
    periods = []

    def orbit_under(run, period, orbits):
        periods.append(period)
        raise ArithmeticError("no orbit")

    monkeypatch.setattr("campaigns.explore.multipliers.orbit_under", orbit_under)
    flipped = OrbitUnder(3, np.array([complex(multiplier)]), np.array([0.01]), None)
    assert orbit_of_twice(None, flipped, None) is None and periods == [6] * asked


@pytest.mark.parametrize(("multiplier", "outlasts"), [(1.6, True), (1.4, False), (-1.6, True)])
def test_a_run_that_outlasts_an_unstable_orbit_ends(multiplier, outlasts, monkeypatch):
    """From 45 to 135 waves 1.6 makes 61 bits, 1.4 makes 44: a run that passes by would have left."""
    run = simulate(at(0.06), periods=135)
    orbit = OrbitUnder(1, np.array([complex(multiplier)]), np.array([0.01]), run)
    monkeypatch.setattr("campaigns.explore.judgement.orbit_under", lambda *_: orbit)
    monkeypatch.setattr("campaigns.explore.judgement.orbit_of_twice", lambda *_: None)
    row = judged_row(run)
    assert row["regime"] == "undecided"
    assert longer_decides(row["regime"], row["regime_reason"]) is not outlasts


def test_a_start_is_kept_with_all_that_its_end_depends_on():
    def known(x):
        return [Settled(1, np.array([[x]]), np.array([[x, x, x]]), np.ones(1), "")]

    usual = Request({}, at(0.1), Start("kick"))
    state = SimpleNamespace(digest=lambda: "of a state")
    others = [{"known": known(0.0)}, {"known": known(1.0)}, {"settles": False}, {"most": 60}, {"scene": at(0.2)}]
    starts = Start("kick", (1.0, 0.0)), Start("kick", phase=1.0), Start("", state=state)
    others += [{"start": start} for start in starts]
    keys = {start_job(request).key for request in (usual, *(usual._replace(**other) for other in others))}
    assert len(keys) == 1 + len(others)


def test_proposals_are_kept_for_their_speed_and_seed(tmp_path, monkeypatch):
    keys, plan = set(), SimpleNamespace(out=tmp_path, how=None)

    def results(how, store, title, tasks, size):
        keys.update(task.key for task in tasks)
        return SimpleNamespace(results=[])

    monkeypatch.setattr(proposals, "results", results)
    for speed_mps, seed in ((6.0, 1), (5.0, 1), (6.0, 2)):
        proposals.screened(plan, [at(0.1), at(0.2)], speed_mps, seed)
    assert len(keys) == 6
