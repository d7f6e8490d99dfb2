"""Orbit diagrams of eq. (33) over one of its parameters, with both exponents at every value."""

from dataclasses import astuple, dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from analysis.oscillator.equation import SnapOscillator
from analysis.oscillator.growth import random_starts, standard_error
from analysis.oscillator.motions import checked_starts
from analysis.oscillator.strobing import growth_over_values
from analysis.sampling import checked_count, checked_series

FIELDS = ("damping", "frequency", "force", "lift", "phase")


@dataclass(frozen=True, eq=False)
class SnapDiagram:
    """An orbit diagram with exponents; p values, n starts each.

    over              the parameter: "force", "frequency", "damping", "lift"
    values (p,)
    section (p, n, m, 2)   strobed g and g' after the transient, by start: coexisting attractors stay apart
    exponents (p, n, 2)    lambda_1, lambda_2 of every start, nats per unit of time
    errors (p, n)          standard error of lambda_1, from blocks of time
    slack_fraction (p, n)  share of the time without tension
    """

    over: str
    values: np.ndarray
    section: np.ndarray
    exponents: np.ndarray
    errors: np.ndarray
    slack_fraction: np.ndarray


def snap_diagram(
    oscillator: SnapOscillator,
    over: str,
    values: ArrayLike,
    starts: ArrayLike | None = None,
    count: int = 4,
    transient_periods: int = 500,
    periods: int = 1000,
    points: int = 200,
    blocks: int = 10,
    seed: int = 0,
) -> SnapDiagram:
    """Orbit diagram of eq. (33): strobed states and both exponents at each value of one parameter.

    over, values        "force", "frequency", "damping" or "lift", and its values (p,)
    starts              (n, 2) states from which every value is begun; None: `count` random ones from `seed`, in
                        PAPER_BOX. Several, because attractors coexist; the same at every value, so that no
                        value depends on the one before it.
    transient_periods   forcing periods left out;  periods  of the averages, a multiple of `blocks`
    points              strobed states kept, at most `periods`
    Returns SnapDiagram. NaN where an orbit could not be computed.
    ValueError for a name that is no parameter, for values that the oscillator does not allow, and for odd counts.
    Source: Tjavaras et al. 1998, eq. (33); exponents as in `snap_exponents`.
    """
    if over not in FIELDS[:-1]:
        raise ValueError(f"over: one of {', '.join(FIELDS[:-1])} is needed, given {over!r}")
    values = checked_series(values, "values")
    periods, blocks = checked_count(periods, "periods"), checked_count(blocks, "blocks", 2)
    points, transient = checked_count(points, "points"), checked_count(transient_periods, "transient_periods", 0)
    if periods % blocks or points > periods:
        raise ValueError(f"periods: a multiple of blocks = {blocks}, at least points = {points}, given {periods}")
    starts = random_starts(count, seed) if starts is None else checked_starts(starts)
    all_of_them = [replace(oscillator, **{over: float(value)}) for value in values]
    parameters = np.array([astuple(one) for one in all_of_them], dtype=float)
    sums, section, _, slack = growth_over_values(parameters, starts, transient, blocks, periods // blocks, points)
    length = periods // blocks * np.array([one.period for one in all_of_them])
    rates = sums / length[:, None, None, None]
    errors = standard_error(np.moveaxis(rates[..., 0], 2, 0))
    return SnapDiagram(over, values, section, rates.mean(axis=2), errors, slack)
