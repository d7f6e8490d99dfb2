"""Where a sweep is: at one node (a whole number), or at two at once (a pair), one from each end of the tether.

The same source then serves one half of a tether after another, as a batch does them (`engine.lanes`), and both halves
of a run alone as the two lanes of a vector, bit for bit the same. A way d is 1 (up) or -1 (down), of a pair (1, -1).
"""

from llvmlite import ir
from numba.core import types
from numba.extending import intrinsic, overload

from ..lanes.vector import Lanes

PAIR = Lanes(2)
_OPTIONS = {"nogil": True, "error_model": "numpy", "boundscheck": False}


@intrinsic
def both(context, lower, upper):
    """Two numbers as one vector."""

    def generate(context, builder, signature, values):
        vector = ir.Constant(context.get_data_type(PAIR), ir.Undefined)
        for lane, value in enumerate(values):
            vector = builder.insert_element(vector, value, ir.Constant(ir.IntType(32), lane))
        return vector

    return PAIR(types.float64, types.float64), generate


@intrinsic
def lane(context, vector, number):
    """Number 0 or 1 of a pair."""

    def generate(context, builder, signature, values):
        return builder.extract_element(*values)

    return types.float64(vector, types.intp), generate


def take(array, k, i):
    """array[k, i]."""


def put(array, k, i, value):
    """array[k, i] = value."""


def move(k, d):
    """The next place on the way d."""


def half_box(tables, first, k, d):
    """Half the length (m) of the box from k on the way d, negative downwards; tables[first] is the first length."""


@overload(take, jit_options=_OPTIONS)
def _take(array, k, i):
    if isinstance(k, types.Integer):
        return lambda array, k, i: array[k, i]
    return lambda array, k, i: both(array[k[0], i], array[k[1], i])


@overload(put, jit_options=_OPTIONS)
def _put(array, k, i, value):
    def put_one(array, k, i, value):
        array[k, i] = value

    def put_two(array, k, i, value):
        array[k[0], i] = lane(value, 0)
        array[k[1], i] = lane(value, 1)

    return put_one if isinstance(k, types.Integer) else put_two


@overload(move, jit_options=_OPTIONS)
def _move(k, d):
    if isinstance(k, types.Integer):
        return lambda k, d: k + d
    return lambda k, d: (k[0] + d[0], k[1] + d[1])


@overload(half_box, jit_options=_OPTIONS)
def _half_box(tables, first, k, d):
    if isinstance(k, types.Integer):
        return lambda tables, first, k, d: 0.5 * d * tables[first + min(k, k + d)]
    return lambda tables, first, k, d: both(0.5 * tables[first + k[0]], -0.5 * tables[first + k[1] - 1])
