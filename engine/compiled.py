"""Compilation of the kernels: one decorator, and code of their own for plane, space and lanes (`by_kind`).

Where machine code is kept, and when it is thrown away, is the business of `machine_code.store`.
"""

import hashlib
from functools import cache
from pathlib import Path

from numba import from_dtype, types
from numba.extending import models, register_model

from machine_code.parts import compiled_in_parts
from machine_code.store import folder_of, hash_of

from .record import KINDS, Kind
from .simd.fma import with_fused_sums
from .simd.vector import LaneRecord

_ROOT = Path(__file__).parent
_KEPT_CACHES = 6
_KINDS = {from_dtype(dtype): kind for dtype, kind in KINDS.items()}


# Numba writes a record into the names of compiled functions as a number that counts the types its process has met.
# Two processes give one number to two records: code that one stored for the planar record and the other for the
# spatial one then has one name, and a process that loads both gets one of them for both. Names are only names: other
# users of Numba in the process lose nothing by names that tell records apart.
types.Record.mangling_args = property(lambda kind: ("Record", (hashlib.sha256(kind.name.encode()).hexdigest()[:16],)))


@cache
def source_hash() -> str:
    """Hash of everything in the engine that can change a result; part of the key of every stored run.

    sha256, hexadecimal, over the names and the code of all `engine/**/*.py` and `*.toml`, and of `machine_code`.
    Docstrings and comments do not count.
    """
    return hash_of(_ROOT, endings=(".py", ".toml"))


def kernel(function):
    """Compile a kernel: no Python objects, no GIL, sums of products fused (`engine.simd.fma`), cached on disk.

    No ``fastmath``: what it allows differs from processor to processor and between one run and a batch; it breaks the
    range reduction of `engine.simd.elementary.sincos` and hides NaN.
    """
    return compiled_in_parts(with_fused_sums(function), folder_of("kernels", source_hash(), _KEPT_CACHES))


def by_kind(planar, spatial, lanes=None, plain=None, extra=None):
    """One name for kernels that do the same for different kinds of runs.

    A kernel that calls the returned name gets `planar`, `spatial`, `lanes` or `plain`, by the type of the first
    argument: a RECORD, a SPATIAL, a PLAIN (`engine.record`) or a LaneRecord (`engine.simd.vector`: several planar runs
    at once; `plain` where these are). Numba chooses while it compiles the caller. So a scene compiles only the kernels
    that it uses, and no run pays for the choice. lanes = None: the planar kernel serves several runs at once too;
    plain = None: so does that of the lanes for plain scenes. extra: of an EXTRA and an EXTRA_SPATIAL, which are else
    served as a RECORD and a SPATIAL.
    """
    lanes = planar if lanes is None else lanes
    return _Choice(planar, spatial, lanes, lanes if plain is None else plain, extra)


def of_extras(otherwise=None):
    """Declare a kernel that EXTRA and EXTRA_SPATIAL runs have (`by_kind`); all others get the constant `otherwise`."""

    def declared(function):
        def without(p, *arguments):
            return otherwise

        without.__qualname__ = f"{function.__module__}_{function.__name__}"  # Numba names machine code by this
        constant = compiled_in_parts(without, None)
        return by_kind(constant, constant, extra=kernel(function))

    return declared


class _Choice:
    def __init__(self, *kernels):
        self.kernels = kernels  # a type of Numba does not keep them alive
        self._numba_type_ = _ChoiceType(*kernels)

    def __call__(self, p, *arguments):
        """In Python, with a record of NumPy: of what `work_arrays` is made of."""
        return self.kernels[self._numba_type_.place(KINDS[p.dtype])].py_func(p, *arguments)


class _ChoiceType(types.Callable, types.Dummy):
    """What Numba asks of a function: of the kernel that is chosen."""

    def __init__(self, *kernels):
        self.kernels = [types.Dispatcher(kernel) for kernel in kernels if kernel is not None]
        super().__init__(f"choice({', '.join(kernel.name for kernel in self.kernels)})")

    def _chosen(self, p):
        in_lanes = isinstance(p, LaneRecord)
        kind = Kind(plain=p.plain, extras=p.extras) if in_lanes else _KINDS[p]
        return self.kernels[self.place(kind, in_lanes)]

    def place(self, kind, in_lanes=False):
        """Which of the kernels serves a record of this kind."""
        if kind.extras and len(self.kernels) > 4:
            return 4
        if kind.plain:
            return 3
        if kind.spatial:
            return 1
        return 2 if in_lanes else 0

    def get_call_type(self, context, arguments, keywords):
        return self._chosen(arguments[0]).get_call_type(context, arguments, keywords)

    def get_impl_key(self, signature):
        return self._chosen(signature.args[0]).get_impl_key(signature)

    def get_call_signatures(self):
        return [], True


register_model(_ChoiceType)(models.OpaqueModel)
