"""Sections of the reports that no run decides, and the equations in them, from `templates/sections.toml`."""

import tomllib
from functools import cache
from importlib.resources import files

from .content import Equation, Heading, Items, Text, with_subscripts


def section_items(name: str, heading: str = "Question", **insertions: str) -> Items:
    """The texts and equations of a section below its heading, "" for none; insertions: what stands in braces there."""
    items = [Heading(heading)] if heading else []
    for template in _sections()["sections"][name]:
        text = template.format(**insertions)
        items.append(equation(text) or Text(with_subscripts(text)))
    return items


def equation(name: str) -> Equation | None:
    """The equation of that name, None where there is none."""
    entry = _sections()["equations"].get(name)
    return entry and Equation(**entry)


@cache
def _sections() -> dict:
    return tomllib.loads(files("reports").joinpath("templates/sections.toml").read_text(encoding="utf-8"))
