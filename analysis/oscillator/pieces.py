"""The closed form of eq. (33) within a piece, where a is 1 (taut) or 0 (slack) throughout.

A forcing period is cut into windows (one, unless the period is long) and time tau runs from the start of the window,
where the forcing has the phase theta. Within a piece

    (g, g')(tau) = Phi_a(tau) (x, v) + q_a(tau),

Phi the fundamental matrix, q the response to F sin(omega tau + theta) + (B - W) from rest at 0, and (x, v) the state
that the piece would have had at the start of the window: it need not have been valid there. All pieces of a window thus
share their functions of tau, which are tabled once at even nodes; a node costs two multiplications.

    taut    Phi = e^{-mu tau/2} [cos + mu/2 s, s; -s, cos - mu/2 s] of nu tau,  s = sin(nu tau)/nu,  nu^2 = 1 - mu^2/4
    slack   Phi = [1, E1; 0, e],  e = e^{-mu tau},  E1 = (1 - e)/mu,  E2 = (tau - E1)/mu    (series for small mu tau)

det Phi = e^{-mu tau} in both. Curvature bounds, used to exclude hidden crossings (`crossings`): the taut homogeneous
part is Re(A e^{lambda tau}) with |lambda| = 1, so its second derivative is at most |A|; the slack acceleration is that
of the steady velocity plus (B - W - mu (v - v_p)) e.

In the paper: eq. (33) snap oscillator, closed form.
"""

import math
from dataclasses import astuple
from typing import NamedTuple

import numpy as np

from analysis.compiled import kernel
from analysis.oscillator.equation import SnapOscillator

NODES = 64  # least number of intervals in a window; an interval is also at most 0.1 long (1/60 of a natural period)
LONGEST_INTERVAL = 0.1
LONGEST_WINDOW = 8.0
MOST_DECAY = 2.0  # mu times a window: the inverse of Phi grows as its exponential


class Piecewise(NamedTuple):
    """Everything the kernels need of one oscillator: constants, and tables over the nodes of a window."""

    constants: np.ndarray  # see `constants_of`
    theta: np.ndarray  # (windows + 1,) phase of the forcing at the start of each window, and at the end
    tau: np.ndarray  # (nodes + 1,)
    phi: np.ndarray  # (2, 4, nodes + 1): slack, taut; 11 12 21 22
    q: np.ndarray  # (windows, 2, 2, nodes + 1): displacement, velocity
    steady: np.ndarray  # (windows, 2, 2): the steady part of q, displacement and velocity at the window's start
    reach: np.ndarray  # (windows,) upper bound of q of the slack piece
    size: np.ndarray  # (windows,) largest |q| of either piece, for the rounding floor


class Piece(NamedTuple):
    """A piece of a motion: whether taut (1) or slack (0), and what its closed form needs within a window."""

    a: int
    x: float  # the state that the piece would have had at the start of the window
    v: float
    theta: float  # phase of the forcing there
    k: np.ndarray  # see `constants_of`
    p0: float  # the steady motion there
    w0: float


MU, OMEGA, LIFT, NU, TAUT_SIN, TAUT_COS, SLACK_SIN, SLACK_COS, TAUT_ACC, SLACK_ACC = range(10)


@kernel
def constants_of(mu, omega, force, lift):
    """The numbers the closed forms are made of; the indices above name them."""
    k = np.empty(10)
    square = (1.0 - omega * omega) ** 2 + (mu * omega) ** 2
    k[MU], k[OMEGA], k[LIFT], k[NU] = mu, omega, lift, math.sqrt(1.0 - 0.25 * mu * mu)
    k[TAUT_SIN] = force * (1.0 - omega * omega) / square
    k[TAUT_COS] = -force * mu * omega / square
    k[SLACK_SIN] = force * mu / (mu * mu + omega * omega)
    k[SLACK_COS] = -force * omega / (mu * mu + omega * omega)
    k[TAUT_ACC] = omega * omega * force / math.sqrt(square)
    k[SLACK_ACC] = omega * force / math.sqrt(mu * mu + omega * omega)
    return k


@kernel
def relaxation(mu, tau):
    """e = e^{-mu tau} and its integrals E1, E2, to rounding for any mu tau >= 0, mu = 0 included."""
    x = mu * tau
    if x < 0.5:
        total = 0.0
        for k in range(14, 0, -1):  # Horner form of the sum of 2 (-x)^j/(j + 2)!, j >= 1
            total = -(1.0 + total) * x / (k + 2.0)
        e2 = 0.5 * tau * tau * (1.0 + total)
        e1 = tau - mu * e2
        return 1.0 - mu * e1, e1, e2
    e = math.exp(-x)
    e1 = (1.0 - e) / mu
    return e, e1, (tau - e1) / mu


@kernel
def steady_motion(a, k, sine, cosine):
    """The particular solution that q is made of, at a phase: displacement, velocity (slack: less the lift's part)."""
    if a == 1:
        place = k[LIFT] + k[TAUT_SIN] * sine + k[TAUT_COS] * cosine
        return place, k[OMEGA] * (k[TAUT_SIN] * cosine - k[TAUT_COS] * sine)
    place = (k[SLACK_COS] * sine - k[SLACK_SIN] * cosine) / k[OMEGA]
    return place, k[SLACK_SIN] * sine + k[SLACK_COS] * cosine


@kernel
def motion(a, tau, theta, k, p0, w0):
    """Phi (11, 12, 21, 22) and q (displacement, velocity) of piece a at tau; p0, w0 the steady motion at tau = 0."""
    phase = k[OMEGA] * tau + theta
    p, w = steady_motion(a, k, math.sin(phase), math.cos(phase))
    if a == 1:
        decay = math.exp(-0.5 * k[MU] * tau)
        s = decay * math.sin(k[NU] * tau) / k[NU]
        c = decay * math.cos(k[NU] * tau)
        c1, c2 = c + 0.5 * k[MU] * s, c - 0.5 * k[MU] * s
        return c1, s, -s, c2, p - c1 * p0 - s * w0, w + s * p0 - c2 * w0
    e, e1, e2 = relaxation(k[MU], tau)
    return 1.0, e1, 0.0, e, p - p0 - w0 * e1 + k[LIFT] * e2, w - w0 * e + k[LIFT] * e1


@kernel
def curvature_bound(a, x, v, k, p0, w0):
    """An upper bound of |g''| over the window for the piece a of state (x, v) at the window's start."""
    if a == 1:
        y, u = x - p0, v - w0
        w = (u + 0.5 * k[MU] * y) / k[NU]
        return math.sqrt(y * y + w * w) + k[TAUT_ACC]
    return abs(k[LIFT] - k[MU] * (v - w0)) + k[SLACK_ACC]


@kernel
def piecewise(mu, omega, force, lift, phase):
    """Tables for one oscillator; costs about as much as ten forcing periods."""
    period = 2.0 * math.pi / omega
    windows = max(1, math.ceil(period / LONGEST_WINDOW), math.ceil(mu * period / MOST_DECAY))
    span = period / windows
    nodes = max(NODES, math.ceil(span / LONGEST_INTERVAL), math.ceil(NODES * omega * span / (2.0 * math.pi)))
    k = constants_of(mu, omega, force, lift)
    tau = np.arange(nodes + 1) * (span / nodes)
    theta = np.empty(windows + 1)
    phi = np.empty((2, 4, nodes + 1))
    q = np.empty((windows, 2, 2, nodes + 1))
    steady = np.empty((windows, 2, 2))
    reach, size = np.empty(windows), np.empty(windows)
    for window in range(windows + 1):
        theta[window] = phase + 2.0 * math.pi * (window % windows) / windows
    for window in range(windows):
        for a in range(2):
            p0, w0 = steady_motion(a, k, math.sin(theta[window]), math.cos(theta[window]))
            steady[window, a] = p0, w0
            for j in range(nodes + 1):
                matrix_and_response = motion(a, tau[j], theta[window], k, p0, w0)
                phi[a, :, j], q[window, a, :, j] = matrix_and_response[:4], matrix_and_response[4:]
        bulge = curvature_bound(0, 0.0, 0.0, k, steady[window, 0, 0], steady[window, 0, 1]) * tau[1] ** 2 / 8.0
        reach[window] = q[window, 0, 0].max() + bulge
        size[window] = np.abs(q[window, :, 0]).max()
    return Piecewise(k, theta, tau, phi, q, steady, reach, size)


def tables(oscillator: SnapOscillator) -> Piecewise:
    """The `Piecewise` record of a SnapOscillator."""
    return piecewise(*(float(number) for number in astuple(oscillator)))
