"""Where all tests run in several processes, those of the engine stay together in the last, because side by side they
would compile the same kernels; and each process begins with some of the longest tests. Linear algebra has one thread in
each, because threads that wait for a core of another process would take ten times the time.

Python does not look for garbage among what the tests are made of: that took a seventh of the time."""

import gc
import os
from pathlib import Path

import pytest

for library in ("OPENBLAS", "MKL", "OMP"):  # read when NumPy is loaded, and by processes that tests start
    os.environ.setdefault(f"{library}_NUM_THREADS", "1")
gc.disable()  # until all tests are collected

ANALYSIS, ENGINE = Path(__file__).parent / "analysis", Path(__file__).parent / "engine"
MANY = 1000  # tests, from which nearly every kernel is needed
SCENES = {  # what the tests of each need: changes of the tethered buoy, and as of `engine.run.pieces.shares_of`
    "gw0": [({}, True, True), ({}, False, True)],
    "gw1": [
        ({"buoy.submergence": "spherical-cap"}, False, False),
        ({"motion.dimensions": 3}, False, False),
        ({"solver.scheme": "paper-box"}, False, False),
    ],
}
LONGEST = (  # minutes each
    "test_pages.py", "test_own_mooring_page.py", "test_lowest_versions.py", "test_campaign.py", "test_basins.py",
)  # fmt: skip


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(config, items):
    """Put the engine last, and the longest tests at the beginnings of the blocks, of equal size, with which the
    processes start.

    A long test that began last would keep one process busy when the others have ended.
    """
    items.sort(key=lambda item: [ENGINE in item.path.parents, ANALYSIS in item.path.parents])
    processes = getattr(config, "workerinput", {}).get("workercount", 1)
    longest, others = [], []
    for item in items:
        is_long = item.path.name in LONGEST and item.get_closest_marker("slow") is not None
        (longest if is_long else others).append(item)
    left = len(items)
    items.clear()
    for number in range(processes):
        size = left // (processes - number)
        first = longest[number::processes]
        room = max(size - len(first), 0)
        items += first + others[:room]
        del others[:room]
        left -= size
    items += others


@pytest.hookimpl(trylast=True)
def pytest_collection_finish(session):
    """Compile after the process has told which tests it has found: nobody waits for it."""
    gc.freeze()
    gc.enable()
    scenes = SCENES.get(getattr(session.config, "workerinput", {}).get("workerid"), [])
    if scenes and len(session.items) > MANY:
        from engine import compile_piece, load_scene, shares_of

        for pieces in shares_of((load_scene("tethered_buoy", changes), *how) for changes, *how in scenes):
            for key, scene in pieces.items():
                compile_piece(key, scene)
