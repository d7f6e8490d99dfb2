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


def widest(*kinds):
    """The type that takes in all of these: a vector, else a float."""
    return next((kind for kind in kinds if isinstance(kind, Lanes)), types.float64)


@intrinsic
def where(context, condition, a, b):
    kind = widest(a, b)
    mask = condition
    if isinstance(condition, LaneMask):
        kind = Lanes(condition.count)
    elif isinstance(kind, Lanes):
        mask = types.boolean

    def generate(context, builder, signature, values):
        return builder.select(*values)

    return kind(mask, kind, kind), generate


def _over_lanes(symbol, bits_of_all):
    """Intrinsic of a mask: do its bits, as one whole number, stand in this relation to that one?"""

    def typed(context, condition):
        def generate(context, builder, signature, values):
            if not isinstance(condition, LaneMask):
                return values[0]
            bits = builder.bitcast(values[0], ir.IntType(condition.count))
            return builder.icmp_unsigned(symbol, bits, ir.Constant(bits.type, bits_of_all))

        return types.boolean(condition), generate

    return intrinsic(typed)


def _extreme(symbol):
    """Intrinsic of two numbers: the second where it stands in this relation to the first, else the first."""

    def typed(context, a, b):
        kind = widest(a, b)

        def generate(context, builder, signature, values):
            x, y = values
            return builder.select(builder.fcmp_ordered(symbol, y, x), y, x)

        return kind(kind, kind), generate

    return intrinsic(typed)


every, some = _over_lanes("==", -1), _over_lanes("!=", 0)
larger, smaller = _extreme(">"), _extreme("<")


@intrinsic
def finite(context, a):
    kind = widest(a)

    def generate(context, builder, signature, values):
        difference = builder.fsub(values[0], values[0])  # 0, or NaN for what is not finite
        return builder.fcmp_ordered("==", difference, difference)

    return (LaneMask(kind.count) if isinstance(kind, Lanes) else types.boolean)(kind), generate
