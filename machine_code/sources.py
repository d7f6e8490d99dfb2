"""A hash of sources that only a change of what they say moves: comments, docstrings and layout do not count.

Runs, rows, reports and machine code are kept under such hashes. A better sentence in a docstring leaves them in use.
"""

import ast
import contextlib
import os
import tomllib
from collections.abc import Mapping
from hashlib import sha256
from pathlib import Path

DIGITS = 64  # of sha256, hexadecimal
_DOCUMENTED = ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef


def sources_of(root: Path, *endings: str) -> dict[str, Path]:
    """Name relative to a folder -> path of its files with these endings (".py"), in all its folders."""
    paths = sorted(path for ending in endings for path in root.rglob(f"*{ending}"))
    return {path.relative_to(root).as_posix(): path for path in paths}


def code_hash(sources: Mapping[str, Path], folder: Path | None = None) -> str:
    """sha256, hexadecimal, over the names of files and what they say; of one that is not .py or .toml, over its bytes.

    folder: where the hash is kept under that of the files' bytes, because to parse all sources takes longer than to
    load the machine code made of them; None: nowhere.
    Raises OSError for a file that cannot be read, SyntaxError or ValueError for one that is no Python or TOML.
    """
    contents = {name: path.read_bytes() for name, path in sources.items()}
    exact = _digest(contents)
    with contextlib.suppress(OSError, UnicodeDecodeError):
        known = "" if folder is None else (folder / exact).read_text("ascii")
        if len(known) == DIGITS:
            return known
    code_digest = _digest({name: meaning_of(name, content) for name, content in contents.items()})
    if folder is not None:
        part = folder / f"{exact}.{os.getpid()}"
        with contextlib.suppress(OSError):
            part.write_text(code_digest, "ascii")
            part.replace(folder / exact)
    return code_digest


def meaning_of(name: str, content: bytes) -> bytes:
    """The content of a file without what only a reader needs; name: says by its ending how it is read."""
    if name.endswith(".py"):
        return code_of(content)
    if name.endswith(".toml"):
        return repr(tomllib.loads(content.decode("utf-8"))).encode("utf-8")
    return content


def code_of(source: str | bytes) -> bytes:
    """The syntax tree of a Python source without docstrings, as bytes. Entries that are empty are left out, because
    versions of Python differ in which of them exist."""
    words: list[str] = []
    _write(ast.parse(source), words)
    return "\n".join(words).encode("utf-8", "surrogatepass")


def _write(node: ast.AST, words: list[str]) -> None:
    """Append a node of a syntax tree and all below it, in order."""
    words.append(type(node).__name__)
    for name in node._fields:
        value = getattr(node, name, None)
        if value is None or value == [] or name in ("kind", "ctx"):  # kind: of u"..."; ctx: follows from the place
            continue
        entries = value if isinstance(value, list) else [value]
        if name == "body" and isinstance(node, _DOCUMENTED) and _is_docstring(entries[0]):
            entries = entries[1:]
        words.append(f"{name} {len(entries)}")
        for entry in entries:
            if isinstance(entry, ast.AST):
                _write(entry, words)
            else:
                words.append(repr(entry))


def _is_docstring(statement: ast.stmt) -> bool:
    return (
        isinstance(statement, ast.Expr)
        and isinstance(statement.value, ast.Constant)
        and isinstance(statement.value.value, str)
    )


def _digest(contents: Mapping[str, bytes]) -> str:
    digest = sha256()
    for name, content in contents.items():
        digest.update(f"{name}\0{len(content)}\0".encode() + content)
    return digest.hexdigest()
