"""The grid of starts: two things that a gust, a release or the moment of either decides, and their values."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product

PHASE = "phase"
PAIRS = ("vx vz", "vx phase", "vz phase", "x z")
COLUMNS = {
    "vx": "kick_x_mps",
    "vz": "kick_z_mps",
    "x": "displacement_x_m",
    "z": "displacement_z_m",
    PHASE: "phase_rad",
}
PHASES = 720  # in a wave period: those of a search are whole parts of it, and so fall on samples
GRID = "grid"  # found_by of its starts


@dataclass(frozen=True)
class StartGrid:
    """counts of starts along the two axes `across`; each from -size to size (m/s, m), phases all round.

    size: None until the scene is known.

    A start is also told by a turn and a size: direction and length of its kick; with a phase, the turn is that, and the
    second time round the kick goes the other way.
    """

    across: tuple[str, str]
    counts: tuple[int, int]
    size: float | None

    @property
    def round(self) -> float:
        """Turns (rad) that reach every start of a size."""
        return 2.0 * math.pi * (1 + (self.across[1] == PHASE))

    def values(self, axis: int) -> list[float]:
        """The values along an axis."""
        count = self.counts[axis]
        if self.across[axis] == PHASE:
            return [2.0 * math.pi * k / count for k in range(count)]
        return [float(f"{self.size * (2 * k / (count - 1) - 1):.12g}") for k in range(count)]

    def start(self, first: float, second: float, found_by: str = GRID):
        """The `Start` with these two coordinates."""
        from campaigns.explore.starts import Start  # slow to import

        coordinates = dict.fromkeys(("vx", "vz", "x", "z"), 0.0)
        coordinates |= zip(self.across, (first, second), strict=True)
        kick = coordinates["vx"], coordinates["vz"]
        displacement = coordinates["x"], coordinates["z"]
        return Start(found_by, kick, displacement, coordinates.get(PHASE))

    def at(self, turn: float, size: float, found_by: str):
        """The `Start` of a turn and a size."""
        if self.across[1] != PHASE:
            return self.start(round(size * math.cos(turn), 12), round(size * math.sin(turn), 12), found_by)
        part = round(turn / (2.0 * math.pi) * PHASES)
        if part // PHASES % 2:
            size = -size
        return self.start(size, 2.0 * math.pi * (part % PHASES) / PHASES, found_by)

    def polar(self, first: float, second: float) -> tuple[float, float]:
        """Turn and size of a start."""
        if self.across[1] != PHASE:
            return math.atan2(second, first), math.hypot(first, second)
        return second + 2.0 * math.pi * (first < 0.0), abs(first)

    def points(self) -> list[tuple]:
        """All of them, in the order of the table."""
        points = product(self.values(1), self.values(0))
        return [(first, second) for second, first in points]

    def beside(self, number: int) -> Iterator[int]:
        """The numbers of the points next to a point, along and across; phases go all round."""
        columns, rows = self.counts
        row, column = divmod(number, columns)
        for down, right in product((-1, 0, 1), repeat=2):
            beside_row, beside_column = row + down, column + right
            if self.across[1] == PHASE:
                beside_row %= rows
            is_on_grid = 0 <= beside_row < rows and 0 <= beside_column < columns
            if (down or right) and is_on_grid:
                yield beside_row * columns + beside_column

    def spread(self, seed: int) -> Iterator[int]:
        """The numbers of all points, so that any first part of them is spread over the grid (Halton's sequence)."""
        from scipy.stats import qmc

        (nx, nz), waiting = self.counts, dict.fromkeys(range(self.counts[0] * self.counts[1]))
        for x, z in qmc.Halton(2, seed=seed).random(2 * len(waiting)):
            number = int(z * nz) * nx + int(x * nx)
            if number in waiting:
                del waiting[number]
                yield number
        yield from waiting
