"""Names of a package that are imported when they are first used."""

import sys
from collections.abc import Callable
from importlib import import_module


def on_first_use(package: str, home: dict[str, str]) -> tuple[Callable, Callable]:
    """(__getattr__, __dir__) for a package whose public names live in its modules.

    package: its full name; home: name -> the module of the package that defines it. No module may bear the name of a
    function: importing it would bind its own name in the package and hide the function. A name that is not there raises
    AttributeError, as everywhere.
    """
    namespace = vars(sys.modules[package])

    def find(name: str) -> object:
        if name not in home:
            raise AttributeError(f"module {package!r} has no attribute {name!r}")
        value = getattr(import_module(f"{package}.{home[name]}"), name)
        namespace[name] = value
        return value

    def names() -> list[str]:
        return sorted({*namespace, *home})

    return find, names
