"""A campaign that is finished and asked for again: the same order, the same code, and the folder as it was left.

Its answer is then printed as it stands. Runs, rows and report are not looked at, and the scenes of its runs are not
made again, so that whoever only looks does not wait for what is there.
"""

import hashlib
import json
import os
from collections.abc import Iterator, Mapping
from pathlib import Path

from campaigns.machinery.folder import PACKAGES, made_by, of_the_page, read_json, write_json
from campaigns.machinery.plan import Summary

FILE = "finished.json"
_BESIDE = {FILE, ".lock"}  # files of the folder that say nothing of its results
_DATA = "engine/scenes/*.toml", "campaigns/**/*.toml", "campaigns/**/*.csv"
_COMPUTED_AGAIN = {"error", "worker-died", "analysis-failed", "lost"}  # statuses of rows that another attempt may mend


def order_key(called: str, asked: Mapping[str, object], versions: Mapping[str, str | None]) -> str:
    """Hash of everything that a finished folder depends on: an order, all code and data, the versions of libraries.

    called: the command; asked: what its options ask for. Of a word that names a file or a folder the content counts.
    """
    root = Path(__file__).resolve().parents[2]
    data = [path.relative_to(root).as_posix() for pattern in _DATA for path in root.glob(pattern)]
    words = json.dumps(dict(asked), sort_keys=True, default=str)
    content = {
        "order": [called, words],
        "files": [hashlib.sha256(path.read_bytes()).hexdigest() for path in _files_in(asked.values())],
        "code": made_by(*PACKAGES, *of_the_page(), *data),
        "versions": dict(versions),
    }
    return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()


def _files_in(values) -> Iterator[Path]:
    """The files that words among these values name, also words of a list; of a folder its tables."""
    for value in values:
        if isinstance(value, str) and os.path.isfile(value):
            yield Path(value)
        elif isinstance(value, str) and os.path.isdir(value):
            yield from sorted(Path(value).rglob("*.csv"))
        elif isinstance(value, list | tuple):
            yield from _files_in(value)


def finished(out: Path, key: str) -> Summary | None:
    """The summary of the finished campaign in a folder; None where it is another one, or the folder has changed.

    Its rows have their status only.
    """
    record = read_json(out / FILE)
    if not isinstance(record, dict) or record.get("key") != key or record.get("files") != _listing(out):
        return None
    rows = [{"status": status} for status in record["statuses"]]
    return Summary(rows, record["runs"], 0)


def keep_finished(out: Path, key: str, summary: Summary) -> None:
    """Say that the folder is finished, unless another attempt may mend a row of it. Raises OSError."""
    statuses = [str(row["status"]) for row in summary.rows]
    if not _COMPUTED_AGAIN & set(statuses):
        record = {"key": key, "runs": summary.found + summary.computed, "statuses": statuses, "files": _listing(out)}
        write_json(out / FILE, record)


def _listing(out: Path) -> str:
    """Hash of names, sizes and times of all files in a folder."""
    digest = hashlib.sha256()
    for folder, folders, files in os.walk(out):
        folders.sort()
        for name in sorted({*files} - _BESIDE):
            path = Path(folder, name)
            status = path.stat()
            digest.update(f"{path.relative_to(out)} {status.st_size} {status.st_mtime_ns}\n".encode())
    return digest.hexdigest()
