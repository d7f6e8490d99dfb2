"""a * b + c as one operation with one rounding, decided in the source of a kernel and not by LLVM.

LLVM may fuse a product and a sum where it is allowed to, and decides by what surrounds them: for a number otherwise
than for a vector of numbers, on one processor otherwise than on another. A run that shares a batch with others
(`engine.simd`) would then differ from the same run alone. So the decorator `engine.compiled.kernel` writes, before
anything is compiled, every sum or difference with a product in it as a call of `fused`:

    a * b + c, c + a * b -> fused(a, b, c)      a * b - c -> fused(a, b, -c)      c - a * b -> fused(-a, b, c)

(where both are products the first one is a, b). The results are those of IEEE 754-2008 fusedMultiplyAdd, everywhere.
"""

import ast
import inspect
import types as python_types
from functools import cache, update_wrapper

from numba.core import types
from numba.extending import intrinsic

from .select import widest
from .vector import call_intrinsic

NAME = "_fused"


@intrinsic
def fused(context, a, b, c):
    """a * b + c with one rounding; of integers, exactly."""
    argument_kinds = types.unliteral(a), types.unliteral(b), types.unliteral(c)
    all_integers = all(isinstance(kind, (types.Integer, types.Boolean)) for kind in argument_kinds)
    kind = types.intp if all_integers else widest(*argument_kinds)  # vectors of numbers win over numbers

    def generate(context, builder, signature, arguments):
        x, y, z = arguments
        if kind is types.intp:
            return builder.add(builder.mul(x, y), z)
        return call_intrinsic("fma", builder, x, y, z)

    return kind(kind, kind, kind), generate


class _Fuse(ast.NodeTransformer):
    """Writes the products within sums of one function as calls of `fused`."""

    def visit_BinOp(self, node):
        self.generic_visit(node)
        minus = isinstance(node.op, ast.Sub)
        if not (minus or isinstance(node.op, ast.Add)):
            return node
        if _is_product(node.left):
            addend = ast.UnaryOp(ast.USub(), node.right) if minus else node.right
            return _call(node, node.left.left, node.left.right, addend)
        if _is_product(node.right):
            factor = ast.UnaryOp(ast.USub(), node.right.left) if minus else node.right.left
            return _call(node, factor, node.right.right, node.left)
        return node

    def visit_AugAssign(self, node):
        """x += a * b as x = x + a * b: the indices of an element are then evaluated twice, which has no effect."""
        plain = ast.parse(ast.unparse(node.target), mode="eval").body
        if isinstance(node.op, (ast.Add, ast.Sub)) and _is_product(node.value):
            sum_ = ast.copy_location(ast.BinOp(ast.fix_missing_locations(plain), node.op, node.value), node)
            return ast.copy_location(ast.Assign([self.visit(node.target)], self.visit(sum_)), node)
        self.generic_visit(node)
        return node


def _is_product(node):
    return isinstance(node, ast.BinOp) and isinstance(node.op, ast.Mult)


def _call(node, *arguments):
    return ast.copy_location(ast.Call(ast.Name(NAME, ast.Load()), list(arguments), []), node)


@cache
def _definitions(path):
    """Line of its first decorator or `def` -> syntax tree, of every function of a file."""
    with open(path, encoding="utf-8") as file:
        tree = ast.parse(file.read(), path)
    functions = [node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef)]
    return {min([node.lineno, *(d.lineno for d in node.decorator_list)]): node for node in functions}


def with_fused_sums(function):
    """The same Python function, with its sums of products written as calls of `fused`; lines keep their numbers."""
    path = inspect.getsourcefile(function)
    tree = _definitions(path).get(function.__code__.co_firstlineno) if path else None
    if tree is None or function.__closure__:
        raise ValueError(f"{function.__qualname__}: a kernel is a plain function in a file, without a closure")
    tree.decorator_list = []
    module = ast.fix_missing_locations(ast.Module([_Fuse().visit(tree)], []))
    code = next(
        part
        for part in compile(module, path, "exec").co_consts
        if isinstance(part, python_types.CodeType) and part.co_name == function.__name__
    )
    function.__globals__[NAME] = fused
    changed = python_types.FunctionType(code, function.__globals__, function.__name__, function.__defaults__)
    update_wrapper(changed, function)
    del changed.__wrapped__
    return changed
