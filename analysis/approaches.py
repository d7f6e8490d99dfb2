"""Whether a run that has not settled comes nearer to a periodic orbit, and as fast as the orbit's multiplier says.

A slowly damped motion rings for hundreds of periods. Newton's method finds the orbit long before the run is there, and
the largest multiplier mu of the orbit says whether it attracts: |mu| + error < 1. Whether the run goes to this orbit,
and not to another motion, its distance from the orbit says. Near an orbit of period N it shrinks as |mu|^(k/N) in k
periods. So the last two thirds of a record are cut into three windows, with distances d_1, d_2, d_3 (rms over a window
of the largest difference of a coordinate, in its scale):

    near        d_3 <= near
    shrinks     d_3 <= left d_1
    as it must  ln(d_1/d_2) and ln(d_2/d_3) are within a factor `agrees` of what |mu| says

A run that stops at a saddle or at a torus beside the orbit, or decays towards another motion, has another rate. A run
on an orbit that attracts (d_3 <= arrived, what the steps of a run scatter) need not come nearer.
"""

import numpy as np
from numpy.typing import ArrayLike

from analysis.evidence import Evidence
from analysis.sampling import checked_columns

LEFT, AGREES = 0.65, 1.5
NEARER, ON_IT = "approach", "on an orbit"  # names of the evidence


def approached_period(
    strobed: ArrayLike, scale: ArrayLike, max_period: int = 16, *, left: float = LEFT, agrees: float = AGREES
) -> int | None:
    """The least N for which the steps over N periods shrink, and alike over both pairs of windows.

    strobed (m + 1, d), scale (d,)   as in `detect_period`
    left                             what is left at most of the steps
    agrees                           the rates differ at most by the square of this factor
    """
    x = checked_columns(strobed, "strobed") / np.asarray(scale)
    for period in range(1, min(max_period, len(x) // 9) + 1):
        distances, rates = _in_windows(x[period:] - x[:-period])
        if distances[2] <= left * distances[0] and 0.0 < rates.max() <= agrees**2 * rates.min():
            return period
    return None


def approach_evidence(
    strobed: ArrayLike,
    orbit: ArrayLike,
    multipliers: ArrayLike,
    errors: ArrayLike,
    scale: ArrayLike,
    *,
    near: float = 0.2,
    left: float = LEFT,
    agrees: float = AGREES,
    arrived: float = 0.002,
) -> Evidence:
    """Whether a record comes nearer to a periodic orbit that attracts (head of this file).

    strobed (m + 1, d)            states once a forcing period, from the start of the run on
    orbit (N, d)                  the strobed states of the orbit, in order
    multipliers, errors (k,)      of the orbit, the largest first
    scale (d,)                    size of the motion in each coordinate
    near, arrived                 distance of the last window, in that scale: of an orbit that counts, of a run on it
    left                          what is left of the distance of the first window at most
    agrees                        factor by which the rates may differ from that of the orbit
    Returns the Evidence ON_IT of a run that lies on the orbit, else NEARER. Its value is the multiplier that the
    distances show, the threshold that of the orbit.
    """
    x, points = checked_columns(strobed, "strobed"), checked_columns(orbit, "orbit")
    order, period = np.arange(len(x)), len(points)
    phases = [_in_windows((x - points[(order + k) % period]) / np.asarray(scale)) for k in range(period)]
    distances, rates = min(phases, key=lambda phase: phase[0][2])
    moduli = np.abs(multipliers)
    expected = -np.log(moduli[0]) / period
    attracts = (moduli + errors).max() < 1.0
    alike = (expected / agrees <= rates) & (rates <= agrees * expected)
    comes_nearer = alike.all() and distances[2] <= min(near, left * distances[0])
    on_it = distances[2] <= arrived
    passed = attracts and (comes_nearer or on_it)
    shown = np.exp(-rates.mean() * period)
    attraction = "attracts" if attracts else "is not known to attract"
    way = f"the run comes nearer as that says ({shown:.4f} each time)"
    if on_it:
        way = "the run lies on it"
    elif not passed:
        way = f"the run is not shown to come nearer as that says ({shown:.4f} each time)"
    sentence = (
        f"a period-{period} orbit lies {100.0 * distances[2]:.2g} % of the motion away; "
        f"it {attraction} (leading multiplier {moduli[0]:.4f} ± {errors[0]:.1g}), "
        f"and {way}"
    )
    name = ON_IT if on_it else NEARER
    return Evidence(name, shown, moduli[0], passed, sentence)


def _in_windows(differences: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(3,) distances in the three windows, and the two rates, nats a period, at which they shrink."""
    window = 2 * len(differences) // 9
    away = np.abs(differences[-3 * window :]).max(axis=1).reshape(3, window)
    distances = np.maximum(np.sqrt(np.mean(away**2, axis=1)), np.finfo(float).tiny)
    return distances, -np.diff(np.log(distances)) / window
