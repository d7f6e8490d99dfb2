"""Where all tests run in two processes, each compiles other kernels: side by side they would compile the same ones."""

import pytest

MANY = 1000  # tests, from which nearly every kernel is needed


def _planar():
    from engine import load_scene, simulate, simulate_batch

    carried = {"output.tangent_vectors": 1, "output.lateral_growth": True}
    for changes in ({}, carried):
        scenes = [
            load_scene("tethered_buoy", {"tether.nodes": 5, "waves.steepness": kA, **changes}) for kA in (0.01, 0.02)
        ]
        simulate(scenes[0], duration_s=0.2)
        simulate_batch(scenes, duration_s=0.2)


def _spatial_and_paper():
    from engine import load_scene, simulate

    for changes in ({"motion.dimensions": 3}, {"solver.scheme": "paper-box"}):
        simulate(load_scene("tethered_buoy", {"tether.nodes": 5, **changes}), duration_s=0.2)


@pytest.hookimpl(trylast=True)
def pytest_collection_finish(session):
    """Compile after the process has told which tests it has found: nobody waits for it."""
    worker = getattr(session.config, "workerinput", {}).get("workerid")
    compile_kernels = {"gw0": _planar, "gw1": _spatial_and_paper}.get(worker)
    if compile_kernels and len(session.items) > MANY:
        compile_kernels()
