"""Pieces of machine code: a run needs no other, and no two processes compile the same."""

import json

import pytest

from tests.processes import python

PROGRAM = """
import json, sys
from numba.core.dispatcher import Dispatcher
from engine import compile_piece, load_scene, shares_of, simulate, simulate_batch

def loaded():
    modules = [vars(module) for name, module in [*sys.modules.items()] if name.startswith("engine.")]
    kernels = {one for module in modules for one in module.values() if isinstance(one, Dispatcher)}
    return sorted(f"{one.py_func.__qualname__} {types}" for one in kernels for types in one.overloads)

few, carried = {"tether.nodes": 5}, {"output.tangent_vectors": 1}
plain, carrying = (load_scene("tethered_buoy", few | more) for more in ({}, carried))
shares = shares_of([(plain, True, True), (plain, False, True)])
for share in shares if sys.argv[1] == "all" else [shares[int(sys.argv[1])]]:
    for piece in share.items():
        compile_piece(*piece)
pieces = loaded()
if sys.argv[1] == "all":
    for scene in (plain, carrying):
        simulate(scene, duration_s=0.2)
        simulate_batch([scene, scene], duration_s=0.2)
print(json.dumps([pieces, loaded()]))
"""


def loaded(which):
    """Kernels with the types of their arguments that a process has: after the pieces, and after runs as well."""
    return json.loads(python("-c", PROGRAM, which).stdout)


@pytest.mark.slow
def test_runs_need_no_machine_code_but_that_of_their_pieces_which_are_apart():
    pieces, runs = loaded("all")
    assert pieces == runs
    first, second = (set(loaded(which)[0]) for which in "01")
    assert first and second and not first & second and first | second == set(pieces)
