"""Finished results: a key -> numbers, words and lists, a sealed file each, written once.

The key says everything that a result depends on, so a result is never out of date. A file appears whole or not at all
(`engine.atomic`), so a kill at any moment leaves the results that are finished. A damaged file is told in a line, and
counts as none.
"""

import contextlib
import hashlib
import json
from collections.abc import Callable, Mapping
from pathlib import Path

from campaigns.machinery.folder import keep_json, kept_json
from campaigns.machinery.progress import print_line

Result = dict[str, object]


class Store:
    """The results in a folder.

    folder: None for a worker that does not see the folder of its campaign. Its results stay in `unsaved`; the campaign
    saves them when they arrive (`add`). suffix: of the files.
    """

    def __init__(self, folder: Path | None, suffix: str = ".json"):
        self.folder = folder
        self.suffix = suffix
        self.unsaved: dict[str, Result] = {}

    def path(self, key: str) -> Path:
        """The file of a result."""
        return self.folder / f"{key}{self.suffix}"

    def get(self, key: str) -> Result | None:
        """The result with this key; None where there is none, or a damaged one."""
        if self.folder is None:
            return self.unsaved.get(key)
        path = self.path(key)
        if not path.exists():
            return None
        result = kept_json(path)
        if not result:
            print_line(f"{path}: damaged; made again")
            return None
        return result

    def put(self, key: str, result: Result) -> None:
        """Save a result. A full disk loses only the time to compute it again."""
        if self.folder is None:
            self.unsaved[key] = result
            return
        with contextlib.suppress(OSError):
            self.folder.mkdir(exist_ok=True)
            keep_json(self.path(key), result)

    def add(self, results: Mapping[str, Result]) -> None:
        """Save results that a worker has sent."""
        for key, result in results.items():
            self.put(key, result)

    def finished(self, key: str, compute: Callable) -> Result:
        """The result with this key, computed now where it is not there."""
        result = self.get(key)
        if result is None:
            # as a file holds it, so that a new result and one that is read are the same
            result = json.loads(json.dumps(compute(), default=plain))
            self.put(key, result)
        return result


def orbits_in(folder: Path | None) -> Store:
    """The orbits under the runs of a campaign (`campaigns.explore.multipliers`), beside their trajectories."""
    if folder is not None:
        folder = folder / "trajectories"
    return Store(folder, ".orbit.json")


def plain(content: object) -> object:
    """What JSON writes for an array (a list), a complex number (two numbers) and a number of NumPy."""
    if isinstance(content, complex):
        return [content.real, content.imag]
    return content.tolist()


def key_of(*parts: object) -> str:
    """A content key of plain values, arrays, and objects with a `digest`."""
    content = hashlib.sha256()
    for part in parts:
        if hasattr(part, "digest"):
            part = part.digest()
        if hasattr(part, "tobytes"):
            part = (part.shape, part.tobytes())
        content.update(f"{part!r}\0".encode())
    return content.hexdigest()
