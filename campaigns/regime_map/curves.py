"""The curves of a folder of `campaigns.orbits --curves`, taken over into the folder of a map over the same two keys."""

import os
import shutil
from collections.abc import Iterator
from pathlib import Path

from campaigns.machinery import Plan
from campaigns.regime_map.cells import CellGrid
from tables import Row, read_columns

FOLDER = "curves"
FILES = "columns.csv", "table.csv"
NOT_OF_AN_ORBIT = {"name", "title", "motion", "start", "solver", "output"}  # parts of a scene


def folder_of_curves(text: str) -> str:
    """The name of a folder that has curves. Raises ValueError without them."""
    if not os.path.isfile(Path(text) / FOLDER / FILES[1]):  # pathlib raises where a name is too long
        raise ValueError(text)
    return text


def faults(folder: str, grid: CellGrid, place: Row, scene) -> Iterator[str]:
    """Why the curves of a folder cannot be drawn on a map. scene: that of the map at a place."""
    from engine.scene import SceneError, scene_from_toml

    given = f"--curves {folder}"
    try:
        columns = [*read_columns(Path(folder) / FOLDER / FILES[0])]
        first_error = columns.index("error_1")  # behind the columns of both keys
        text = (Path(folder) / "scene.toml").read_text()
        (Path(folder) / FOLDER / FILES[1]).read_text()
    except (OSError, ValueError) as why:
        yield f"{given}: {why}; allowed: a folder of campaigns.orbits --curves"
        return
    keys, axes = columns[first_error - 2 : first_error], [key.key for key in grid.axes]
    if set(keys) != set(axes):
        yield f"{given}: has curves over {' and '.join(keys)}; allowed: over {' and '.join(axes)}, the keys of the map"
        return
    try:
        changes, _ = grid.changes(place, scene)
        own = scene_from_toml(text, changes).as_dict()
    except SceneError as error:
        yield f"{given}: its scene.toml: {error}"
        return
    of_map = scene.as_dict()
    parts = [part for part in of_map | own if part not in NOT_OF_AN_ORBIT]
    differing = [part for part in parts if own.get(part) != of_map.get(part)]
    if differing:
        yield f"{given}: has curves of another scene, with another {', '.join(differing)}; allowed: of that of the map"


def take_over(folder: str | None, plan: Plan) -> None:
    """Copy the curves into the folder of the map, where its report finds them. Raises OSError."""
    from campaigns.explore.motions import subfolder

    if folder is None:
        shutil.rmtree(plan.out / FOLDER, ignore_errors=True)
        return
    for name in FILES:
        shutil.copyfile(Path(folder) / FOLDER / name, subfolder(plan, FOLDER) / name)
