"""Scenes: what is simulated. `load` reads them, `models` declares every key, `rules` compares keys with each other."""

from .load import Scene, SceneError, build_scene, known_scenes, load_scene, parse_assignment, scene_from_toml

__all__ = ["Scene", "SceneError", "build_scene", "known_scenes", "load_scene", "parse_assignment", "scene_from_toml"]
