"""Motions that are not chaotic are not called so, even when the exponent says they are."""

import pytest

from analysis import regime
from tests.analysis.forced_records import KINDS, SAMPLES, record

# An estimator fooled by noise: a positive exponent, 25 errors away from 0, for every record.
FOOLED = (0.5, 0.02)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("number", [0, 1])
def test_no_false_alarm(kind, number):
    verdict = regime(record(kind, number), 1 / SAMPLES, 1.0, wolf_exponent=FOOLED)
    assert verdict.regime != "chaotic", verdict.reason


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("exponent", [FOOLED, None], ids=["fooled", "wolf"])
def test_no_false_alarm_in_more_than_200_records(kind, exponent):
    for number in range(100, 136):
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
