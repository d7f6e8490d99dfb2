"""Equations of the reports, and the sections that say how they belong together, from `templates/equations.toml`."""

import tomllib
from functools import cache
from importlib.resources import files

from .content import Equation, Heading, Item, Text, with_subscripts


def equation_items(section: str, heading: str = "Equations", **taken: str) -> list[Item]:
    """A section of equations and the words between them; taken: what stands in braces there."""
    said = (one.format(**taken) for one in _told()["sections"][section])
    found = (equation(one) or Text(with_subscripts(one)) for one in said)
    return [Heading(heading), *found] if heading else [*found]


def equation(name: str) -> Equation | None:
    """The equation of that name, None where there is none."""
    told = _told()["equations"].get(name)
    return told and Equation(**told)


@cache
def _told() -> dict:
    return tomllib.loads(files("reports").joinpath("templates/equations.toml").read_text(encoding="utf-8"))
