"""Where all tests run in two processes, each compiles other kernels: side by side they would compile the same ones."""

import pytest

MANY = 1000  # tests, from which nearly every kernel is needed
SCENES = (  # what most tests need: changes of the tethered buoy, and as of `engine.run.pieces.shares_of`
    ({}, True, True),
    ({}, False, True),
    ({"buoy.submergence": "spherical-cap"}, False, False),
    ({"motion.dimensions": 3}, False, False),
    ({"solver.scheme": "paper-box"}, False, False),
)


@pytest.hookimpl(trylast=True)
def pytest_collection_finish(session):
    """Compile after the process has told which tests it has found: nobody waits for it."""
    worker = getattr(session.config, "workerinput", {}).get("workerid")
    if worker in ("gw0", "gw1") and len(session.items) > MANY:
        from engine import compile_piece, load_scene, shares_of

        shares = shares_of((load_scene("tethered_buoy", changes), *how) for changes, *how in SCENES)
        for pieces in shares[int(worker[-1]) :: 2]:
            for key, scene in pieces.items():
                compile_piece(key, scene)
