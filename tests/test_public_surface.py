"""Every function and method that the packages offer says the type of each argument and of what comes back."""

import importlib
import inspect

import pytest

SURFACE = ("engine", "analysis", "campaigns.study", "reports")


def offered(module: object, listed: list[str] | None = None) -> dict[str, object]:
    """Functions of a module, and public methods written in its classes; those listed, else what it defines itself."""
    functions = {}
    for name in listed if listed is not None else [name for name in vars(module) if not name.startswith("_")]:
        item = getattr(module, name)
        item = getattr(item, "fget", getattr(item, "__func__", item))
        if listed is None and getattr(item, "__module__", "") != getattr(module, "__module__", module.__name__):
            continue
        if inspect.isclass(item):
            functions |= {f"{name}.{key}": value for key, value in offered(item).items()}
        elif inspect.isfunction(item):
            functions[name] = inspect.unwrap(item)
    return functions


def lacking(function) -> list[str]:
    """Arguments without a type, and `return` where it has none."""
    requested = [name for name in inspect.signature(function).parameters if name not in ("self", "cls")]
    return [name for name in [*requested, "return"] if name not in function.__annotations__]


@pytest.mark.parametrize("name", SURFACE)
def test_every_offered_function_is_typed(name):
    module = importlib.import_module(name)
    functions = offered(module, getattr(module, "__all__", None))
    untyped = [f"{key}: {', '.join(lacking(function))}" for key, function in functions.items() if lacking(function)]
    assert functions and not untyped, "\n".join(untyped)
