"""Sections of the reports that no run decides, and the equations in them, from `templates/sections.toml`."""

import tomllib
from functools import cache
from importlib.resources import files

from .content import Equation, Heading, Item, Text, with_subscripts


def section_items(name: str, heading: str = "Equations", **taken: str) -> list[Item]:
    """The texts and equations of a section below its heading, "" for none; taken: what stands in braces there."""
    texts = (text.format(**taken) for text in _told()["sections"][name])
    found = (equation(text) or Text(with_subscripts(text)) for text in texts)
    return [Heading(heading), *found] if heading else [*found]


def equation(name: str) -> Equation | None:
    """The equation of that name, None where there is none."""
    entry = _told()["equations"].get(name)
    return entry and Equation(**entry)


@cache
def _told() -> dict:
    return tomllib.loads(files("reports").joinpath("templates/sections.toml").read_text(encoding="utf-8"))
