"""What takes the place of branches in kernels that serve floats and vectors of floats alike (`engine.simd`).

    where(m, a, b)   a where m holds, else b            every(m), some(m)   does m hold in every, in some lane?
    larger(a, b)     the larger, a where b is NaN       smaller(a, b)   the smaller, a where b is NaN
    finite(a)        is a a finite number?

Both a and b are computed. A kernel may skip work that no lane needs by `if every(m)`: the numbers stay the same.
"""

from llvmlite import ir
from numba.core import types
from numba.extending import intrinsic

from .vector import LaneMask, Lanes


def _widest(*kinds):
    """The type that takes in all of these: a vector, else a float."""
    return next((kind for kind in kinds if isinstance(kind, Lanes)), types.float64)


def _mask_of(kind):
    return LaneMask(kind.count) if isinstance(kind, Lanes) else types.boolean


@intrinsic
def where(context, condition, a, b):
    kind = _widest(a, b)
    mask = condition
    if isinstance(condition, LaneMask):
        kind = Lanes(condition.count)
    elif isinstance(kind, Lanes):
        mask = types.boolean

    def generate(context, builder, signature, values):
        return builder.select(*values)

    return kind(mask, kind, kind), generate


@intrinsic
def every(context, condition):
    def generate(context, builder, signature, values):
        if not isinstance(condition, LaneMask):
            return values[0]
        bits = builder.bitcast(values[0], ir.IntType(condition.count))
        return builder.icmp_unsigned("==", bits, ir.Constant(bits.type, -1))

    return types.boolean(condition), generate


@intrinsic
def some(context, condition):
    def generate(context, builder, signature, values):
        if not isinstance(condition, LaneMask):
            return values[0]
        bits = builder.bitcast(values[0], ir.IntType(condition.count))
        return builder.icmp_unsigned("!=", bits, ir.Constant(bits.type, 0))

    return types.boolean(condition), generate


def _extreme(symbol):
    def typed(context, a, b):
        kind = _widest(a, b)

        def generate(context, builder, signature, values):
            x, y = values
            return builder.select(builder.fcmp_ordered(symbol, y, x), y, x)

        return kind(kind, kind), generate

    return typed


@intrinsic
def larger(context, a, b):
    return _extreme(">")(context, a, b)


@intrinsic
def smaller(context, a, b):
    return _extreme("<")(context, a, b)


@intrinsic
def finite(context, a):
    kind = _widest(a)

    def generate(context, builder, signature, values):
        difference = builder.fsub(values[0], values[0])  # 0, or NaN for what is not finite
        return builder.fcmp_ordered("==", difference, difference)

    return _mask_of(kind)(kind), generate
