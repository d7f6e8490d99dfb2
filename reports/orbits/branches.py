"""The branches of a folder of orbits as its report sees them: values along each, events between, what is stable."""

from collections.abc import Iterator, Mapping, Sequence
from itertools import cycle, groupby
from operator import itemgetter
from typing import NamedTuple

import numpy as np

from tables import PEAK, any_rows, number_of

from ..figures.curves import COLOURS, Curve, dots, with_gaps
from ..figures.quantities import colours_of
from ..parts import Folder, Row, having, series
from ..parts.style import INK

EVENTS = {"fold": "D", "flip": "s", "torus": "^"}  # kinds, with their marks
DASHED = (0, (3.5, 1.5))
MODULUS = "multiplier_modulus"


class Branch(NamedTuple):
    """One branch: m points along it are its orbits and, between them, its events.

    orbits, events: rows of the tables. at (m,): of the key. seen: "strobes" (m, N), r in m; "peak" (m, 1), largest
    tension in kN; "modulus" (m, 1), of the first multiplier. kinds (m,): of events, "" for an orbit. stable (m - 1,):
    whether it is from one point to the next.
    """

    name: str
    orbits: Sequence[Row]
    events: Sequence[Row]
    colour: str
    at: np.ndarray
    seen: Mapping[str, np.ndarray]
    kinds: np.ndarray
    stable: np.ndarray

    @property
    def changes(self) -> np.ndarray:
        """Points at which it becomes stable or unstable; at an event that was located, or at an orbit."""
        return np.flatnonzero(self.stable[1:] != self.stable[:-1]) + 1

    def lines(self, quantity: str) -> Iterator[Curve]:
        """A quantity of `seen` over the key: solid where the orbits are stable, dashed where they are not."""
        first = 0
        for stable, group in groupby(self.stable):
            part = slice(first, first + len(list(group)) + 1)
            first = part.stop - 1
            x, y = self._points(quantity, part)
            line, width = ("-", 1.3) if stable else (DASHED, 0.9)
            yield Curve(with_gaps(x.T), with_gaps(y.T), "", line, colour=self.colour, width=width)

    def marks(self, quantity: str) -> Iterator[Curve]:
        """The same at the events."""
        for kind, mark in EVENTS.items():
            x, y = self._points(quantity, self.kinds == kind)
            yield dots(x.ravel(), y.ravel(), mark, INK, 3.4)

    def _points(self, quantity: str, part) -> tuple[np.ndarray, np.ndarray]:
        y = self.seen[quantity][part]
        return np.broadcast_to(self.at[part][:, None], y.shape), y


def read_branches(folder: Folder, key: str, motions: Sequence[Row]) -> list[Branch]:
    """The branches, each in the colour of the motion on it; one that begins at an event of another has its colour."""
    letters, parents, strobes = {}, {}, {}
    for row in folder.part("branches").table:
        letters[row["branch"]] = row["motion"].partition(" ")[0]
    events = [row for row in folder.part("events").table if np.isfinite(row[key])]
    for row in events:
        parents[row["leads_to"]] = row["branch"]
    parents.pop("", None)
    for row in any_rows(folder.directory / "strobes.csv"):
        strobes.setdefault((row["branch"], int(row["place"])), []).append(float(row["radius_m"]))
    orbits_of_branches = {}
    for row in folder.table:
        orbits = orbits_of_branches.setdefault(row["branch"], [])
        if (row["branch"], row["place"]) in strobes:
            orbits.append(row)
    colours_of_motions, free_colours, colours, branches = colours_of(motions), cycle(COLOURS), {}, []
    for name, orbits in orbits_of_branches.items():
        colour = colours_of_motions.get(letters.get(name)) or colours.get(parents.get(name)) or next(free_colours)
        colours[name] = colour
        if not orbits:
            continue
        orbits.sort(key=itemgetter("place"))
        points = np.array([strobes[name, row["place"]] for row in orbits])
        on_branch = having(events, branch=name)
        branches.append(Branch(name, orbits, on_branch, colour, *_with_events(orbits, on_branch, key, points)))
    return branches


def _with_events(orbits: Sequence[Row], events: Sequence[Row], key: str, strobes: np.ndarray) -> tuple:
    """at, seen, kinds and stable of a `Branch`: an event stands between the two orbits whose chord is nearest."""
    steady = series(orbits, "unstable") == 0
    table = np.column_stack([series(orbits, key), series(orbits, PEAK), series(orbits, MODULUS), strobes])
    nodes = [(float(place), "", steady[place], row) for place, row in enumerate(table)]
    if len(table) < 2:
        events = ()
    for event in events:
        point = np.array([number_of(event, key), number_of(event, PEAK)])
        place, share = _changing_chord(steady, *_nearest(table[:, :2], point))
        row = (1.0 - share) * table[place] + share * table[place + 1]
        row[:2] = np.where(np.isfinite(point), point, row[:2])
        sides = steady[place : place + 2]
        if sides.any() and not sides.all():
            row[2] = 1.0
        nodes.append((place + 0.001 + 0.998 * share, event["kind"], sides.any(), row))
    nodes.sort(key=itemgetter(0))
    _, kinds, stable, rows = map(np.array, zip(*nodes, strict=True))
    seen = {"strobes": rows[:, 3:], "peak": 1e-3 * rows[:, 1:2], "modulus": rows[:, 2:3]}
    return rows[:, 0], seen, kinds, stable[1:] & stable[:-1]


def _changing_chord(steady: np.ndarray, place: int, share: float) -> tuple[int, float]:
    """Place and share of an event; on the chord beside it, where the stability changes there and not here, because
    another accuracy moves an event that far."""
    changes = steady[1:] != steady[:-1]
    for neighbour, end in ((place + 1, 0.0), (place - 1, 1.0)):
        if not changes[place] and 0 <= neighbour < len(changes) and changes[neighbour]:
            return neighbour, end
    return place, share


def _nearest(points: np.ndarray, target: np.ndarray) -> tuple[int, float]:
    """(i, share of the way from point i to the next) of the chord of points (m, 2) that is nearest to a target (2,)."""
    scale = np.maximum(np.ptp(points, axis=0), 1e-12)
    starts, ways = points[:-1] / scale, np.diff(points / scale, axis=0)
    off = np.nan_to_num(target / scale - starts)
    share = np.clip((off * ways).sum(axis=1) / np.maximum((ways**2).sum(axis=1), 1e-24), 0.0, 1.0)
    place = int(np.argmin(((off - share[:, None] * ways) ** 2).sum(axis=1)))
    return place, float(share[place])
