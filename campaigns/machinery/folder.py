"""A campaign's folder: written so that a kill, a crash or a full disk at any moment leaves it readable.

Every file appears whole or not at all: written under a temporary name, forced to disk, renamed. A lock keeps two
campaigns out of the same folder; the system drops it when its holder dies, however it dies.
"""

import contextlib
import errno
import fcntl
import hashlib
import json
import math
import os
import re
import shutil
import socket
import time
from collections.abc import Iterator
from pathlib import Path

import engine
from engine.atomic import write_atomic
from tables import Columns, Row, names, write_table

PACKAGES = "machine_code", "tables", "engine", "analysis", "campaigns", "reports"  # of this project
PROGRESS = ".progress-"  # begins the names of folders in which workers say how far they are
SEAL = b"sha256:" + 64 * b"0"  # stands in a content that `write_sealed` is given
_SEALED = re.compile(rb"sha256:[0-9a-f]{64}")
_NO_SPACE = {errno.ENOSPC, errno.EDQUOT, errno.EFBIG}


class CampaignStopped(Exception):
    """The campaign cannot go on, for a reason outside its runs; str() is one line for the user."""

    code = 1  # with which its command ends


class BadInput(CampaignStopped):
    """An option is at fault that only the first results can judge."""

    code = 2


def trajectory_path(directory: Path, key: str) -> Path:
    """Where the run with this content key is kept."""
    return directory / "trajectories" / f"{key}.nc"


def is_full(error: BaseException | None) -> bool:
    """Whether an exception, or one that it was raised from, says that nothing more fits on the disk."""
    while error is not None:
        if isinstance(error, OSError) and error.errno in _NO_SPACE:
            return True
        error = error.__cause__ or error.__context__
    return False


def write_failure(directory: Path | str, error: BaseException) -> str:
    """One line on a failed write: a full disk in plain words, anything else with the system's reason."""
    if is_full(error):
        return f"the disk of {directory} is full; finished runs are kept; make room and run the same command again"
    return f"cannot write to {directory}: {error}"


@contextlib.contextmanager
def claimed(directory: Path) -> Iterator[None]:
    """Create the folder and hold it for this process alone.

    Raises CampaignStopped when another campaign is running in it, OSError when it cannot be made.
    """
    (directory / "trajectories").mkdir(parents=True, exist_ok=True)
    with open(directory / ".lock", "a+", encoding="utf-8") as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            lock.seek(0)
            holder = lock.read().strip() or "another process"
            raise CampaignStopped(
                f"{directory} is in use by {holder}; wait for it to end, or give another folder with --out"
            ) from None
        # The words in the file only inform; the lock is the flock. The file stays: unlinking it would open a race.
        with contextlib.suppress(OSError):
            lock.truncate(0)
            lock.write(f"process {os.getpid()} on {socket.gethostname()}")
            lock.flush()
        _drop_temporaries(directory)
        try:
            yield
        finally:
            _drop_temporaries(directory)  # of workers that were ended while they wrote


def _drop_temporaries(directory: Path) -> None:
    for path in directory.glob(f"{PROGRESS}*"):
        shutil.rmtree(path, ignore_errors=True)
    for path in directory.rglob(".*.tmp"):
        with contextlib.suppress(OSError):
            path.unlink()


class Table:
    """table.csv while it grows: rows by run key, always written in the order of the campaign.

    Rows may arrive in any order; the file is rewritten as they come, at most twice a second, and by `write`. The
    dictionary of its columns (columns.csv) is written before the table is.
    """

    def __init__(self, path: Path, columns: Columns, keys: list[str]):
        self.path, self.columns, self.keys = path, columns, keys
        self.rows: dict[str, Row] = {}
        self._written_s = -math.inf

    def add(self, key: str, row: Row) -> None:
        """Take in a row and bring the file up to date unless that was done a moment ago. Raises OSError."""
        unknown = set(row) - set(names(self.columns))
        if unknown:
            raise KeyError(f"the table has no column {', '.join(sorted(unknown))}")
        self.rows[key] = row
        if time.monotonic() - self._written_s > 0.5:
            self.write()

    def in_order(self) -> list[Row]:
        """The rows there are, in the order of the campaign."""
        return [self.rows[key] for key in self.keys if key in self.rows]

    def write(self) -> None:
        """Rewrite the file. Raises OSError."""
        write_table(self.path, self.columns, self.in_order())
        self._written_s = time.monotonic()


def stored_run(folder: Path, key: str) -> "engine.Trajectory":
    """The run with this content key. Raises TrajectoryError where its file is not there, damaged, or of another run."""
    return engine.Trajectory.load(trajectory_path(folder, key), {"run_key": key})


def run_of(folder: Path, row: Row) -> "engine.Trajectory | None":
    """The trajectory of a row; None for a run that ended early, or whose file cannot be read."""
    try:
        if row["status"] == "ok":
            return stored_run(folder, row["run_key"])
    except ValueError:  # TrajectoryError
        pass
    return None


def write_new(path: Path, content: bytes) -> None:
    """Write a file, unless it has this content already. Raises OSError."""
    if not path.exists() or path.read_bytes() != content:
        write_atomic(path, content)


def read_json(path: Path) -> object:
    """The content of a JSON file; None where it cannot be read."""
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError):
        return None


def write_json(path: Path, content: dict) -> None:
    """Write a JSON file whole. Raises OSError."""
    write_atomic(path, (json.dumps(content, indent=2, allow_nan=False) + "\n").encode())


def write_sealed(path: Path, content: bytes) -> None:
    """Write a file in which SEAL stands; the digest of its name and of its content takes its place. Raises OSError."""
    write_atomic(path, _closed(path, content))


def read_sealed(path: Path) -> bytes | None:
    """What `write_sealed` was given; None where the file is not there, not whole, changed, or has another's name."""
    try:
        found = path.read_bytes()
    except OSError:
        return None
    content = _SEALED.sub(SEAL, found, count=1)
    return content if SEAL in content and _closed(path, content) == found else None


def _closed(path: Path, content: bytes) -> bytes:
    digest = hashlib.sha256(path.name.encode() + b"\0" + content).hexdigest()
    return content.replace(SEAL, b"sha256:" + digest.encode(), 1)


def keep_json(path: Path, content: dict) -> None:
    """Write a JSON file that is read again, sealed. Raises OSError."""
    write_sealed(path, (json.dumps({"seal": SEAL.decode(), **content}, indent=1, default=float) + "\n").encode())


def kept_json(path: Path) -> dict:
    """What `keep_json` was given; {} where there is none, or it is not what was written."""
    found = read_sealed(path)
    return {} if found is None else {name: entry for name, entry in json.loads(found).items() if name != "seal"}


def made_by(*sources: str, **settings: object) -> str:
    """Hash of the code of every .py file in the given folders of the project, or given files, and of settings (plain
    values); docstrings and comments do not count.

    A row that is kept beside its run belongs to such a hash of what made it; to any other it is as good as nothing.
    Raises FileNotFoundError for a source that is not there, or a folder with no .py file: rows would outlive what made
    them.
    """
    from machine_code.store import kept_hash

    root = Path(__file__).resolve().parents[2]
    files = {}  # by name in the project
    for source in sources:
        path = root / source
        members = [path]
        if path.is_dir():
            members = list(path.rglob("*.py"))
        if not members:
            raise FileNotFoundError(f"no source in {path}")
        for file in sorted(members):
            files[file.relative_to(root).as_posix()] = file
    return hashlib.sha256((json.dumps(settings, sort_keys=True) + kept_hash(files)).encode()).hexdigest()


def of_the_page() -> tuple[str, ...]:
    """What shapes a report.html and is no .py file, as sources of `made_by`."""
    place = "reports/templates"
    found = (Path(__file__).resolve().parents[2] / place).iterdir()
    return tuple(sorted(f"{place}/{path.name}" for path in found if path.is_file()))
