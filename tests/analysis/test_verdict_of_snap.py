"""Eq. (33) at the paper's parameters is chaotic (lambda_1 = 0.509 bits per period); its period-8 orbit is period-8."""

import pytest

from analysis import regime
from analysis.oscillator import SnapOscillator, search_periodic_orbits, snap_motion, strobed_states

SAMPLES = 48
SNAP = SnapOscillator()
NOT_ENOUGH = ((0.509, 0.3), (-0.2, 0.05), (float("nan"), float("nan")))
GIVEN = [(0.509, 0.01), *NOT_ENOUGH]


def _verdict(number, periods=400, **given):
    """Consecutive pieces of one orbit on the chaotic attractor, 400 periods each; displacement only."""
    start = strobed_states(SNAP, (0.68, 0.0), 1, 500 + 400 * number)[0]
    motion = snap_motion(SNAP, start, periods, SAMPLES)
    return regime(motion.displacement, SNAP.period / SAMPLES, SNAP.period, seed=number, **given)


@pytest.mark.slow
@pytest.mark.parametrize("number", [0, 1])
def test_the_displacement_alone_shows_chaos(number):
    verdict = _verdict(number)
    assert verdict.regime == "chaotic", verdict.reason
    assert all(item.passed for item in verdict.evidence if item.name in ("exponent", "0-1 test", "linear null"))


@pytest.mark.slow
def test_at_least_nine_of_ten_records_of_400_periods_are_chaotic_and_none_is_periodic():
    words = [_verdict(number).regime for number in range(20)]
    assert words.count("chaotic") >= 18
    assert not any(word.startswith("period-") for word in words)


@pytest.mark.slow
@pytest.mark.parametrize("given", GIVEN)
def test_chaos_needs_an_exponent_positive_by_two_errors(given):
    verdict = _verdict(3, wolf_exponent=given)
    assert (verdict.regime == "chaotic") == (given == (0.509, 0.01))
    assert verdict.regime in ("chaotic", "undecided")


@pytest.mark.slow
def test_the_exponent_of_the_tangent_dynamics_goes_before_that_of_the_series():
    assert _verdict(3, wolf_exponent=(0.5, 0.01), tangent_exponent=(-0.1, 0.01)).regime == "undecided"
    assert _verdict(3, wolf_exponent=(-0.1, 0.01), tangent_exponent=(0.5, 0.01)).regime == "chaotic"


@pytest.mark.slow
def test_chaos_must_survive_the_tighter_tolerance():
    exponent = (0.509, 0.01)
    assert _verdict(4, tangent_exponent=exponent, tighter="chaotic").regime == "chaotic"
    changed = _verdict(4, tangent_exponent=exponent, tighter="period-2")
    assert changed.regime == "undecided" and "tighter tolerance is period-2" in changed.reason


def test_the_coexisting_orbit_is_period_8():
    starts = [(-20.0 + 4 * i, -10.0 + 4 * j) for i in range(8) for j in range(6)]
    orbits = [orbit for orbit in search_periodic_orbits(SNAP, 8, starts) if orbit.stable]
    motion = snap_motion(SNAP, orbits[0].points[0], 120, SAMPLES)
    verdict = regime(motion.displacement, SNAP.period / SAMPLES, SNAP.period)
    assert (verdict.regime, verdict.period) == ("period-8", 8), verdict.reason
