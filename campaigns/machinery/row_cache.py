"""Rows kept beside their trajectories, so that a campaign run again does not analyse again what has not changed.

A row belongs to what made it: a hash of the sources of the analysis and of its settings. Anything else that is found -
another hash, a damaged file - is as good as nothing, and the row is made anew.
"""

import contextlib
import hashlib
import json
from pathlib import Path

from engine.atomic import write_atomic


def made_by(settings: dict, *sources: str) -> str:
    """Hash of settings (plain values) and of every .py file in the given folders of the project, or given files.

    Raises FileNotFoundError for a source that is not there, or a folder with no .py file: rows would outlive what made
    them.
    """
    root = Path(__file__).resolve().parents[2]
    digest = hashlib.sha256(json.dumps(settings, sort_keys=True).encode())
    for source in sources:
        path = root / source
        files = sorted(path.rglob("*.py")) if path.is_dir() else [path]
        if not files:
            raise FileNotFoundError(f"no source in {path}")
        for file in files:
            digest.update(file.relative_to(root).as_posix().encode() + b"\0" + file.read_bytes() + b"\0")
    return digest.hexdigest()


def of_the_page() -> tuple[str, ...]:
    """What shapes a report.html and is no .py file, as sources of `made_by`."""
    place = "reports/templates"
    found = (Path(__file__).resolve().parents[2] / place).iterdir()
    return tuple(sorted(f"{place}/{path.name}" for path in found if path.is_file()))


def kept_row(directory: Path, key: str, maker: str) -> dict | None:
    """The row of a run as `maker` made it, or None."""
    try:
        content = json.loads(_path(directory, key).read_text(encoding="utf-8"))
        return dict(content["row"]) if content["made_by"] == maker else None
    except (OSError, ValueError, KeyError, TypeError):
        return None


def keep_row(directory: Path, key: str, maker: str, row: dict) -> None:
    """Store a row. A disk that is full loses no more than the time to make it again."""
    content = json.dumps({"made_by": maker, "row": row}, default=float)
    with contextlib.suppress(OSError):
        write_atomic(_path(directory, key), content.encode())


def _path(directory: Path, key: str) -> Path:
    return directory / "trajectories" / f"{key}.row.json"
