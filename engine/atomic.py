"""Files that appear whole or not at all, whether a folder takes one, and whether a file may be that of a run."""

import contextlib
import os
import secrets
import tempfile
from pathlib import Path


def can_be_written(folder: str | Path) -> bool:
    """Whether a file can be made in a folder. One is made, because /proc says yes to root and then makes none."""
    if not os.path.isdir(folder) or not os.access(folder, os.W_OK):
        return False
    try:
        with tempfile.TemporaryFile(dir=folder):  # without a name, where the file system has such files
            return True
    except OSError:
        return False


def is_netcdf(path: str | Path) -> bool:
    """Whether a file can be read and begins as netCDF-3 does: told without the libraries that read all of it."""
    if not os.path.isfile(path) or not os.access(path, os.R_OK):
        return False
    with open(path, "rb") as file:
        return file.read(3) == b"CDF"


def write_atomic(path: str | Path, content: bytes) -> None:
    """Put content under path in one step: a reader, or a machine that stops, sees the old file or the new one.

    Written to a temporary name in the same folder, flushed to the disk, renamed. The temporary file is removed when
    anything fails (a full disk, an interrupt); then path is untouched. Raises OSError.
    """
    path = Path(path)
    if not path.parent.is_dir():
        raise FileNotFoundError(f"{path}: there is no folder {path.parent}")
    if path.is_dir():
        raise IsADirectoryError(f"{path}: is a folder; allowed: the path of a file")
    temporary = path.with_name(f".{path.name}.{os.getpid()}-{secrets.token_hex(4)}.tmp")
    try:
        with open(temporary, "xb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        os.replace(temporary, path)
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise
    with contextlib.suppress(OSError):  # the rename reaches the disk only with its folder; not every system opens one
        folder = os.open(path.parent, os.O_RDONLY)
        try:
            os.fsync(folder)
        finally:
            os.close(folder)
