"""Compilation of the measures' kernels.

The engine does the same for its own, in a folder of its own: a change in one of the two packages does not throw away
the machine code of the other. Where and how it is kept is the business of `machine_code.store`.
"""

from functools import cache
from pathlib import Path

from machine_code.store import compiled, folder_of, hash_of

_KEPT_CACHES = 16


@cache
def source_hash():
    """sha256, hexadecimal, of the names and the code of all ``analysis/**/*.py`` and of ``machine_code``: of everything
    that can change a result of a kernel."""
    return hash_of(Path(__file__).parent)


def kernel(function):
    """Compile a kernel: no Python objects, no GIL, fused multiply-add allowed, cached on disk.

    Full ``fastmath`` is not used: it would let the compiler assume that no NaN exists, and NaN is how a measure says
    that nothing qualified. Division by zero gives inf or NaN, as in NumPy, and indices are not checked.
    """
    return compiled(function, folder_of("analysis", source_hash(), _KEPT_CACHES), fastmath={"contract"})
