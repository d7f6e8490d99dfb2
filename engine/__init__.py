"""Scenes, simulation and trajectories of extensible tethers: the public surface of the engine.

Every name is imported on first use, so that `import engine` costs nothing and building a scene needs neither Numba nor
pandas.
"""

import sys
from importlib import import_module
from types import ModuleType

if sys.version_info < (3, 11):  # noqa: UP036
    running = ".".join(map(str, sys.version_info[:3]))
    raise ImportError(
        f"the tether workbench needs Python 3.11 or newer, and this is {running} ({sys.executable}); "
        "make its environment with a newer one, for instance python3.12 -m venv .venv"
    )

_HOME = {
    "Scene": "engine.scene",
    "SceneError": "engine.scene",
    "Trajectory": "engine.trajectory",
    "goes_in_lanes": "engine.simd.cover",
    "load_scene": "engine.scene",
    "simulate": "engine.simulate",
    "simulate_batch": "engine.simulate",
    "simulate_each": "engine.simulate",
    "source_hash": "engine.compiled",
}

__all__ = list(_HOME)


class _Package(ModuleType):
    """`engine.simulate` is the function, also after something has imported the module of the same name."""

    def __setattr__(self, name: str, value: object) -> None:
        if name == "simulate" and isinstance(value, ModuleType):
            value = value.simulate
        super().__setattr__(name, value)


sys.modules[__name__].__class__ = _Package


def __getattr__(name: str) -> object:
    if name not in _HOME:
        raise AttributeError(f"module 'engine' has no attribute {name!r}")
    return getattr(import_module(_HOME[name]), name)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
