"""Places: one node (a whole number), or two nodes at once (a pair of them) as two lanes of a vector.

What is done at every node for itself is written once for a place. A run alone does it at two nodes at a time, a batch,
whose numbers are vectors already (`engine.simd`), at one after the other: the same operations, bit for bit.
"""

from llvmlite import ir
from numba.core import cgutils, types
from numba.extending import intrinsic
from numba.np import arrayobj

from ..compiled import by_kind, kernel
from ..physics.tension import LINEAR, tension
from ..simd.select import where
from ..simd.vector import Lanes

PAIR, PLACES = Lanes(2), types.UniTuple(types.intp, 2)


def _join(context, builder, values):
    """An LLVM value for each place -> a number, or a vector of two."""
    if len(values) == 1:
        return values[0]
    vector = ir.Constant(context.get_data_type(PAIR), ir.Undefined)
    for lane, value in enumerate(values):
        vector = builder.insert_element(vector, value, ir.Constant(ir.IntType(32), lane))
    return vector


def _places(builder, kind, k):
    """The whole numbers in k."""
    return cgutils.unpack_tuple(builder, k, kind.count) if isinstance(kind, types.UniTuple) else [k]


def _kinds(array, k):
    """Types of a place and of a number there."""
    return (PLACES, PAIR) if isinstance(k, types.BaseTuple) else (types.intp, array.dtype)


def _pointer(context, builder, kind, array, row, column):
    at = context.get_constant(types.intp, column)
    return cgutils.get_item_pointer(context, builder, kind, array, [row, at], wraparound=False)


@intrinsic(prefer_literal=True)
def take(context, array, k, first, count):
    """The numbers array[k, first], ... array[k, first + count - 1]."""
    begin, end = first.literal_value, first.literal_value + count.literal_value
    place, number = _kinds(array, k)
    result = types.UniTuple(number, end - begin)

    def generate(context, builder, signature, values):
        source = arrayobj.make_array(array)(context, builder, values[0])
        rows = _places(builder, place, values[1])
        taken = []
        for i in range(begin, end):
            pointers = [_pointer(context, builder, array, source, row, i) for row in rows]
            loaded = [arrayobj.load_item(context, builder, array, pointer) for pointer in pointers]
            taken.append(_join(context, builder, loaded))
        return context.make_tuple(builder, result, taken)

    return result(array, place, first, count), generate


@intrinsic(prefer_literal=True)
def put(context, array, k, first, numbers):
    """array[k, first], array[k, first + 1] ... = numbers."""
    begin = first.literal_value
    place, number = _kinds(array, k)
    given = types.UniTuple(number, len(numbers))

    def generate(context, builder, signature, values):
        target = arrayobj.make_array(array)(context, builder, values[0])
        rows = _places(builder, place, values[1])
        for i, value in enumerate(cgutils.unpack_tuple(builder, values[3], len(numbers))):
            for lane, row in enumerate(rows):
                part = value if len(rows) == 1 else builder.extract_element(value, ir.Constant(ir.IntType(32), lane))
                arrayobj.store_item(
                    context, builder, array, part, _pointer(context, builder, array, target, row, begin + i)
                )

    return types.void(array, place, first, given), generate


@intrinsic
def both(context, lower, upper):
    """Two tuples of numbers as one of vectors."""
    kind = types.UniTuple(types.float64, len(lower))
    result = types.UniTuple(PAIR, len(lower))

    def generate(context, builder, signature, values):
        parts = zip(*(cgutils.unpack_tuple(builder, value, len(lower)) for value in values), strict=True)
        return context.make_tuple(builder, result, [_join(context, builder, pair) for pair in parts])

    return result(kind, kind), generate


@intrinsic(prefer_literal=True)
def lane(context, vectors, number):
    """Numbers of lane 0 or 1 of a tuple of vectors."""
    result = types.UniTuple(types.float64, len(vectors))
    at = ir.Constant(ir.IntType(32), number.literal_value)

    def generate(context, builder, signature, values):
        parts = cgutils.unpack_tuple(builder, values[0], len(vectors))
        return context.make_tuple(builder, result, [builder.extract_element(part, at) for part in parts])

    return result(vectors, number), generate


@kernel
def _two_nodes(p, j, n):
    return 2 * j, min(2 * j + 1, n - 1)


@kernel
def _one_node(p, j, n):
    return j


@kernel
def _half(p, n):
    return (n + 1) // 2


@kernel
def _all(p, n):
    return n


# place number j of so many; of an odd number of nodes the last place is one node twice
place = by_kind(_two_nodes, _two_nodes, _one_node)
count_of_places = by_kind(_half, _half, _all)


@kernel
def _of_pair(p, tables, eps):
    """`tension` at two strains: at once for the usual law, else at one after the other, as a table branches.

    At 41 nodes `node.node_quantities` takes 0.64 us with the usual law apart, and 1.7 without.
    """
    if p.law == LINEAR and p.barrier == 0.0:
        return p.p1 * eps, where(eps > 0.0, p.p1, p.p1)
    below, above = tension(lane((eps,), 0)[0], p, tables), tension(lane((eps,), 1)[0], p, tables)
    T, slope = both(below, above)
    return T, slope


@kernel
def _of_batch(p, tables, eps):
    return tension(eps, p, tables)


tension_at = by_kind(_of_pair, _of_pair, _of_batch)
