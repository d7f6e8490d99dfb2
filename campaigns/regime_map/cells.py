"""Cells of a map: where they lie, which are beside each other, and how one is bisected into four (a quadtree)."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import filterfalse, product
from typing import NamedTuple

from campaigns.explore.grid import Grid, Varied
from campaigns.machinery import Job
from campaigns.study import Order
from tables import Row

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
        i, j = 2 * self.i, 2 * self.j
        return [Cell(self.page, self.level + 1, *place) for place in product((i, i + 1), (j, j + 1))]

    def parent(self) -> "Cell":
        """The cell of which it is a part."""
        return Cell(self.page, self.level - 1, self.i // 2, self.j // 2)

    def next(self, side: tuple[int, int]) -> "Cell":
        """The cell of its level across a side."""
        return Cell(self.page, self.level, self.i + side[0], self.j + side[1])


@dataclass(frozen=True)
class CellGrid(Grid):
    """Cells over two keys. keys: those along i and j; before them that of the pages, where there is one."""

    @property
    def axes(self) -> tuple[Varied, ...]:
        """The keys along i and j."""
        return self.keys[-2:]

    @property
    def page(self) -> Varied | None:
        """The key of the pages."""
        return next(iter(self.keys[:-2]), None)

    def coarse(self) -> list[Cell]:
        """The cells of level 0, page by page."""
        pages, levels = range(1), (0,)
        if self.page is not None:
            pages = range(len(self.page.values))
        along_i, along_j = self.axes
        numbers = range(len(along_i.values)), range(len(along_j.values))
        return [Cell(*numbers_of_cell) for numbers_of_cell in product(pages, levels, *numbers)]

    def labels(self, cell: Cell) -> Row:
        """The values of the keys at the centre of a cell."""
        labels = {}
        if self.page is not None:
            labels[self.page.key] = self.page.values[cell.page]
        for key, number in zip(self.axes, (cell.i, cell.j), strict=True):
            if cell.level == 0:
                labels[key.key] = key.values[number]
            else:
                labels[key.key] = float(f"{key.values[0] + _step(key) * _centre(number, cell.level):.12g}")
        return labels

    def widths(self, cell: Cell) -> dict[str, float]:
        """The size of a cell along both keys, by column."""
        return {f"width_{key.key}": _step(key) / 2**cell.level for key in self.axes}

    def job_at(self, order: Order, cell: Cell) -> Job | None:
        """The run from rest of a cell, as `Grid.job`."""
        return self.job(order, self.labels(cell), most=order.options.budget, level=cell.level)


def _step(key: Varied) -> float:
    return (key.values[-1] - key.values[0]) / (len(key.values) - 1)


def _centre(number: int, level: int) -> float:
    """Where the centre of a part lies, in coarse cells from the centre of the first."""
    return (number + 0.5) / 2**level - 0.5


class Quadtree:
    """The cells of a map by their number, and the cells beside each."""

    def __init__(self) -> None:
        self.cells = []
        self.number = {}  # by cell
        self._neighbours = {}  # by number

    def add(self, cells: list[Cell]) -> None:
        """Add cells; the four parts of a bisected one come together."""
        for cell in cells:
            self.number[cell] = len(self.cells)
            self.cells.append(cell)
        self._neighbours.clear()

    def bisected(self, cell: Cell) -> bool:
        """Whether a cell has parts."""
        return cell.parts()[0] in self.number

    def leaves(self) -> list[Cell]:
        """The cells that are not bisected."""
        return list(filterfalse(self.bisected, self.cells))

    def touching(self, cell: Cell) -> Iterator[Cell]:
        """The cells without parts that have a side, or a part of one, in common with a cell."""
        for side in SIDES:
            neighbour = cell.next(side)
            while neighbour not in self.number and neighbour.level > 0:
                neighbour = neighbour.parent()
            if neighbour in self.number:
                yield from self._facing(neighbour, side)

    def _facing(self, cell: Cell, side: tuple[int, int]) -> Iterator[Cell]:
        """The cells without parts in a cell, along the side that looks back."""
        if not self.bisected(cell):
            yield cell
            return
        for part in cell.parts():
            back = part.next((-side[0], -side[1]))
            if back.parent() != cell:
                yield from self._facing(part, side)

    def neighbours(self, place: int) -> dict[int, str]:
        """The cells to which motions of a cell are carried, by number: those that touch it, its parts and its parent.

        A cell that is bisected keeps to cells of its level, and to its parts.
        """
        if place not in self._neighbours:
            cell = self.cells[place]
            near = [*map(cell.next, SIDES), *cell.parts()]
            if not self.bisected(cell):
                near += self.touching(cell)
            if cell.level:
                near.append(cell.parent())
            numbers = [self.number[neighbour] for neighbour in near if neighbour in self.number]
            self._neighbours[place] = dict.fromkeys(numbers, CARRIED)
        return self._neighbours[place]
