"""The regime of motions whose regime is known, and what makes a verdict void."""

from functools import partial

import numpy as np
import pytest
from scipy.signal import lfilter

from analysis import evidence_text, read_evidence, regime, section_lyapunov
from analysis.evidence import Evidence, incommensurate_evidence
from analysis.exponents import Exponent
from analysis.oscillator import SnapOscillator, snap_motion, strobed_states
from analysis.verdicts import _without_period
from tests.analysis.systems import circle, circle_map, henon, logistic, nonchaotic_map, normal

K = np.arange(300)
POSITIVE = (0.6, 0.02)
FOOLED = (0.5, 0.02)  # by noise: a positive exponent, 25 errors away from 0, for every record
TORUS = circle_map(0.5, 0.6180339, 200)
quick = partial(regime, surrogates=19)  # half of those by default, and the least


@pytest.mark.parametrize("period", [2, 16])
def test_a_line_is_incommensurate_only_beyond_the_largest_period(period):
    """Lines at 1/N and beside it, half a turn over the record away."""
    for turns, largest, free in ((0.0, 16, False), (0.5, 16, True), (0.0, period - 1, True)):
        line = np.cos(2.0 * np.pi * (1.0 / period + turns / 800) * np.arange(800) + 1.0)
        assert incommensurate_evidence(line[:, None], largest).passed is free


@pytest.mark.parametrize(("share", "free"), [(0.007, False), (0.014, True)])
def test_a_line_counts_from_one_per_cent_of_the_variance(share, free):
    k = np.arange(400)
    line = np.sqrt(2.0 * share) * np.cos(2.0 * np.pi * 0.1234567 * k)
    motion = line + np.sqrt(2.0 * (1.0 - share)) * np.cos(0.5 * np.pi * k + 1.0)
    assert incommensurate_evidence(motion[:, None], 16).passed is free
    assert "100%" in incommensurate_evidence((-1.0) ** k[:, None], 16).sentence, (
        "a motion from side to side is its line"
    )


@pytest.mark.parametrize(("bands", "word"), [(1, "quasi-periodic"), (2, "undecided")])
def test_a_map_that_shrinks_by_more_than_a_bit_a_round_of_its_bands_is_no_torus(bands, word):
    """The map of noise about points has no slope: perturbations shrink, here by 0.7 bits a period."""
    section = np.resize([0.0, 5.0][:bands], 200)[:, None] + 0.1 * normal(0, 200, 1)
    tests_of_a_torus = [Evidence("", 0.0, 1.0, passed, "") for passed in (False, True, True, False, False)]
    assert _without_period(section, [], [Evidence("exponent", -0.7, 0.0, False, "")], *tests_of_a_torus)[0] == word


@pytest.mark.parametrize(
    ("section", "exponent"),
    [
        (circle_map(0.8, 0.41421356, 300), (0.01, 0.01)),
        (circle(0.1234567 * K) + np.outer((-1.0) ** K, [3.0, 0.1]), None),
        *((np.round(circle_map(0.5, 0.6180339, 300), digits), None) for digits in (1, 2, 3)),
    ],
    ids=["root", "torus on a period-2 motion", "few values", "more", "many"],
)
def test_tori_are_quasi_periodic(section, exponent):
    assert quick(strobed=section, wolf_exponent=exponent).regime == "quasi-periodic"


@pytest.mark.parametrize("multiplier", [0.98, 0.995, -0.99])
def test_a_decay_is_a_transient_and_then_a_period(multiplier):
    spiral, centre = circle(K / (2 * np.pi)) * multiplier ** K[:, None], np.array([21.0, 0.0])
    assert regime(strobed=centre + spiral, scale=2.0).regime == "transient"
    assert regime(strobed=centre + 1e-3 * spiral, scale=2.0).regime == "period-1"


def test_a_period_tells_how_fast_it_attracts():
    """Multipliers of the logistic map at its fixed point: 2 - rate."""
    verdict = regime(strobed=logistic(2.9, 60, skip=20), scale=1.0, tolerance=0.05)
    assert verdict.named("contraction").value == pytest.approx(-0.9, abs=0.01)


def test_what_a_period_misses_stands_beside_its_tolerance():
    """Its steps shrink by -0.9: the first of the later half is the largest."""
    section = 21.0 + 0.01 * (-0.9) ** K[:60]
    period = regime(strobed=section, scale=2.0, tolerance=0.01).named("period")
    assert period.value == pytest.approx(0.5 * 0.019 * 0.9**30) and period.value < period.threshold == 0.01


@pytest.mark.parametrize(
    ("section", "words", "why"),
    [
        (np.concatenate([TORUS[:, 0], 2.0 * logistic(3.9, 200) - 1.0]), ("undecided", "transient"), ""),
        (normal(0, 300, 2), ("undecided",), "null"),
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


def test_a_period_stands_where_the_exponent_given_is_positive_by_one_error_only():
    assert quick(strobed=logistic(3.2, 300), scale=0.5, tangent_exponent=(0.02, 0.02)).regime == "period-2"


def test_a_tighter_tolerance_that_says_otherwise_makes_any_word_undecided():
    plain = quick(strobed=TORUS)
    assert quick(strobed=TORUS, tighter=plain).regime == plain.regime == "quasi-periodic"
    assert quick(strobed=TORUS, tighter="period-2").regime == "undecided"


def test_the_same_seed_gives_the_same_verdict_and_the_evidence_can_be_read():
    first, repeated, reseeded = (quick(strobed=henon(150), tangent_exponent=POSITIVE, seed=seed) for seed in (8, 8, 9))
    assert [repr(item) for item in first.evidence] == [repr(item) for item in repeated.evidence]
    assert reseeded.regime == first.regime
    assert (first.seed, reseeded.seed) == (8, 9)
    assert reseeded.named("0-1 test").value != first.named("0-1 test").value
    read = read_evidence(evidence_text(first))
    assert [item[0] for item in read] == [item.name for item in first.evidence]
    assert ("0-1 test", f"{first.named('0-1 test').value:.3g}", "0.9", "yes") in read
    assert read_evidence("") == read_evidence("no evidence at all") == []


def test_a_record_is_seen_once_a_period_after_its_transient():
    """Slow growth of a stray start, then a rotation: 10 samples a period."""
    time = np.arange(3001) / 10.0
    motion = np.cos(2 * np.pi * time) + 0.5 * np.cos(2 * np.pi * 0.1618034 * time) + 30 * np.exp(-time)
    assert quick(motion, 0.1, 1.0).regime == "transient"
    verdict = quick(motion, 0.1, 1.0, transient_periods=40)
    assert verdict.regime == "quasi-periodic" and verdict.points == 260
    assert regime(np.full(2001, 20.8), 0.05, 1.0).regime == "period-1"


def test_exponents_come_in_either_unit():
    nats = Exponent(0.42, 0.01, "nats/time", "known")
    evidence = regime(strobed=henon(60), period_s=2.0, tangent_exponent=nats).named("exponent")
    assert evidence.value == pytest.approx(0.84 / np.log(2))


@pytest.mark.parametrize(("rate", "bands"), [(3.65, 2), (3.585, 4), pytest.param(3.574, 8, marks=pytest.mark.slow)])
def test_chaos_in_bands_is_chaotic(rate, bands):
    """Bands of the logistic map merge at the rates 3.5748, 3.5926 and 3.6786: to 4, 2 and 1."""
    verdict = quick(strobed=logistic(rate, 120 * bands), scale=0.5)
    assert verdict.regime == "chaotic", verdict.reason
    assert f"{bands} bands" in verdict.named("0-1 test").sentence
    exponent, section = verdict.named("exponent"), logistic(rate, 120 * bands)
    of_bands = [section_lyapunov(section[first::bands])[0] for first in range(bands)]
    assert (exponent.value, exponent.error) in [(item.value / bands, item.error / bands) for item in of_bands]


BANDS = np.arange(1200) % 4  # visited in turn
BETWEEN = np.array([0.0, 3.0, 1.0, 5.0])[BANDS]
ON_CURVES = BETWEEN[:, None] + 0.3 * circle(0.1234567 * np.arange(1200))
DRAWN = normal(5, 1200)
NOT_CHAOTIC = {
    "period 4 in noise": BETWEEN + 0.1 * DRAWN,
    "period 8 in noise": logistic(3.55, 1200) + 0.003 * DRAWN,
    "coloured noise on a period 4": BETWEEN + 0.3 * lfilter([1.0], [1.0, -0.5], DRAWN),
    "torus on four curves": ON_CURVES,
    "the same in noise": ON_CURVES + 0.03 * DRAWN[:, None],
    "strange nonchaotic on two curves": np.repeat(nonchaotic_map(1.5, 600), 2)[:, None] + 20.0 * (BANDS[:, None] % 2),
}


@pytest.mark.parametrize("name", NOT_CHAOTIC)
def test_bands_alone_are_not_chaos(name):
    """In their bands noise has no map, and a torus and what is forced at two rhythms do not forget."""
    verdict = quick(strobed=NOT_CHAOTIC[name], wolf_exponent=FOOLED)
    assert verdict.regime in ("undecided", "quasi-periodic"), verdict.reason
    assert "bands" in verdict.named("0-1 test").sentence and "(1 bands)" not in verdict.named("0-1 test").sentence


def test_a_strange_nonchaotic_attractor_is_not_chaotic():
    """Its neighbours part, its next point can be predicted, its 0-1 test says irregular: it does not forget."""
    verdict = regime(strobed=nonchaotic_map(1.5, 600), wolf_exponent=FOOLED)
    assert verdict.regime == "undecided" and "memory" in verdict.reason


@pytest.mark.parametrize("row", [0, 150, 299])
def test_one_sample_far_outside_leaves_no_verdict(row):
    section = logistic(3.5, 300)
    section[row] = -9999.0
    verdict = regime(strobed=section)
    assert verdict.regime == "undecided" and f"row {row + 1} (-9999)" in verdict.reason


@pytest.mark.slow
def test_eleven_of_twelve_records_of_the_snapping_buoy_are_chaotic_and_none_is_periodic():
    """Eq. (33) at the paper's parameters: consecutive pieces of one orbit, 400 periods each; displacement only."""
    snap, words = SnapOscillator(), []
    for seed in range(12):
        start = strobed_states(snap, (0.68, 0.0), 1, 500 + 400 * seed)[0]
        record = snap_motion(snap, start, 400, 48).displacement
        words.append(quick(record, snap.period / 48, snap.period, seed=seed).regime)
    assert words.count("chaotic") >= 11
    assert not any(word.startswith("period-") for word in words)


@pytest.mark.parametrize(
    ("wolf", "tangent", "tighter", "word"),
    [
        ((0.509, 0.01), None, None, "chaotic"),
        ((0.509, 0.3), None, None, "undecided"),
        ((-0.2, 0.05), None, None, "undecided"),
        ((np.nan, np.nan), None, None, "undecided"),
        ((0.5, 0.01), (-0.1, 0.01), None, "undecided"),
        ((-0.1, 0.01), (0.5, 0.01), None, "chaotic"),
        (None, (0.509, 0.01), "chaotic", "chaotic"),
        (None, (0.509, 0.01), "period-2", "undecided"),
    ],
)
def test_chaos_needs_an_exponent_positive_by_two_errors_of_the_best_source_and_at_the_tighter_tolerance(
    wolf, tangent, tighter, word
):
    verdict = quick(strobed=henon(300), wolf_exponent=wolf, tangent_exponent=tangent, tighter=tighter)
    assert verdict.regime == word
