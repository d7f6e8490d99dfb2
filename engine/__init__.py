"""Scenes, simulation and trajectories of extensible tethers: the public surface of the engine.

Every name is imported on first use, so that `import engine` costs nothing and building a scene needs neither Numba nor
pandas.
"""

from importlib import import_module

_HOME = {
    "Scene": "engine.scene",
    "SceneError": "engine.scene",
    "load_scene": "engine.scene",
    "Trajectory": "engine.trajectory",
    "simulate": "engine.simulate",
    "simulate_batch": "engine.simulate",
    "source_hash": "engine.compiled",
}

__all__ = ["Scene", "SceneError", "Trajectory", "load_scene", "simulate", "simulate_batch", "source_hash"]


def __getattr__(name: str) -> object:
    if name not in _HOME:
        raise AttributeError(f"module 'engine' has no attribute {name!r}")
    if _HOME[name] == f"engine.{name}":
        # `engine.simulate` is a module and a function: importing the module binds the name to the module, so put the
        # function in its place before anybody can see the difference.
        function = getattr(import_module(_HOME[name]), name)
        globals()[name] = function
        return function
    return getattr(import_module(_HOME[name]), name)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
