"""Scenes: what is simulated. `load` reads them, `models` declares every key, `rules` compares keys with each other.

Names are imported on first use: `engine.physics.tension` declares keys too, with the types of `values`.
"""

import lazy_loader

_NAMES = [
    "Scene", "SceneError", "build_scene", "list_scenes", "load_scene", "parse_assignment",
    "scene_from_toml",
]  # fmt: skip
__getattr__, __dir__, __all__ = lazy_loader.attach(__name__, submod_attrs={"load": _NAMES})
