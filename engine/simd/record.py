"""What takes the place of a parameter record where several runs go at once: fields by the same names.

Whole numbers are common to all lanes, so that kernels may branch on them; floats are vectors.
"""

from typing import ClassVar

import numpy as np
from numba.core import cgutils, types
from numba.core.typing.templates import AttributeTemplate, infer_getattr
from numba.extending import intrinsic, lower_getattr_generic, models, register_model
from numba.np import arrayobj

from ..record import RECORD
from .vector import Lanes

WHOLE = tuple(name for name in RECORD.names if RECORD[name] == np.int64)
REAL = tuple(name for name in RECORD.names if RECORD[name] == np.float64)


class LaneRecord(types.Type):
    """Parameters of `count` planar runs (`engine.record.RECORD`)."""

    fields: ClassVar[dict] = {
        name: (whole, row) for whole, group in ((True, WHOLE), (False, REAL)) for row, name in enumerate(group)
    }

    def __init__(self, count):
        self.count = count
        super().__init__(f"lane_record({count})")


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
        found = record.fields.get(name)
        return None if found is None else types.int64 if found[0] else Lanes(record.count)


@lower_getattr_generic(LaneRecord)
def _get_field(context, builder, record, value, name):
    whole, row = record.fields[name]
    pointers = cgutils.create_struct_proxy(record)(context, builder, value=value)
    address = builder.gep(pointers.counts if whole else pointers.values, [context.get_constant(types.intp, row)])
    return builder.load(address)


@intrinsic
def lane_record(context, counts, values):
    """Record of the parameters `counts` (whole numbers in the order of WHOLE), `values` (as_lanes, order of REAL)."""
    kind = LaneRecord(values.dtype.count)

    def generate(context, builder, sig, arguments):
        pointers = cgutils.create_struct_proxy(kind)(context, builder)
        pointers.counts = arrayobj.make_array(counts)(context, builder, arguments[0]).data
        pointers.values = arrayobj.make_array(values)(context, builder, arguments[1]).data
        return pointers._getvalue()

    return kind(counts, values), generate
