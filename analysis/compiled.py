"""Compilation of the measures' kernels, and the one place where their on-disk cache is decided.

Numba's cache looks at the file of the compiled function only: change a function that it calls, in another file,
and the old machine code comes back. The cache folder is therefore named by a hash of every source of this package.
The engine does the same for its own kernels; neither package imports the other, and a change in one of them does not
throw away the machine code of the other.
"""

import contextlib
import fcntl
import hashlib
import os
import tempfile
from functools import cache
from pathlib import Path

import numba
from numba import config

_ROOT = Path(__file__).parent
_KEPT_CACHES = 16


@cache
def source_hash():
    """Hash of everything in this package that can change a result of a kernel.

    Returns
    -------
    str
        sha256, hexadecimal, over the names and contents of all ``analysis/**/*.py``.
    """
    digest = hashlib.sha256()
    for path in sorted(_ROOT.rglob("*.py")):
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
        folder = root / f"analysis-{source_hash()[:16]}"
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
    others = sorted((p for p in root.glob("analysis-*") if p != current), key=_last_change)
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


def _last_change(folder):
    # Another process may be dropping the same folder.
    try:
        return folder.stat().st_mtime
    except OSError:
        return 0.0


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
    """Compile a kernel: no Python objects, no GIL, fused multiply-add allowed, cached on disk.

    Full ``fastmath`` is not used: it would let the compiler assume that no NaN exists, and NaN is how a measure says
    that nothing qualified. Division by zero gives inf or NaN, as in NumPy, and indices are not checked.
    """
    folder = cache_directory()
    saved = config.CACHE_DIR
    if folder is not None:
        config.CACHE_DIR = str(folder)
    try:
        dispatcher = numba.njit(
            cache=folder is not None, nogil=True, fastmath={"contract"}, error_model="numpy", boundscheck=False
        )(function)
    finally:
        config.CACHE_DIR = saved
    return dispatcher if folder is None else one_at_a_time(dispatcher, folder)
