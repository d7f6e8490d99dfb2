"""The smallest start that leads to a motion, on the grid of the line and on a finer one."""

from collections.abc import Sequence
from functools import partial

from campaigns.basins.found import Found
from campaigns.basins.smallest import Shock, smallest
from campaigns.explore.along import MOTION, Motion
from campaigns.explore.starts import KICKS
from engine.scene import scene_from_toml
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


def shocks(found: Found, target: Motion) -> list[dict[str, object]]:
    """The rows of COLUMNS, which are written to shock/table.csv; a row a grid of the line. Raises as `runner.run`."""
    nodes = found.scene.tether.nodes
    finer = scene_from_toml(found.scene.to_toml(), {"tether.nodes": 2 * nodes - 1})
    points = found.grid.points()
    there = [found.grid.polar(*points[number]) for number, one in found.ended.items() if one.motion is target]
    there.sort(key=lambda polar: polar[1])
    rows = [_row(found, target, scene, there[:FIRST]) for scene in (found.scene, finer)]
    (found.plan.how.out / FOLDER).mkdir(exist_ok=True)
    write_table(found.plan.how.out / FOLDER / "table.csv", COLUMNS, rows)
    return rows


def _row(found: Found, target: Motion, scene, candidates: Sequence[tuple[float, float]]) -> dict[str, object]:
    nodes = scene.tether.nodes
    told = {"motion": target.branch.letter, "nodes": nodes}
    leads = partial(_leads, found, target, scene)
    there = (
        candidates
        if scene is found.scene
        else [one for one, led in zip(candidates, leads(candidates), strict=True) if led]
    )
    if not there:
        return told | {"status": "none", "message": f"none of {len(candidates)} starts of the grid leads there"}
    least = Shock(*there[0], 0.0)
    if least.size > 0.0:
        least = smallest(leads, least, found.grid.round)
    start = found.grid.at(least.turn, least.size, "").labels()
    del start["found_by"]
    return told | start | {"size": least.size, "size_without": least.below, "status": "ok"}


def _leads(found: Found, target: Motion, scene, starts: Sequence[tuple[float, float]]) -> list[bool]:
    said = f"smallest start, {scene.tether.nodes} nodes"
    ended = found.along.starts.run(said, [found.asked(found.grid.at(*one, said), scene) for one in starts])
    return [found.led(one) is target for one in ended]
