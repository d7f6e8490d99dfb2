"""A vector of numbers as one Numba value: `Lanes(COUNT)` is a float of each of COUNT runs, in one register.

COUNT is eight on a processor with AVX-512, and four on others.

A kernel written for floats is compiled for such vectors where it is given them: +, -, *, /, comparisons, abs, sqrt,
exp, tanh, sin, cos, acos, rint, floor and array elements are defined here, and no branch may depend on them
(`engine.simd.select` has what takes the place of branches). Every lane goes through the same IEEE operations as a float
would, so that its bits are those of the run alone.

`LaneRecord` takes the place of a parameter record: fields by the same names. Whole numbers are common to all lanes, so
that kernels may branch on them; floats are vectors.

Memory: an array whose last axis is the lanes, contiguous and aligned to one vector (`lane_zeros`); kernels see it
without that axis (`as_lanes`).
"""

import math
import operator
from functools import partial
from typing import ClassVar

import numpy as np
from llvmlite import ir
from llvmlite.binding import get_host_cpu_features
from numba.core import cgutils, types
from numba.core.typeconv import Conversion
from numba.core.typing.templates import AbstractTemplate, AttributeTemplate, infer_getattr, infer_global, signature
from numba.extending import intrinsic, lower_builtin, lower_cast, lower_getattr_generic, models, register_model
from numba.np import arrayobj

from ..record import EXTRA

COUNT = 8 if get_host_cpu_features().get("avx512f") else 4  # lanes of a batch
DOUBLE, BIT = ir.DoubleType(), ir.IntType(1)


class _PerLane(types.Type):
    """A number in each of `count` lanes; `plain`: types of numbers that may take its place; `each`: the type of one
    lane in Numba and in LLVM."""

    def __init__(self, count):
        self.count = count
        super().__init__(f"{self.word}({count})")

    def unify(self, context, kind):
        """A variable that is a number in one place and a vector in another is a vector."""
        return self if isinstance(kind, self.plain) else None

    def can_convert_from(self, context, kind):
        return Conversion.safe if isinstance(kind, self.plain) else None


class Lanes(_PerLane):
    """A float in each of `count` lanes."""

    word, plain, each = "lanes", (types.Float, types.Integer), (types.float64, DOUBLE)


class LaneMask(_PerLane):
    """Yes or no in each of `count` lanes."""

    word, plain, each = "lane_mask", (types.Boolean,), (types.boolean, BIT)


@register_model(Lanes)
@register_model(LaneMask)
class _PerLaneModel(models.PrimitiveModel):
    def __init__(self, manager, kind):
        super().__init__(manager, kind, ir.VectorType(kind.each[1], kind.count))


def spread(builder, value, count):
    """The same number in every lane."""
    kind = ir.VectorType(value.type, count)
    first = builder.insert_element(ir.Constant(kind, ir.Undefined), value, ir.Constant(ir.IntType(32), 0))
    zeros = ir.Constant(ir.VectorType(ir.IntType(32), count), [0] * count)
    return builder.shuffle_vector(first, ir.Constant(kind, ir.Undefined), zeros)


@lower_cast(types.Float, Lanes)
@lower_cast(types.Integer, Lanes)
@lower_cast(types.Boolean, LaneMask)
def _cast(context, builder, from_kind, to_kind, value):
    return spread(builder, context.cast(builder, value, from_kind, to_kind.each[0]), to_kind.count)


def _define(function, kinds, result, build):
    """Type and code of a function of numbers and vectors, at least one of its arguments a vector (or a mask)."""
    arguments = len(kinds)

    @infer_global(function)
    class Template(AbstractTemplate):
        def generic(self, operands, keywords):
            if keywords or len(operands) != arguments:
                return None
            wide = [a for a in operands if isinstance(a, _PerLane)]
            if not wide:
                return None
            counts = {a.count for a in wide}
            wanted = [kind(wide[0].count) for kind in kinds]
            fits = all(a == b or isinstance(a, b.plain) for a, b in zip(operands, wanted, strict=True))
            return signature(result(wide[0].count), *wanted) if len(counts) == 1 and fits else None

    @lower_builtin(function, *kinds)
    def lower(context, builder, sig, values):
        return build(builder, *values)


def _instruction(name, *leading):
    """An instruction of LLVM's builder; leading: what its operands follow."""
    return lambda builder, *values: getattr(builder, name)(*leading, *values)


def external(builder, name, kind, count):
    """The function `name` of `count` arguments of this LLVM type, whose result has it too."""
    return cgutils.get_or_insert_function(builder.module, ir.FunctionType(kind, (kind,) * count), name)


def call_intrinsic(name, builder, *values):
    """Call of an LLVM intrinsic that exists for numbers and vectors."""
    kind = values[0].type
    suffix = f"v{kind.count}f64" if isinstance(kind, ir.VectorType) else "f64"
    return builder.call(external(builder, f"llvm.{name}.{suffix}", kind, len(values)), values)


def _lane_by_lane(name, builder, value):
    """A function of the C library, called for one lane after another, as for a float."""
    function, result = external(builder, name, DOUBLE, 1), ir.Constant(value.type, ir.Undefined)
    for lane in range(value.type.count):
        at = ir.Constant(ir.IntType(32), lane)
        result = builder.insert_element(result, builder.call(function, (builder.extract_element(value, at),)), at)
    return result


for _name, _code in (("add", "fadd"), ("sub", "fsub"), ("mul", "fmul"), ("truediv", "fdiv")):
    for _prefix in ("", "i"):  # x + y and x += y
        _define(getattr(operator, _prefix + _name), (Lanes, Lanes), Lanes, _instruction(_code))
for _name, _symbol in zip("lt le gt ge eq".split(), "< <= > >= ==".split(), strict=True):
    _define(getattr(operator, _name), (Lanes, Lanes), LaneMask, _instruction("fcmp_ordered", _symbol))
_define(operator.ne, (Lanes, Lanes), LaneMask, _instruction("fcmp_unordered", "!="))
_define(operator.neg, (Lanes,), Lanes, _instruction("fneg"))
_define(operator.and_, (LaneMask, LaneMask), LaneMask, _instruction("and_"))
_define(operator.or_, (LaneMask, LaneMask), LaneMask, _instruction("or_"))
for _function, _name in ((abs, "fabs"), (math.sqrt, "sqrt"), (np.rint, "rint"), (np.floor, "floor")):
    _define(_function, (Lanes,), Lanes, partial(call_intrinsic, _name))
for _function in (math.exp, math.tanh, math.sin, math.cos, math.acos):
    _define(_function, (Lanes,), Lanes, partial(_lane_by_lane, _function.__name__))


def lane_zeros(*shape):
    """Zeros (*shape, COUNT) that begin where a vector may."""
    size = COUNT * int(np.prod(shape))
    room = np.zeros(size + COUNT)
    first = -room.ctypes.data // 8 % COUNT
    return room[first : first + size].reshape(*shape, COUNT)


def _lane_array(array):
    """Type of the view that `as_lanes` gives of an array."""
    return types.Array(Lanes(COUNT), array.ndim - 1, "C", aligned=True)


def view(context, builder, array, value, kind, first):
    """An array as one of another kind: from its number `first` on, as many of its leading axes as the kind has."""
    source = arrayobj.make_array(array)(context, builder, value)
    target = arrayobj.make_array(kind)(context, builder)
    entry = context.get_data_type(kind.dtype).as_pointer()
    arrayobj.populate_array(
        target,
        data=builder.bitcast(builder.gep(builder.bitcast(source.data, DOUBLE.as_pointer()), [first]), entry),
        shape=cgutils.unpack_tuple(builder, source.shape, array.ndim)[: kind.ndim],
        strides=cgutils.unpack_tuple(builder, source.strides, array.ndim)[: kind.ndim],
        itemsize=context.get_constant(types.intp, 8 * getattr(kind.dtype, "count", 1)),
        meminfo=None,
    )
    return target._getvalue()


def _view(context, builder, array, value):
    return view(context, builder, array, value, _lane_array(array), context.get_constant(types.intp, 0))


@intrinsic
def as_lanes(context, arrays):
    """View of a contiguous array (..., lanes) as an array (...) of vectors, or of each array of a (named) tuple.

    A view does not keep the memory alive.
    """
    if isinstance(arrays, types.Array):
        return _lane_array(arrays)(arrays), lambda c, b, sig, values: _view(c, b, arrays, values[0])
    kinds = tuple(_lane_array(array) for array in arrays)
    result = types.BaseTuple.from_types(kinds, getattr(arrays, "instance_class", None))

    def generate(context, builder, signature, values):
        parts = cgutils.unpack_tuple(builder, values[0], len(kinds))
        views = [_view(context, builder, array, part) for array, part in zip(arrays, parts, strict=True)]
        return context.make_tuple(builder, result, views)

    return result(arrays), generate


@intrinsic
def expect(context, array, at):
    """Have element `at` of a contiguous array fetched from memory, because it is needed soon; it need not exist."""

    def generate(context, builder, signature, values):
        first = arrayobj.make_array(array)(context, builder, values[0]).data
        address = builder.bitcast(builder.gep(first, [values[1]]), cgutils.voidptr_t)
        kinds = cgutils.voidptr_t, cgutils.int32_t, cgutils.int32_t, cgutils.int32_t
        prefetch = ir.FunctionType(ir.VoidType(), kinds)
        function = cgutils.get_or_insert_function(builder.module, prefetch, "llvm.prefetch.p0")
        builder.call(function, [address, *(cgutils.int32_t(number) for number in (0, 2, 1))])  # data, to be read, L2
        return context.get_dummy_value()

    return types.none(array, types.intp), generate


@intrinsic
def transposed(context, rows):
    """Columns of the matrices of which each COUNT of these vectors (a tuple) are the rows."""

    def generate(context, builder, signature, values):
        vectors, width = cgutils.unpack_tuple(builder, values[0], len(rows)), 1
        while width < COUNT:  # blocks of this width change places across the diagonal, then wider ones
            low = [COUNT + j - width if j & width else j for j in range(COUNT)]
            masks = [ir.Constant(ir.VectorType(ir.IntType(32), COUNT), [j + d for j in low]) for d in (0, width)]
            for i in (i for i in range(len(rows)) if not i & width):
                pair = vectors[i], vectors[i + width]
                vectors[i], vectors[i + width] = (builder.shuffle_vector(*pair, mask) for mask in masks)
            width *= 2
        return context.make_tuple(builder, rows, vectors)

    return rows(rows), generate


WHOLE = tuple(name for name in EXTRA.names[1:] if EXTRA[name] == np.int64)  # the first only names the type
REAL = tuple(name for name in EXTRA.names if EXTRA[name] == np.float64)


def fields_of(record, names):
    """The numbers of a planar record by these names; 0 for a field that only an EXTRA has."""
    return [record[name] if name in record.dtype.names else 0 for name in names]


class LaneRecord(types.Type):
    """Parameters of `count` planar runs (`engine.record.RECORD`); plain, extras: of PLAIN, of EXTRA ones."""

    fields: ClassVar[dict] = {
        name: (whole, row) for whole, group in ((True, WHOLE), (False, REAL)) for row, name in enumerate(group)
    }

    def __init__(self, count, plain, extras):
        self.count, self.plain, self.extras = count, plain, extras
        super().__init__(f"lane_record({count}, {plain}, {extras})")


@register_model(LaneRecord)
class _LaneRecordModel(models.StructModel):
    def __init__(self, manager, kind):
        members = [("counts", types.CPointer(types.int64)), ("values", types.CPointer(Lanes(kind.count)))]
        super().__init__(manager, kind, members)


@infer_getattr
class _LaneRecordAttributes(AttributeTemplate):
    key = LaneRecord

    def generic_resolve(self, record, name):
        """Whole numbers are common to the lanes, floats are vectors."""
        field = record.fields.get(name)
        return None if field is None else types.int64 if field[0] else Lanes(record.count)


@lower_getattr_generic(LaneRecord)
def _get_field(context, builder, record, value, name):
    is_integer, row = record.fields[name]
    pointers = cgutils.create_struct_proxy(record)(context, builder, value=value)
    address = builder.gep(pointers.counts if is_integer else pointers.values, [context.get_constant(types.intp, row)])
    return builder.load(address)


@intrinsic
def lane_record(context, records, counts, values):
    """Record of the parameters `counts` (whole numbers in the order of WHOLE), `values` (as_lanes, order of REAL) of
    these `records`."""
    fields = records.dtype.fields
    kind = LaneRecord(values.dtype.count, "plain" in fields, "extra" in fields)

    def generate(context, builder, sig, arguments):
        pointers = cgutils.create_struct_proxy(kind)(context, builder)
        pointers.counts = arrayobj.make_array(counts)(context, builder, arguments[1]).data
        pointers.values = arrayobj.make_array(values)(context, builder, arguments[2]).data
        return pointers._getvalue()

    return kind(records, counts, values), generate
