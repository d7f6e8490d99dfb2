"""Compilation of the kernels, and the one place where their on-disk cache is decided.

Numba's cache looks at the file of the compiled function only: change a function that it calls, in another file,
and the old machine code comes back. The cache folder is therefore named by a hash of every source of the engine.
The folder is set only while a kernel is being declared, so other users of Numba in the process keep their own.
"""

import contextlib
import fcntl
import hashlib
import os
import tempfile
from functools import cache
from pathlib import Path

import numba
from numba import config, types

from .fused import with_fused_sums

_ROOT = Path(__file__).parent
_KEPT_CACHES = 6


def _mangled_by_contents(record):
    return "Record", (hashlib.sha256(record.name.encode()).hexdigest()[:16],)


# Numba writes a record into the names of compiled functions as a number that counts the types its process has met.
# Two processes give one number to two records: code that one stored for the planar record and the other for the
# spatial one then has one name, and a process that loads both gets one of them for both. Names are only names: other
# users of Numba in the process lose nothing by names that tell records apart.
types.Record.mangling_args = property(_mangled_by_contents)


@cache
def source_hash():
    """Hash of everything in the engine that can change a result; part of the key of every stored run.

    Returns
    -------
    str
        sha256, hexadecimal, over the names and contents of all ``engine/**/*.py`` and ``*.toml``.
    """
    digest = hashlib.sha256()
    for path in sorted([*_ROOT.rglob("*.py"), *_ROOT.rglob("*.toml")]):
        digest.update(path.relative_to(_ROOT).as_posix().encode() + b"\0")
        digest.update(path.read_bytes() + b"\0")
    return digest.hexdigest()


@cache
def cache_directory():
    """Folder for machine code: ``$TETHER_CACHE_DIR``, else the user's cache, else a temporary folder."""
    home = os.environ.get("TETHER_CACHE_DIR") or os.path.join(
        os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache"), "tether-workbench"
    )
    for root in (Path(home), Path(tempfile.gettempdir()) / f"tether-workbench-{os.getuid()}"):
        folder = root / f"kernels-{source_hash()[:16]}"
        try:
            folder.mkdir(parents=True, exist_ok=True)
            probe = tempfile.TemporaryFile(dir=folder)
        except OSError:
            continue
        probe.close()
        _drop_old(root, folder)
        return folder
    return None


def _drop_old(root, current):
    others = sorted((p for p in root.glob("kernels-*") if p != current), key=lambda p: p.stat().st_mtime)
    for folder in others[: -_KEPT_CACHES or None]:
        for path in sorted(folder.rglob("*"), reverse=True):
            try:
                path.rmdir() if path.is_dir() else path.unlink()
            except OSError:
                continue
        try:
            folder.rmdir()
        except OSError:
            continue


def one_at_a_time(dispatcher, folder):
    """Let one process at a time look up or store machine code in `folder`; returns the dispatcher.

    Numba chooses the file of a new piece of code and then writes it: two processes that compile a kernel for two kinds
    of arguments at the same moment choose the same file, and from then on one kind is handed the code of the other.
    """
    store = dispatcher._cache._cache_file

    def alone(method):
        def call(*arguments):
            with contextlib.ExitStack() as stack:
                with contextlib.suppress(OSError):  # a folder that was dropped as old: nothing is found, nothing kept
                    lock = stack.enter_context(open(folder / ".lock", "a"))
                    fcntl.flock(lock, fcntl.LOCK_EX)
                return method(*arguments)

        return call

    store.load, store.save = alone(store.load), alone(store.save)
    return dispatcher


def kernel(function):
    """Compile a kernel: no Python objects, no GIL, sums of products fused (`engine.fused`), cached on disk.

    No ``fastmath``: what it allows differs from processor to processor and between one run and a batch; it breaks the
    range reduction of `engine.elementary.sincos` and hides NaN.
    """
    folder = cache_directory()
    saved = config.CACHE_DIR
    if folder is not None:
        config.CACHE_DIR = str(folder)
    try:
        dispatcher = numba.njit(cache=folder is not None, nogil=True, error_model="numpy", boundscheck=False)(
            with_fused_sums(function)
        )
    finally:
        config.CACHE_DIR = saved
    return dispatcher if folder is None else one_at_a_time(dispatcher, folder)


def by_kind(planar, spatial, lanes=None):
    """One name for two kernels or three: `planar` for records of the plane, `spatial` for those with a third dimension,
    `lanes` for several planar runs at once (`engine.lanes`; None: the planar one serves them too).

    The choice is by the type of the first argument, when a kernel that calls the name is compiled: nothing is compiled
    for a scene that does not need it, and nothing is decided at run time.
    """
    from numba.extending import overload

    def either(*arguments):
        raise NotImplementedError("only compiled kernels call this")

    @overload(either, strict=False, jit_options={"nogil": True, "error_model": "numpy"})
    def chosen(p, *arguments):
        from .lanes.record import LaneRecord  # knows `engine.parameters`, which knows some of the kernels

        if "GI" in p.fields:
            return spatial.py_func
        return (lanes if lanes is not None and isinstance(p, LaneRecord) else planar).py_func

    return either
