"""Who ran what, where, with which versions: `provenance.json`.

The file describes what made the results, so a later run of the same campaign that computes nothing leaves it alone, and
a report made from the folder does not change.
"""

import json
import os
import platform
import socket
import subprocess
from datetime import UTC, datetime
from importlib import metadata
from pathlib import Path

from campaigns.machinery.folder import write_json

_PACKAGES = (
    "numpy", "scipy", "numba", "llvmlite", "pandas", "xarray", "pydantic", "joblib", "dask", "distributed", "tqdm",
    "matplotlib", "jinja2", "typst",
)  # fmt: skip
_OF_THE_OCCASION = {
    "command", "jobs", "backend", "dask_address", "host", "cpu_count", "platform", "started_utc", "finished_utc",
    "timing", "runs",
}  # fmt: skip


def gather(campaign: str, command: list[str]) -> dict[str, object]:
    """What is known before the first run: versions, sources, machine, time; nothing of the campaign's parameters.

    seed is null: no campaign that calls this draws random numbers.
    """
    from engine import source_hash

    return {
        "campaign": campaign,
        "command": command,
        "started_utc": now_utc(),
        "finished_utc": None,
        "seed": None,
        "host": socket.gethostname(),
        "cpu_count": os.cpu_count(),
        "platform": platform.platform(),
        "versions": {"python": platform.python_version()} | {name: _version(name) for name in _PACKAGES},
        "git": git_state(Path(__file__).parents[1]),
        "engine_source_hash": source_hash(),
    }


def now_utc() -> str:
    """The time now, UTC, to the second."""
    return datetime.now(UTC).strftime("%Y-%m-%dT%H:%M:%SZ")


def git_state(directory: Path) -> dict[str, object]:
    """{"commit", "dirty"} of the checkout that holds `directory`; both null outside one, or without git."""
    commit = _git(directory, "rev-parse", "HEAD")
    changes = _git(directory, "status", "--porcelain") if commit is not None else None
    return {"commit": commit, "dirty": None if changes is None else changes != ""}


def write(path: Path, record: dict[str, object]) -> None:
    """Write the record whole. Raises OSError."""
    write_json(path, record)


def read_if_same(path: Path, record: dict[str, object]) -> dict[str, object] | None:
    """The record on disk where it is of a finished campaign and differs from `record` only in when and where it ran."""
    try:
        old = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    if not isinstance(old, dict) or old.get("finished_utc") is None:
        return None
    lasting = json.loads(json.dumps({key: entry for key, entry in record.items() if key not in _OF_THE_OCCASION}))
    return old if lasting == {key: entry for key, entry in old.items() if key not in _OF_THE_OCCASION} else None


def _version(package: str) -> str | None:
    try:
        return metadata.version(package)
    except metadata.PackageNotFoundError:
        return None


def _git(directory: Path, *words: str) -> str | None:
    # An installed copy is no checkout, even when it lies inside somebody's: only our own repository counts.
    if not (directory.parent / ".git").exists():
        return None
    try:
        command = ["git", "-C", str(directory), *words]
        done = subprocess.run(command, capture_output=True, text=True, timeout=10, check=True)
    except (OSError, subprocess.SubprocessError):
        return None
    return done.stdout.strip()
