"""Where all tests run in several processes, each compiles other kernels, because side by side they would compile the
same ones; and each begins with some of the longest tests. Linear algebra has one thread in each, because threads that
wait for a core of another process would take ten times the time."""

import os

import pytest

for library in ("OPENBLAS", "MKL", "OMP"):  # read when NumPy is loaded, and by processes that tests start
    os.environ.setdefault(f"{library}_NUM_THREADS", "1")

MANY = 1000  # tests, from which nearly every kernel is needed
SCENES = (  # what most tests need: changes of the tethered buoy, and as of `engine.run.pieces.shares_of`
    ({}, True, True),
    ({}, False, True),
    ({"buoy.submergence": "spherical-cap"}, False, False),
    ({"motion.dimensions": 3}, False, False),
    ({"solver.scheme": "paper-box"}, False, False),
)
LONGEST = (  # minutes each
    "test_pages.py", "test_own_mooring_page.py", "test_lowest_versions.py", "test_campaign.py", "test_basins.py",
)  # fmt: skip


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(config, items):
    """Put the longest tests at the beginnings of the blocks, of equal size, with which the processes start.

    A long test that began last would keep one process busy when the others have ended.
    """
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
    worker = getattr(session.config, "workerinput", {}).get("workerid")
    if worker in ("gw0", "gw1") and len(session.items) > MANY:
        from engine import compile_piece, load_scene, shares_of

        shares = shares_of((load_scene("tethered_buoy", changes), *how) for changes, *how in SCENES)
        for pieces in shares[int(worker[-1]) :: 2]:
            for key, scene in pieces.items():
                compile_piece(key, scene)
