"""Folders of laws, one file a law: a new file is a new value of the key that names the law.

The number by which a parameter record (`engine.record`) names a law is its place among the laws of its folder.
"""

from functools import reduce
from importlib import import_module
from operator import or_
from pkgutil import iter_modules
from typing import Annotated, get_args

from pydantic import Field


def laws_in(package, path):
    """(the laws of a folder, a module each; their names; the type of the scene's table), from its `__name__` and
    `__path__`."""
    files = [entry.name for entry in iter_modules(path) if entry.name != "kernels"]
    laws = tuple(import_module(f"{package}.{file}") for file in files)
    names = [get_args(law.Model.model_fields["law"].annotation)[0] for law in laws]
    table = reduce(or_, (law.Model for law in laws))
    if len(laws) > 1:
        table = Annotated[table, Field(discriminator="law")]
    return laws, names, table
