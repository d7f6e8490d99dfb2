"""Cells of a map: where they lie, which are beside each other, and how one is bisected into four (a quadtree)."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product
from typing import NamedTuple

from campaigns.sweep import Varied
from tables import Column

SIDES = ((1, 0), (-1, 0), (0, 1), (0, -1))
CARRIED = "carried"


class Cell(NamedTuple):
    """A cell: number of its page, its level (0: of the coarse grid), and its numbers along both keys, as if all cells
    were of this level.
    """

    page: int
    level: int
    i: int
    j: int

    def parts(self) -> list["Cell"]:
        """The four into which it is bisected."""
        return [Cell(self.page, self.level + 1, 2 * self.i + a, 2 * self.j + b) for a, b in product((0, 1), (0, 1))]

    def whole(self) -> "Cell":
        """The one of which it is a part."""
        return Cell(self.page, self.level - 1, self.i // 2, self.j // 2)

    def next(self, side: tuple[int, int]) -> "Cell":
        """The one of its level across a side."""
        return Cell(self.page, self.level, self.i + side[0], self.j + side[1])


@dataclass(frozen=True)
class Grid:
    """keys: of the map, along i and j; page: the third one, or None."""

    keys: tuple[Varied, Varied]
    page: Varied | None = None

    @property
    def every(self) -> tuple[Varied, ...]:
        """All keys, that of the pages first."""
        return self.keys if self.page is None else (self.page, *self.keys)

    @property
    def columns(self) -> tuple[Column, ...]:
        """Those of all keys."""
        return tuple(one.column for one in self.every)

    def coarse(self) -> list[Cell]:
        """The cells of level 0, page by page."""
        pages = range(1 if self.page is None else len(self.page.values))
        counts = (range(len(one.values)) for one in self.keys)
        return [Cell(page, 0, i, j) for page, i, j in product(pages, *counts)]

    def labels(self, cell: Cell) -> dict[str, object]:
        """The values of the keys at the centre of a cell."""
        found = {} if self.page is None else {self.page.key: self.page.values[cell.page]}
        for one, number in zip(self.keys, cell[2:], strict=True):
            at = (
                one.values[number] if cell.level == 0 else one.values[0] + self._step(one) * _centre(number, cell.level)
            )
            found[one.key] = at if cell.level == 0 else float(f"{at:.12g}")
        return found

    def widths(self, cell: Cell) -> tuple[float, ...]:
        """The size of a cell along both keys."""
        return tuple(self._step(one) / 2**cell.level for one in self.keys)

    def changes(self, cell: Cell, base) -> tuple[dict[str, object], list[str]]:
        """What the scene `base` is changed by at a cell, and the faults of lists without such an element."""
        labels, changes, faults = self.labels(cell), {}, []
        for one in self.every:
            faults += one.put(labels[one.key], base, changes)
        return changes, faults

    @staticmethod
    def _step(one: Varied) -> float:
        return (one.values[-1] - one.values[0]) / (len(one.values) - 1)


def _centre(number: int, level: int) -> float:
    """Where the centre of a part lies, in coarse cells from the centre of the first."""
    return (number + 0.5) / 2**level - 0.5


class Quadtree:
    """The cells of a map by their number, and what lies beside each."""

    def __init__(self) -> None:
        self.cells: list[Cell] = []
        self.number: dict[Cell, int] = {}
        self._beside: dict[int, dict[int, str]] = {}

    def add(self, cells: list[Cell]) -> None:
        """Add cells; the four parts of a bisected one come together."""
        for cell in cells:
            self.number[cell] = len(self.cells)
            self.cells.append(cell)
        self._beside.clear()

    def bisected(self, cell: Cell) -> bool:
        """Whether a cell has parts."""
        return cell.parts()[0] in self.number

    def leaves(self) -> list[Cell]:
        """The cells that are not bisected."""
        return [cell for cell in self.cells if not self.bisected(cell)]

    def touching(self, cell: Cell) -> Iterator[Cell]:
        """The cells without parts that have a side, or a part of one, in common with a cell."""
        for side in SIDES:
            there = cell.next(side)
            while there not in self.number and there.level > 0:
                there = there.whole()
            if there in self.number:
                yield from self._along(there, side)

    def _along(self, cell: Cell, side: tuple[int, int]) -> Iterator[Cell]:
        """The cells without parts in a cell, along the side that looks back."""
        if not self.bisected(cell):
            yield cell
            return
        for part in cell.parts():
            if all(not step or number % 2 == (step < 0) for step, number in zip(side, part[2:], strict=True)):
                yield from self._along(part, side)

    def beside(self, at: int) -> dict[int, str]:
        """The cells to which motions of a cell are carried, by number: those that touch it, its parts and its whole.

        One that is bisected keeps to cells of its level, and to its parts.
        """
        if at not in self._beside:
            cell = self.cells[at]
            near = [*(cell.next(side) for side in SIDES), *cell.parts()]
            near += [] if self.bisected(cell) else self.touching(cell)
            near += [cell.whole()] if cell.level else []
            found = (self.number.get(one) for one in near)
            self._beside[at] = dict.fromkeys((number for number in found if number is not None), CARRIED)
        return self._beside[at]
