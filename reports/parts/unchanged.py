"""Whether a report is still the one that its folder gives: a key of all that it was drawn from, kept beside it.

The key takes in every file of the folder but the drawings themselves (the text of tables and other small files; name,
size and time of the rest), the sources of reports, analysis and engine, and the versions of the libraries that draw.
"""

import json
from collections.abc import Iterable
from hashlib import sha256
from importlib import metadata
from pathlib import Path

from machine_code.store import hash_of

FILE = ".report.json"
_READ = (".csv", ".json", ".toml", ".txt")  # told by what they say
_SOURCES = ("reports", "analysis", "engine", "tables")
_DRAWING = (".py", ".js", ".css", ".typ", ".toml", ".jinja", ".mplstyle")
_LIBRARIES = ("numpy", "matplotlib", "jinja2", "typst", "pillow")


def is_unchanged(directory: Path) -> bool:
    """Whether every file of the last drawing is there, and what it was drawn from is the same."""
    try:
        drawing_record = json.loads((directory / FILE).read_text(encoding="utf-8"))
        files = drawing_record["files"]
        for name, size in files.items():
            if (directory / name).stat().st_size != size:
                return False
        return drawing_record["key"] == key_of(directory, files)
    except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
        return False


def record(directory: Path, pages: dict[Path, bytes]) -> bytes:
    """What is to be kept in FILE of a drawing that has just been written. pages: path -> content."""
    files = {str(path.relative_to(directory)): len(content) for path, content in pages.items()}
    return json.dumps({"key": key_of(directory, files), "files": files}, indent=1).encode()


def key_of(directory: Path, without: Iterable[str]) -> str:
    """The key; without: names of drawings in the folder."""
    left_out = {FILE, *without}
    versions = [f"{name} {metadata.version(name)}" for name in _LIBRARIES]
    digest = sha256(" ".join(versions).encode())
    root = Path(__file__).parents[2]
    sources = [root / name for name in _SOURCES]
    digest.update(hash_of(*sources, endings=_DRAWING).encode())
    for path in sorted(directory.rglob("*")):
        name = str(path.relative_to(directory))
        if name in left_out or path.name == ".lock" or not path.is_file():
            continue
        state = path.stat()
        digest.update(f"{name} {state.st_size} ".encode())
        if path.suffix in _READ:
            digest.update(path.read_bytes())
        else:
            digest.update(str(state.st_mtime_ns).encode())
    return digest.hexdigest()
