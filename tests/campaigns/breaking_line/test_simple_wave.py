"""The simple wave of a breaking line: closed forms against quadrature, the published speeds, where shocks begin."""

import numpy as np
import pytest
from scipy.integrate import quad

from campaigns.breaking_line.theory import PAPER_LAW, break_theory, shock_start, simple_wave_work
from campaigns.breaking_line.theory import law as closed
from campaigns.breaking_line.theory.simple_wave import shock_speed, sonic_strain
from tests.campaigns.breaking_line.paper_line import CASES, FAST, LENGTH, MASS, SLOW, TENSIONS

LAW = closed.checked_law(PAPER_LAW, MASS)


@pytest.mark.parametrize("eps", [-20.0, -1.0, -0.1, 0.05, 0.2086, 0.35])
def test_speed_and_energy_integrals_are_those_of_the_law_also_in_deep_slack(eps):
    p1, p2, p3, p4, p5 = PAPER_LAW

    def pull(x):
        return p1 * np.tanh(p2 * x + p3) + p4 + p5 * x

    def c(x):
        return np.sqrt((p1 * p2 / np.cosh(p2 * x + p3) ** 2 + p5) / MASS)

    near = max(min(eps, 1.0), -2.0)  # quad wants the steep part apart from the long flat one
    assert closed.riemann(LAW, eps) == pytest.approx(sum(quad(c, *x)[0] for x in ((0, near), (near, eps))), abs=1e-9)
    assert closed.energy(LAW, eps) == pytest.approx(sum(quad(pull, *x)[0] for x in ((0, near), (near, eps))), rel=1e-9)


@pytest.mark.parametrize("guess", [-5.0, 0.2, 3.0])
@pytest.mark.parametrize("eps", [-26.0, -0.4, 0.0, 0.2, 0.3])
def test_strains_are_found_from_any_guess(eps, guess):
    assert closed.strain_of_riemann(LAW, closed.riemann(LAW, eps), guess) == pytest.approx(eps, rel=1e-12, abs=1e-13)
    assert closed.strain_of_tension(LAW, closed.tension(LAW, eps), guess) == pytest.approx(eps, rel=1e-12, abs=1e-13)


def test_without_the_curved_part_the_line_is_linear():
    line = closed.checked_law((0.0, 10.0, -2.0, 0.0, 5e4), 2.0)
    assert closed.riemann(line, 0.3) == pytest.approx(0.3 * np.sqrt(5e4 / 2.0), rel=1e-14)
    assert not np.isfinite(shock_start((0.0, 10.0, -2.0, 0.0, 5e4), 2.0, 1e4, FAST).time_s)


@pytest.mark.parametrize(
    ("tension0", "strain", "end_speed", "front"),
    [*zip(TENSIONS, (0.099, 0.178, 0.228, 0.292), (43.2, 111.2, 166.2, 228.3), (658, 1056, 1089, 800), strict=True)],
)
def test_strains_and_speeds_of_the_four_tensions(tension0, strain, end_speed, front):
    theory = break_theory(PAPER_LAW, MASS, LENGTH, tension0)
    assert theory.strain0 == pytest.approx(strain, abs=1e-3)  # the paper's per cent, cut or rounded
    assert theory.slack_strain == pytest.approx(2.76e-4, abs=5e-7)
    assert theory.end_speed_mps == pytest.approx(end_speed, abs=0.05)
    assert theory.front_speed_mps == pytest.approx(front, abs=0.5)
    assert theory.slack_front_speed_mps == pytest.approx(261.4, abs=0.05)


def test_the_late_shock_of_the_highest_tension():
    theory = break_theory(PAPER_LAW, MASS, LENGTH, 450e3)
    assert theory.shock_strain == pytest.approx(0.1695, abs=5e-5)
    assert theory.shock_speed_mps == pytest.approx(1027.0, abs=0.5)
    assert theory.shock_end_speed_mps == pytest.approx(228.8, abs=0.05)


@pytest.mark.parametrize("case", ["1", "2", "1p", "2p"])
def test_below_the_inflection_nothing_steepens(case):
    assert not np.isfinite(shock_start(PAPER_LAW, MASS, *CASES[case]).distance_m)
    assert np.isnan(break_theory(PAPER_LAW, MASS, LENGTH, CASES[case][0]).shock_speed_mps)


@pytest.mark.parametrize(("case", "distance"), [("3", 50.0), ("4", 3.9), ("4p", 39.0)])
def test_where_a_shock_begins(case, distance):
    assert shock_start(PAPER_LAW, MASS, *CASES[case]).distance_m == pytest.approx(distance, rel=0.01)


def test_when_the_shock_of_case_4_begins_and_that_it_scales_with_the_breaking_time():
    fast, slow = shock_start(PAPER_LAW, MASS, 450e3, FAST), shock_start(PAPER_LAW, MASS, 450e3, SLOW)
    assert fast.time_s == pytest.approx(5.2e-3, abs=5e-5)
    assert (slow.time_s, slow.distance_m) == pytest.approx((10 * fast.time_s, 10 * fast.distance_m), rel=1e-9)
    assert slow.strain == pytest.approx(fast.strain, rel=1e-6)


def test_a_sonic_shock_touches_the_law_and_is_the_fastest_into_its_strain():
    ahead = break_theory(PAPER_LAW, MASS, LENGTH, 450e3).strain0
    sonic = sonic_strain(LAW, ahead)
    fastest = shock_speed(LAW, ahead, sonic)
    assert fastest == pytest.approx(closed.wave_speed(LAW, sonic), rel=1e-9)
    assert all(shock_speed(LAW, ahead, behind) < fastest for behind in (sonic - 0.02, sonic + 0.02, 0.0))


def test_the_end_force_takes_out_energy_in_proportion_to_the_breaking_time():
    fast, slow = (simple_wave_work(PAPER_LAW, MASS, 450e3, t) for t in (FAST, SLOW))
    assert slow == pytest.approx(10.0 * fast, rel=1e-12) and fast < 0.0


@pytest.mark.parametrize("law", [(1.0, 2.0, 3.0, 4.0), (-1.0, 10.0, 0.0, 0.0, 1.0), (1.0, 10.0, 0.0, 0.0, 0.0)])
def test_a_law_that_does_not_rise_everywhere_is_refused(law):
    with pytest.raises(ValueError, match="law"):
        shock_start(law, MASS, 45e3, FAST)
