"""The regime of simulated motions, look by look: known maps with their tangents, transients, and what is not enough."""

import numpy as np
import pytest

from analysis import motion_regime, tangent_lyapunov
from analysis.exponents import Exponent
from analysis.looks import BLURRED, CLOSE, OF_STEPS
from tests.analysis.systems import circle, circle_map, henon, henon_growth, logistic, logistic_growth, normal

M = np.arange(1001)


def circle_growth(coupling, turns):
    return np.log(np.abs(1.0 - coupling * np.cos(2.0 * np.pi * turns[:-1])))


def turns_of(section):
    return np.arctan2(section[:, 1], section[:, 0]) / (2.0 * np.pi)


@pytest.mark.parametrize(("rate", "period"), [(2.8, 1), (3.2, 2), (3.5, 4), (3.55, 8), (3.832, 3)])
@pytest.mark.parametrize("carried", [True, False])
def test_windows_of_the_logistic_map_need_two_looks(rate, period, carried):
    orbit = logistic(rate, 300)
    verdict = motion_regime(orbit, logistic_growth(rate, orbit) if carried else None, scale=0.5)
    assert (verdict.regime, verdict.period) == (f"period-{period}", period)
    assert verdict.transient + verdict.points == 300
    assert motion_regime(orbit[:110], None, scale=0.5).regime == "undecided"


def test_a_strobed_record_of_chaos_alone_does_not_tell():
    orbit = logistic(4.0, 1001)
    assert motion_regime(orbit, logistic_growth(4.0, orbit), scale=1.0).regime == "chaotic"
    assert motion_regime(orbit, None, scale=1.0).regime == "undecided"


@pytest.mark.parametrize(("coupling", "rotation"), [(0.5, 0.6180339), (0.8, 0.41421356), (0.5, 0.1314)])
def test_tori_are_quasi_periodic_and_stay_so(coupling, rotation):
    section = circle_map(coupling, rotation, 1001)
    growth = circle_growth(coupling, turns_of(section))
    assert motion_regime(section, growth, scale=2.0).regime == "quasi-periodic"
    assert motion_regime(section + 1e-3 * normal(0, *section.shape), growth, scale=2.0,
                         tolerance=0.01).regime == "quasi-periodic"  # fmt: skip


@pytest.mark.parametrize(("errors", "word"), [(2.5, "undecided"), (3.5, "quasi-periodic")])
def test_one_look_is_enough_for_a_torus_whose_growth_is_below_the_bound_by_three_errors(errors, word):
    """Perturbations are carried too late for the look before the last one."""
    growth = np.full(465, np.nan)
    growth[270:] = normal(0, 195)
    (exponent,) = tangent_lyapunov(growth[280:])
    growth = (growth - exponent.value * np.log(2.0)) * 0.06 / (errors * exponent.error)
    assert motion_regime(circle_map(0.5, 0.6180339, 466), growth, scale=2.0).regime == word


def test_a_shear_does_not_make_a_torus_chaotic():
    """On a torus whose turns depend on its size a perturbation grows linearly in time: ln((k + 1)/k) a period."""
    growth = np.log1p(1.0 / np.arange(1, 1001))
    assert motion_regime(circle(0.6180339 * M), growth, scale=2.0).regime != "chaotic"


@pytest.mark.parametrize(("multiplier", "word"), [(0.97, "period-1"), (0.999, "transient")])
def test_a_decay_is_a_period_once_it_is_over(multiplier, word):
    section = np.array([21.0, 0.0]) + circle(M / (2 * np.pi)) * multiplier ** M[:, None]
    verdict = motion_regime(section, np.full(1000, np.log(multiplier)), scale=2.0, tolerance=1e-3)
    assert verdict.regime == word


def test_a_state_that_moves_though_its_start_is_forgotten_is_no_transient():
    section = 21.0 + np.random.default_rng(1).normal(scale=0.01, size=(1001, 2))
    verdict = motion_regime(section, np.full(1000, np.log(0.8)), scale=2.0, tolerance=1e-3)
    assert verdict.regime == "undecided" and BLURRED in verdict.reason


@pytest.mark.parametrize("offset", [1e-5, 2e-5])
def test_a_torus_beside_a_resonance_does_not_repeat_closely(offset):
    """Its six-period steps are small, but they add up: alone they are no evidence of a period."""
    section = circle((1.0 / 6.0 + offset) * M) + np.outer(0.96**M, [0.1, 0.05])
    verdict = motion_regime(section[:136], scale=2.0, tolerance=0.01)
    assert (verdict.evidence[-1].name, verdict.evidence[-1].passed) == (CLOSE, False)
    assert motion_regime(section, np.zeros(1000), scale=2.0, tolerance=0.01).period is None
    turns = np.arange(586)
    slowing = circle(turns / 6.0 + 0.01 * np.sin(2.0 * np.pi * turns / 2000.0))  # its steps shrink for 500 turns
    assert motion_regime(slowing, np.full(585, -1e-3), scale=2.0, tolerance=0.01).period is None


def going_on(value):
    return Exponent(value, 0.02, "bits/period", "given", "" if np.isfinite(value) else "newton-failed")


def test_chaos_has_to_survive_a_tighter_tolerance_after_the_look_that_finds_it():
    orbit = henon(466)
    growth = henon_growth(orbit)
    for value, word in ((0.6, "chaotic"), (0.01, "undecided"), (np.nan, "undecided")):
        for end in (205, 465):  # two looks in a row, or one from 465 periods on
            verdict = motion_regime(orbit[: end + 1], growth[:end], scale=1.0, tighter={end: going_on(value)})
            assert verdict.regime == word and verdict.transient == end // 3
    assert motion_regime(orbit, growth, scale=1.0, tighter={}).points == 465 - 465 // 3 + 1  # to be gone on from
    refused = {135: going_on(0.01), 205: going_on(0.01), 310: going_on(0.01)}
    assert motion_regime(orbit, growth, scale=1.0, tighter={**refused, 465: going_on(0.6)}).regime == "chaotic"


@pytest.mark.parametrize(("value", "of_steps"), [(-0.05, True), (-0.03, False), (0.03, False)])
def test_chaos_that_shrinks_at_a_tighter_tolerance_is_one_of_steps(value, of_steps):
    orbit = henon(466)
    verdict = motion_regime(orbit, henon_growth(orbit), scale=1.0, tighter={465: going_on(value)})
    assert verdict.regime == "undecided" and (OF_STEPS in verdict.reason) == of_steps


def test_a_shrinking_flip_is_no_period_2():
    """A motion that nears period 1 from both sides in turn repeats after 2 all the while."""
    noise = 1e-3 * normal(2, 1051, 2)
    flip = np.outer((-0.994) ** np.arange(1051), [0.1, 0.05]) + noise
    assert not any(motion_regime(flip[: n + 1], scale=2.0, tolerance=0.01).period for n in (135, 205))
    assert motion_regime(flip, scale=2.0, tolerance=0.01).regime == "period-1"
    stays = np.outer((-1.0) ** np.arange(136), [0.1, 0.05]) + noise[:136]
    assert motion_regime(stays, scale=2.0, tolerance=0.01).regime == "period-2"


def test_perturbations_may_be_carried_from_later_on():
    orbit, growth = henon(1001), henon_growth(henon(1001))
    growth[:400] = np.nan
    verdict = motion_regime(orbit, growth, scale=1.0)
    assert verdict.regime == "chaotic"
    growth[400:410] = 50.0  # they need ten periods to turn, which do not count
    assert motion_regime(orbit, growth, scale=1.0).named("exponent") == verdict.named("exponent")
