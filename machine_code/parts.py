"""Kernels that kernels call: compiled for their callers and not for Python.

Numba makes machine code of every function that a kernel calls, optimises it, and links and optimises it again within
each of its callers, up to the top: the time grows with the depth of the calls. Here a kernel that another one calls is
a part, which stays as Numba's front end leaves it: without machine code, without a wrapper for Python, not kept on
disk. A kernel that Python calls is a whole: it takes in all parts below it, once, and only then LLVM optimises and
translates them. A kernel may be both. The same was proposed for Numba itself (pull request 9566, not merged).

LLVM may neither fuse nor reorder the operations of numbers, so that a whole gives the bits that its parts would give.
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
from numba.core.compiler_machinery import PassManager, register_pass

from .store import compiled

PARTS_OF_ARRAYS = "getitem", "static_getitem"  # how Numba names the operations that take a part of an array


class _Library(JITCodeLibrary):
    """Takes in, with every part that it calls, what this part calls; callers first, because LLVM's linker leaves out
    what nobody has asked for yet."""

    def add_linking_library(self, library):
        below = library._linking_libraries if isinstance(library, _Part) else ()
        for linked in (library, *below):
            if linked not in self._linking_libraries:
                super().add_linking_library(linked)

    def add_ir_module(self, module):
        """Takes in a module, whose functions shall find their stack where vectors of 64 bytes may be put: LLVM would
        let those that do not fit into registers straddle two lines of the cache."""
        for function in module.functions:
            if not function.is_declaration:
                function.attributes.alignstack = 64
                function.attributes.add("nounwind")  # llvmlite writes no alignment alone
        super().add_ir_module(module)


class _Part(_Library):
    """Code that is linked into others, as often as they like, and is never run by itself."""

    def finalize(self):
        for function in self._final_module.functions:
            if not function.is_declaration and function.linkage.name == "external":
                function.linkage = "linkonce_odr"
        self._shared_module, self._finalized = self._final_module, True

    def get_pointer_to_function(self, name):
        """Zero: there is no machine code."""
        self._ensure_finalized()
        return 0

    @property
    def codegen(self):
        return self

    def set_env(self, name, environment):
        """Nothing: only Python objects would need it."""


def _has_arrays(kind):
    """Whether values of this type of Numba are arrays, or tuples with arrays in them."""
    if isinstance(kind, types.BaseTuple):
        return any(map(_has_arrays, kind))
    return isinstance(kind, types.Array)


def _makes_arrays(state):
    """Whether a function makes arrays, or gets or returns new ones. state: of Numba's compiler, with all types."""
    for expression, signature in state.calltypes.items():
        operation = getattr(expression, "op", None)  # None: of a statement, which has no value
        if operation is None or operation in PARTS_OF_ARRAYS or not _has_arrays(signature.return_type):
            continue
        packs_arrays = operation == "call" and isinstance(state.typemap[expression.func.name], types.NamedTupleClass)
        if not packs_arrays:
            return True
    return _has_arrays(state.return_type)


@register_pass(mutates_CFG=True, analysis_only=False)
class _Lowering(typed.NativeLowering):
    """Numba counts who uses an array, by atomic operations for every row that a kernel takes of one. A part that makes
    no arrays need not count: whoever calls it keeps those that it is given."""

    _name = "lowering_of_kernels"

    def run_pass(self, state):
        if isinstance(state.library, _Part) and not _makes_arrays(state):
            state.targetctx = state.targetctx.subtarget(enable_nrt=False)
        return super().run_pass(state)


@cache
def _passes():
    """Numba's own passes, without those for what no kernel has: closures, comprehensions, generators, literal types,
    objects, exceptions, parallel loops, functions that are inlined before they have types."""
    manager = PassManager("kernel")
    for numba_pass in (
        untyped.TranslateByteCode, untyped.FixupArgs, untyped.IRProcessing, untyped.RewriteSemanticConstants,
        untyped.DeadBranchPrune, untyped.GenericRewrites, untyped.ReconstructSSA, typed.NopythonTypeInference,
        typed.PreLowerStripPhis, typed.NopythonRewrites, typed.IRLegalization, _Lowering, typed.NoPythonBackend,
    ):  # fmt: skip
        manager.add_pass(numba_pass)
    manager.finalize()
    return manager


_found: dict[tuple, object] = {}  # (function of Numba, types of its arguments): the signature that Numba chose


def _within_kernel(context):
    """Whether a kernel is being compiled. context: Numba's typing context."""
    return "resolve_function_type" in vars(context)


@contextmanager
def _without_detours(context):
    """While a kernel is compiled, Python does not look for garbage, and Numba, which tries some ten meanings of a + for
    every + that it meets, remembers which one it was. context: Numba's typing context, restored afterwards."""
    if _within_kernel(context):
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
    """As `machine_code.store.compiled`, but other kernels that call this one take in a Part in its place.

    Functions of plain Numba that call it get its own machine code: they would not take in what the part calls.
    """
    part = compiled(function, None, no_cpython_wrapper=True, pipeline_class=_PartCompiler)
    complete = compiled(function, folder, pipeline_class=_WholeCompiler)

    def chosen(name):
        of_part, of_complete = getattr(part, name), getattr(complete, name)
        return lambda *arguments: (of_part if _within_kernel(complete.typingctx) else of_complete)(*arguments)

    complete.get_call_template, complete.get_overload = chosen("get_call_template"), chosen("get_overload")
    return complete
