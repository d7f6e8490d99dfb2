"""Curves of events over two keys: each fold, flip and torus point that was found along the first key is followed over
the second (`analysis.orbits.curves`). A curve is one task, whose result is kept, and so is each of its points."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import pairwise
from pathlib import Path

import numpy as np

import engine
from analysis.orbits import OrbitMap, follow_curve
from campaigns.explore.grid import Varied
from campaigns.explore.motions import subfolder
from campaigns.explore.multipliers import COUNT, cable_map
from campaigns.explore.tracing import SOURCES, Line, Scenes, Solved, line_task
from campaigns.machinery import Store, key_of, made_by
from campaigns.orbits.tables import ANGLE, KIND, PERIOD
from campaigns.orbits.tree import Tree
from tables import MESSAGE, STATUS, Column, Row, finite, of_words, write_table

FOLDER = "curves"
# of what is seen, and shares of the ranges; below `least` steps of time scatter an orbit by more than the curve moves
STEPS = {"step": 0.3, "least": 0.008, "longest": 0.5}
KNOWN = 0.02  # of the range of the first key: an event this near to a curve of its kind and period lies on it
CURVE = Column("curve", "", "curve", "number of the curve, from 1 on", 0)
PLACE = Column("place", "", "place", "number of the point along the curve, from 0 on; empty for a special point", 0)
_SPECIAL = (
    "cusp, extremum (of the second key: birth or death of an island there), fold-flip, or strong resonance 1:1 to 1:4"
)
SPECIAL = of_words("special", _SPECIAL, "point")
BEGINS = of_words("begins", "why the curve begins where it does")
ENDS = of_words("ends", "why the curve ends where it does")
OF = of_words("branch", "branch on which its first event was found")


@dataclass(frozen=True, eq=False)
class Plane:
    """The scenes of a line over a second key.

    line: of the first key. key: the second one; its first and last values are the range. value: of it on the line.
    points: folder of finished points; None where a worker does not see it.
    """

    line: Line
    key: Varied
    value: float
    points: Path | None = None

    @property
    def low(self) -> np.ndarray:
        """(2,) least values of the keys."""
        return np.array([self.line.low, self.key.values[0]])

    @property
    def high(self) -> np.ndarray:
        """(2,) largest values of the keys."""
        return np.array([self.line.high, self.key.values[-1]])

    def scene(self, values: tuple[float, float]):
        """The scene at values of both keys. Raises ArithmeticError where there is none."""
        return Scenes(self.line.scene(values[0]), self.key).at(values[1])

    @property
    def maps(self) -> OrbitMap:
        """The map of orbits, with parameters (2,)."""
        size = self.high - self.low
        cable, system = cable_map(self.scene, self.line.state, (self.line.value, self.value), size)

        def frozen(points, values, mesh):
            return [_of_array(image) for image in cable.frozen(points, tuple(map(float, values)), mesh)]

        return replace(system, step=_of_array(cable.step), frozen=frozen)

    @property
    def sharper_maps(self) -> OrbitMap:
        """The same at a tenth of the tolerance."""
        rtol = 0.1 * min(self.line.rtol, self.line.scenes.base.solver.rtol)
        return replace(self, line=replace(self.line, rtol=rtol)).maps

    def digest(self) -> str:
        """Of all that a curve depends on beside its first event."""
        own = made_by(*SOURCES, "campaigns/orbits/curves.py"), engine.source_hash()
        return key_of(self.line, self.key.key, *self.key.values, *own)


def _of_array(image):
    """A map whose parameters come as an array (2,)."""
    return lambda z, values: image(z, tuple(map(float, values)))


def curve(plane: Plane, kind: str, value: float, points: np.ndarray, most: int) -> Solved:
    """The curve of an event that was found at a value of the first key, with the points (N, 8 n) of its orbit."""
    place = np.array([value, plane.value])
    store, digest = Store(plane.points, ".point.json"), plane.digest()

    def kept(arguments, compute):
        return store.finished(key_of(digest, kind, *arguments), compute)

    settings = STEPS | {"most": most, "count": COUNT, "kept": kept, "sharper": plane.sharper_maps}
    followed = follow_curve(plane.maps, kind, points, place, plane.low, plane.high, **settings)
    begins, ends = followed.ends
    points, special = [*map(_point, followed.points)], [*map(_point, followed.special)]
    return {"reason": "", "points": points, "special": special, "begins": begins, "ends": ends}, []


def _point(point) -> dict:
    return {
        "values": point.parameters.tolist(),
        "errors": [finite(error) for error in point.errors],
        "angle_rad": point.angle_rad,
        "special": point.kind,
        "status": "ok" if point.found else "not-found",
        "message": point.reason,
    }


def curves_of(tree: Tree, plane: Plane) -> Iterator[Row]:
    """Rows of all curves of the events of a tree; an event on a curve that is known is not followed again."""
    known = []  # first event and result of each curve
    waiting = [(branch, event) for branch in tree.branches for event in branch.events]
    number = 0

    def is_new(event):
        return not any(_lies_on(event, *pair, plane) for pair in known)

    while waiting:
        following, waiting = waiting[: tree.plan.how.jobs], waiting[tree.plan.how.jobs :]
        tasks = []
        for branch, event in following:
            arguments = event["kind"], event["value"], branch.points[event["at"]], tree.most
            tasks.append(line_task(curve, plane, arguments))
        for (branch, event), (result, _) in zip(following, tree.work("curves", tasks), strict=True):
            if not is_new(event):  # it lies on the curve of one that was followed beside it
                continue
            number += 1
            label = {CURVE.name: number, "branch": branch.name, "kind": event["kind"], "period": event["period"]}
            if result["reason"]:
                yield label | {"status": "no-curve", "message": result["reason"]}
                continue
            known.append((event, result))
            yield from _rows(label, result, event, plane)
        waiting = [(branch, event) for branch, event in waiting if is_new(event)]


def _lies_on(event: dict, first: dict, result: dict, plane: Plane) -> bool:
    if (event["kind"], event["period"]) != (first["kind"], first["period"]):
        return False
    for begin, end in pairwise(point["values"] for point in result["points"]):
        low, high = sorted((begin, end), key=lambda values: values[1])
        if low[1] <= plane.value <= high[1] and low[1] < high[1]:
            there = np.interp(plane.value, [low[1], high[1]], [low[0], high[0]])
            if abs(there - event["value"]) < KNOWN * plane.line.size:
                return True
    return False


def _rows(label: Row, result: dict, event: dict, plane: Plane) -> Iterator[Row]:
    """The points of a curve. To errors of the first key is added what a finer grid changes of its event, and they are
    no smaller than the error of that; those of the second key grow in proportion."""
    first, second = plane.line.scenes.key.column, plane.key.column
    floor = event["error"] or 0.0
    of_grid, grid = "errors are those of this grid alone", 0.0
    if event.get("finer"):
        of_grid, grid = "", abs(event["finer"] - event["value"])
    label = label | {"begins": result["begins"], "ends": result["ends"]}
    for part in ("points", "special"):
        for place, point in enumerate(result[part]):
            error = point["errors"][0]
            scale = 1.0
            if error and point["status"] == "ok":
                scale = max(error + grid, floor) / error
            row = label | point
            errors = [known and scale * known for known in point["errors"]]
            yield row | {
                PLACE.name: place if part == "points" else None,
                first.name: point["values"][0],
                second.name: point["values"][1],
                "error_1": errors[0],
                "error_2": errors[1],
                "message": point["message"] or of_grid,
            }


def write_curves(tree: Tree, plane: Plane) -> None:
    """Write curves/table.csv, with its columns. Raises OSError and CampaignStopped."""
    folder = subfolder(tree.plan, FOLDER)
    first, second = (replace(key.column, digits=5) for key in (plane.line.scenes.key, plane.key))
    meaning = (
        "change over three sequences of steps and change at a tenth of the tolerance, together, where the other key "
        "is held, and the change of its first event on a finer grid; empty for the reason in message"
    )
    errors = [
        Column("error_1", first.unit, f"± {first.symbol}", f"{meaning}; at least that of its event", 6),
        Column("error_2", second.unit, f"± {second.symbol}", meaning, 6),
    ]
    columns = CURVE, PLACE, OF, PERIOD, KIND, SPECIAL, first, second, *errors, ANGLE, BEGINS, ENDS, STATUS, MESSAGE
    write_table(folder / "table.csv", columns, [*curves_of(tree, plane)])
