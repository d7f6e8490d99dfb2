"""A campaign that is finished and asked for again: the same order, the same code, and the folder as it was left.

Its answer is then printed as it stands. Runs, rows and report are not looked at, so that whoever only looks does not
wait for what is there.
"""

import hashlib
import json
from collections.abc import Mapping
from pathlib import Path

from campaigns.machinery.folder import made_by, of_the_page, read_json, write_json
from campaigns.machinery.plan import Summary

FILE = "finished.json"
_BESIDE = (FILE, ".lock")  # files of the folder that say nothing of its results
_PACKAGES = "machine_code", "tables", "engine", "analysis", "campaigns", "reports"
_COMPUTED_AGAIN = {"error", "worker-died", "analysis-failed", "lost"}  # statuses of rows that another attempt may mend


def order_key(order, parameters: Mapping[str, object], versions: Mapping[str, str | None]) -> str:
    """Hash of everything that a finished folder depends on: the order, all code, and the versions of libraries."""
    content = {
        "parameters": dict(parameters),
        "runs": [job.key for job in order.cases],
        "code": made_by({}, *_PACKAGES, *of_the_page()),
        "versions": dict(versions),
        "report": order.how.report,
    }
    return hashlib.sha256(json.dumps(content, sort_keys=True, default=str).encode()).hexdigest()


def finished(out: Path, key: str) -> Summary | None:
    """The summary of the finished campaign in a folder; None where it is another one, or the folder has changed.

    Its rows have their status only.
    """
    record = read_json(out / FILE)
    if not isinstance(record, dict) or record.get("key") != key or record.get("files") != _listing(out):
        return None
    rows = [{"status": status} for status in record["statuses"]]
    return Summary(rows, record["runs"], 0, 0.0)


def keep_finished(out: Path, key: str, summary: Summary) -> None:
    """Say that the folder is finished, unless another attempt may mend a row of it. Raises OSError."""
    statuses = [str(row["status"]) for row in summary.rows]
    if not _COMPUTED_AGAIN & set(statuses):
        record = {"key": key, "runs": summary.found + summary.computed, "statuses": statuses, "files": _listing(out)}
        write_json(out / FILE, record)


def _listing(out: Path) -> str:
    """Hash of names, sizes and times of all files in a folder."""
    digest = hashlib.sha256()
    for path in sorted(out.rglob("*")):
        if path.is_file() and path.name not in _BESIDE:
            status = path.stat()
            digest.update(f"{path.relative_to(out)} {status.st_size} {status.st_mtime_ns}\n".encode())
    return digest.hexdigest()
