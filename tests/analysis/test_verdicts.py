"""The regime of motions whose regime is known, what makes a verdict void, and no false alarm in regular records."""

from functools import partial

import numpy as np
import pytest
from scipy.signal import lfilter

from analysis import evidence_text, read_evidence, regime
from analysis.exponents import Exponent
from analysis.oscillator import SnapOscillator, search_periodic_orbits, snap_motion, start_grid, strobed_states
from tests.analysis.forced_records import KINDS, SAMPLES, record
from tests.analysis.systems import circle, circle_map, henon, logistic, nonchaotic_map

K = np.arange(300)
POSITIVE = (0.6, 0.02)
FOOLED = (0.5, 0.02)  # by noise: a positive exponent, 25 errors away from 0, for every record
TORUS = circle_map(0.5, 0.6180339, 200)
quick = partial(regime, surrogates=19)  # half of those by default, and the least


@pytest.mark.parametrize(("rate", "period"), [(2.8, 1), (3.2, 2), (3.5, 4), (3.55, 8), (3.832, 3)])
def test_windows_of_the_logistic_map(rate, period):
    verdict = regime(strobed=logistic(rate, 300), scale=0.5)
    assert (verdict.regime, verdict.period) == (f"period-{period}", period)


@pytest.mark.parametrize("section", [logistic(3.9, 300), henon(300)])
def test_chaotic_maps(section):
    assert quick(strobed=section, tangent_exponent=POSITIVE).regime == "chaotic"


@pytest.mark.parametrize(
    ("section", "exponent"),
    [
        (circle_map(0.8, 0.41421356, 300), (0.0, 0.01)),
        pytest.param(circle_map(0.5, 0.1314, 300), (0.005, 0.001), marks=pytest.mark.slow),
        (circle(0.1234567 * K) + np.outer((-1.0) ** K, [3.0, 0.1]), None),
    ],
    ids=["root", "slow", "torus on a period-2 motion"],
)
def test_tori_are_quasi_periodic(section, exponent):
    assert quick(strobed=section, wolf_exponent=exponent).regime == "quasi-periodic"


@pytest.mark.parametrize("multiplier", [0.98, 0.995, -0.99])
def test_a_decay_is_a_transient_and_then_a_period(multiplier):
    spiral, away = circle(K / (2 * np.pi)) * multiplier ** K[:, None], np.array([21.0, 0.0])
    assert regime(strobed=away + spiral, scale=2.0).regime == "transient"
    assert regime(strobed=away + 1e-3 * spiral, scale=2.0).regime == "period-1"


def test_a_period_tells_how_fast_it_attracts():
    """Multipliers of the logistic map at its fixed point: 2 - rate."""
    verdict = regime(strobed=logistic(2.9, 60, skip=20), scale=1.0, tolerance=0.05)
    assert verdict.named("contraction").value == pytest.approx(-0.9, abs=0.01)


@pytest.mark.parametrize(
    ("section", "words", "why"),
    [
        (np.concatenate([TORUS[:, 0], 2.0 * logistic(3.9, 200) - 1.0]), ("undecided", "transient"), ""),
        (np.random.default_rng(0).normal(size=(300, 2)), ("undecided",), "null"),
        (circle_map(0.5, 0.6180339, 150), ("undecided",), ""),
        (logistic(3.2, 300), ("undecided",), "tangent dynamics is positive"),
        (henon(39), ("undecided",), "40 strobed points are needed"),
        (henon(150), ("undecided",), ""),
    ],
    ids=["halves that disagree", "noise", "torus", "period", "too short", "too short for chaos"],
)
def test_a_positive_exponent_alone_is_not_chaos(section, words, why):
    verdict = quick(strobed=section, scale=0.5, tangent_exponent=POSITIVE)
    assert verdict.regime in words and why in verdict.reason


def test_a_tighter_tolerance_that_says_otherwise_makes_any_word_undecided():
    found = quick(strobed=TORUS)
    assert quick(strobed=TORUS, tighter=found).regime == found.regime == "quasi-periodic"
    assert quick(strobed=TORUS, tighter="period-2").regime == "undecided"


def test_the_same_seed_gives_the_same_verdict_and_the_evidence_can_be_read():
    first, again, other = (quick(strobed=henon(150), tangent_exponent=POSITIVE, seed=seed) for seed in (8, 8, 9))
    assert [repr(item) for item in first.evidence] == [repr(item) for item in again.evidence]
    assert other.regime == first.regime
    assert (first.seed, other.seed) == (8, 9)
    assert other.named("0-1 test").value != first.named("0-1 test").value
    with pytest.raises(ValueError, match="there is period"):
        first.named("nothing")
    assert all(item.sentence for item in first.evidence)
    read = read_evidence(evidence_text(first))
    assert [item[0] for item in read] == [item.name for item in first.evidence]
    assert ("0-1 test", f"{first.named('0-1 test').value:.3g}", "0.9", "yes") in read
    assert read_evidence("") == read_evidence("no evidence at all") == []


@pytest.mark.slow
def test_units_and_origin_do_not_matter():
    section = henon(250)
    plain, moved = (
        regime(strobed=one, tangent_exponent=POSITIVE) for one in (section, section * [1e3, -1e-3] + [21.0, 5.0])
    )
    assert plain.regime == moved.regime == "chaotic"
    assert moved.named("0-1 test").value == pytest.approx(plain.named("0-1 test").value, abs=1e-6)


def test_a_record_is_seen_once_a_period_after_its_transient():
    """Slow growth of a stray start, then a rotation: 10 samples a period."""
    time = np.arange(3001) / 10.0
    motion = np.cos(2 * np.pi * time) + 0.5 * np.cos(2 * np.pi * 0.1618034 * time) + 30 * np.exp(-time)
    assert quick(motion, 0.1, 1.0).regime == "transient"
    verdict = quick(motion, 0.1, 1.0, transient_periods=40)
    assert verdict.regime == "quasi-periodic" and verdict.points == 260
    assert regime(np.full(2001, 20.8), 0.05, 1.0).regime == "period-1"


def test_exponents_come_in_either_unit():
    section, nats = henon(60), Exponent(0.42, 0.01, "nats/time", "known")
    found = regime(strobed=section, period_s=2.0, tangent_exponent=nats).named("exponent")
    assert found.value == pytest.approx(0.84 / np.log(2))
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
    section = np.repeat(logistic(3.9, 250), 2)[:, None] + [0.0, 0.3] + 100.0 * (np.arange(500) % 2)[:, None]
    found = regime(strobed=section, tangent_exponent=POSITIVE).named("0-1 test")
    assert found.passed and "2 bands" in found.sentence


@pytest.mark.parametrize(("rate", "bands"), [(3.65, 2), (3.585, 4), pytest.param(3.574, 8, marks=pytest.mark.slow)])
def test_chaos_in_bands_is_chaotic(rate, bands):
    """Bands of the logistic map merge at the rates 3.5748, 3.5926 and 3.6786: to 4, 2 and 1."""
    verdict = quick(strobed=logistic(rate, 120 * bands), scale=0.5)
    assert verdict.regime == "chaotic", verdict.reason
    assert f"{bands} bands" in verdict.named("0-1 test").sentence


BANDS = np.arange(1200) % 4  # visited in turn
BETWEEN = np.array([0.0, 3.0, 1.0, 5.0])[BANDS]
DRAWN = np.random.default_rng(5).normal(size=1200)
NOT_CHAOTIC = {
    "period 4 in noise": BETWEEN + 0.1 * DRAWN,
    "period 8 in noise": logistic(3.55, 1200) + 0.003 * DRAWN,
    "coloured noise on a period 4": BETWEEN + 0.3 * lfilter([1.0], [1.0, -0.5], DRAWN),
    "torus on four curves": BETWEEN[:, None] + 0.3 * circle(0.1234567 * np.arange(1200)),
    "the same in noise": BETWEEN[:, None] + 0.3 * circle(0.1234567 * np.arange(1200)) + 0.03 * DRAWN[:, None],
    "strange nonchaotic on two curves": np.repeat(nonchaotic_map(1.5, 600), 2)[:, None] + 20.0 * (BANDS[:, None] % 2),
}


@pytest.mark.parametrize("name", NOT_CHAOTIC)
def test_bands_alone_are_not_chaos(name):
    """In their bands noise has no map, and a torus and what is forced at two rhythms do not forget."""
    verdict = quick(strobed=NOT_CHAOTIC[name], wolf_exponent=FOOLED)
    assert verdict.regime in ("undecided", "quasi-periodic"), verdict.reason
    assert "bands" in verdict.named("0-1 test").sentence and "(1 bands)" not in verdict.named("0-1 test").sentence


@pytest.mark.parametrize(
    ("sigma", "points"), [(1.5, 600), *(pytest.param(s, 3000, marks=pytest.mark.slow) for s in (1.3, 1.5, 1.7))]
)
def test_a_strange_nonchaotic_attractor_is_not_chaotic(sigma, points):
    """Its neighbours part, its next point can be predicted, its 0-1 test says irregular: it does not forget."""
    verdict = regime(strobed=nonchaotic_map(sigma, points), wolf_exponent=FOOLED)
    assert verdict.regime == "undecided" and "memory" in verdict.reason


@pytest.mark.parametrize("digits", [1, 2, 3])
def test_a_torus_that_takes_few_values_is_one_all_the_same(digits):
    assert quick(strobed=np.round(circle_map(0.5, 0.6180339, 300), digits)).regime == "quasi-periodic"


@pytest.mark.parametrize("row", [0, 150, 299])
def test_one_sample_far_outside_leaves_no_verdict(row):
    section = logistic(3.5, 300)
    section[row] = -9999.0
    verdict = regime(strobed=section)
    assert verdict.regime == "undecided" and f"row {row + 1} (-9999)" in verdict.reason


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


SNAP = SnapOscillator()


def snapping(number, **given):
    """Eq. (33) at the paper's parameters, chaotic with 0.509 bits per period: one of consecutive pieces of one orbit,
    400 periods each; displacement only."""
    start = strobed_states(SNAP, (0.68, 0.0), 1, 500 + 400 * number)[0]
    return regime(snap_motion(SNAP, start, 400, 48).displacement, SNAP.period / 48, SNAP.period, seed=number, **given)


@pytest.mark.slow
def test_at_least_nine_of_ten_records_of_the_snapping_buoy_are_chaotic_and_none_is_periodic():
    words = [snapping(number).regime for number in range(20)]
    assert words.count("chaotic") >= 18
    assert not any(word.startswith("period-") for word in words)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("given", "word"),
    [
        (dict(wolf_exponent=(0.509, 0.01)), "chaotic"),
        (dict(wolf_exponent=(0.509, 0.3)), "undecided"),
        (dict(wolf_exponent=(-0.2, 0.05)), "undecided"),
        (dict(wolf_exponent=(np.nan, np.nan)), "undecided"),
        (dict(wolf_exponent=(0.5, 0.01), tangent_exponent=(-0.1, 0.01)), "undecided"),
        (dict(wolf_exponent=(-0.1, 0.01), tangent_exponent=(0.5, 0.01)), "chaotic"),
        (dict(tangent_exponent=(0.509, 0.01), tighter="chaotic"), "chaotic"),
        (dict(tangent_exponent=(0.509, 0.01), tighter="period-2"), "undecided"),
    ],
)
def test_chaos_needs_an_exponent_positive_by_two_errors_of_the_best_source_and_at_the_tighter_tolerance(given, word):
    assert snapping(3, **given).regime == word


@pytest.mark.slow
def test_the_coexisting_orbit_of_the_snapping_buoy_is_period_8():
    orbits = [orbit for orbit in search_periodic_orbits(SNAP, 8, start_grid(12, 8)) if orbit.stable]
    motion = snap_motion(SNAP, orbits[0].points[0], 120, 48)
    verdict = regime(motion.displacement, SNAP.period / 48, SNAP.period)
    assert (verdict.regime, verdict.period) == ("period-8", 8), verdict.reason
