"""The exact motion of the breaking line, evaluated anywhere: simple wave, fitted shock, echo of the fixed end."""

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicHermiteSpline, PchipInterpolator

from analysis.compiled import kernel
from analysis.sampling import checked_not_negative, checked_series
from campaigns.breaking_line.theory import characteristics as row
from campaigns.breaking_line.theory.characteristics import Net
from campaigns.breaking_line.theory.law import riemann, strain_of_riemann, strain_of_tension, tension, wave_speed
from campaigns.breaking_line.theory.simple_wave import Case, ShockStart, dissipation, end_force, simple_wave_at


@dataclass(frozen=True, eq=False)
class ShockPath:
    """A shock from its start to the fixed end, or to the end of the solution; all (rows,)."""

    time_s: np.ndarray
    place_m: np.ndarray  # from the fixed end, in unstretched length
    ahead: np.ndarray  # strain
    behind: np.ndarray
    speed_mps: np.ndarray  # sigma of Rankine-Hugoniot, towards the fixed end
    emission_s: np.ndarray  # when the characteristic met from ahead left the end; 0: the shock leads the wave

    def at(self, time_s):
        """(place [m], strain ahead, strain behind) at times (m,) of the path; nan outside it.

        The place is a cubic with the speeds as slopes. Strains grow as the root of the time since the start.
        """
        t = np.asarray(time_s, float)
        if len(self.time_s) < 2:
            return tuple(np.full(t.shape, np.nan) for _ in range(3))
        inside = (t >= self.time_s[0]) & (t <= self.time_s[-1])
        root = np.sqrt(np.clip(t - self.time_s[0], 0.0, None))
        place = CubicHermiteSpline(self.time_s, self.place_m, -self.speed_mps)(t)
        rows = PchipInterpolator(np.sqrt(self.time_s - self.time_s[0]), [*zip(self.ahead, self.behind, strict=True)])
        ahead, behind = rows(root).T
        return tuple(np.where(inside, column, np.nan) for column in (place, ahead, behind))


@dataclass(frozen=True, eq=False)
class FittedBreak:
    """The motion after `fitted_break`; `at` evaluates it."""

    case: Case  # what was asked for
    start: ShockStart  # of the simple wave: where theory lets the shock begin
    shock: ShockPath  # no rows when none forms on the line in time
    valid_until_s: float  # the time asked for, or when a second shock begins that is not fitted
    first_echo_s: float  # when the first wave from the fixed end or the shock is at the broken end; inf: not yet
    net: Net  # the crossings of characteristics
    starts: np.ndarray  # where the C+ start, see `characteristics`

    def at(self, s_m, time_s):
        """Strain, velocity [m/s] along +s and tension [N] at places (m,) [m], each (m,), at one time [s].

        On the shock itself: the state behind it. ValueError outside the line or after valid_until_s.
        """
        s, t, law = checked_series(s_m, "s_m"), checked_not_negative(time_s, "time_s"), self.case.law
        if np.any((s < 0.0) | (s > self.case.length)) or t > self.valid_until_s:
            raise ValueError(f"s_m, time_s: 0 ... {self.case.length} m and 0 ... {self.valid_until_s} s are needed")
        behind, latest = self._behind_from(t)
        ahead = s < behind
        strain, velocity = np.empty(len(s)), np.empty(len(s))
        strain[ahead] = simple_waves(self.case, s[ahead], t, latest)
        velocity[ahead] = riemann(law, strain[ahead]) - riemann(law, self.case.strain0)
        if not np.all(ahead):
            strain[~ahead], velocity[~ahead] = self._crossed(s[~ahead], t, behind)
        return strain, velocity, tension(law, strain)

    def lost_J(self, time_s):
        """Energy [J] lost in the shock up to a time [s]; stored + kinetic + lost = stored at rest + work of the end."""
        shock = self.shock
        if len(shock.time_s) < 2:
            return 0.0
        power = np.array([dissipation(self.case.law, a, b) for a, b in zip(shock.ahead, shock.behind, strict=True)])
        lost = np.append(0.0, np.cumsum(0.5 * (power[1:] + power[:-1]) * np.diff(shock.time_s)))
        return float(np.interp(time_s, shock.time_s, lost))

    def _behind_from(self, t):
        """Where the net of crossing characteristics begins at t, and the last emission time ahead of it."""
        shock = len(self.shock.time_s)
        if t < self.starts[0, row.TIME]:
            return np.inf, np.inf
        if not shock or t >= self.shock.time_s[-1]:
            return 0.0, 0.0
        return float(self.shock.at(t)[0]), self.shock.emission_s[np.searchsorted(self.shock.time_s, t, "right") - 1]

    def _crossed(self, s, t, edge):
        """Strain and velocity at s, all in the net, which begins at `edge` at time t."""
        law, length, shock = self.case.law, self.case.length, len(self.shock.time_s)
        crossings = np.empty((len(self.net.p) + len(self.net.q), 3)).T
        count = on_outgoing(law, self.net, self.starts[-1, row.LINE], length, t, crossings)
        count = on_echoes(self.net, self.starts, shock, t, crossings, count)
        crossings = crossings[:, :count].T
        if edge > 0.0:
            left = np.interp(t, self.starts[:shock, row.TIME], self.starts[:shock, row.P_BEHIND])
            first = (edge, left, left - 2.0 * riemann(law, float(self.shock.at(t)[2])))
        else:
            wall = self.starts[max(shock - 1, 0) :]
            left = np.interp(t, wall[:, row.TIME], wall[:, row.P_BEHIND])
            first = (0.0, left, -left)
        force = end_force(self.case, t)
        # what leaves the broken end: of the force alone until an echo is back
        incoming = 2.0 * riemann(law, strain_of_tension(law, force, 0.2)) - riemann(law, self.case.strain0)
        right = incoming if t <= self.first_echo_s else float(np.interp(t, self.net.tau, self.net.p))
        last = (length, right, right - 2.0 * riemann(law, strain_of_tension(law, force, 0.0)))
        closest = 1e-9 * length
        crossings = crossings[(crossings[:, 0] > edge + closest) & (crossings[:, 0] < length - closest)]
        rows = np.vstack([first, crossings[np.argsort(crossings[:, 0])], last])
        rows = rows[np.append(True, np.diff(rows[:, 0]) > closest)]
        p, q = PchipInterpolator(rows[:, 0], rows[:, 1:])(s).T
        return strains_of(law, 0.5 * (p - q)), 0.5 * (p + q)


@kernel
def simple_waves(case, s, t, latest):
    """eps (m,) of the simple wave at places s (m,) [m]; `simple_wave_at`."""
    out = np.empty(len(s))
    for i in range(len(s)):
        out[i] = simple_wave_at(case, s[i], t, latest)[0]
    return out


@kernel
def strains_of(law, phi):
    """eps (m,) of phi (m,) [m/s]."""
    out, eps = np.empty(len(phi)), 0.0
    for i in range(len(phi)):
        eps = strain_of_riemann(law, phi[i], eps)
        out[i] = eps
    return out


@kernel
def on_outgoing(law, net, ended, length, t, crossings):
    """Fill `crossings` (3, at least lines) with place [m], p and q [m/s] where each C- is at time t; return how many.

    ended    the last C- that has come to the shock or the wall: what lies up to it ends with its last crossing, what
             lies behind goes on straight from there
    """
    count = 0
    for i in range(len(net.p)):
        if net.tau[i] > t:
            break
        t0, s0, q0, alive = net.tau[i], length, net.born_q[i], i > ended
        for k in range(len(net.q)):
            if np.isnan(net.T[i, k]):
                continue
            if net.T[i, k] >= t:
                share = (t - t0) / (net.T[i, k] - t0) if net.T[i, k] > t0 else 0.0
                s0, q0 = s0 + share * (net.S[i, k] - s0), q0 + share * (net.q[k] - q0)
                t0, alive = t, True
                break
            t0, s0, q0 = net.T[i, k], net.S[i, k], net.q[k]
        if alive:
            c = wave_speed(law, strain_of_riemann(law, 0.5 * (net.p[i] - q0), 0.0))
            crossings[:, count] = s0 - c * (t - t0), net.p[i], q0
            count += 1
    return count


@kernel
def on_echoes(net, starts, shock, t, crossings, count):
    """Go on filling `crossings` from `count` with where the C+ of the fixed end are at t, between known crossings.

    Needed where p hardly changes and its lines are few, while an echo passes. The C+ of the shock, its first `shock`
    rows, are left out: q hardly changes from one to the next, and p is less well known along them.
    """
    for k in range(shock, len(net.q)):
        if starts[k, row.TIME] > t:
            break
        first = int(starts[k, row.LINE])
        t0, s0, p0 = starts[k, row.TIME], starts[k, row.PLACE], starts[k, row.P_BEHIND]
        for i in range(first + 1, len(net.p)):
            if np.isnan(net.T[i, k]):
                break
            if net.T[i, k] >= t:
                share = (t - t0) / (net.T[i, k] - t0) if net.T[i, k] > t0 else 0.0
                crossings[:, count] = s0 + share * (net.S[i, k] - s0), p0 + share * (net.p[i] - p0), net.q[k]
                count += 1
                break
            t0, s0, p0 = net.T[i, k], net.S[i, k], net.p[i]
    return count
