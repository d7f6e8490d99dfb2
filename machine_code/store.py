"""The on-disk cache of compiled kernels.

Numba's cache looks at the file of the compiled function only: change a function that it calls, in another file,
and the old machine code comes back. The cache folder is therefore named by a hash of every source of a package. The
folder is set only while a kernel is being declared, so other users of Numba in the process keep their own.
"""

import contextlib
import fcntl
import hashlib
import os
import tempfile
from pathlib import Path

import numba
from numba import config

_ROOT = Path(__file__).parent


def hash_of(package: Path, *endings: str) -> str:
    """sha256, hexadecimal, over names and contents of all files of a package's folder with these endings (".py"), and
    of the .py files here."""
    digest = hashlib.sha256()
    for root, path in [*_sources(package, endings), *_sources(_ROOT, (".py",))]:
        digest.update(path.relative_to(root).as_posix().encode() + b"\0")
        digest.update(path.read_bytes() + b"\0")
    return digest.hexdigest()


def _sources(root: Path, endings: tuple[str, ...]) -> list[tuple[Path, Path]]:
    return [(root, path) for path in sorted(path for ending in endings for path in root.rglob(f"*{ending}"))]


def folder_for(name: str, sources: str, kept: int) -> Path | None:
    """Folder `name`-`sources` for machine code; None where nothing can be written.

    In $TETHER_CACHE_DIR, else the user's cache, else a temporary folder. Of older folders of this name the last `kept`
    stay.
    """
    home = os.environ.get("TETHER_CACHE_DIR") or os.path.join(
        os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache"), "tether-workbench"
    )
    for root in (Path(home), Path(tempfile.gettempdir()) / f"tether-workbench-{os.getuid()}"):
        folder = root / f"{name}-{sources[:16]}"
        try:
            folder.mkdir(parents=True, exist_ok=True)
            probe = tempfile.TemporaryFile(dir=folder)
        except OSError:
            continue
        probe.close()
        _drop_old(sorted((p for p in root.glob(f"{name}-*") if p != folder), key=_last_change)[: -kept or None])
        return folder
    return None


def _drop_old(folders: list[Path]) -> None:
    for folder in folders:
        for path in sorted(folder.rglob("*"), reverse=True):
            try:
                path.rmdir() if path.is_dir() else path.unlink()
            except OSError:
                continue
        with contextlib.suppress(OSError):
            folder.rmdir()


def _last_change(folder: Path) -> float:
    # Another process may be dropping the same folder.
    try:
        return folder.stat().st_mtime
    except OSError:
        return 0.0


def one_at_a_time(dispatcher, folder: Path):
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


def compiled(function, folder: Path | None, **options):
    """`function` as a Numba dispatcher without Python objects, GIL and checks of indices, kept in `folder` (None: not
    kept). Division by zero gives inf or NaN, as in NumPy. options: further ones of numba.njit."""
    saved = config.CACHE_DIR
    if folder is not None:
        config.CACHE_DIR = str(folder)
    try:
        dispatcher = numba.njit(
            cache=folder is not None, nogil=True, error_model="numpy", boundscheck=False, **options
        )(function)
    finally:
        config.CACHE_DIR = saved
    return dispatcher if folder is None else one_at_a_time(dispatcher, folder)
