"""Compilation of the kernels: one decorator, and code of their own for plane, space and lanes (`by_kind`).

Where machine code is kept, and when it is thrown away, is the business of `machine_code.store`.
"""

import hashlib
from functools import cache
from pathlib import Path

from numba import types

from machine_code.store import compiled, folder_for, hash_of

from .simd.fma import with_fused_sums

_ROOT = Path(__file__).parent
_KEPT_CACHES = 6


def _mangled_by_contents(record):
    return "Record", (hashlib.sha256(record.name.encode()).hexdigest()[:16],)


# Numba writes a record into the names of compiled functions as a number that counts the types its process has met.
# Two processes give one number to two records: code that one stored for the planar record and the other for the
# spatial one then has one name, and a process that loads both gets one of them for both. Names are only names: other
# users of Numba in the process lose nothing by names that tell records apart.
types.Record.mangling_args = property(_mangled_by_contents)


@cache
def source_hash():
    """Hash of everything in the engine that can change a result; part of the key of every stored run.

    Returns
    -------
    str
        sha256, hexadecimal, over the names and contents of all ``engine/**/*.py`` and ``*.toml``, and of
        ``machine_code``.
    """
    return hash_of(_ROOT, ".py", ".toml")


@cache
def cache_directory():
    """Folder for the machine code of these sources; None where nothing can be written."""
    return folder_for("kernels", source_hash(), _KEPT_CACHES)


def kernel(function):
    """Compile a kernel: no Python objects, no GIL, sums of products fused (`engine.simd.fma`), cached on disk.

    No ``fastmath``: what it allows differs from processor to processor and between one run and a batch; it breaks the
    range reduction of `engine.simd.elementary.sincos` and hides NaN.
    """
    return compiled(with_fused_sums(function), cache_directory())


def by_kind(planar, spatial, lanes=None):
    """One name for two kernels or three: `planar` for records of the plane, `spatial` for those with a third dimension,
    `lanes` for several planar runs at once (`engine.simd`; None: the planar one serves them too).

    The choice is by the type of the first argument, when a kernel that calls the name is compiled: nothing is compiled
    for a scene that does not need it, and nothing is decided at run time.
    """
    from numba.extending import overload

    def either(*arguments):
        raise NotImplementedError("only compiled kernels call this")

    @overload(either, strict=False, jit_options={"nogil": True, "error_model": "numpy"})
    def chosen(p, *arguments):
        from .simd.record import LaneRecord  # knows `engine.parameters`, which knows some of the kernels

        if "GI" in p.fields:
            return spatial.py_func
        return (lanes if lanes is not None and isinstance(p, LaneRecord) else planar).py_func

    return either
