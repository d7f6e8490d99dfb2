"""Where machine code is kept: a folder for each state of the sources, and not too many of them; and code that several
processes store at once: every kind of arguments finds its own again."""

import fcntl
import multiprocessing
import os
import pickle
import shutil
from functools import partial
from pathlib import Path
from types import SimpleNamespace

import numba
import numpy as np
import pytest
from numba.core.caching import IndexDataCacheFile
from numba.core.runtime import rtsys
from numba.core.runtime._nrt_python import memsys_enable_stats

from engine import load_scene, source_hash
from engine.parameters import record_of
from engine.planar.columns import NODE_WIDTH
from engine.planar.node import shape
from machine_code.parts import compiled_in_parts
from machine_code.sources import code_hash, code_of, meaning_of
from machine_code.store import compiled, folder_for, hash_of, one_at_a_time
from tests.processes import python

PROCESSES, KINDS = 4, 12


def test_every_source_counts_by_name_and_code(tmp_path, monkeypatch):
    monkeypatch.setenv("TETHER_CACHE_DIR", str(tmp_path / "cache"))
    package = tmp_path / "package"
    package.mkdir()
    endings = (".py", ".toml")
    results = {hash_of(package, endings=endings)}
    for name, content in (("a.py", "x"), ("a.py", "y"), ("b.py", "y"), ("inner/c.toml", ""), ("inner/c.toml", "x = 1")):
        (package / name).parent.mkdir(exist_ok=True)
        (package / name).write_text(content)
        results.add(hash_of(package, endings=endings))
    assert len(results) == 6
    (package / "notes.md").write_text("nothing of this compiles")
    assert hash_of(package, endings=endings) in results


def test_the_hash_of_the_engine_takes_in_kernels_scenes_and_the_store(monkeypatch):
    hashed = []
    monkeypatch.setattr("machine_code.store.kept_hash", hashed.extend)
    source_hash.__wrapped__()
    assert {"engine/time/steps.py", "engine/scenes/tethered_buoy.toml", "store.py"} <= set(hashed)


SOURCE = '''"""Module."""
def f(a, b=0):
    """Function."""
    return [a + b for a in "x"]  # comment


class C:
    """Class."""
'''


@pytest.mark.parametrize(
    "old, new, same",
    [
        ('"""Module."""', "", True),
        ('"""Function."""\n', "", True),
        ("# comment", "# another one, longer", True),
        ("a + b for", "(a\n  + b)  for", True),
        ('"x"', 'u"x"', True),
        ('"x"', '"y"', False),
        ("b=0", "b=0.0", False),
        ("b=0", "b=None", False),
        ("a + b for", "b + a for", False),
        ('    """Class."""', '    name = """Class."""', False),
        ("(a, b=0)", "(a, /, b=0)", False),
        ("def f", "async def f", False),
        ("    return [", '    ("a",)\n    return [', False),
        ('class C:\n    """Class."""', '    class C:\n        """Class."""', False),  # the same words, but within f
    ],
)
def test_only_code_counts(old, new, same):
    assert old in SOURCE
    assert (code_of(SOURCE.replace(old, new)) == code_of(SOURCE)) == same


@pytest.mark.parametrize(
    ("text", "same"), [("# a head\nlength_m = 20.0  # and why\n", True), ("length_m = 21.0", False)]
)
def test_a_comment_in_a_scene_file_leaves_its_hash(text, same):
    assert (meaning_of("a.toml", text.encode()) == meaning_of("a.toml", b"length_m = 20.0")) == same


@pytest.mark.parametrize("damage", [b"", b"short", b"\xff" * 64])
def test_a_damaged_note_of_a_hash_is_not_believed(tmp_path, damage):
    (tmp_path / "a.py").write_text("x = 1")
    files = {"a.py": tmp_path / "a.py"}
    results = code_hash(files, tmp_path / "notes")
    (tmp_path / "notes").mkdir()
    assert code_hash(files, tmp_path / "notes") == results
    (note,) = (tmp_path / "notes").iterdir()
    note.write_bytes(damage)
    assert code_hash(files, tmp_path / "notes") == results and note.read_text() == results


def test_the_latest_folders_of_a_name_stay(tmp_path, monkeypatch):
    monkeypatch.setenv("TETHER_CACHE_DIR", str(tmp_path))
    other = folder_for("other", "0", 2)
    for number in range(5):
        folder = folder_for("mine", str(number), 2)
        (folder / "inner").mkdir()
        (folder / "inner" / "code").touch()
        os.utime(folder, (number, number))
    assert {path.name for path in tmp_path.iterdir()} == {"mine-4", "mine-3", "mine-2", other.name}


@pytest.fixture
def elsewhere(tmp_path, monkeypatch):
    """Sets up a user whose own folder cannot be written, with the temporary files in tmp_path."""
    (tmp_path / "file").touch()
    monkeypatch.setenv("TETHER_CACHE_DIR", str(tmp_path / "file" / "below"))
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    return monkeypatch


def test_where_nothing_can_be_written_the_temporary_folder_is_taken(tmp_path, elsewhere):
    assert folder_for("mine", "0", 1).parent.parent == tmp_path
    elsewhere.setattr("tempfile.tempdir", str(tmp_path / "file"))
    assert folder_for("mine", "0", 1) is None


def test_code_that_somebody_else_left_among_the_temporary_files_is_not_run(elsewhere):
    theirs = os.getuid() + 1
    elsewhere.setattr("os.getuid", lambda: theirs)
    assert folder_for("mine", "0", 1) is None


def test_a_relative_folder_stays_where_it_was_when_the_process_goes_elsewhere(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("TETHER_CACHE_DIR", "code")
    assert folder_for("mine", "0", 1) == tmp_path / "code" / "mine-0"


def test_a_user_without_a_home_gets_no_folder_of_that_name(tmp_path, elsewhere):
    elsewhere.chdir(tmp_path)
    for name in ("TETHER_CACHE_DIR", "XDG_CACHE_HOME"):
        elsewhere.delenv(name, raising=False)
    elsewhere.setattr("os.path.expanduser", lambda path: path)
    assert folder_for("mine", "0", 1).is_relative_to(tmp_path) and not (tmp_path / "~").exists()


def half(x):
    return 0.5 * x


kept_in = partial(compiled, half)  # the kernel as another process would declare it


def hits(kernel):
    """How often its code was found on disk, after one call."""
    assert kernel(3.0) == 1.5
    return sum(kernel.stats.cache_hits.values())


def test_what_a_kernel_calls_has_no_machine_code_of_its_own(tmp_path):
    inner = compiled_in_parts(half, tmp_path)
    outer = compiled_in_parts(lambda x: inner(inner(x)), tmp_path)
    assert outer(6.0) == 1.5 and not inner.signatures
    assert len(list(tmp_path.rglob("*.nbc"))) == 1
    assert [hits(compiled_in_parts(half, tmp_path)) for _ in range(2)] == [0, 1]


@pytest.mark.parametrize("ending", [".nbi", ".nbc"])
@pytest.mark.parametrize("content", [b"", b"half", pickle.dumps("of another hand")])
def test_damaged_machine_code_is_compiled_again(tmp_path, ending, content):
    assert [hits(kept_in(tmp_path)) for _ in range(2)] == [0, 1]
    (file,) = tmp_path.rglob(f"*{ending}")
    file.write_bytes(content)
    assert [hits(kept_in(tmp_path)) for _ in range(2)] == [0, 1]


def test_old_code_goes_with_its_index(tmp_path, monkeypatch):
    """A new index numbers from one again: until its code is written, the number is that of the old code."""
    hits(kept_in(tmp_path))
    (code,) = tmp_path.rglob("*.nbc")
    (index,) = tmp_path.rglob("*.nbi")
    index.write_bytes(b"")
    kernel = kept_in(tmp_path)
    monkeypatch.setattr(kernel._cache, "save_overload", lambda *_: None)
    assert hits(kernel) == 0 and not code.exists() and not index.exists()


def test_a_folder_that_cannot_be_written_costs_no_run(tmp_path, capfd):
    folder = tmp_path / "code"
    kernel = kept_in(folder)
    shutil.rmtree(folder)
    folder.touch()
    assert hits(kernel) == 0 and hits(kept_in(folder)) == 0
    assert capfd.readouterr().err.count(f"machine code cannot be kept in {folder}") == 2
    assert not list(Path(__file__).parent.rglob("test_machine_code.half*"))  # nor beside the source


def test_a_process_that_was_stopped_with_the_lock_is_not_waited_for(tmp_path, monkeypatch, capfd):
    hits(kept_in(tmp_path))
    monkeypatch.setattr("machine_code.store.PATIENCE_S", 0.05)
    with open(tmp_path / ".lock", "a") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        assert hits(kept_in(tmp_path)) == 0
    assert "locked by a process that does not go on" in capfd.readouterr().err


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
    fork = multiprocessing.get_context("fork")
    processes = [fork.Process(target=compile_kinds, args=(tmp_path, i)) for i in range(PROCESSES)]
    for process in processes:
        process.start()
    for process in processes:
        process.join()
        assert process.exitcode == 0
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

    def printed(*dimensions):
        return python("-c", LAW, *dimensions, TETHER_CACHE_DIR=str(tmp_path)).stdout.split()

    law = ["5000.0", "50000.0"]
    assert printed("2") == law
    assert printed("3") == law
    assert printed("2", "3") == law * 2
    assert printed("3", "2") == law * 2


def test_plain_numba_may_call_a_kernel_that_calls_others():
    p, tables = record_of(load_scene("tethered_buoy", {"tether.nodes": 5}), kept := [])[0], np.concatenate(kept)
    Y, results = np.random.default_rng(0).normal(size=(5, 6)), []

    @numba.njit
    def by_numba(p, tables, Y, Q, X):
        shape(p, tables, Y, Q, X)

    for call in (shape, by_numba):
        results.append((np.zeros((5, NODE_WIDTH)), np.zeros((5, 2))))
        call(p, tables, Y, *results[-1])
    (first_Q, first_X), (second_Q, second_X) = results
    assert np.array_equal(first_Q, second_Q) and np.array_equal(first_X, second_X) and first_X.any()


compiled_for_callers = partial(compiled_in_parts, folder=None)


@compiled_for_callers
def twice(row):
    return 2.0 * row


@compiled_for_callers
def first_of(rows, k):
    row = rows[k]
    return row[0]


@compiled_for_callers
def last_row(rows):
    return rows[rows.shape[0] - 1]


@compiled_for_callers
def of_new_rows(k):
    rows = np.arange(12.0).reshape(4, 3)
    return first_of(rows, k) + twice(rows[k])[1] + last_row(rows)[2]


def test_arrays_that_parts_make_are_given_back_once():
    whole = compiled_in_parts(lambda k: of_new_rows(k) + first_of(np.ones((2, 1)), 0), None)
    assert whole(1) == 3.0 + 8.0 + 11.0 + 1.0
    memsys_enable_stats()
    before = rtsys.get_allocation_stats()
    for _ in range(100):
        whole(1)
    after = rtsys.get_allocation_stats()
    made, freed = after.mi_alloc - before.mi_alloc, after.mi_free - before.mi_free
    assert made == freed >= 100


def test_a_kernel_that_takes_rows_of_its_arrays_does_not_count_who_uses_them():
    p, tables = record_of(load_scene("tethered_buoy", {"tether.nodes": 5}), kept := [])[0], np.concatenate(kept)
    whole = compiled_in_parts(lambda *arguments: shape(*arguments), None)
    whole(p, tables, np.zeros((5, 6)), np.zeros((5, NODE_WIDTH)), np.zeros((5, 2)))
    (code,) = whole.inspect_llvm().values()
    assert "call void @NRT_incref" not in code
