"""The smallest start that leads to a motion, on the grid of the line and on a finer one."""

from collections.abc import Sequence
from functools import partial
from itertools import compress

from campaigns.basins.exploration import Exploration
from campaigns.basins.smallest import Shock, smallest
from campaigns.explore.motions import MOTION, Motion, subfolder
from campaigns.explore.starts import KICKS
from campaigns.finer import finer
from tables import MESSAGE, STATUS, Column, write_table

FIRST = 24  # smallest starts of the grid that lead there: on the finer grid some of them may not
FOLDER = "shock"
COLUMNS = (
    MOTION,
    Column("nodes", "", "nodes", "nodes of the line", 0),
    *KICKS,
    Column("size", "m/s or m", "size", "size of the smallest start that leads to the motion, as of its kick", 3),
    Column("size_without", "m/s or m", "without", "largest size known below it, in its direction, that does not", 3),
    STATUS,
    MESSAGE,
)


def shocks(exploration: Exploration, target: Motion) -> list[dict[str, object]]:
    """The rows of COLUMNS, which are written to shock/table.csv; a row a grid of the line. Raises as `runner.run`."""
    grid, points, candidates = exploration.grid, exploration.grid.points(), []
    for number, ending in exploration.endings.items():
        if ending.motion is target:
            candidates.append(grid.polar(*points[number]))
    candidates = sorted(candidates, key=lambda polar: polar[1])[:FIRST]
    rows = []
    for scene in (exploration.scene, finer(exploration.scene, elements=2)):
        rows.append(_row(exploration, target, scene, candidates))
    write_table(subfolder(exploration.plan, FOLDER) / "table.csv", COLUMNS, rows)
    return rows


def _row(
    exploration: Exploration, target: Motion, scene, candidates: Sequence[tuple[float, float]]
) -> dict[str, object]:
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
    del start["found_by"]
    return row | start | {"size": least.size, "size_without": least.below, "status": "ok"}


def _leads(exploration: Exploration, target: Motion, scene, starts: Sequence[tuple[float, float]]) -> list[bool]:
    """Whether starts, each a turn and a size, lead to the target in a scene."""
    title = f"smallest start, {scene.tether.nodes} nodes"
    starts_there = [exploration.grid.at(turn, size, title) for turn, size in starts]
    return [ending.motion is target for ending in exploration.run(title, starts_there, scene)]
