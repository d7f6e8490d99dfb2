"""Places to explore: keys of a scene with their values, and the run from rest of every combination of these.

A key is called in tables as it is on the command line, unless its column has another name: `campaigns.buoy_sweep` is
the sweep of waves.steepness with the column `steepness`.
"""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import reduce
from itertools import product

import engine
from campaigns.judge import judged_job, judged_scene
from campaigns.machinery import Job, cli, filled
from campaigns.study import Order
from tables import Column, Columns, Row, names

STEEPNESS = Column("steepness", "", "kA", "wave steepness: wave number times amplitude", 3)


@dataclass(frozen=True)
class Varied:
    """A key with its values.

    key: as on the command line, "water.depth_m", "start.buoy_velocity_mps[1]", "current.velocity_mps[2][0]" or
    "waves.components[0].amplitude_m".
    name: of the number or of the list in the scene.
    index: of the element of a list, a number for each list within it; () for a number.
    part: the number in an element that is a table; "" for an element that is a number.
    column: of tables, with its name, unit and symbol.
    """

    key: str
    name: str
    index: tuple[int, ...]
    values: tuple
    column: Column
    part: str = ""

    def put(self, value: float, base, changes: dict) -> Iterator[str]:
        """Put a value into the changes of a scene; yields the fault of a list that has no such element.

        base: the scene whose list it is; two keys may change two elements of one list.
        """
        if not self.index:
            changes[self.name] = value
            return
        elements = changes.get(self.name)
        if elements is None:
            elements = reduce(lambda table, name: (table or {}).get(name), self.name.split("."), base.as_dict())
        element = _element(elements, self.index)
        if element is None:
            yield f"--vary {self.key}: the scene has no such element; {self.name} is {elements}"
            return
        if isinstance(element, list | tuple):
            yield f"--vary {self.key}: holds a list; allowed: one element of it, as {self.key}[0]"
            return
        if self.part:
            value = {**element, self.part: value}
        changes[self.name] = _with_element(elements, self.index, value)

    def of(self, scene) -> float | None:
        """The value of the key in a scene; None where it has none."""
        value = reduce(lambda section, name: getattr(section, name, None), self.name.split("."), scene)
        return _element(value, self.index)


def _element(elements, index: tuple[int, ...]):
    """The element of lists within lists; None where there is none. index: () for the whole."""
    for place in index:
        if not isinstance(elements, list | tuple) or place >= len(elements):
            return None
        elements = elements[place]
    return elements


def _with_element(elements, index: tuple[int, ...], value):
    """The lists with another value at an index."""
    if not index:
        return value
    place, *inner = index
    return [*elements[:place], _with_element(elements[place], inner, value), *elements[place + 1 :]]


def varied(
    words: list[str],
    faults: list[str],
    option: str = "--vary",
    of_words: bool = False,
    numbers: Sequence[float] | None = None,
    count: int | None = None,
) -> Varied | None:
    """The key and values of KEY LO HI COUNT; None where one is at fault. of_words: or of KEY WORD WORD ...

    numbers: of a program, in place of LO HI COUNT; the only word is then the key. count: of a program, after KEY LO HI.
    """
    from engine.scene.faults import suggestion
    from engine.scene.reference import keys

    key = words[0]
    list_name, places, part = re.fullmatch(r"(?s)(.*?)(?:((?:\[\d+\])+)(?:\.(\w+))?)?", key).groups("")
    name = ".".join(filter(None, (list_name, part)))
    declared = keys().get(name)
    kind = declared and declared.kind
    text, digits = of_words and kind == "text", None
    if text:
        values = words[1:]
        if not values:
            faults.append(f"{option} {key}: given nothing; allowed: its words")
    else:
        values = numbers or cli.evenly(words[1:], f"{option} {key}", faults, count=count)
        digits = max((len(f"{value:.6f}".rstrip("0").partition(".")[2]) for value in values), default=0)
    if declared is None:
        faults.append(f"{option} {key}: no such key{suggestion(name, list(keys()))}")
        return None
    if kind == "list" and not places:
        faults.append(f"{option} {key}: holds a list; allowed: one element of it, as {name}[0]")
        return None
    if kind not in ("number", "whole number", "list") and not text:
        faults.append(f"{option} {key}: holds a {kind}; allowed: a key that holds a number")
        return None
    if kind == "whole number":
        broken = [value for value in values if value != round(value)]
        if broken and count is None:
            faults.append(f"{option} {key}: given {broken[0]:g}; allowed: whole numbers")
        values, digits = map(round, values), 0
    values = tuple(dict.fromkeys(values))
    if not values:
        return None
    symbol = declared.symbol
    if symbol in ("", "-", "–"):
        symbol = key.rpartition(".")[2].replace("_", " ")
    meaning = declared.meaning[:1].lower() + declared.meaning[1:].rstrip(".")
    column = Column(key, declared.unit.removesuffix("1"), symbol, meaning, digits)
    index = tuple(map(int, re.findall(r"\d+", places)))
    return Varied(key, list_name, index, values, column, part)


@dataclass(frozen=True)
class Grid:
    """The keys of an exploration; a place has a value of each. Without a key there is one place."""

    keys: tuple[Varied, ...] = ()

    @property
    def columns(self) -> Columns:
        """Those that name a place."""
        return tuple(key.column for key in self.keys)

    def places(self) -> Iterator[Row]:
        """The columns of every place."""
        for values in product(*(key.values for key in self.keys)):
            yield filled(self.columns, values)

    def base(self, order: Order, tell: bool = False) -> "engine.Scene | None":
        """`Order.base`; with the first values of the keys where the scene cannot be without them."""
        first = {key.name: key.values[0] for key in self.keys if not key.index}
        return order.base() or order.base(first, tell)

    def refuse_set(self, order: Order, instead: str = "; use --vary") -> None:
        """A key that is varied cannot be set too."""
        for key in self.keys:
            if key.key in order.changes:
                order.tell(f"--set {key.key}: this campaign sets it{instead}")

    def changes(self, place: Row, base) -> tuple[dict, list]:
        """What the scene `base` is changed by at a place, and the faults of lists without such an element."""
        changes, faults = {}, []
        for key in self.keys:
            faults += key.put(place[key.column.name], base, changes)
        return changes, faults

    def job(self, order: Order, place: Row, most: int | None = None, **labels: object) -> Job | None:
        """The judged run from rest of a place, with more labels; None where there is no such scene: it is told.

        most: as of `campaigns.judge.judged_job`.
        """
        changes, faults = self.changes(place, self.base(order))
        order.tell(*faults)
        if faults:
            return None
        scene = judged_scene(order, changes)
        if scene is None:
            return None
        return judged_job(order, {**place, **labels, "dimensions": scene.motion.dimensions}, scene, most=most)


def place_in(row: Row, keys: Columns) -> tuple:
    """The values of the keys in a row."""
    return tuple(row[name] for name in names(keys))


def grid_of(words: list[str], faults: list[str], least: int = 0, example: str = "") -> Grid:
    """The grid over the keys in the words of --vary: KEY LO HI COUNT of each, at least so many times, at most twice."""
    if len(words) not in range(4 * least, 9, 4):
        allowed = f"once or twice KEY LO HI COUNT{example}"
        faults.append(f"--vary: given {' '.join(words) or 'nothing'}; allowed: {allowed}")
        return Grid()
    keys = [varied(words[first : first + 4], faults) for first in range(0, len(words), 4)]
    grid = Grid(tuple(filter(None, keys)))
    if len({key.key for key in grid.keys}) < len(grid.keys):
        faults.append(f"--vary {grid.keys[0].key}: given twice; allowed: two different keys")
    return grid
