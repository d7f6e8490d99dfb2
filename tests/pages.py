"""The blocks of a page that someone would copy: TOML files, Python, commands."""

import re
import shlex
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PAGES = ("tutorial", "howto_tension_law", "howto_waves", "howto_time_series")
COMMAND = ".venv/bin/python -m "


def blocks(name):
    """(kind, text) of every fenced block of docs/NAME.md, in order."""
    text = (ROOT / "docs" / f"{name}.md").read_text(encoding="utf-8")
    return re.findall(r"^```(\w+)\n(.*?)^```$", text, flags=re.DOTALL | re.MULTILINE)


def commands(text):
    """(module, words) of each line of a block of commands."""
    for line in text.strip().splitlines():
        assert line.startswith(COMMAND), line
        module, *words = shlex.split(line.removeprefix(COMMAND))
        yield module, words


def file_of(text):
    """Name under which the page says to save a TOML block, or None for a part of a scene."""
    found = re.match(r"# (\w+\.toml)\n", text)
    return found and found[1]
