"""The breaking line in one dimension: closed forms, the published speeds, and the motion by characteristics.

The motion: d'Alembert, balance of energy, Rankine-Hugoniot and Lax, second order. The engine converges to it:
`tests/engine/physics/test_shock_capturing.py`.
"""

from functools import cache
from itertools import pairwise, product

import numpy as np
import pytest
from scipy.integrate import quad

from campaigns.breaking_line.theory import PAPER_LAW, fitted_break
from campaigns.breaking_line.theory import law as closed
from campaigns.breaking_line.theory import simple_wave as wave_theory
from campaigns.breaking_line.theory.simple_wave import break_theory, case_of, shock_start, simple_wave_work
from tests.engine.lines import orders

LENGTH, MASS = 60.0, 1140.0 * 1.964e-3
FAST, SLOW = 5e-3, 50e-3
TENSIONS = (45e3, 180e3, 315e3, 450e3)
CASES = {f"{i + 1}{mark}": (TENSIONS[i], t) for i, (mark, t) in product(range(4), (("", FAST), ("p", SLOW)))}
LAW = closed.checked_law(PAPER_LAW, MASS)
EVERYWHERE = np.linspace(0.0, LENGTH, 24001)


def broken(force, decay=FAST):
    return case_of(PAPER_LAW, MASS, LENGTH, force, decay)


@cache
def motion(case, until, lines=200):
    return fitted_break(PAPER_LAW, MASS, LENGTH, *CASES[case], until, lines)


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


@pytest.mark.parametrize(
    ("tension0", "strain", "end_speed", "front"),
    [*zip(TENSIONS, (0.099, 0.178, 0.228, 0.292), (43.2, 111.2, 166.2, 228.3), (658, 1056, 1089, 800), strict=True)],
)
def test_strains_and_speeds_of_the_four_tensions(tension0, strain, end_speed, front):
    theory = break_theory(broken(tension0))
    assert theory.strain0 == pytest.approx(strain, abs=1e-3)  # the paper's per cent, cut or rounded
    assert theory.slack_strain == pytest.approx(2.76e-4, abs=5e-7)
    assert theory.end_speed_mps == pytest.approx(end_speed, abs=0.05)
    assert theory.front_speed_mps == pytest.approx(front, abs=0.5)
    assert theory.slack_front_speed_mps == pytest.approx(261.4, abs=0.05)


@pytest.mark.parametrize(("case", "distance"), [("1", np.inf), ("2p", np.inf), ("3", 50.0), ("4", 3.9), ("4p", 39.0)])
def test_where_a_shock_begins_below_the_inflection_nowhere(case, distance):
    assert shock_start(broken(*CASES[case])).distance_m == pytest.approx(distance, rel=0.01)
    assert np.isnan(break_theory(broken(*CASES[case])).shock_end_speed_mps) == np.isinf(distance)


def test_a_slow_break_steepens_and_takes_out_energy_in_proportion_to_its_time():
    fast, slow = (shock_start(broken(450e3, decay)) for decay in (FAST, SLOW))
    assert fast.time_s == pytest.approx(5.2e-3, abs=5e-5)
    assert (slow.time_s, slow.distance_m) == pytest.approx((10 * fast.time_s, 10 * fast.distance_m), rel=1e-9)
    work, slow_work = (simple_wave_work(broken(450e3, decay)) for decay in (FAST, SLOW))
    assert slow_work == pytest.approx(10.0 * work, rel=1e-12) and work < 0.0


def test_a_sonic_shock_touches_the_law_and_is_the_fastest_into_its_strain():
    strain0 = broken(450e3).strain0
    sonic = wave_theory.sonic_strain(LAW, strain0)
    assert sonic == pytest.approx(0.1695, abs=5e-5)
    fastest = wave_theory.shock_speed(LAW, strain0, sonic)
    assert fastest == pytest.approx(closed.wave_speed(LAW, sonic), rel=1e-9)
    assert all(wave_theory.shock_speed(LAW, strain0, behind) < fastest for behind in (sonic - 0.02, sonic + 0.02, 0.0))


@pytest.mark.parametrize("law", [(1.0, 2.0, 3.0, 4.0), (-1.0, 10.0, 0.0, 0.0, 1.0), (1.0, 10.0, 0.0, 0.0, 0.0)])
def test_a_law_that_does_not_rise_everywhere_is_refused(law):
    with pytest.raises(ValueError, match="law"):
        case_of(law, MASS, LENGTH, 45e3, FAST)


def test_a_linear_line_is_dalembert_through_every_echo():
    stiffness, force, decay = 5e4, 1e4, 2e-3
    c = np.sqrt(stiffness / MASS)
    line = fitted_break((0.0, 10.0, -2.0, 0.0, stiffness), MASS, 1.0, force, decay, 6.5 / c)

    def released(t):  # F(t) - F(0), what leaves the end
        t = np.clip(t, 0.0, decay)
        return -force * np.sin(0.5 * np.pi * t / decay) ** 2

    s = np.linspace(0.0, 1.0, 41)
    for t in np.array([0.4, 1.3, 2.6, 3.7, 5.5, 6.4]) / c:
        # Images: the fixed end returns T as it is, the free end with the other sign.
        pull = force + sum(
            (-1) ** n * (released(t - (2 * n + 1 - s) / c) + released(t - (2 * n + 1 + s) / c)) for n in range(4)
        )
        assert line.at(s, t)[2] == pytest.approx(pull, abs=1e-5 * force)


def over_line(wave, t, *densities):
    """Integrals over the line of functions of (strain, velocity) at a time, apart on the two sides of a shock."""
    shock = wave.shock
    inside = len(shock.time_s) > 1 and shock.time_s[0] <= t < shock.time_s[-1]
    places = [float(shock.at(t)[0])] if inside else []
    total = np.zeros(len(densities))
    for low, high in pairwise([0.0, *places, LENGTH]):
        s = np.linspace(low, high, 20001)
        s[-1] = high if high == LENGTH else np.nextafter(high, low)
        strain, velocity, _ = wave.at(s, t)
        total += [np.trapezoid(density(strain, velocity), s) for density in densities]
    return total


def end_force(force, decay, t):
    return force * np.where(t < decay, np.cos(0.5 * np.pi * t / decay) ** 2, 0.0)


@pytest.mark.parametrize(("case", "until"), [("4", 0.058), ("3", 0.055), ("4p", 0.073), ("2", 0.12), ("3p", 0.1)])
def test_energy_is_balanced_with_what_the_shock_loses(case, until):
    wave, (force, decay) = motion(case, until), CASES[case]
    least = closed.energy(LAW, break_theory(wave.case).slack_strain)
    rest, lost = LENGTH * (closed.energy(LAW, wave.case.strain0) - least), []
    for t in (0.3 * until, 0.8 * until, 0.99 * until):
        stored = (lambda strain, u: closed.energy(LAW, strain) - least), (lambda strain, u: 0.5 * MASS * u**2)
        times = np.linspace(0.0, min(t, decay), 4001)
        speed = np.array([wave.at([LENGTH], now)[1][0] for now in times[::10]])
        work = np.trapezoid(end_force(force, decay, times) * np.interp(times, times[::10], speed), times)
        lost.append(wave.lost_J(t))
        assert rest + work - over_line(wave, t, *stored).sum() - lost[-1] == pytest.approx(0.0, abs=1e-5 * rest)
    assert np.all(np.diff(lost) >= 0.0) and (lost[-1] > 0.0) == (case in ("3", "4", "4p"))


def test_the_shock_obeys_rankine_hugoniot_and_lax_and_turns_sonic():
    wave = motion("4", 0.058)
    shock = wave.shock
    ahead, behind, speeds = shock.ahead[1:], shock.behind[1:], shock.speed_mps[1:]
    inside = shock.time_s[1:] < 0.055
    points = np.column_stack([shock.time_s, shock.place_m, shock.speed_mps])[1:][inside]
    for now, s, speed in points[:: len(points) // 9]:
        strain, velocity, pull = wave.at([s * (1 - 1e-9), s * (1 + 1e-9)], now)
        assert velocity[1] - velocity[0] == pytest.approx(-speed * (strain[0] - strain[1]), rel=1e-4)
        assert pull[0] - pull[1] == pytest.approx(MASS * speed**2 * (strain[0] - strain[1]), rel=1e-4)
    assert np.all(closed.wave_speed(LAW, ahead) < speeds) and np.all(speeds < closed.wave_speed(LAW, behind))
    sonic = wave_theory.sonic_strain(LAW, wave.case.strain0)
    missing = np.abs(behind[inside] - sonic)
    assert missing[-1] < 0.006 and np.all(np.diff(missing) < 0.0)
    assert speeds[-1] < wave_theory.shock_speed(LAW, wave.case.strain0, sonic)
    assert speeds[-1] == pytest.approx(1027.0, rel=1e-3)


def test_the_echo_of_the_shock_adds_half_a_metre_a_second_to_the_end():
    wave = motion("4", 0.058)
    theory = break_theory(wave.case)
    assert 0.0137 < wave.first_echo_s < 0.0139
    assert wave.at([LENGTH], 0.0137)[1][0] == pytest.approx(-theory.end_speed_mps, rel=1e-9)
    late = -wave.at([LENGTH], 0.058)[1][0]
    assert theory.shock_end_speed_mps == pytest.approx(228.8, abs=0.05)
    assert theory.shock_end_speed_mps - 0.03 < late < theory.shock_end_speed_mps


@pytest.mark.slow
def test_the_error_falls_with_the_square_of_the_lines():
    finest = motion("4", 0.058, 800)
    place = [motion("4", 0.058, lines).shock.at(0.04)[0] - finest.shock.at(0.04)[0] for lines in (50, 100, 200)]
    assert np.all(np.abs(orders(np.abs(place)) - 2.0) < 0.2) and abs(place[-1]) < 1e-4
    strains = [motion("2", 0.12, lines).at(EVERYWHERE, 0.1)[0] for lines in (50, 100, 200, 800)]
    errors = [np.mean(np.abs(strain - strains[-1])) for strain in strains[:-1]]
    assert np.all(orders(errors) > 1.5) and errors[-1] < 1e-5


def test_the_ends_and_the_undisturbed_part_keep_their_conditions():
    wave = motion("2", 0.14)
    for t in (0.001, 0.004, 0.03, 0.08, 0.13):
        _, velocity, pull = wave.at([0.0, LENGTH], t)
        assert velocity[0] == pytest.approx(0.0, abs=1e-12)
        assert pull[1] == pytest.approx(end_force(180e3, FAST, t), abs=1e-3)
    assert wave.at([1.0], 0.05)[0][0] == wave.case.strain0


@pytest.mark.parametrize(("case", "until"), [("3", 0.0551), ("4p", 0.0738)])
def test_a_motion_ends_where_a_second_shock_begins(case, until):
    wave = motion(case, 0.1)
    assert wave.valid_until_s == pytest.approx(until, abs=1e-4)
    with pytest.raises(ValueError, match="time_s"):
        wave.at([30.0], 0.09)


def test_no_shock_is_fitted_before_it_begins():
    assert motion("4p", 0.0515).shock.time_s.size == 0 < motion("4p", 0.0525).shock.time_s.size


def test_slack_is_followed_below_the_last_stiffness():
    wave = motion("4", 0.1)
    strain, _, pull = wave.at(EVERYWHERE, 0.1)
    assert strain.min() < -1.0 and np.all(np.isfinite(strain))
    assert pull == pytest.approx(closed.tension(LAW, strain), rel=1e-12)
