"""Finished results of a campaign, kept by key: each is a record of numbers, words and lists in a sealed file.

The key is made of everything that a result depends on, so a result is never out of date. A file appears whole or not at
all (`engine.atomic`), so finished results survive a kill at any moment. A damaged file is reported in a line, and its
result is computed again.
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

    folder: None for a worker that does not see the folder of its campaign. Its results stay in `unsaved`, and the
    campaign saves them with `add` when the worker has sent them. suffix: of the names of the files.
    """

    def __init__(self, folder: Path | None, suffix: str = ".json"):
        self.folder = folder
        self.suffix = suffix
        self.unsaved: dict[str, Result] = {}

    def path(self, key: str) -> Path:
        """The file of the result with this key."""
        return self.folder / f"{key}{self.suffix}"

    def get(self, key: str) -> Result | None:
        """The result with this key; None where it is not finished, or its file is damaged."""
        if self.folder is None:
            return self.unsaved.get(key)
        path = self.path(key)
        if not path.exists():
            return None
        result = kept_json(path)
        if not result:
            print_line(f"{path}: damaged; it is computed again")
            return None
        return result

    def put(self, key: str, result: Result) -> None:
        """Save a result. If the disk is full it is not saved, and a later command computes it again."""
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
        """The result with this key; if it is not finished, compute it now and save it."""
        result = self.get(key)
        if result is None:
            # Through JSON and back, so that a new result has the same types as one that is read from its file.
            result = json.loads(json.dumps(compute(), default=plain))
            self.put(key, result)
        return result


def orbits_in(folder: Path | None) -> Store:
    """The store of the orbits under the runs of a campaign (`campaigns.explore.multipliers`), beside their
    trajectories. folder: of the campaign; None: as of `Store`."""
    if folder is not None:
        folder = folder / "trajectories"
    return Store(folder, ".orbit.json")


def plain(content: object) -> object:
    """A value as JSON can write it: an array as a list, a complex number as two numbers, a NumPy number as Python's."""
    if isinstance(content, complex):
        return [content.real, content.imag]
    return content.tolist()


def key_of(*parts: object) -> str:
    """A hash of these parts as a key: plain values, arrays, and objects with a method `digest`."""
    content = hashlib.sha256()
    for part in parts:
        if hasattr(part, "digest"):
            part = part.digest()
        if hasattr(part, "tobytes"):
            part = (part.shape, part.tobytes())
        content.update(f"{part!r}\0".encode())
    return content.hexdigest()
