"""Scenes along a key, and what workers do with their orbits (`campaigns.explore.orbit_tasks`).

Each is one task with a result of plain numbers, words and arrays, kept in a file of the folder under a key of all that
it depends on: a campaign that was killed goes on behind the last one.
"""

import hashlib
import io
import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property, partial, reduce
from pathlib import Path

import numpy as np

import engine
from campaigns.explore.multipliers import TOLERANCE, cable_map
from campaigns.machinery.folder import CampaignStopped, made_by
from campaigns.machinery.plan import Plan
from campaigns.machinery.pools import PoolBroken, opened
from campaigns.machinery.progress import stage
from engine.atomic import write_atomic
from engine.scene import SceneError, scene_from_toml

_OWN = (f"campaigns/explore/{name}.py" for name in ("tracing", "orbit_tasks", "multipliers"))
SOURCES = "analysis/orbits", "analysis/sampling.py", *_OWN


@dataclass(frozen=True)
class Scenes:
    """The scenes along one key. toml: of any of them; key, name, index: as of `campaigns.sweep.Varied`."""

    toml: str
    key: str
    name: str
    index: int | None = None

    def at(self, value: float, more: dict | None = None):
        """The scene at a value, with more changes. Raises SceneError."""
        put: object = value
        if self.index is not None:
            whole = [*reduce(getattr, self.name.split("."), self.base)]
            put = [*whole[: self.index], value, *whole[self.index + 1 :]]
        return scene_from_toml(self.toml, {self.name: put, **(more or {})})

    def __call__(self, value: float):
        """The scene at a value; None where there is none, as between two whole numbers."""
        try:
            return self.at(value)
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
        more: dict[str, object] = {"solver.rtol": min(self.rtol, self.scenes.base.solver.rtol)}
        try:
            return self.scenes.at(value, more | ({"tether.nodes": self.nodes} if self.nodes else {}))
        except SceneError:
            raise ArithmeticError(f"no scene can have {self.scenes.key} = {value:.4g}") from None

    @cached_property
    def maps(self):
        """PeriodMap and OrbitMap."""
        return cable_map(self.scene, self.state, self.value, self.size)

    def digest(self) -> str:
        """Of all that results depend on beside their own task."""
        made = self.state.digest(), made_by({}, *SOURCES), engine.source_hash()
        parts = self.scenes, self.low, self.high, self.size, self.value, self.nodes, self.rtol, *made
        return hashlib.sha256(repr(parts).encode()).hexdigest()


@dataclass(frozen=True, eq=False)
class Task:
    """do(line, *given) -> (result, points): what is asked for of a line. given: numbers, words, arrays, states."""

    do: Callable
    line: Line
    given: tuple

    @cached_property
    def key(self) -> str:
        """Content key."""
        said = hashlib.sha256(f"{self.do.__name__} {self.line.digest()}".encode())
        for part in self.given:
            digest = part.digest() if hasattr(part, "digest") else None
            said.update(part.tobytes() if isinstance(part, np.ndarray) else repr(digest or part).encode())
        return said.hexdigest()


def work(plan: Plan, folder: Path, said: str, tasks: Sequence[Task]) -> tuple[list[tuple[dict, list]], int]:
    """Results of tasks (`worked`), in their order, and how many of them were there before.

    Raises CampaignStopped where a worker dies: what is finished is kept.
    """
    if not tasks:
        return [], 0
    folder.mkdir(exist_ok=True)
    results: dict[str, tuple] = {}
    there = sum(_kept(folder / f"{task.key}.npz") is not None for task in tasks)
    kept, how = None if plan.sends else folder.absolute(), plan.how
    try:
        with (
            opened(how.backend, max(1, min(how.jobs, len(tasks))), how.dask_address) as execute,
            stage(said, float(len(tasks)), "of them", lambda: float(len(results))),
        ):
            for task, result in execute(partial(worked, kept), list(tasks)):
                results[task.key] = result
    except PoolBroken as broken:
        raise CampaignStopped(f"a worker process ended: {broken}; what is finished is kept") from broken
    return [results[task.key] for task in tasks], there


def worked(folder: Path | None, task: Task) -> tuple[dict, list[np.ndarray]]:
    """The result of a task and its points, kept in the folder; a fault of the code is a result with its reason."""
    path = None if folder is None else folder / f"{task.key}.npz"
    if path is not None and (found := _kept(path)) is not None:
        return found
    try:
        result, points = task.do(task.line, *task.given)
    except (ArithmeticError, ValueError) as why:
        result, points = {"reason": str(why)}, []
    if path is not None:
        content = io.BytesIO()
        np.savez(content, told=np.array(json.dumps(result)), **{f"points_{i}": one for i, one in enumerate(points)})
        write_atomic(path, content.getvalue())
    return result, points


def _kept(path: Path) -> tuple[dict, list[np.ndarray]] | None:
    """What a file holds; None where there is none, or a damaged one."""
    try:
        with np.load(path, allow_pickle=False) as content:
            return json.loads(str(content["told"])), [content[f"points_{i}"] for i in range(len(content) - 1)]
    except Exception:  # numpy, zipfile and json each have their own
        return None
