"""The blocks of a page that someone would copy: TOML files, Python, commands, and what they print."""

import json
import re
import shlex
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
# pages of docs/ with a block of Python: all their blocks are run, in order
PAGES = sorted(path.stem for path in (ROOT / "docs").glob("*.md") if "```python" in path.read_text(encoding="utf-8"))
PAGES += ["../README"]
COMMAND = ".venv/bin/python -m "
NUMBER = r"-?\d+(?:\.\d+)?(?:e-?\d+)?"


def blocks(name: str) -> list[tuple[str, str]]:
    """(kind, text) of every fenced block of docs/NAME.md, in order.

    A block of the kind "text" is what the block of Python before it prints; "output" is what a script prints.
    """
    text = (ROOT / "docs" / f"{name}.md").read_text(encoding="utf-8")
    return re.findall(r"^```(\w+)\n(.*?)^```$", text, flags=re.DOTALL | re.MULTILINE)


def cells(name: str) -> Iterator[tuple[str, str]]:
    """(source, text of what it printed or shows as HTML) of every cell of code of docs/NAME.ipynb."""
    notebook = json.loads((ROOT / "docs" / f"{name}.ipynb").read_text(encoding="utf-8"))
    for cell in notebook["cells"]:
        if cell["cell_type"] == "code":
            shown = (output.get("text") or output["data"].get("text/html", []) for output in cell["outputs"])
            yield "".join(cell["source"]), "".join("".join(lines) for lines in shown)


def commands(text: str) -> Iterator[tuple[str, list[str]]]:
    """(module, words) of each line of a block of commands."""
    for line in text.strip().splitlines():
        assert line.startswith(COMMAND), line
        module, *words = shlex.split(line.removeprefix(COMMAND))
        yield module, words


def file_of(text: str) -> str | None:
    """Name under which the page says to save a TOML block, or None for a part of a scene."""
    match = re.match(r"# (\w+\.toml)\n", text)
    return match and match[1]


def without_numbers(text: str) -> list[str]:
    """The words of a text, # for each number in it."""
    return re.sub(NUMBER, "#", text).split()


def compare(printed: str, shown: str) -> None:
    """Words are the same exactly, numbers to two units of the last digit (another machine rounds otherwise)."""
    assert without_numbers(printed) == without_numbers(shown)
    for computed, stated in zip(re.findall(NUMBER, printed), re.findall(NUMBER, shown), strict=True):
        if "e" not in stated:
            assert float(computed) == pytest.approx(float(stated), abs=2.01 * 10.0 ** -len(stated.partition(".")[2]))


def assert_complete(folder: Path) -> None:
    """The folder of a campaign has its tables, where they are from, and its report as a page and as a PDF."""
    for name in ("table.csv", "columns.csv", "provenance.json", "report.html", "report.pdf"):
        assert (folder / name).stat().st_size
    assert (folder / "report.pdf").read_bytes().startswith(b"%PDF")
