"""The regime of sections whose regime is known, what makes a verdict void, and no false alarm in regular records."""

import numpy as np
import pytest

from analysis import evidence_text, read_evidence, regime
from analysis.exponents import Exponent
from tests.analysis.forced_records import KINDS, SAMPLES, record
from tests.analysis.maps import circle_map, henon, logistic

K = np.arange(300)
POSITIVE = (0.6, 0.02)


@pytest.mark.parametrize(("rate", "period"), [(2.8, 1), (3.2, 2), (3.5, 4), (3.55, 8), (3.832, 3)])
def test_windows_of_the_logistic_map(rate, period):
    verdict = regime(strobed=logistic(rate, 300), scale=0.5)
    assert (verdict.regime, verdict.period) == (f"period-{period}", period)


@pytest.mark.parametrize("section", [logistic(3.9, 300), logistic(4.0, 300), henon(300)])
def test_chaotic_maps(section):
    assert regime(strobed=section, tangent_exponent=POSITIVE).regime == "chaotic"


@pytest.mark.parametrize(
    ("coupling", "rotation", "exponent"),
    [(0.5, 0.6180339, None), (0.8, 0.41421356, (0.0, 0.01)), (0.5, 0.1314, (0.005, 0.001))],
)
def test_one_to_one_circle_maps_are_quasi_periodic(coupling, rotation, exponent):
    section = circle_map(coupling, rotation, 300)
    assert regime(strobed=section, wolf_exponent=exponent).regime == "quasi-periodic"


def test_a_torus_on_a_period_2_motion_is_quasi_periodic():
    turn = 2 * np.pi * 0.1234567 * K
    section = np.column_stack([np.cos(turn) + 3 * (-1.0) ** K, np.sin(turn + 0.3 * np.sin(turn))])
    assert regime(strobed=section).regime == "quasi-periodic"


@pytest.mark.parametrize("multiplier", [0.98, 0.995, -0.99])
def test_a_decay_is_a_transient_and_then_a_period(multiplier):
    spiral = np.exp(1j * K)
    path = [21.0, 0.0] + np.column_stack([spiral.real, spiral.imag]) * multiplier ** K[:, None]
    assert regime(strobed=path, scale=2.0).regime == "transient"
    settled = [21.0, 0.0] + 1e-3 * (path - [21.0, 0.0])
    assert regime(strobed=settled, scale=2.0).regime == "period-1"


def test_a_period_tells_how_fast_it_attracts():
    """Multipliers of the logistic map at its fixed point: 2 - rate."""
    verdict = regime(strobed=logistic(2.9, 60, skip=20), scale=1.0, tolerance=0.05)
    assert verdict.named("contraction").value == pytest.approx(-0.9, abs=0.01)


def test_halves_that_disagree_are_not_chaos():
    mixed = np.concatenate([circle_map(0.5, 0.6180339, 200)[:, 0], 2.0 * logistic(3.9, 200) - 1.0])
    assert regime(strobed=mixed, tangent_exponent=POSITIVE).regime != "chaotic"


def test_noise_is_undecided_even_with_a_positive_exponent():
    noise = np.random.default_rng(0).normal(size=(300, 2))
    verdict = regime(strobed=noise, tangent_exponent=POSITIVE)
    assert verdict.regime == "undecided" and "null" in verdict.reason


def test_a_regular_word_against_a_positive_tangent_exponent_is_undecided():
    assert regime(strobed=circle_map(0.5, 0.6180339, 150), tangent_exponent=POSITIVE).regime == "undecided"
    assert regime(strobed=logistic(3.2, 300), scale=0.5, tangent_exponent=POSITIVE).regime == "undecided"


def test_a_tighter_tolerance_that_says_otherwise_makes_any_word_undecided():
    section = circle_map(0.5, 0.6180339, 200)
    found = regime(strobed=section)
    assert regime(strobed=section, tighter=found).regime == found.regime == "quasi-periodic"
    assert regime(strobed=section, tighter="period-2").regime == "undecided"


def test_the_same_seed_gives_the_same_verdict_and_the_evidence_can_be_read():
    first, again, other = (regime(strobed=henon(150), tangent_exponent=POSITIVE, seed=seed) for seed in (8, 8, 9))
    assert [repr(item) for item in first.evidence] == [repr(item) for item in again.evidence]
    assert other.regime == first.regime
    assert other.named("0-1 test").value != first.named("0-1 test").value
    assert all(item.sentence for item in first.evidence)
    read = read_evidence(evidence_text(first))
    assert [item[0] for item in read] == [item.name for item in first.evidence]
    assert ("0-1 test", f"{first.named('0-1 test').value:.3g}", "0.9", "yes") in read
    assert read_evidence("") == read_evidence("no evidence at all") == []
    with pytest.raises(ValueError, match="there is period"):
        first.named("nothing")


@pytest.mark.slow
def test_units_and_origin_do_not_matter():
    section = henon(250)
    plain = regime(strobed=section, tangent_exponent=POSITIVE)
    moved = regime(strobed=section * [1e3, -1e-3] + [21.0, 5.0], tangent_exponent=POSITIVE)
    assert plain.regime == moved.regime == "chaotic"
    assert moved.named("0-1 test").value == pytest.approx(plain.named("0-1 test").value, abs=1e-6)


def test_a_record_is_seen_once_a_period_after_its_transient():
    """Slow growth of a stray start, then a rotation: 10 samples a period."""
    time = np.arange(3001) / 10.0
    motion = np.cos(2 * np.pi * time) + 0.5 * np.cos(2 * np.pi * 0.1618034 * time) + 30 * np.exp(-time)
    assert regime(motion, 0.1, 1.0).regime == "transient"
    verdict = regime(motion, 0.1, 1.0, transient_periods=40)
    assert verdict.regime == "quasi-periodic" and verdict.points == 260


def test_too_short_a_record_is_undecided():
    verdict = regime(strobed=henon(39))
    assert verdict.regime == "undecided" and "40 strobed points are needed" in verdict.reason
    assert regime(strobed=henon(150), tangent_exponent=POSITIVE).regime == "undecided"


def test_a_motion_at_rest_is_period_1():
    assert regime(np.full(2001, 20.8), 0.05, 1.0).regime == "period-1"


def test_exponents_come_in_either_unit():
    section, nats = henon(60), Exponent(0.42, 0.01, "nats/time", "known")
    assert regime(strobed=section, period_s=2.0, tangent_exponent=nats).named("exponent").value == pytest.approx(
        0.84 / np.log(2)
    )
    with pytest.raises(ValueError, match="period_s is needed"):
        regime(strobed=section, tangent_exponent=nats)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        (dict(), "either series or strobed"),
        (dict(series=np.zeros(100), strobed=np.zeros(100)), "either series or strobed"),
        (dict(series=np.zeros(100)), "step_s and period_s"),
        (dict(strobed=np.zeros(100), surrogates=18), "surrogates"),
    ],
)
def test_what_makes_no_sense_is_refused(given, message):
    with pytest.raises(ValueError, match=message):
        regime(**given)


@pytest.mark.slow
def test_chaos_in_two_bands_is_seen_in_each_band():
    """Two logistic maps visited in turn, a hundred times further apart than they are wide."""
    slow = np.repeat(logistic(3.9, 250), 2)[:, None] + [0.0, 0.3]
    section = slow + 100.0 * (K[:250].repeat(2) * 0 + np.arange(500) % 2)[:, None]
    found = regime(strobed=section, tangent_exponent=POSITIVE).named("0-1 test")
    assert found.passed and "2 bands" in found.sentence


# An estimator fooled by noise: a positive exponent, 25 errors away from 0, for every record.
FOOLED = (0.5, 0.02)


@pytest.mark.parametrize("kind", ["noisy-periodic", "noisy-quasi", "ar2"])
def test_no_false_alarm(kind):
    verdict = regime(record(kind, 0), 1 / SAMPLES, 1.0, wolf_exponent=FOOLED)
    assert verdict.regime != "chaotic", verdict.reason


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_no_false_alarm_in_more_than_100_records(kind):
    for number in range(100, 118):
        exponent = None if number < 106 else FOOLED  # None: Wolf's own
        verdict = regime(record(kind, number), 1 / SAMPLES, 1.0, wolf_exponent=exponent, seed=number)
        assert verdict.regime != "chaotic", (number, verdict.reason)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("kind", "words", "share"),
    [("periodic", "period-", 1.0), ("quasi", "quasi-periodic", 0.75), ("transient", ("transient", "period-"), 0.9)],
)
def test_most_clean_records_get_their_own_word(kind, words, share):
    verdicts = [regime(record(kind, number), 1 / SAMPLES, 1.0).regime for number in range(200, 240)]
    assert sum(word.startswith(words) for word in verdicts) >= share * len(verdicts)
