"""A verdict is about the end of a record: the same law for records of every length, and for motions that change."""

import numpy as np
import pytest

from analysis import motion_regime
from analysis.stationarity import record_drift
from tests.analysis.systems import circle, henon, henon_growth, logistic, logistic_growth, normal

LENGTHS = range(100, 1501, 100)
RANDOM = np.random.default_rng(4)
GOLDEN = 0.6180339


def steps(count, bits, scatter=0.3):
    """Growth of a perturbation in nats, independent from period to period."""
    return np.log(2.0) * (bits + scatter * RANDOM.normal(size=count))


def verdict_of(record, growth, length, scale=1.0):
    return motion_regime(record[: length + 1], growth[:length], scale=scale, tolerance=0.01)


def after_chaos(length, then, growth):
    """Chaos of the logistic map for so many periods, and what follows it."""
    chaos = logistic(4.0, length)
    rates = np.append(logistic_growth(4.0, chaos), 0.0)
    return np.concatenate([chaos, then]), np.concatenate([rates, growth])


@pytest.mark.parametrize("lasted", [60, 230, 600, 950])
@pytest.mark.parametrize("period", [1, 6])
def test_a_period_after_chaos_is_told_on_every_length_and_chaos_is_taken_back(lasted, period):
    points = RANDOM.random(period)
    record, growth = after_chaos(lasted, points[np.arange(1600) % period], steps(1600, -0.1, 0.01))
    for length in LENGTHS:
        verdict, periodic = verdict_of(record, growth, length), length - lasted
        if periodic > max(length / 2, 136):
            assert verdict.period == period and abs(verdict.transient - lasted) < 15, length
        assert periodic < length / 3 or verdict.regime != "chaotic", length
        assert periodic > 0 or verdict.period is None, length
    assert "chaotic transient" in verdict_of(record, growth, 1500).reason or lasted < 100


def test_a_period_in_the_last_half_alone_takes_two_looks():
    record, growth = after_chaos(360, np.zeros(300), steps(300, -0.1, 0.01))
    first = verdict_of(record, growth, 465)
    assert first.regime == "undecided" and "period-1 at the last look only" in first.reason
    assert verdict_of(record, growth, 600).period == 1


@pytest.mark.parametrize("lasted", [150, 500, 900])
def test_chaos_after_a_period_takes_the_period_back(lasted):
    """A run beside an unstable orbit leaves it."""
    chaos = henon(1600)[:, 0]
    record = np.concatenate([np.tile([0.1, 0.7], lasted // 2), chaos])
    growth = np.concatenate([steps(lasted, 0.02, 0.01), henon_growth(henon(1601))])
    for length in LENGTHS:
        if length > lasted + 20:
            assert verdict_of(record, growth, length, scale=2.0).period is None, length
    assert verdict_of(record, growth, 1500, scale=2.0).regime == "chaotic"


def test_a_torus_whose_perturbations_grow_is_none_though_little():
    for bits, word in ((0.0, {"quasi-periodic"}), (0.03, {"undecided", "chaotic"})):
        record, growth = circle(GOLDEN * np.arange(1501)), steps(1500, bits, 0.1)
        words = {verdict_of(record, growth, length, scale=2.0).regime for length in (585, 920, 1500)}
        assert words <= word, (bits, words)


@pytest.mark.parametrize("scatter", [0.3, 1.0])
def test_an_observed_period_beside_growing_perturbations_is_no_period_and_says_both(scatter):
    """The rest of the system need not repeat: a test that cannot see growth does not count."""
    record = RANDOM.random(8)[np.arange(1501) % 8] + 5e-4 * RANDOM.normal(size=1501)
    grows, shrinks = steps(1500, 0.35, scatter), steps(1500, -0.1, scatter)
    for length in LENGTHS:
        verdict = verdict_of(record, grows, length)
        assert verdict.period is None, length
    assert verdict.regime == "chaotic" and "repeats after 8" in verdict.reason and "grow by 0.3" in verdict.reason
    verdicts = [verdict_of(record, shrinks, length) for length in LENGTHS]
    assert all(verdict.regime in ("undecided", "period-8") for verdict in verdicts)
    assert verdicts[-1].period == 8 and verdicts[-1].named("no growth").value < 0.1


def test_perturbations_that_were_not_carried_ask_for_a_closer_period():
    points = RANDOM.random(4)[np.arange(301) % 4]
    for noise, close in ((1e-4, True), (2e-3, False)):
        verdict = motion_regime(points + noise * RANDOM.normal(size=301), scale=1.0, tolerance=0.01)
        assert verdict.period == 4 and verdict.named("close").passed is close


@pytest.mark.parametrize("rate", [3.8284, 3.8286, 3.7385, 3.906, 3.9605])
def test_a_word_holds_beside_and_within_windows_of_the_logistic_map(rate):
    """3.8284 lies below the window of period 3: its orbits seem to repeat for 140 points and more, again and again."""
    for start in (0.05, 0.35, 0.62, 0.81):
        orbit = logistic(rate, 10_001, start, skip=0)
        growth = logistic_growth(rate, orbit)
        for length in (310, 735, 1500):
            verdict = verdict_of(orbit, growth, length)
            assert verdict.period is None or growth[5000:].mean() < 0.0, (start, length)
            assert verdict.regime != "chaotic" or growth[2 * length // 3 : length].mean() > -0.01, (start, length)


def test_a_record_whose_beginning_alone_is_wide_has_not_settled():
    """Its spread and its mean do not march: seven eighths are alike."""
    record = normal(0, 400)
    wide = np.where(np.arange(400) < 50, 6.0, 1.0)
    assert record_drift(wide * record).drifting and not record_drift(record).drifting
