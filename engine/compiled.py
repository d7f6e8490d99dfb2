"""Compilation of the kernels: one decorator, and code of their own for plane, space and lanes (`by_kind`).

Where machine code is kept, and when it is thrown away, is the business of `machine_code.store`.
"""

import hashlib
from functools import cache
from pathlib import Path

from numba import types
from numba.extending import overload

from machine_code.store import compiled, folder_of, hash_of

from .simd.fma import with_fused_sums
from .simd.vector import LaneRecord

_ROOT = Path(__file__).parent
_KEPT_CACHES = 6


# Numba writes a record into the names of compiled functions as a number that counts the types its process has met.
# Two processes give one number to two records: code that one stored for the planar record and the other for the
# spatial one then has one name, and a process that loads both gets one of them for both. Names are only names: other
# users of Numba in the process lose nothing by names that tell records apart.
types.Record.mangling_args = property(lambda kind: ("Record", (hashlib.sha256(kind.name.encode()).hexdigest()[:16],)))


@cache
def source_hash() -> str:
    """Hash of everything in the engine that can change a result; part of the key of every stored run.

    sha256, hexadecimal, over the names and contents of all `engine/**/*.py` and `*.toml`, and of `machine_code`.
    """
    return hash_of(_ROOT, ".py", ".toml")


def kernel(function):
    """Compile a kernel: no Python objects, no GIL, sums of products fused (`engine.simd.fma`), cached on disk.

    No ``fastmath``: what it allows differs from processor to processor and between one run and a batch; it breaks the
    range reduction of `engine.simd.elementary.sincos` and hides NaN.
    """
    return compiled(with_fused_sums(function), folder_of("kernels", source_hash(), _KEPT_CACHES))


def by_kind(planar, spatial, lanes=None):
    """One name for kernels that do the same for different kinds of runs.

    A kernel that calls the returned name gets `planar`, `spatial` or `lanes`, by the type of the first argument: a
    RECORD, a SPATIAL (`engine.record`) or a LaneRecord (`engine.simd.vector`: several planar runs at once). Numba
    chooses while it compiles the caller. So a scene compiles only the kernels that it uses, and no run pays for the
    choice. lanes = None: the planar kernel serves several runs at once too.
    """

    def either(*arguments):
        raise NotImplementedError("only compiled kernels call this")

    @overload(either, strict=False, jit_options={"nogil": True, "error_model": "numpy"})
    def chosen(p, *arguments):
        if "GI" in p.fields:
            return spatial.py_func
        return (lanes if lanes is not None and isinstance(p, LaneRecord) else planar).py_func

    return either
