"""Kernels that only kernels call: compiled for their callers and not for Python.

Numba makes machine code of every function as soon as somebody calls it, optimises it, and links and optimises it again
within each caller, up to the top. A Part stays as the front end leaves it. What Python calls (a Whole) takes in all
Parts below it once, and only that is optimised and translated. So the time to compile no longer grows with the depth
of the calls, and nobody pays for wrappers that are not used. The same was proposed for Numba itself (numba#9566).
"""

from pathlib import Path

from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import CompilerBase, DefaultPassBuilder

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


class _WholeCompiler(CompilerBase):
    library = _Library

    def define_pipelines(self):
        state = self.state
        state.library = self.library(state.targetctx.codegen(), state.func_id.func_qualname)
        state.library.enable_object_caching()
        return [DefaultPassBuilder.define_nopython_pipeline(state)]


class _PartCompiler(_WholeCompiler):
    library = _Part


def compiled_in_parts(function, folder: Path | None):
    """As `machine_code.store.compiled`, but other kernels that call this one take in a Part in its place."""
    part = compiled(function, None, no_cpython_wrapper=True, pipeline_class=_PartCompiler)
    whole = compiled(function, folder, pipeline_class=_WholeCompiler)
    whole.get_call_template, whole.get_overload = part.get_call_template, part.get_overload
    return whole
