"""Kernels that call the law of a record, out of the laws of a folder (`engine.physics.laws`)."""

from machine_code.parts import compiled_in_parts

from ..compiled import by_kind, kernel


def of_the_law(laws, function, code_of):
    """A kernel (p, tables, x) that calls function(x, p, tables) of one of the laws, the one with the number code_of(p).

    In a batch of runs (`engine.simd`) only the laws that are IN_LANES are compiled.
    """
    compiled = {code: kernel(getattr(law, function)) for code, law in enumerate(laws)}
    in_lanes = {code: compiled[code] for code in compiled if laws[code].IN_LANES}
    alone = _first_of(list(compiled.items()), function, code_of)
    return by_kind(alone, alone, _first_of(list(in_lanes.items()), function, code_of))


def _first_of(laws, function, code_of):
    """A kernel that calls the first of the laws, (code, kernel) each, if it is the record's, and else looks further."""
    (code, law), *others = laws
    further = _first_of(others, function, code_of) if others else None

    def last(p, tables, x):
        return law(x, p, tables)

    def chosen(p, tables, x):
        if code_of(p) == code:
            return law(x, p, tables)
        return further(p, tables, x)

    choice = chosen if others else last
    # Numba names machine code by this: what two processes keep of two choices must not have one name
    choice.__qualname__ = "_".join([law.py_func.__module__.split(".")[-2], function, *(str(code) for code, _ in laws)])
    return compiled_in_parts(choice, None)
