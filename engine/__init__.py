"""Scenes, simulation and trajectories of extensible tethers: the public surface of the engine.

Every name is imported on first use, so that `import engine` costs nothing and building a scene needs neither Numba nor
pandas.
"""

import machine_code  # noqa: F401, I001  first: an older Python does not get through lazy_loader
import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach(
    __name__,
    submod_attrs={
        "compiled": ["source_hash"],
        "trajectory.final_state": ["FinalState"],
        "run.going_on": ["between"],
        "massless": ["MasslessRuns", "massless_covers", "massless_rest", "massless_runs"],
        "run.pieces": ["compile_piece", "shares_of"],
        "scene": ["Scene", "SceneError", "list_scenes", "load_scene"],
        "parameters.cover": ["goes_in_lanes"],
        "run.simulation": ["simulate", "simulate_batch", "simulate_each"],
        "trajectory": ["Trajectory"],
    },
)
