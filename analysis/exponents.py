"""The record that every estimate of a Lyapunov exponent comes back in, and its units.

    d(t) ~ d(0) e^{lambda t} = d(0) 2^{sigma t/T_i},     sigma = lambda T_i/ln 2                                (32)

lambda is in nats per unit of time, sigma in bits per forcing period. Whatever the method, an estimate carries an error,
and where nothing qualified it is NaN with a reason. It is never 0 for want of an answer: 0 is a result, and says
"neither grows nor shrinks".

In the paper: eq. (32) Lyapunov exponent.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from analysis.sampling import checked_positive

NATS_PER_TIME = "nats/time"
BITS_PER_PERIOD = "bits/period"


@dataclass(frozen=True, eq=False)
class Exponent:
    """An estimate of a Lyapunov exponent (or of a rate of growth) with its error.

    value      the estimate in `unit`; NaN where nothing qualified
    error      one standard error in `unit`; NaN where value is NaN, and where the method gives no error
    unit       "nats/time" (per unit of the sampling step) or "bits/period" (per forcing period, eq. 32)
    method     which estimator, with its reference, e.g. "Wolf et al. 1985"
    reason     one sentence: why this value, or, if it is NaN, why there is none
    details    what the estimator wants shown: settings, curves, plateau (names by the estimator)

    ValueError for another unit, a negative error, or a NaN without a reason.
    """

    value: float
    error: float
    unit: str
    method: str
    reason: str = ""
    details: Mapping[str, object] = field(default_factory=dict)

    def __post_init__(self):
        if self.unit not in (NATS_PER_TIME, BITS_PER_PERIOD):
            raise ValueError(f"unit: {NATS_PER_TIME!r} or {BITS_PER_PERIOD!r} is needed, given {self.unit!r}")
        if self.error < 0.0:
            raise ValueError(f"error: a number >= 0 or NaN is needed, given {self.error!r}")
        if np.isnan(self.value) and not self.reason:
            raise ValueError("reason: an exponent that is NaN must say why")
        object.__setattr__(self, "value", float(self.value))
        error = float(self.error) if np.isfinite(self.value) else np.nan
        object.__setattr__(self, "error", error)

    def __str__(self) -> str:
        if not self.found:
            return f"none: {self.reason}"
        return f"{self.value:.3f} ± {self.error:.3f} {self.unit}, by {self.method}"

    @property
    def found(self) -> bool:
        """True where there is an estimate: value is a finite number."""
        return bool(np.isfinite(self.value))

    def in_bits_per_period(self, period: float) -> Exponent:
        """The same estimate per forcing period, sigma = lambda T_i/ln 2 of eq. (32); `period` in the unit of time of
        the sampling step. `details` stay in the units in which the estimator wrote them."""
        if self.unit == BITS_PER_PERIOD:
            return self
        factor = checked_positive(period, "period") / np.log(2.0)
        return replace(self, value=self.value * factor, error=self.error * factor, unit=BITS_PER_PERIOD)


def no_exponent(
    method: str, reason: str, unit: str = NATS_PER_TIME, details: Mapping[str, object] | None = None
) -> Exponent:
    """An Exponent without a value: NaN, with the sentence that says why nothing qualified.

    method, reason    as in Exponent; reason must not be empty
    unit, details     as in Exponent
    Returns an Exponent whose `found` is False.
    """
    return Exponent(np.nan, np.nan, unit, method, reason, details or {})
