"""Kernels that only kernels call: compiled for their callers and not for Python.

Numba makes machine code of every function as soon as somebody calls it, optimises it, and links and optimises it again
within each caller, up to the top. A Part stays as the front end leaves it. What Python calls (a Whole) takes in all
Parts below it once, and only that is optimised and translated. So the time to compile no longer grows with the depth
of the calls, and nobody pays for wrappers that are not used. The same was proposed for Numba itself (numba#9566).
"""

import gc
from contextlib import contextmanager
from functools import cache
from pathlib import Path

from numba.core import typed_passes as typed
from numba.core import types
from numba.core import untyped_passes as untyped
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import CompilerBase
from numba.core.compiler_machinery import PassManager

from .store import compiled


class _Library(JITCodeLibrary):
    """Code that takes in what the Parts that it calls call in their turn, callers before those whom they call."""

    def add_linking_library(self, library):
        below = library._linking_libraries if isinstance(library, _Part) else ()
        for one in (library, *below):
            if one not in self._linking_libraries:
                super().add_linking_library(one)


class _Part(_Library):
    """Code of a kernel for its callers."""

    def finalize(self):
        for function in self._final_module.functions:
            if not function.is_declaration and function.linkage.name == "external":
                function.linkage = "linkonce_odr"
        self._shared_module, self._finalized = self._final_module, True

    def get_pointer_to_function(self, name):
        """Zero, as Numba has it for functions without machine code."""
        self._ensure_finalized()
        return 0

    @property
    def codegen(self):
        return self

    def set_env(self, name, environment):
        """Nothing: what a kernel of Python objects would need."""


@cache
def _passes():
    """Numba's own passes, without those for what no kernel has: closures, comprehensions, generators, literal types,
    objects, exceptions, parallel loops, functions that are inlined before they have types."""
    manager = PassManager("kernel")
    for one in (
        untyped.TranslateByteCode, untyped.FixupArgs, untyped.IRProcessing, untyped.RewriteSemanticConstants,
        untyped.DeadBranchPrune, untyped.GenericRewrites, untyped.ReconstructSSA, typed.NopythonTypeInference,
        typed.PreLowerStripPhis, typed.NopythonRewrites, typed.IRLegalization, typed.NativeLowering,
        typed.NoPythonBackend,
    ):  # fmt: skip
        manager.add_pass(one)
    manager.finalize()
    return manager


_found: dict[tuple, object] = {}  # what a function of Numba gives for arguments of these types


@contextmanager
def _without_detours(context):
    """While a kernel is compiled: no search for garbage, of which there is none, and what Numba has once found out
    about a sum of two numbers is not found out again. Half of the time of the front end went into both."""
    if "resolve_function_type" in vars(context):  # a kernel within a kernel
        yield
        return
    search, collects = context.resolve_function_type, gc.isenabled()

    def resolve(function, arguments, keywords):
        kind = context._lookup_global(function) or function
        if keywords or not isinstance(kind, types.Function):
            return search(function, arguments, keywords)
        key = kind, tuple(arguments)
        if key not in _found:
            _found[key] = search(function, arguments, keywords)
        return _found[key]

    context.resolve_function_type = resolve
    gc.disable()
    try:
        yield
    finally:
        del context.resolve_function_type
        if collects:
            gc.enable()


class _WholeCompiler(CompilerBase):
    library = _Library

    def compile_extra(self, function):
        with _without_detours(self.state.typingctx):
            return super().compile_extra(function)

    def define_pipelines(self):
        state = self.state
        state.library = self.library(state.targetctx.codegen(), state.func_id.func_qualname)
        state.library.enable_object_caching()
        return [_passes()]


class _PartCompiler(_WholeCompiler):
    library = _Part


def compiled_in_parts(function, folder: Path | None):
    """As `machine_code.store.compiled`, but other kernels that call this one take in a Part in its place."""
    part = compiled(function, None, no_cpython_wrapper=True, pipeline_class=_PartCompiler)
    whole = compiled(function, folder, pipeline_class=_WholeCompiler)
    whole.get_call_template, whole.get_overload = part.get_call_template, part.get_overload
    return whole
