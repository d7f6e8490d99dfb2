"""Machine code that several processes store at once: every kind of arguments finds its own again."""

import multiprocessing
from types import SimpleNamespace

import pytest
from numba.core.caching import IndexDataCacheFile

import analysis.compiled
import engine.compiled

PROCESSES, KINDS = 4, 12


def store_of(package, folder):
    store = IndexDataCacheFile(str(folder), "kernel", "stamp")
    package.one_at_a_time(SimpleNamespace(_cache=SimpleNamespace(_cache_file=store)), folder)
    return store


def compile_kinds(package, folder, process):
    store = store_of(package, folder)
    for kind in range(KINDS):
        store.save((process, kind), f"code of {process}, {kind}")


@pytest.mark.parametrize("package", [engine.compiled, analysis.compiled], ids=["engine", "analysis"])
def test_every_kind_finds_its_own_code(package, tmp_path):
    fork = multiprocessing.get_context("fork")
    processes = [fork.Process(target=compile_kinds, args=(package, tmp_path, i)) for i in range(PROCESSES)]
    for process in processes:
        process.start()
    for process in processes:
        process.join()
        assert process.exitcode == 0
    store = store_of(package, tmp_path)
    for process in range(PROCESSES):
        for kind in range(KINDS):
            assert store.load((process, kind)) == f"code of {process}, {kind}"
