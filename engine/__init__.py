"""Scenes, simulation and trajectories of extensible tethers: the public surface of the engine.

Every name is imported on first use, so that `import engine` costs nothing and building a scene needs neither Numba nor
pandas.
"""

import sys

if sys.version_info < (3, 11):  # noqa: UP036
    running = ".".join(map(str, sys.version_info[:3]))
    raise ImportError(
        f"the tether workbench needs Python 3.11 or newer, and this is {running} ({sys.executable}); "
        "make its environment with a newer one, for instance python3.12 -m venv .venv"
    )

import lazy_loader  # not above: an older Python does not get through it

__getattr__, __dir__, __all__ = lazy_loader.attach(
    __name__,
    submod_attrs={
        "compiled": ["source_hash"],
        "scene": ["Scene", "SceneError", "load_scene"],
        "simd.cover": ["goes_in_lanes"],
        "simulation": ["simulate", "simulate_batch", "simulate_each"],
        "trajectory": ["Trajectory"],
    },
)
