"""Every function and method that the packages offer says the type of each argument and of what comes back."""

import importlib
import inspect

import pytest

SURFACE = ("engine", "analysis", "campaigns.study", "reports")


def offered(module) -> dict[str, object]:
    """The public names of a module: those that it lists, else what it defines itself."""
    listed = getattr(module, "__all__", None)
    names = (
        listed
        if listed is not None
        else [n for n, v in vars(module).items() if getattr(v, "__module__", "") == module.__name__]
    )
    return {name: getattr(module, name) for name in names if not name.startswith("_")}


def functions(name: str, item: object) -> dict[str, object]:
    """Name and function of an offered function, or of each public method and the initialiser written in a class."""
    if inspect.isfunction(item):
        return {name: item}
    if not inspect.isclass(item):
        return {}
    found = {}
    for key, value in vars(item).items():
        function = getattr(value, "__func__", getattr(value, "fget", value))
        written_here = (
            inspect.isfunction(function)
            and function.__module__ == item.__module__
            and function.__code__.co_filename != "<string>"
        )
        if written_here and (not key.startswith("_") or key == "__init__"):
            found[f"{name}.{key}"] = function
    return found


def lacking(function) -> list[str]:
    """Arguments without a type, and `return` where it has none."""
    function = inspect.unwrap(function)
    parameters = [name for name in inspect.signature(function).parameters if name not in ("self", "cls")]
    asked = [*parameters, *([] if function.__name__ == "__init__" else ["return"])]
    return [name for name in asked if name not in function.__annotations__]


@pytest.mark.parametrize("module", SURFACE)
def test_every_offered_function_is_typed(module):
    public = offered(importlib.import_module(module))
    found = {key: value for name, item in public.items() for key, value in functions(name, item).items()}
    untyped = {f"{module}.{key}": missing for key, value in found.items() if (missing := lacking(value))}
    assert found and not untyped, "\n".join(f"{key}: {', '.join(missing)}" for key, missing in untyped.items())


def test_what_is_lacking_is_named():
    def half(x, *, of: float = 1.0):
        return x / 2

    assert lacking(half) == ["x", "return"]
