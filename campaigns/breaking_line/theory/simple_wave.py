"""What theory says of the breaking line before anything is computed: simple wave, steepening, shock conditions.

No gravity, no bending: m u_t = T(eps)_s and eps_t = u_s on 0 <= s <= L, u = 0 at s = 0, T = F(t) at s = L, where

    F(t) = F_s cos^2(pi t/(2 t_br)) until t_br, then 0,                                             (section 4.1.1)

from rest at the uniform strain eps_0, T(eps_0) = F_s. With phi of `law`, u + phi is constant along ds/dt = -c and
u - phi along ds/dt = +c. Until something comes back from the fixed end or from a shock the motion is a simple wave:

    u = phi(eps) - phi(eps_0),   eps constant along L - s = c(eps) (t - tau),   T(eps) = F(tau).

A shock running towards the fixed end, state a ahead and b behind, obeys Rankine-Hugoniot,

    sigma^2 = (T_a - T_b)/(m (eps_a - eps_b)),   u_b = u_a - sigma (eps_a - eps_b),

and needs c_a <= sigma <= c_b (Lax). Since T has an inflection, c_b = sigma is reached (the chord touches the law):
behind a centred wave the shock ends there and a fan goes on; behind a break of finite duration that is the late limit.
Source: Courant & Friedrichs, Supersonic Flow and Shock Waves (1948), sections 29-55; Oleinik (1959) for the chord.
"""

from collections import namedtuple

import numpy as np

from analysis.compiled import kernel
from analysis.sampling import checked_positive
from campaigns.breaking_line.theory.law import (
    checked_law,
    energy,
    riemann,
    slope,
    strain_of_tension,
    tension,
    wave_speed,
    wave_speed_slope,
)

SCAN = 4000  # emission times looked at for the first crossing of characteristics
POINTS = 200  # of the quadrature of the end work

# law (p1 ... p5, m), length L [m], force F_s [N], decay t_br [s], strain0: eps_0, stop: followed up to then [s]
Case = namedtuple("Case", "law length force decay strain0 stop")


def case_of(parameters, mass, length, tension0, decay_s, until_s=np.inf):
    """A break, checked.

    parameters    p1 ... p5 of eq. (20);  mass  [kg/m];  length  [m];  tension0  F_s [N];  decay_s  t_br [s]
    until_s       [s] how long it is followed
    ValueError for a law that does not rise everywhere, and for numbers that are not above zero.
    """
    law, force = checked_law(parameters, mass), checked_positive(tension0, "tension0")
    length, decay = checked_positive(length, "length"), checked_positive(decay_s, "decay_s")
    return Case(law, length, force, decay, float(strain_of_tension(law, force, 0.2)), float(until_s))


@kernel
def end_force(case, t):
    """F(t) [N]; t [s]."""
    return case.force * np.cos(0.5 * np.pi * t / case.decay) ** 2 if t < case.decay else 0.0


@kernel
def shock_speed(law, ahead, behind):
    """sigma [m/s] of Rankine-Hugoniot; c for a jump too small to divide by."""
    jump = ahead - behind
    if abs(jump) < 1e-7:
        return wave_speed(law, 0.5 * (ahead + behind))
    return np.sqrt((tension(law, ahead) - tension(law, behind)) / (law[5] * jump))


@kernel
def dissipation(law, ahead, behind):
    """Power [W] lost in a shock: sigma times the area between the law and its chord, from behind to ahead."""
    chord = 0.5 * (tension(law, ahead) + tension(law, behind)) * (ahead - behind)
    return shock_speed(law, ahead, behind) * (energy(law, ahead) - energy(law, behind) - chord)


@kernel
def sonic_strain(law, ahead):
    """Strain behind the strongest shock into `ahead`: where the chord touches the law, sigma = c_b.

    `ahead` itself where the law is not concave at `ahead`: unloading then spreads and no shock lasts.
    """
    high = -law[2] / law[1]  # the inflection
    if ahead <= high:
        return ahead
    low, gap = high, ahead - high
    while (tension(law, ahead) - tension(law, low)) < slope(law, low) * (ahead - low):
        low -= gap
    for _ in range(200):
        middle = 0.5 * (low + high)
        if (tension(law, ahead) - tension(law, middle)) < slope(law, middle) * (ahead - middle):
            high = middle
        else:
            low = middle
    return 0.5 * (low + high)


@kernel
def crossing_of(case, tau):
    """(time, distance from the broken end) [s, m] at which the characteristic of emission time tau meets its
    neighbour: tau + c/(dc/d tau) and c^2/(dc/d tau); inf where it does not."""
    law = case.law
    t = np.pi * tau / case.decay
    rate = -0.5 * np.pi * case.force / case.decay * np.sin(t)
    eps = strain_of_tension(law, end_force(case, tau), 0.2)
    steepening = wave_speed_slope(law, eps) * rate / slope(law, eps)
    if steepening <= 0.0:
        return np.inf, np.inf
    c = wave_speed(law, eps)
    return tau + c / steepening, c * c / steepening


# Where characteristics of the simple wave first cross; all inf or nan when they never do:
# time_s, distance_m: from the start of the break, and from the broken end (may be longer than the line)
# emission_s: when the characteristic on which it forms left the end; strain, speed_mps: on that characteristic
ShockStart = namedtuple("ShockStart", "time_s distance_m emission_s strain speed_mps")


def shock_start(case):
    """Time and place at which unloading first steepens into a shock: the least time on the envelope of characteristics.

        t = tau + c/(dc/dtau),   L - s = c^2/(dc/dtau),   dc/dtau = c'(eps) F'(tau)/T'(eps)

    Returns a ShockStart. The fixed end is not looked at: compare distance_m with the length, and time_s with the time
    L/c(eps_0) at which the front gets there. Both scale with t_br. Source: head of this file.
    """
    taus = np.linspace(0.0, case.decay, SCAN + 1)[1:-1]
    times = np.array([crossing_of(case, tau)[0] for tau in taus])
    first = int(np.argmin(times))
    if not np.isfinite(times[first]):
        return ShockStart(np.inf, np.inf, np.nan, np.nan, np.nan)
    low, high = taus[max(first - 1, 0)], taus[min(first + 1, len(taus) - 1)]
    golden = 0.5 * (np.sqrt(5.0) - 1.0)
    for _ in range(80):
        left, right = high - golden * (high - low), low + golden * (high - low)
        if crossing_of(case, left)[0] < crossing_of(case, right)[0]:
            high = right
        else:
            low = left
    tau = 0.5 * (low + high)
    strain = strain_of_tension(case.law, end_force(case, tau), 0.2)
    return ShockStart(*map(float, (*crossing_of(case, tau), tau, strain, wave_speed(case.law, strain))))


# Speeds of the simple wave of a line broken under F_s, and its late shock:
# strain0, slack_strain: where T = F_s, and where T = 0;  front_speed_mps: c(strain0), the first thing that moves
# slack_front_speed_mps: c(slack_strain), the edge of the part without tension
# end_speed_mps: of the broken end once T = 0 there, without the shock's small addition
# front_arrival_s: when the front would reach the fixed end
# shock_end_speed_mps: of the broken end behind the strongest (sonic) shock into strain0 and its fan, once its echo has
# come back; nan without a shock
BreakTheory = namedtuple(
    "BreakTheory",
    "strain0 slack_strain front_speed_mps slack_front_speed_mps end_speed_mps front_arrival_s shock_end_speed_mps",
)


def break_theory(case):
    """End speed, front speeds and the late shock of the breaking line, independent of the breaking time.

        end speed = integral of sqrt(T'/m) d eps from T = 0 to T = tension0;   fronts sqrt(T'/m) at both ends of it

    Returns a BreakTheory. shock_end_speed_mps is nan at or below the inflection, where unloading spreads.
    Source: Tjavaras et al. 1998, section 4.1.2; head of this file.
    """
    law, strain0 = case.law, case.strain0
    slack, front, sonic = strain_of_tension(law, 0.0, 0.0), wave_speed(law, strain0), sonic_strain(law, strain0)
    end_speed = riemann(law, strain0) - riemann(law, slack)
    behind_shock = shock_speed(law, strain0, sonic) * (strain0 - sonic) + riemann(law, sonic) - riemann(law, slack)
    speeds = (front, wave_speed(law, slack), end_speed, case.length / front)
    return BreakTheory(*map(float, (strain0, slack, *speeds, behind_shock if sonic < strain0 else np.nan)))


def simple_wave_work(case):
    """Work [J] that the decaying end force does on the line, negative: the part of the stored energy that a slow break
    takes out before anything moves freely.

        A = integral_0^t_br F(t) u(t) dt = -t_br integral_0^1 F (phi(eps_0) - phi(eps(F))) d(t/t_br)

    Proportional to t_br. Exact while no echo of the fixed end or of a shock has reached the end before t_br: the
    midpoint rule on an even, smooth, periodic integrand converges faster than any power (50 points give 10 digits).
    """
    at_rest, total = riemann(case.law, case.strain0), 0.0
    for k in range(POINTS):
        pull = end_force(case, case.decay * (k + 0.5) / POINTS)
        total += pull * (riemann(case.law, strain_of_tension(case.law, pull, 0.2)) - at_rest)
    return float(case.decay * total / POINTS)


@kernel
def simple_wave_at(case, s, t, latest):
    """eps at s [m], t [s] in the simple wave, and when its characteristic left the end, at most `latest` [s].

    L - s = c(tau) (t - tau) is solved by bisection. Not folded, or ahead of a shock with `latest` the emission time of
    the characteristic that the shock met there before, it has one root, or none: still at rest, tau = 0.
    """
    law, way = case.law, case.length - s
    if way >= wave_speed(law, case.strain0) * t:
        return case.strain0, 0.0
    low, high, eps = 0.0, min(t, latest), case.strain0
    while high - low > 1e-17 + 4e-16 * high:
        tau = 0.5 * (low + high)
        if tau in (low, high):
            break
        eps = strain_of_tension(law, end_force(case, tau), eps)
        if wave_speed(law, eps) * (t - tau) > way:
            low = tau
        else:
            high = tau
    return eps, high
