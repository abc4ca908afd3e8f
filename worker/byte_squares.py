"""Squared differences of 32 bytes at once, which a loop over bytes is not compiled to.

Numba makes 64-bit numbers of whatever is computed with bytes, and the lines of a patch are too
short for what LLVM makes of such a loop: this is more than twice as quick, and as exact. LLVM
brings the vectors to the registers a processor has.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from llvmlite import ir
from numba.core import cgutils, types
from numba.extending import intrinsic

if TYPE_CHECKING:
    from numpy.typing import NDArray

WIDTH = 32
"""Bytes that are read whether they count or not: rows have to go on that far."""
_BYTE = ir.IntType(8)
_BYTES, _SHORTS, _NUMBERS = (ir.VectorType(ir.IntType(bits), WIDTH) for bits in (8, 16, 32))
_SUM = f"llvm.vector.reduce.add.v{WIDTH}i32"


def counting(length: int) -> NDArray[np.uint8]:
    """Return what says of a line of so many bytes which count: 255, then 0 up to a whole vector."""
    counts = np.zeros(-(-length // WIDTH) * WIDTH, np.uint8)
    counts[:length] = 255
    return counts


@intrinsic  # type: ignore[untyped-decorator]
def squares(
    _: Any, ours: Any, row: Any, column: Any, theirs: Any, other_row: Any, other_column: Any,
    counts: Any, first: Any,
) -> Any:  # fmt: skip
    """Return the sum of squared differences of 32 bytes of two arrays, as an int32; in kernels.

    Args:
        _: Numba's.
        ours: Bytes, (rows, columns).
        row: Where to begin in ours.
        column: Likewise.
        theirs: Bytes, (rows, columns).
        other_row: Where to begin in theirs.
        other_column: Likewise.
        counts: Made by `counting`.
        first: Where to begin in it.
    """
    place = types.intp
    signature = types.int32(ours, place, place, theirs, place, place, counts, place)

    def generate(context: Any, builder: Any, _: Any, values: Any) -> Any:
        def read(kind: Any, array: Any, *where: Any) -> Any:
            struct = context.make_array(kind)(context, builder, array)
            offset = where[-1]
            if len(where) > 1:
                stride = builder.extract_value(struct.strides, 0)
                offset = builder.add(builder.mul(where[0], stride), offset)
            start = builder.gep(builder.bitcast(struct.data, _BYTE.as_pointer()), [offset])
            return builder.load(builder.bitcast(start, _BYTES.as_pointer()), align=1)

        count = read(counts, *values[6:8])
        one, other = (
            builder.zext(builder.and_(read(kind, *parts), count), _SHORTS)
            for kind, parts in ((ours, values[0:3]), (theirs, values[3:6]))
        )
        steps = builder.sext(builder.sub(one, other), _NUMBERS)
        kind = ir.FunctionType(ir.IntType(32), [_NUMBERS])
        total = cgutils.get_or_insert_function(builder.module, kind, _SUM)
        return builder.call(total, [builder.mul(steps, steps)])

    return signature, generate
