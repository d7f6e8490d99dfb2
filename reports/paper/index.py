"""Where each numbered equation and each figure of the paper is in the code, as the modules' docstrings say it.

A docstring names what it holds in one paragraph, "In the paper: eq. (7) strain; eq. (8) velocity.", and is the only
place that does so. `python -m reports.paper.index` prints the tables of NOTATION.md.
"""

import ast
import re
from functools import cache
from pathlib import Path

from ..parts import Heading, Items, Table, Text, heads

ROOT = Path(__file__).resolve().parents[2]
PACKAGES = ("engine", "analysis", "reports")
_PARAGRAPH = re.compile(r"^In the paper: (.+?)\.?\s*(?:\n\s*\n|\Z)", re.DOTALL | re.MULTILINE)
_ENTRY = re.compile(r"(eq\.|fig\.) \(?(\d+)\)? (.+)")
CAPTIONS = {
    "fig.": "The paper's figures and what draws them; fig. 1 (segment of the line) and fig. 8 (buoy in waves) are "
    "sketches. Data: `figures/`.",
    "eq.": "The paper's equations and where they are in the code.",
}
HEADS = {"eq.": ("equation", "what", "code"), "fig.": ("figure", "what", "drawn by")}


@cache
def entries() -> dict[tuple[str, int], tuple[str, list[str]]]:
    """("eq." or "fig.", number) -> what it is, and the files that say they hold it; the paper's own form comes last."""
    places = {}
    paths = []
    for package in PACKAGES:
        paths += (ROOT / package).rglob("*.py")
    for path in sorted(paths, key=lambda path: ("paper_box" in path.parts, path.as_posix())):
        for kind, number, title in named_in(path.read_text(encoding="utf-8")):
            _, files = places.setdefault((kind, number), (title, []))
            files.append(path.relative_to(ROOT).as_posix())
    return dict(sorted(places.items()))


def named_in(source: str) -> list[tuple[str, int, str]]:
    """(kind, number, what) of the equations and figures that the docstring of a module names. ValueError for others."""
    if "\nIn the paper: " not in source:
        return []
    paragraph = _PARAGRAPH.search(ast.get_docstring(ast.parse(source)) or "")
    if paragraph is None:
        return []
    rows = []
    for entry in " ".join(paragraph[1].split()).split("; "):
        part = _ENTRY.fullmatch(entry)
        if part is None:
            raise ValueError(f"{entry!r} in a docstring is neither eq. (N) nor fig. N with what it is")
        rows.append((part[1], int(part[2]), part[3]))
    return rows


def rows_of(kind: str) -> list[tuple[str, str, str]]:
    """(as written in the sources, what, files) of all equations or figures."""
    form = {"eq.": "eq. ({})", "fig.": "fig. {}"}[kind]
    rows = []
    for (entry_kind, number), (title, files) in entries().items():
        if entry_kind == kind:
            rows.append((form.format(number), title, ", ".join(f"`{path}`" for path in files)))
    return rows


def markdown(kind: str) -> str:
    """The table of NOTATION.md."""
    lines = [HEADS[kind], ("---",) * 3, *rows_of(kind)]
    return "\n".join(f"| {' | '.join(cells)} |" for cells in lines)


def index_items() -> Items:
    """The section."""
    text = "To find an equation or a figure in the sources search for it as written here; NOTATION.md has the list too."
    items = [Heading("Where to find what"), Text(text)]
    for kind, caption in CAPTIONS.items():
        items.append(Table(heads(*HEADS[kind]), rows_of(kind), caption))
    return items


if __name__ == "__main__":
    print(markdown("eq."), markdown("fig."), sep="\n\n")
