"""Machine code that several processes store at once: every kind of arguments finds its own again."""

import multiprocessing
import os
import subprocess
import sys
from types import SimpleNamespace

import pytest
from numba.core.caching import IndexDataCacheFile

from machine_code.store import one_at_a_time

PROCESSES, KINDS = 4, 12


def store_of(folder):
    store = IndexDataCacheFile(str(folder), "kernel", "stamp")
    overloads = SimpleNamespace(_cache_file=store, load_overload=store.load, save_overload=store.save)
    one_at_a_time(SimpleNamespace(_cache=overloads), folder)
    return store


def compile_kinds(folder, process):
    store = store_of(folder)
    for kind in range(KINDS):
        store.save((process, kind), f"code of {process}, {kind}")


def test_every_kind_finds_its_own_code(tmp_path):
    with multiprocessing.get_context("fork").Pool(PROCESSES) as pool:
        pool.starmap(compile_kinds, [(tmp_path, i) for i in range(PROCESSES)], chunksize=1)
    store = store_of(tmp_path)
    for process in range(PROCESSES):
        for kind in range(KINDS):
            assert store.load((process, kind)) == f"code of {process}, {kind}"


LAW = """
import sys
import numpy as np
from engine import load_scene, parameters
from engine.physics.tension.kernels import tension
for dimensions in map(int, sys.argv[1:]):
    tables = []
    record = parameters.record_of(load_scene("tethered_buoy", {"motion.dimensions": dimensions}), tables)[0]
    print(*tension(0.1, record, np.concatenate(tables)))
"""


@pytest.mark.slow
def test_code_stored_by_one_process_each_is_told_apart_where_both_are_loaded(tmp_path):
    """The tension law takes the planar record or the spatial one; Table 1 has T = EA eps = 5000 N, EA = 50 kN."""

    def said(*dimensions):
        environment = os.environ | {"TETHER_CACHE_DIR": str(tmp_path)}
        run = subprocess.run(
            [sys.executable, "-c", LAW, *dimensions], env=environment, capture_output=True, text=True, check=True
        )
        return run.stdout.split()

    law = ["5000.0", "50000.0"]
    assert said("2") == law
    assert said("3") == law
    assert said("2", "3") == law * 2
    assert said("3", "2") == law * 2
