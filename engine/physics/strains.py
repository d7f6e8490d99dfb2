"""A tension law outside the kernels: T at a strain, and the strain under a load."""

from collections.abc import Sequence
from functools import cache
from types import SimpleNamespace

from .tension import LAWS, NAMES, TensionLaw


@cache
def _numbers_of(law):
    """(module, parameters, table) of a law, as its kernels have them."""
    module = LAWS[NAMES.index(law.law)]
    numbers, table = module.numbers(law)
    return module, SimpleNamespace(law_at=0, **numbers), table


def tension_at(strain: float, law: TensionLaw) -> float:
    """T (N) at a strain, outside the kernels."""
    return tensions_at([strain], law)[0]


def tensions_at(strains: Sequence[float], law: TensionLaw) -> list[float]:
    """T (N) at strains."""
    module, p, table = _numbers_of(law)
    return [float(module.value(strain, p, table)[0]) for strain in strains]


def strain_at(load: float, law: TensionLaw) -> float:
    """Smallest positive strain that carries `load` (N), within [1e-9, 10]."""
    closed = getattr(_numbers_of(law)[0], "strain_under", None)
    if closed is not None:
        return max(closed(load, law), 1e-9)
    from scipy.optimize import brentq

    low, high = 1e-9, 1e-6
    while tension_at(high, law) < load and high < 10:
        low, high = high, 2 * high
    if tension_at(low, law) >= load or tension_at(high, law) < load:
        return high
    return brentq(lambda e: tension_at(e, law) - load, low, high)
