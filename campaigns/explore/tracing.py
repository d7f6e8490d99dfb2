"""Scenes along a key, and tasks on their orbits (`campaigns.explore.orbit_tasks`)."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from pathlib import Path

import numpy as np

import engine
from campaigns.explore.grid import Varied
from campaigns.explore.multipliers import TOLERANCE, cable_map
from campaigns.machinery.folder import made_by
from campaigns.machinery.plan import Plan
from campaigns.machinery.store import Store, key_of
from campaigns.machinery.tasks import Task, results
from engine.scene import SceneError, scene_from_toml

_FILES = (f"campaigns/explore/{name}.py" for name in ("tracing", "orbit_tasks", "multipliers"))
SOURCES = "analysis/orbits", "analysis/sampling.py", *_FILES


@dataclass(frozen=True)
class Scenes:
    """The scenes along one key. toml: of any of them."""

    toml: str
    key: Varied

    def __call__(self, value: float, changes: dict | None = None):
        """The scene at a value, with further changes; None where there is none, as between two whole numbers."""
        changes = dict(changes or {})
        if any(self.key.put(value, self.base, changes)):
            return None
        try:
            return scene_from_toml(self.toml, changes)
        except SceneError:
            return None

    @cached_property
    def base(self):
        """The scene of the text."""
        return scene_from_toml(self.toml)


@dataclass(frozen=True, eq=False)
class Line:
    """Scenes with the coordinates of their orbits, taken from a state of a run at a value.

    low, high: range in which orbits are followed; size: the change of the key that counts as 1 m of the motion; nodes:
    of another grid, 0 for that of the scenes; rtol: tolerance of the orbits, at most.
    """

    scenes: Scenes
    low: float
    high: float
    size: float
    state: object
    value: float
    nodes: int = 0
    rtol: float = TOLERANCE

    def scene(self, value: float):
        """The scene at a value, as its orbits are computed. Raises ArithmeticError where there is none."""
        base = self.scenes.base
        changes = {"solver.rtol": min(self.rtol, base.solver.rtol), "tether.nodes": self.nodes or base.tether.nodes}
        scene = self.scenes(value, changes)
        if scene is None:
            raise ArithmeticError(f"no scene can have {self.scenes.key.key} = {value:.4g}")
        return scene

    @cached_property
    def maps(self):
        """PeriodMap and OrbitMap."""
        return cable_map(self.scene, self.state, self.value, self.size)

    def digest(self) -> str:
        """Of all that results depend on beside their own task."""
        numbers = self.low, self.high, self.size, self.value, self.nodes, self.rtol
        sources = made_by({}, *SOURCES), engine.source_hash()
        return key_of(self.scenes.toml, self.scenes.key.key, self.state, *numbers, *sources)


def line_task(do: Callable, line: Line, arguments: tuple) -> Task:
    """The task do(line, *arguments) -> (result, points). arguments: numbers, words, arrays, states."""
    return Task(key_of(do.__name__, line, *arguments), partial(_computed, do, line, arguments))


def _computed(do: Callable, line: Line, arguments: tuple) -> dict:
    """The result of a task and its points; where the orbits of a line fail, the result is the reason."""
    try:
        result, points = do(line, *arguments)
    except (ArithmeticError, ValueError) as why:
        result, points = {"reason": str(why)}, []
    return {"result": result, "points": points}


def work(plan: Plan, folder: Path, title: str, tasks: Sequence[Task]) -> tuple[list[tuple[dict, list]], int]:
    """Results of tasks with their points, in their order, and how many of them were there before.

    Raises CampaignStopped as `campaigns.machinery.tasks.results`.
    """
    finished = results(plan.how, Store(folder), title, tasks)
    pairs = []
    for result in finished.results:
        pairs.append((result["result"], [np.array(points) for points in result["points"]]))
    return pairs, finished.reused
