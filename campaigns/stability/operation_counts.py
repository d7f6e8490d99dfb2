"""Floating-point operations of the engine's kernels, counted: what a Newton iteration of a scene really does.

The kernels are loaded a second time as plain Python, under another package name, with every +, -, *, / and power of
floats and every call of a function of `math` written so that it counts itself; the sources are the engine's own and the
branches are those that the scene takes. Constants count nothing, nor do comparisons, indices and moves. The counts are
exact and the same on every machine: what a scene does not need and skips is not in them.
"""

import ast
import importlib.util
import math
import sys
from collections import Counter
from functools import cache
from importlib.machinery import SourceFileLoader
from pathlib import Path
from types import ModuleType

import numpy as np

ALIAS = "counted_engine"
_ROOT = Path(__file__).resolve().parents[2] / "engine"
_OF_MATH = {"sin", "cos", "tan", "exp", "tanh", "sqrt", "acos", "atan2", "hypot", "log"}
_COUNTED = (ast.Add, ast.Sub, ast.Mult, ast.Div, ast.Pow)
tally: Counter = Counter()  # "operations", "functions", and calls by the name of the kernel


def operations(scene) -> dict[str, object]:
    """One Newton iteration of a scene in motion, and one step's output, counted.

    {"newton": operations, "functions": of them calls of math functions, "output": operations of storing a sample, and a
    profile where the scene keeps them, "kernels": names called}
    """
    from engine import parameters
    from engine.record import STATE

    engine, tables = _counted(), []
    record = parameters.record_of(scene, tables).view(np.recarray)[0]
    tables = np.concatenate(tables)
    n, dimensions = int(record.nodes), engine("dimensions")
    unknowns, conserved = dimensions.size_of(record)
    Y = np.zeros((n, unknowns))
    Y[:, 0] = 0.04
    if unknowns == 6:
        Y[:, 4] = math.pi / 2 - 0.1 * np.linspace(0.0, 1.0, n)
    else:
        Y[:, 6:10] = _frames(n)
    Y[:, conserved // 2 : conserved] = 0.1
    C = np.zeros((n, conserved))
    dimensions.conserved(record, Y, C)
    X, F, Q, E, D, C_tilde = dimensions.work_arrays(record, n)
    C_tilde[:] = C * 0.999
    tally.clear()
    engine("newton").newton(
        record, tables, 1.0, 1.0, 100.0, 100.0, 1e-30, 1, Y.copy(), C_tilde, X, F, Q, E, D
    )  # most = 1: one iteration, which does not converge
    counts = {"newton": tally["operations"], "functions": tally["functions"], "kernels": _kernels()}
    tally.clear()
    state = np.zeros(1, STATE).view(np.recarray)[0]
    samples, profiles = np.zeros((1, 12)), np.zeros((1 if record.profile_step > 0 else 0, n, 6))
    engine("sampling").sample(record, tables, state, 0.01, True, C, 0 * C, C, 0 * C, samples, profiles)
    return counts | {"output": tally["operations"]}


def _kernels() -> list[str]:
    return sorted(name for name in tally if name not in ("operations", "functions"))


def _frames(n):
    """Frames of a line that leans from the vertical, as the engine puts them for planar starts in space."""
    from engine.spatial import lift

    return np.array(
        [lift.shortest_rotation([1.0, 0.0, 0.0], [math.sin(a), 0.0, math.cos(a)]) for a in np.linspace(0, 0.1, n)]
    )


class _Counting(ast.NodeTransformer):
    """Writes a op b as _tick(a op b), math.f(x) as _call(math.f(x)), and a first line of every kernel that names it."""

    def visit_FunctionDef(self, node):
        self.generic_visit(node)
        if not any(isinstance(by, ast.Name) and by.id == "kernel" for by in node.decorator_list):
            return node
        naming = ast.parse(f"_named({node.name!r})").body[0]
        at = 1 if ast.get_docstring(node) is not None else 0
        node.body.insert(at, naming)
        return node

    def visit_BinOp(self, node):
        constant = all(
            not isinstance(part, (ast.Name, ast.Attribute, ast.Call, ast.Subscript)) for part in ast.walk(node)
        )
        self.generic_visit(node)
        return node if constant or not isinstance(node.op, _COUNTED) else _wrapped("_tick", node)

    def visit_AugAssign(self, node):
        self.generic_visit(node)
        target = ast.parse(ast.unparse(node.target), mode="eval").body
        return ast.Assign([node.target], _wrapped("_tick", ast.BinOp(target, node.op, node.value)))

    def visit_Subscript(self, node):
        node.value = self.visit(node.value)
        return node  # indices are integers

    def visit_Call(self, node):
        self.generic_visit(node)
        by = node.func
        of_math = isinstance(by, ast.Attribute) and isinstance(by.value, ast.Name) and by.value.id in ("math", "np")
        return _wrapped("_call", node) if of_math and by.attr in _OF_MATH else node


def _wrapped(name, node):
    return ast.Call(ast.Name(name, ast.Load()), [node], [])


def _tick(value):
    if isinstance(value, float):
        tally["operations"] += 1
    return value


def _call(value):
    tally["operations"] += 1
    tally["functions"] += 1
    return value


def _named(name):
    tally[name] += 1


class _Loader(SourceFileLoader):
    def get_code(self, fullname):
        tree = _Counting().visit(ast.parse(self.get_data(self.path), self.path))
        return compile(ast.fix_missing_locations(tree), self.path, "exec")

    def exec_module(self, module):
        module.__dict__.update(_tick=_tick, _call=_call, _named=_named)
        super().exec_module(module)


class _Finder:
    """Finds the engine's sources under the alias; compilation and vectors of numbers have stand-ins in plain Python."""

    @staticmethod
    def find_spec(fullname, path=None, target=None):
        if fullname.partition(".")[0] != ALIAS:
            return None
        inside = fullname.split(".")[1:]
        if inside and inside[0] in ("compiled", "choose"):
            return importlib.util.spec_from_loader(fullname, _StandIn())
        if inside == ["planar", "places"]:
            return importlib.util.spec_from_loader(fullname, _PlacesStandIn())
        place = _ROOT.joinpath(*inside)
        folder = place.is_dir()
        file = place / "__init__.py" if folder else place.with_suffix(".py")
        if not file.exists():
            return None
        where = {"submodule_search_locations": [str(place)]} if folder else {}
        return importlib.util.spec_from_file_location(fullname, file, loader=_Loader(fullname, str(file)), **where)


class _StandIn:
    def create_module(self, spec):
        return None

    def exec_module(self, module: ModuleType):
        def by_kind(planar, spatial, lanes=None):
            return lambda p, *rest: (spatial if "GI" in p.dtype.names else planar)(p, *rest)

        module.__dict__.update(
            kernel=lambda function: function, by_dimension=by_kind, by_kind=by_kind, every=bool, some=bool,
            where=lambda condition, a, b: a if condition else b, larger=max, smaller=min, finite=math.isfinite,
        )  # fmt: skip


class _PlacesStandIn:
    """One node at a time."""

    def create_module(self, spec):
        return None

    def exec_module(self, module: ModuleType):
        def put(array, k, first, numbers):
            array[k, first : first + len(numbers)] = numbers

        module.__dict__.update(
            take=lambda array, k, first, count: tuple(array[k, first : first + count]), put=put,
            place=lambda p, j, n: j, count_of_places=lambda p, n: n,
            tension_at=lambda p, tables, eps: importlib.import_module(f"{ALIAS}.tension").tension(eps, p, tables),
        )  # fmt: skip


@cache
def _counted():
    sys.meta_path.insert(0, _Finder)  # before the usual finder, which would find the sources as they are
    # the package itself is lazy: nothing of it runs but what is asked for
    return lambda name: importlib.import_module(f"{ALIAS}.{name}")
