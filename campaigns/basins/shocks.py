"""The smallest start that leads to a motion, on the grid of the line and on a finer one.

It is the minimal fatal shock (Halekotte & Feudel, Sci. Rep. 10, 11783, 2020).
"""

from collections.abc import Callable, Sequence
from functools import partial
from itertools import compress
from operator import attrgetter
from typing import NamedTuple

from campaigns.basins.exploration import Exploration
from campaigns.explore.motions import MOTION, Motion, write_part
from campaigns.explore.starts import KICKS
from engine.scene.finer import finer
from tables import MESSAGE, NODES, STATUS, Column, Row

FIRST = 24  # smallest starts of the grid that lead there: on the finer grid some of them may not
Polar = tuple[float, float]  # turn and size of a start
FOLDER = "shock"
SHARP = 0.01  # of the size
RAYS = 16  # bisected side by side
NARROWER = 4.0  # the next rays lie within this part of the angle about the best one
LEAST_TURN = 0.02  # rad between rays below which no better one is looked for
_size = attrgetter("size")
COLUMNS = (
    MOTION,
    NODES,
    *KICKS,
    Column("size", "m/s or m", "size", "size of the smallest start that leads to the motion, as of its kick", 3),
    Column("size_without", "m/s or m", "without", "largest size known below it, in its direction, that does not", 3),
    STATUS,
    MESSAGE,
)


def shocks(exploration: Exploration, target: Motion) -> list[Row]:
    """The rows of COLUMNS, which are written to shock/table.csv; a row a grid of the line. Raises as `runner.run`."""
    grid, points, candidates = exploration.grid, exploration.grid.points(), []
    for number, ending in exploration.endings.items():
        if ending.motion is target:
            candidates.append(grid.polar(*points[number]))
    candidates = sorted(candidates, key=lambda polar: polar[1])[:FIRST]
    rows = []
    for scene in (exploration.scene, finer(exploration.scene, elements=2)):
        rows.append(_row(exploration, target, scene, candidates))
    write_part(exploration.plan, FOLDER, COLUMNS, rows)
    return rows


def _row(exploration: Exploration, target: Motion, scene, candidates: Sequence[Polar]) -> Row:
    row = {"motion": target.branch.letter, "nodes": scene.tether.nodes}
    leads = partial(_leads, exploration, target, scene)
    successful = candidates
    if scene is not exploration.scene:
        successful = list(compress(candidates, leads(candidates)))
    if not successful:
        return row | {"status": "none", "message": f"none of {len(candidates)} starts of the grid leads there"}
    least = Shock(*successful[0], 0.0)
    if least.size > 0.0:
        least = smallest(leads, least, exploration.grid.round)
    start = exploration.grid.at(least.turn, least.size, "").labels()
    return row | start | {"size": least.size, "size_without": least.below, "status": "ok"}


def _leads(exploration: Exploration, target: Motion, scene, starts: Sequence[Polar]) -> list[bool]:
    """Whether starts, each a turn and a size, lead to the target in a scene."""
    title = f"smallest start, {scene.tether.nodes} nodes"
    starts_there = [exploration.grid.at(turn, size, title) for turn, size in starts]
    return [ending.motion is target for ending in exploration.run(title, starts_there, scene)]


class Shock(NamedTuple):
    """A start that leads there; along its ray the largest size found below it that does not."""

    turn: float
    size: float
    below: float


def smallest(leads: Callable, first: Shock, round_: float) -> Shock:
    """The smallest start that leads there, to SHARP of its size along its ray.

    leads(starts) -> whether each start (turn, size) leads there. first: one that does. round_: turns that there are.
    Sizes are bisected along RAYS of all turns, then along as many in a narrower part about the best ray, until that
    gains less than SHARP. A ray is left when a smaller start than any on it is known. Where what leads there is not
    one piece, smaller starts may hide between rays, and below a size on a ray that does not.
    """
    best, width = first, round_
    while True:
        previous_size = best.size
        best = _best_of(leads, _rays(leads, best, width))
        near = width / RAYS <= LEAST_TURN
        if near or (width < round_ and best.size > (1.0 - SHARP) * previous_size):
            return best
        width /= NARROWER


def _rays(leads: Callable, best: Shock, width: float) -> list[Shock]:
    """The best ray, and those of RAYS within a width about it on which a start of its size leads there too."""
    starts = []
    for k in range(RAYS):
        turn = best.turn + width * (k / RAYS - 0.5)
        if turn != best.turn:
            starts.append((turn, best.size))
    successful = compress(starts, leads(starts))
    return [best, *(Shock(*start, 0.0) for start in successful)]


def _best_of(leads: Callable, rays: list[Shock]) -> Shock:
    """The smallest start of the rays, which are bisected side by side."""
    while True:
        sharp, wide = [], []
        for ray in rays:
            uncertain = ray.size - ray.below > SHARP * ray.size
            (wide if uncertain else sharp).append(ray)
        if not wide:
            return min(rays, key=_size)
        rays = sharp + _bisected(leads, wide)
        least = min(rays, key=_size).size
        rays = [ray for ray in rays if ray.below < least]


def _bisected(leads: Callable, rays: Sequence[Shock]) -> list[Shock]:
    """The rays with half the uncertainty of their sizes."""
    middles = [(ray.turn, 0.5 * (ray.size + ray.below)) for ray in rays]
    bisected = []
    for ray, (_, middle), success in zip(rays, middles, leads(middles), strict=True):
        side = "size" if success else "below"
        bisected.append(ray._replace(**{side: middle}))
    return bisected
