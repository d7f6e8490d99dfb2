"""The on-disk cache of compiled kernels.

Numba's cache looks at the file of the compiled function only: change a function that it calls, in another file,
and the old machine code comes back. The cache folder is therefore named by a hash of every source of a package. The
folder is set only while a kernel is being declared, so other users of Numba in the process keep their own.
"""

import contextlib
import fcntl
import glob
import os
import shutil
import sys
import tempfile
import time
from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path

import numba
from numba import config

from .sources import code_hash, sources_of

PATIENCE_S = 20.0  # for a lock that is held for milliseconds
_ROOT = Path(__file__).parent
_given_up: set[Path] = set()
_NOT_KEPT = "machine code cannot be kept in {} ({}); every process compiles it anew"


def hash_of(*packages: Path, endings: tuple[str, ...] = (".py",)) -> str:
    """sha256, hexadecimal, over the code of all files of the packages' folders with these endings (`sources`), and of
    the .py files here."""
    files = sources_of(_ROOT, ".py")
    for package in packages:
        files |= {f"{package.name}/{name}": path for name, path in sources_of(package, *endings).items()}
    return kept_hash(files)


def kept_hash(files: Mapping[str, Path]) -> str:
    """`sources.code_hash`, remembered on disk."""
    return code_hash(files, folder_for("sources", "code", count=1))


def folder_for(name: str, sources: str, count: int) -> Path | None:
    """Folder `name`-`sources` for machine code; None where nothing can be written.

    In $TETHER_CACHE_DIR, else the user's cache, else a temporary folder. Of older folders of this name the last `count`
    stay.
    """
    for root in _roots():
        folder = root / f"{name}-{sources[:16]}"
        try:
            folder.mkdir(parents=True, exist_ok=True)
            probe = tempfile.TemporaryFile(dir=folder)
        except OSError:
            continue
        probe.close()
        with contextlib.suppress(OSError):  # another process may be dropping the same folders
            older = sorted((path.stat().st_mtime, path) for path in root.glob(f"{name}-*") if path != folder)
            for _, old in older[: -count or None]:
                shutil.rmtree(old, ignore_errors=True)
        return folder
    return None


folder_of = cache(folder_for)  # asked once a process, for every kernel


def _roots() -> Iterator[Path]:
    # In full: a process may go to another folder between this and its first kernel.
    chosen = os.environ.get("TETHER_CACHE_DIR")
    cache = os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache")
    if chosen:
        yield Path(chosen).absolute()
    elif not cache.startswith("~"):  # a user whom the system does not know has no home
        yield Path(cache, "tether-workbench").absolute()
    with contextlib.suppress(OSError):  # there may be no place for temporary files, or one full to the last byte
        shared = Path(tempfile.gettempdir()) / f"tether-workbench-{os.getuid()}"
        shared.mkdir(mode=0o700, exist_ok=True)
        # Everybody can write beside it and knows its name: code that somebody else left there would be run.
        if shared.stat().st_uid == os.getuid():
            yield shared


def one_at_a_time(dispatcher, folder: Path):
    """Let one process at a time look up or store machine code in `folder`; returns the dispatcher.

    Numba chooses the file of a new piece of code and then writes it: two processes that compile a kernel for two kinds
    of arguments at the same moment choose the same file, and from then on one kind is handed the code of the other.

    Whatever goes wrong with the files costs the time to compile again, never a run: code that cannot be read is
    dropped, code that cannot be stored (a full disk) is not, and a process that waits PATIENCE_S for a lock - its
    holder has been stopped, with Ctrl-Z - does without the folder.
    """
    found, store = dispatcher._cache, dispatcher._cache._cache_file
    load_overload, save_overload = found.load_overload, found.save_overload

    def alone(method):
        def call(*arguments):
            with contextlib.ExitStack() as stack:
                return method(*arguments) if _locked(folder, stack) else None

        return call

    def load(*arguments):
        try:
            return load_overload(*arguments)
        except OSError:
            return None
        except Exception:  # emptied, truncated, of another hand: unpickling raises whatever it likes
            _drop(Path(store._index_path))
            return None

    def save(*arguments):
        try:
            save_overload(*arguments)
        except OSError as error:
            _say_once(_NOT_KEPT.format(folder, error.strerror))

    store.load, store.save = alone(store.load), alone(store.save)
    found.load_overload, found.save_overload = load, save
    return dispatcher


def _locked(folder: Path, stack: contextlib.ExitStack) -> bool:
    """Lock a folder until the stack ends; False where somebody else does not let go of it."""
    if folder in _given_up:
        return False
    end = time.monotonic() + PATIENCE_S
    try:
        lock = stack.enter_context(open(folder / ".lock", "a"))
        while True:
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
                return True
            except BlockingIOError:
                if time.monotonic() > end:
                    break
            time.sleep(0.002)
    except OSError:  # a folder that was dropped as old: nothing is found, nothing kept
        return True
    _given_up.add(folder)
    _say_once(f"machine code in {folder} is locked by a process that does not go on; compiled without it")
    return False


def _drop(index: Path) -> None:
    """Drop what is kept of a kernel: a new index over old code would hand one kind the code of another."""
    for path in index.parent.glob(f"{glob.escape(index.stem)}.*"):
        with contextlib.suppress(OSError):
            path.unlink()


@cache
def _say_once(message: str) -> None:
    print(message, file=sys.stderr)


def compiled(function, folder: Path | None, **options):
    """`function` as a Numba dispatcher without Python objects, GIL and checks of indices, kept in `folder` (None: not
    kept). Division by zero gives inf or NaN, as in NumPy. options: further ones of numba.njit."""
    options |= {"nogil": True, "error_model": "numpy", "boundscheck": False, "no_cfunc_wrapper": True}
    plain = numba.njit(**options)
    if folder is None:
        return plain(function)
    saved = config.CACHE_DIR
    config.CACHE_DIR = str(folder)
    try:
        dispatcher = numba.njit(cache=True, **options)(function)
    except RuntimeError:  # Numba can write nowhere
        return plain(function)
    finally:
        config.CACHE_DIR = saved
    # Where it cannot write there it keeps code beside the source: old code would outlive a change in another file.
    if Path(dispatcher._cache.cache_path).parent != folder:
        _say_once(_NOT_KEPT.format(folder, "not writable"))
        return plain(function)
    return one_at_a_time(dispatcher, folder)
