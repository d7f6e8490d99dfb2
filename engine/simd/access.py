"""From vectors to the numbers in them: one lane by itself, and eight numbers of one run as one vector.

A sum over many terms of one run, such as the waves of a sea (`engine.physics.sea`), has its terms side by side.
Runs that share a batch take such a sum one after another, each from its own lane. So both have the same bits.
"""

from llvmlite import ir
from numba.core import cgutils, types
from numba.core.imputils import impl_ret_borrowed
from numba.extending import intrinsic
from numba.np import arrayobj

from .vector import COUNT, DOUBLE, LaneMask, Lanes, view

_LONG = ir.VectorType(ir.IntType(64), COUNT)
_SHIFT = 6755399441055744.0  # 1.5 * 2^52: its sum with a whole number has that number in its last bits


def _index(number):
    return ir.Constant(ir.IntType(32), number)


@intrinsic
def lane_count(context, value):
    """How many lanes a value has; one where it is a number."""
    count = getattr(value, "count", 1)

    def generate(context, builder, signature, values):
        return context.get_constant(types.intp, count)

    return types.intp(value), generate


@intrinsic
def lane_of(context, value, lane):
    """The number, or the yes or no, of one lane; of a number itself that number."""
    kind = value.each[0] if isinstance(value, (Lanes, LaneMask)) else value

    def generate(context, builder, signature, values):
        if not isinstance(value, (Lanes, LaneMask)):
            return values[0]
        return builder.extract_element(values[0], builder.trunc(values[1], ir.IntType(32)))

    return kind(value, types.intp), generate


@intrinsic
def in_lane(context, array, lane):
    """View of one lane of an array (...) of vectors, as an array (...) of floats; an array of floats itself."""
    if not isinstance(array.dtype, Lanes):
        return array(array, types.intp), lambda c, b, sig, values: impl_ret_borrowed(c, b, array, values[0])
    kind = types.Array(types.float64, array.ndim, "A")

    return kind(array, types.intp), lambda c, b, sig, values: view(c, b, array, values[0], kind, values[1])


@intrinsic
def vector_at(context, array, at):
    """The COUNT numbers array[at : at + COUNT] of an array of one axis, as a vector."""

    def generate(context, builder, signature, values):
        source = arrayobj.make_array(array)(context, builder, values[0])
        (stride,) = cgutils.unpack_tuple(builder, source.strides, 1)
        first = builder.bitcast(source.data, cgutils.voidptr_t)
        result = ir.Constant(ir.VectorType(DOUBLE, COUNT), ir.Undefined)
        for lane in range(COUNT):
            place = builder.mul(builder.add(values[1], context.get_constant(types.intp, lane)), stride)
            address = builder.bitcast(builder.gep(first, [place]), DOUBLE.as_pointer())
            result = builder.insert_element(result, builder.load(address), _index(lane))
        return result

    return Lanes(COUNT)(array, types.intp), generate


def _address(context, builder, kind, array, at):
    first = arrayobj.make_array(kind)(context, builder, array).data
    return builder.bitcast(builder.gep(first, [at]), ir.VectorType(DOUBLE, COUNT).as_pointer())


@intrinsic
def read_vector(context, array, at):
    """As `vector_at` for a contiguous array, in one instruction."""

    def generate(context, builder, signature, values):
        return builder.load(_address(context, builder, array, *values), align=8)

    return Lanes(COUNT)(array, types.intp), generate


@intrinsic
def write_vector(context, array, at, value):
    """The vector into array[at : at + COUNT] of a contiguous array."""

    def generate(context, builder, signature, values):
        builder.store(values[2], _address(context, builder, array, *values[:2]), align=8)
        return context.get_dummy_value()

    return types.none(array, types.intp, Lanes(COUNT)), generate


@intrinsic
def total(context, vector):
    """Sum over the lanes: halves are added until one number is left."""

    def generate(context, builder, signature, values):
        (value,), width = values, COUNT
        while width > 1:
            width //= 2
            halves = [
                builder.shuffle_vector(
                    value, value, ir.Constant(ir.VectorType(ir.IntType(32), width), [first + i for i in range(width)])
                )
                for first in (0, width)
            ]
            value = builder.fadd(*halves)
        return builder.extract_element(value, _index(0))

    return types.float64(vector), generate


@intrinsic
def power_of_two(context, exponent):
    """2^exponent in every lane, for whole numbers from -1022 to 1023, put where a number has its exponent."""

    def generate(context, builder, signature, values):
        kind = values[0].type
        whole = builder.bitcast(builder.fadd(values[0], ir.Constant(kind, [_SHIFT] * COUNT)), _LONG)
        shifted = builder.shl(whole, ir.Constant(_LONG, [52] * COUNT))
        return builder.bitcast(builder.add(shifted, ir.Constant(_LONG, [1023 << 52] * COUNT)), kind)

    return exponent(exponent), generate
