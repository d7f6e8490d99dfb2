"""Load cycles of a record, the constant load that does the same damage, and the utilisation of a line.

    damage ~ sum n_i R_i^m,    R_eq = (sum n_i R_i^m/N)^(1/m)

R_i are the ranges of the rainflow cycles, n_i is 1 for a whole cycle and 1/2 for a half, and m is the slope of the S-N
curve. N cycles of the range R_eq do the damage of the record (Palmgren, Miner).

The cycles are counted by the library `rainflow`, which follows ASTM E1049. `py-fatigue` counts them too, but brings
plotting libraries that nothing here needs.
"""

import numpy as np
from numpy.typing import ArrayLike

from analysis.sampling import checked_positive, checked_series

MEAN_FACTOR, DYNAMIC_FACTOR = 1.10, 1.50  # of DNV-OS-E301, ULS, consequence class 1, dynamic analysis
STRENGTH = 0.95  # characteristic strength of a line over its minimum breaking load (the same standard)


def rainflow_cycles(series: ArrayLike) -> np.ndarray:
    """The cycles of a series by the rainflow rule: (n, 3) range, mean and count (1 or 0.5) of each.

    series (n,)   samples in any unit, or turning points; the first and the last one count as turning points
    Raises ValueError for values that are not finite.
    Source: ASTM E1049-85, section 5.4.4.
    """
    from rainflow import extract_cycles

    cycles = [(size, mean, count) for size, mean, count, *_ in extract_cycles(checked_series(series))]
    return np.array(cycles).reshape(-1, 3)


def damage_equivalent_load(series: ArrayLike, cycles: float, slope: float) -> float:
    """The range R_eq that does the damage of a series in so many cycles (head of this file), in the unit of the series.

    series (n,)   samples or turning points
    cycles        N, for instance the number of waves in the record
    slope         m of the S-N curve: about 3 for chain, 4 to 5 for wire rope, 13 for polyester rope
    Raises ValueError for values that are not finite, or a number of cycles or a slope that is not above zero.
    """
    cycles, slope = checked_positive(cycles, "cycles"), checked_positive(slope, "slope")
    ranges, _, counts = rainflow_cycles(series).T
    if not ranges.any():
        return 0.0
    largest = ranges.max()  # steep slopes would overflow
    return float(largest * (np.sum(counts * (ranges / largest) ** slope) / cycles) ** (1.0 / slope))


def turning_points(low: ArrayLike, high: ArrayLike) -> np.ndarray:
    """Least and largest values in turn, of a record that keeps both for each sampling step: (m,).

    low, high (n,)   least and largest value since the previous sample. A peak of their middle counts with its largest
                     value, a trough with its least; so do the first and the last sample
    """
    low, high = checked_series(low, "low"), checked_series(high, "high")
    middle = 0.5 * (low + high)
    rising = np.diff(middle) > 0.0
    rises = np.concatenate([rising, ~rising[-1:]])
    risen = np.concatenate([~rising[:1], rising])
    peaks, troughs = risen & ~rises, ~risen & rises
    kept = np.flatnonzero(peaks | troughs)
    return np.where(peaks[kept], high[kept], low[kept])


def utilisation(
    mean_N: float,
    maximum_N: float,
    breaking_load_N: float,
    factors: tuple[float, float] = (MEAN_FACTOR, DYNAMIC_FACTOR),
) -> float:
    """Design tension over design strength by the form of DNV-OS-E301; a line is strong enough up to 1.

        u = (g_mean T_mean + g_dyn (T_max - T_mean))/(0.95 S_mbl)

    mean_N            mean tension of the sea
    maximum_N         most probable largest tension in three hours
    breaking_load_N   minimum breaking load S_mbl of a new line
    factors           g_mean, g_dyn: 1.10, 1.50 in consequence class 1; 1.40, 2.10 in class 2
    Raises ValueError for a breaking load that is not above zero.
    """
    strength_N = STRENGTH * checked_positive(breaking_load_N, "breaking_load_N")
    return (factors[0] * mean_N + factors[1] * (maximum_N - mean_N)) / strength_N
